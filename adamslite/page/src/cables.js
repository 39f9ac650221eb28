// Cables: one line through points and around wheels, coloured by tension.
import { multiplyMatrices, composeMatrix } from "./bodies.js";
import { Strokes } from "./strokes.js";
import { contact, wrap } from "./tangents.js";

const ARC = 24; // straight pieces of an arc on a rim
const WIDTH = 5; // pixels

/** Lowest and highest tension of all cables, null when none has a tension. */
export function tensionRange(cables) {
    const known = cables.filter(({ tension, range }) => tension && range).map(({ range }) => range);
    if (!known.length) return null;
    const low = Math.min(...known.map(([from]) => from));
    const high = Math.max(...known.map(([, to]) => to));
    // What is nothing beside the other end is nothing.
    const least = 1e-6 * (high - low);
    return [low, high].map((value) => (Math.abs(value) < least ? 0 : value));
}

class Node {
    constructor({ point, wheel, radius, sense }) {
        this.at = (point ?? wheel).slice(0, 4);
        this.centre = new Float64Array(3);
        this.wheel = Boolean(wheel);
        if (!this.wheel) return;
        this.signed = radius * (sense < 0 ? -1 : 1);
        this.local = new Float32Array(16);
        composeMatrix(this.local, 0, ...wheel.slice(1));
        this.matrix = new Float32Array(16);
        this.arriving = [radius, 0];
        this.leaving = [radius, 0];
    }

    place(bodies) {
        bodies.point(this.at, this.centre);
        if (this.wheel) multiplyMatrices(bodies.matrices, 16 * this.at[0], this.local, 0, this.matrix, 0);
    }

    /** Where the straight part towards `other` touches this wheel. */
    touch(other, leaving) {
        const m = this.matrix;
        const x = other.centre[0] - this.centre[0];
        const y = other.centre[1] - this.centre[1];
        const z = other.centre[2] - this.centre[2];
        const dx = m[0] * x + m[1] * y + m[2] * z;
        const dy = m[4] * x + m[5] * y + m[6] * z;
        contact(dx, dy, this.signed, this.#seen(other), leaving, leaving ? this.leaving : this.arriving);
    }

    // The other wheel's radius and sense as seen along this wheel's axis.
    #seen(other) {
        if (!other.wheel) return 0;
        const a = this.matrix;
        const b = other.matrix;
        return other.signed * (a[8] * b[8] + a[9] * b[9] + a[10] * b[10]);
    }

    /** Ground coordinates of a place in the wheel's plane. */
    rim(x, y, out) {
        const m = this.matrix;
        for (let c = 0; c < 3; c += 1) out[c] = m[c] * x + m[4 + c] * y + m[12 + c];
    }
}

/** Whether a line ends on the wheel where it begins. */
function isLoop(nodes) {
    if (nodes.length < 3 || !nodes[0].wheel) return false;
    const last = nodes[nodes.length - 1];
    return last.wheel && nodes[0].at.every((value, k) => value === last.at[k]);
}

class Cable {
    constructor(described, archive, range, options) {
        this.nodes = described.nodes.map((node) => new Node(node));
        this.tension = archive.track(described.tension);
        this.range = range;
        const wheels = this.nodes.filter(({ wheel }) => wheel).length;
        this.strokes = new Strokes(Math.max(this.nodes.length - 1, 0) + wheels * ARC, {
            width: WIDTH,
            mapped: Boolean(this.tension && range),
            ...options,
        });
        this.pen = new Float64Array(3);
        this.next = new Float64Array(3);
        this.closed = isLoop(this.nodes);
    }

    /** Tension of part k as a fraction of the legend's range, -1 where it is not known. */
    #value(k, clock) {
        if (!this.tension) return -1;
        const last = this.nodes.length - 2;
        const value = this.tension.at(this.tension.moves ? clock.index : 0, clock.fraction, Math.min(Math.max(k, 0), last));
        if (!Number.isFinite(value)) return -1;
        const [low, high] = this.range;
        return high > low ? (value - low) / (high - low) : 0.5;
    }

    update(bodies) {
        const { nodes } = this;
        for (const node of nodes) node.place(bodies);
        for (let k = 0; k < nodes.length; k += 1) {
            if (!nodes[k].wheel) continue;
            if (k > 0) nodes[k].touch(nodes[k - 1], false);
            if (k < nodes.length - 1) nodes[k].touch(nodes[k + 1], true);
        }
        this.#draw(bodies.clock);
    }

    #draw(clock) {
        let piece = 0;
        for (let k = 0; k < this.nodes.length; k += 1) {
            const before = this.#value(k - 1, clock);
            const after = this.#value(k, clock);
            const node = this.nodes[k];
            const touch = k > 0 ? node.arriving : node.leaving;
            if (node.wheel) node.rim(touch[0], touch[1], this.next);
            else this.next.set(node.centre);
            if (k > 0) piece = this.#segment(piece, before, before);
            this.pen.set(this.next);
            if (node.wheel) piece = this.#arc(piece, node, k, k === this.nodes.length - 1 ? before : after, before);
        }
        this.strokes.touched();
    }

    // Around the rim, from where the line arrives to where it leaves; on a drum at an end, one turn.
    #arc(piece, node, k, after, before) {
        const last = k === this.nodes.length - 1;
        const [x, y] = k === 0 ? node.leaving : node.arriving;
        const angle = this.#angle(node, k, last);
        const from = k === 0 ? after : before;
        for (let n = 1; n <= ARC; n += 1) {
            const turn = (angle * n) / ARC;
            const c = Math.cos(turn);
            const s = Math.sin(turn);
            node.rim(x * c - y * s, x * s + y * c, this.next);
            const low = from + ((after - from) * (n - 1)) / ARC;
            piece = this.#segment(piece, low, from + ((after - from) * n) / ARC);
            this.pen.set(this.next);
        }
        return piece;
    }

    #angle(node, k, last) {
        const sense = Math.sign(node.signed);
        const end = k === 0 || last;
        if (end && !this.closed) return sense * 2 * Math.PI;
        if (k === 0) return 0;
        const leaving = last ? this.nodes[0].leaving : node.leaving;
        return sense * wrap(node.arriving[0], node.arriving[1], leaving[0], leaving[1], sense);
    }

    #segment(piece, from, to) {
        const { array } = this.strokes;
        const o = 8 * piece;
        for (let c = 0; c < 3; c += 1) {
            array[o + c] = this.pen[c];
            array[o + 4 + c] = this.next[c];
        }
        array[o + 3] = from;
        array[o + 7] = to;
        return piece + 1;
    }
}

export class Cables {
    constructor(scene, archive, bodies, stage, options = {}) {
        this.bodies = bodies;
        this.range = tensionRange(scene.cables);
        const look = { colour: stage.palette.line, theme: stage.theme, ...options };
        this.list = scene.cables.map((cable) => new Cable(cable, archive, this.range, look));
        for (const { strokes } of this.list) stage.addStrokes(strokes);
    }

    update() {
        for (const cable of this.list) cable.update(this.bodies);
    }

    setTheme(theme, palette) {
        for (const { strokes } of this.list) {
            if (strokes.material.uniforms.mapped.value) strokes.setTheme(theme);
            else strokes.setColour(palette.line);
        }
    }
}
