// Arrows of forces, torques and reactions; the longest of a kind has a fixed length.
import { Color, DynamicDrawUsage, InstancedMesh, MeshBasicMaterial } from "three";
import { arrowHead, arrowShaft } from "./geometry.js";
import { stretchMatrix } from "./springs.js";

const LONGEST = 0.28; // of the mechanism's radius
const SHORTEST = 0.02; // of the longest: what is smaller is not drawn
export const KINDS = ["force", "torque", "reaction"];

/** Largest length of the vectors of one kind. */
function largest(tracks) {
    let square = 0;
    for (const { data } of tracks) {
        for (let k = 0; k + 2 < data.length; k += 3) {
            const size = data[k] ** 2 + data[k + 1] ** 2 + data[k + 2] ** 2;
            if (size > square) square = size;
        }
    }
    return Math.sqrt(square);
}

function instanced(geometry, colour, count) {
    const mesh = new InstancedMesh(geometry, new MeshBasicMaterial({ color: new Color(colour) }), count);
    mesh.instanceMatrix.setUsage(DynamicDrawUsage);
    mesh.frustumCulled = false;
    mesh.matrixAutoUpdate = false;
    return mesh;
}

class Kind {
    constructor(arrows, archive, bodies, colour, size) {
        this.arrows = arrows;
        this.bodies = bodies;
        this.tracks = arrows.map(({ vector }) => archive.track(vector));
        this.size = size;
        this.largest = largest(this.tracks);
        this.shafts = instanced(arrowShaft(), colour, arrows.length);
        // A torque has two heads, one behind the other.
        this.double = arrows.length > 0 && arrows[0].kind === "torque";
        this.heads = instanced(arrowHead(), colour, arrows.length * (this.double ? 2 : 1));
        this.from = [0, 0, 0];
        this.neck = [0, 0, 0];
        this.tip = [0, 0, 0];
        this.front = [0, 0, 0];
        this.rear = [0, 0, 0];
        this.visible = false;
    }

    set visible(shown) {
        this.shafts.visible = shown;
        this.heads.visible = shown;
    }

    get visible() {
        return this.shafts.visible;
    }

    update() {
        if (!this.visible || !(this.largest > 0)) return;
        for (let k = 0; k < this.arrows.length; k += 1) this.#place(k);
        this.shafts.instanceMatrix.needsUpdate = true;
        this.heads.instanceMatrix.needsUpdate = true;
    }

    #place(k) {
        const { index, fraction } = this.bodies.clock;
        const track = this.tracks[k];
        const { from, neck, tip } = this;
        const x = track.at(track.moves ? index : 0, fraction, 0);
        const y = track.at(track.moves ? index : 0, fraction, 1);
        const z = track.at(track.moves ? index : 0, fraction, 2);
        const share = Math.hypot(x, y, z) / this.largest;
        const long = share * LONGEST * this.size;
        const shown = share > SHORTEST;
        const head = Math.min(0.4 * long, 0.05 * this.size);
        this.bodies.point(this.arrows[k].at, from);
        for (let c = 0; c < 3; c += 1) {
            const direction = shown ? (c === 0 ? x : c === 1 ? y : z) / (share * this.largest) : 0;
            neck[c] = from[c] + direction * (long - head);
            tip[c] = from[c] + direction * long;
        }
        this.#draw(k, head, shown);
    }

    #draw(k, head, shown) {
        const { from, neck, tip } = this;
        const wide = shown ? 0.36 * head : 0;
        stretchMatrix(this.shafts.instanceMatrix.array, 16 * k, from, neck, shown ? 0.0055 * this.size : 0);
        this.#head(k, tip, neck, wide);
        if (!this.double) return;
        for (let c = 0; c < 3; c += 1) {
            this.rear[c] = neck[c] - 0.8 * (tip[c] - neck[c]);
            this.front[c] = tip[c] - 0.8 * (tip[c] - neck[c]);
        }
        this.#head(k + this.arrows.length, this.front, this.rear, wide);
    }

    /** Where the tips are over the whole motion, three numbers each. */
    tips(count) {
        const { times } = this.bodies.clock;
        const cloud = [];
        const frames = Math.max(Math.min(times.length, count), 1);
        for (let n = 0; n < frames; n += 1) {
            this.bodies.setTime(times[Math.round((n * (times.length - 1)) / Math.max(frames - 1, 1))] ?? 0);
            for (let k = 0; k < this.arrows.length; k += 1) {
                this.#place(k);
                if (Number.isFinite(this.tip[0] + this.tip[1] + this.tip[2])) cloud.push(...this.tip);
            }
        }
        return cloud;
    }

    // The head's geometry lies from its tip at z = 0 to its foot at z = -1.
    #head(k, tip, foot, width) {
        const m = this.heads.instanceMatrix.array;
        stretchMatrix(m, 16 * k, foot, tip, width);
        m[16 * k + 12] = tip[0];
        m[16 * k + 13] = tip[1];
        m[16 * k + 14] = tip[2];
    }
}

export class Arrows {
    constructor(arrows, archive, bodies, stage, size) {
        this.kinds = {};
        for (const name of KINDS) {
            const list = arrows.filter(({ kind, vector }) => kind === name && vector);
            if (!list.length) continue;
            const kind = new Kind(list, archive, bodies, stage.palette[name], size);
            this.kinds[name] = kind;
            stage.add(kind.shafts, kind.heads);
        }
    }

    has(kind) {
        return kind in this.kinds;
    }

    /** Length of the longest arrow of a kind, in the unit of its vectors. */
    scale(kind) {
        return this.kinds[kind]?.largest ?? 0;
    }

    show(kind, shown) {
        this.kinds[kind].visible = shown;
    }

    /** Tips of the arrows shown, over the whole motion. */
    tips() {
        const shown = Object.values(this.kinds).filter(({ visible, largest: most }) => visible && most > 0);
        const count = shown.reduce((sum, { arrows }) => sum + arrows.length, 0);
        return shown.flatMap((kind) => kind.tips(Math.min(60, Math.ceil(20000 / Math.max(count, 1)))));
    }

    update() {
        for (const kind of Object.values(this.kinds)) kind.update();
    }

    setTheme(palette) {
        for (const [name, { shafts, heads }] of Object.entries(this.kinds)) {
            shafts.material.color.set(palette[name]);
            heads.material.color.set(palette[name]);
        }
    }
}
