// From the page's blob to arrays of numbers.
import { unzlibSync } from "fflate";

/** Bytes of a base64 text. */
function fromBase64(text) {
    const raw = atob(text.trim());
    const bytes = new Uint8Array(raw.length);
    for (let k = 0; k < raw.length; k += 1) bytes[k] = raw.charCodeAt(k);
    return bytes;
}

/** Rows of numbers over time: `width` of them in each of `rows` rows, in `data`. */
export class Track {
    constructor(data, rows, width) {
        this.data = data;
        this.rows = rows;
        this.width = width;
    }

    get moves() {
        return this.rows > 1;
    }

    /** Component `c` between row i and the next one, of which the fraction f has passed. */
    at(i, f, c = 0) {
        if (this.rows === 1) return this.data[c];
        const first = this.data[i * this.width + c];
        if (f === 0) return first;
        return first + f * (this.data[(i + 1) * this.width + c] - first);
    }
}

/** The inflated blob of a page, from which array references are read. */
export class Archive {
    constructor(base64) {
        this.bytes = base64.trim() ? unzlibSync(fromBase64(base64)) : new Uint8Array(0);
    }

    /** A track from an array reference, or from the plain list of what does not move. */
    track(source) {
        if (source === null || source === undefined) return null;
        if (Array.isArray(source)) return new Track(Float32Array.from(source), 1, source.length);
        const [rows, ...rest] = source.shape;
        const width = rest.reduce((product, size) => product * size, 1);
        const count = rows * width;
        const data =
            source.coding === "i16"
                ? this.#quantised(source, rows, width)
                : new Float32Array(this.bytes.slice(source.at, source.at + 4 * count).buffer);
        return new Track(data, rows, width);
    }

    /** Plain data, or those that are kept as JSON text among the arrays. */
    list(source) {
        if (Array.isArray(source)) return source;
        const text = this.bytes.subarray(source.at, source.at + source.shape[0]);
        return JSON.parse(new TextDecoder().decode(text));
    }

    // value = low + step k; k is stored as differences from row to row modulo 65536, all low bytes
    // of them before all high bytes.
    #quantised({ at, low, step }, rows, width) {
        const count = rows * width;
        const components = low.length;
        const levels = new Uint16Array(width);
        const data = new Float32Array(count);
        for (let n = 0; n < count; n += 1) {
            const column = n % width;
            levels[column] += this.bytes[at + n] + 256 * this.bytes[at + count + n];
            const c = column % components;
            data[n] = low[c] + step[c] * levels[column];
        }
        return data;
    }
}
