// Poses of all bodies at one time: position, attitude and the matrix from body to ground.
import { Object3D } from "three";
import { bodyColour, GROUND } from "./colours.js";

const IDENTITY = [0, 0, 0, 1];

/** q = a b for quaternions x, y, z, w. */
export function multiplyQuaternions(a, b, out) {
    const [ax, ay, az, aw] = a;
    const [bx, by, bz, bw] = b;
    out[0] = aw * bx + ax * bw + ay * bz - az * by;
    out[1] = aw * by - ax * bz + ay * bw + az * bx;
    out[2] = aw * bz + ax * by - ay * bx + az * bw;
    out[3] = aw * bw - ax * bx - ay * by - az * bz;
    return out;
}

/** Writes the 4 x 4 matrix (by columns) of a position and an attitude. */
export function composeMatrix(m, o, x, y, z, qx, qy, qz, qw) {
    m[o] = 1 - 2 * (qy * qy + qz * qz);
    m[o + 1] = 2 * (qx * qy + qz * qw);
    m[o + 2] = 2 * (qx * qz - qy * qw);
    m[o + 3] = 0;
    m[o + 4] = 2 * (qx * qy - qz * qw);
    m[o + 5] = 1 - 2 * (qx * qx + qz * qz);
    m[o + 6] = 2 * (qy * qz + qx * qw);
    m[o + 7] = 0;
    m[o + 8] = 2 * (qx * qz + qy * qw);
    m[o + 9] = 2 * (qy * qz - qx * qw);
    m[o + 10] = 1 - 2 * (qx * qx + qy * qy);
    m[o + 11] = 0;
    m[o + 12] = x;
    m[o + 13] = y;
    m[o + 14] = z;
    m[o + 15] = 1;
}

/** out = a b for rigid or scaled 4 x 4 matrices (last row 0 0 0 1), each at its offset. */
export function multiplyMatrices(a, ao, b, bo, out, oo) {
    for (let c = 0; c < 16; c += 4) {
        const x = b[bo + c];
        const y = b[bo + c + 1];
        const z = b[bo + c + 2];
        const w = c === 12 ? 1 : 0;
        out[oo + c] = a[ao] * x + a[ao + 4] * y + a[ao + 8] * z + a[ao + 12] * w;
        out[oo + c + 1] = a[ao + 1] * x + a[ao + 5] * y + a[ao + 9] * z + a[ao + 13] * w;
        out[oo + c + 2] = a[ao + 2] * x + a[ao + 6] * y + a[ao + 10] * z + a[ao + 14] * w;
        out[oo + c + 3] = w;
    }
}

export class Bodies {
    /** `described`: bodies of a scene (null where a second result has none); `swinging`: numbers of
     *  those that move in a mode. */
    constructor(described, archive, clock, swinging = new Set()) {
        this.clock = clock;
        this.list = described.map((body) => body ?? { name: "", label: "", kind: "none", position: [NaN, NaN, NaN] });
        this.count = this.list.length;
        this.positions = this.list.map((body) => archive.track(body.position));
        this.attitudes = this.list.map((body) => archive.track(body.attitude ?? IDENTITY));
        this.matrices = new Float32Array(16 * this.count);
        this.poses = new Float32Array(7 * this.count);
        this.moving = this.list.map((_, b) => this.positions[b].moves || this.attitudes[b].moves || swinging.has(b));
        this.movers = Uint32Array.from(this.list.keys()).filter((b) => this.moving[b]);
        this.colours = this.list.map((body, b) => (body.kind === "ground" || b === 0 ? GROUND : bodyColour(b - 1)));
        this.objects = this.list.map((body, b) => this.#object(body, b));
        for (let b = 0; b < this.count; b += 1) this.#place(b, 0, 0);
    }

    // The three.js object of a body shares its matrix with what is drawn.
    #object(body, b) {
        const object = new Object3D();
        object.name = body.name;
        object.matrixAutoUpdate = false;
        object.matrixWorldAutoUpdate = false;
        object.matrixWorld.elements = this.matrices.subarray(16 * b, 16 * b + 16);
        return object;
    }

    /** Index of the body of a name or label, -1 when there is none. */
    find(name) {
        const index = this.list.findIndex((body) => body.name === name);
        return index >= 0 ? index : this.list.findIndex((body) => body.label === name);
    }

    /** What a reader calls the body: its label and its statement. */
    title(b) {
        const { name, label } = this.list[b];
        return label && label !== name ? `${label} (${name})` : name;
    }

    setTime(time) {
        const { index, fraction } = this.clock.locate(time);
        for (const b of this.movers) this.#place(b, index, fraction);
    }

    #place(b, i, f) {
        const position = this.positions[b];
        const q = this.attitudes[b];
        let x = q.at(i, f, 0);
        let y = q.at(i, f, 1);
        let z = q.at(i, f, 2);
        let w = q.at(i, f, 3);
        const scale = 1 / Math.sqrt(x * x + y * y + z * z + w * w);
        x *= scale;
        y *= scale;
        z *= scale;
        w *= scale;
        this.setPose(b, position.at(i, f, 0), position.at(i, f, 1), position.at(i, f, 2), x, y, z, w);
    }

    setPose(b, x, y, z, qx, qy, qz, qw) {
        const { poses } = this;
        const o = 7 * b;
        poses[o] = x;
        poses[o + 1] = y;
        poses[o + 2] = z;
        poses[o + 3] = qx;
        poses[o + 4] = qy;
        poses[o + 5] = qz;
        poses[o + 6] = qw;
        composeMatrix(this.matrices, 16 * b, x, y, z, qx, qy, qz, qw);
    }

    /** Where a point [body, x, y, z] is, in ground axes. */
    point(at, out, o = 0) {
        const m = this.matrices;
        const k = 16 * at[0];
        const x = at[1];
        const y = at[2];
        const z = at[3];
        out[o] = m[k] * x + m[k + 4] * y + m[k + 8] * z + m[k + 12];
        out[o + 1] = m[k + 1] * x + m[k + 5] * y + m[k + 9] * z + m[k + 13];
        out[o + 2] = m[k + 2] * x + m[k + 6] * y + m[k + 10] * z + m[k + 14];
        return out;
    }

    /** Speed of a body's origin now: slope of its positions. */
    speed(b) {
        const track = this.positions[b];
        const [i, step] = this.#step();
        if (!track.moves || !step) return 0;
        return Math.hypot(...[0, 1, 2].map((c) => track.at(i + 1, 0, c) - track.at(i, 0, c))) / step;
    }

    /** Angular speed of a body now: the turn from one attitude to the next. */
    angularSpeed(b) {
        const track = this.attitudes[b];
        const [i, step] = this.#step();
        if (!track.moves || !step) return 0;
        // Unit quaternions of a turn by an angle are 2 sin(angle / 4) apart.
        const apart = Math.hypot(...[0, 1, 2, 3].map((c) => track.at(i + 1, 0, c) - track.at(i, 0, c)));
        return (4 * Math.asin(Math.min(apart / 2, 1))) / step;
    }

    /** The output step of the time shown: its first row and its length. */
    #step() {
        const { times, index } = this.clock;
        const i = Math.min(index, times.length - 2);
        return [i, i >= 0 ? times[i + 1] - times[i] : 0];
    }
}
