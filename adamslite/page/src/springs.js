// Springs: coils that stretch between two moving points.
import { InstancedMesh, DynamicDrawUsage, MeshLambertMaterial } from "three";
import { coil, damper } from "./geometry.js";
import { Strokes } from "./strokes.js";

const COILED = 40; // springs up to which they are drawn as coils,
const BENT = 150; // and up to which as bent lines; beyond, they are straight ones
const BENDS = 10; // of a bent line

function length(a, b) {
    return Math.hypot(b[0] - a[0], b[1] - a[1], b[2] - a[2]);
}

/** Writes the matrix that puts a unit z axis from a to b, its width multiplied by `width`. */
export function stretchMatrix(m, o, a, b, width, along = length(a, b)) {
    let zx = b[0] - a[0];
    let zy = b[1] - a[1];
    let zz = b[2] - a[2];
    const size = Math.hypot(zx, zy, zz) || 1;
    zx /= size;
    zy /= size;
    zz /= size;
    // x: perpendicular to z and to the ground axis least along it
    let [px, py] = Math.abs(zx) < 0.8 ? [1, 0] : [0, 1];
    const dot = px * zx + py * zy;
    let pz = -dot * zz;
    px -= dot * zx;
    py -= dot * zy;
    const norm = Math.hypot(px, py, pz);
    px /= norm;
    py /= norm;
    pz /= norm;
    m[o] = px * width;
    m[o + 1] = py * width;
    m[o + 2] = pz * width;
    m[o + 3] = 0;
    m[o + 4] = (zy * pz - zz * py) * width;
    m[o + 5] = (zz * px - zx * pz) * width;
    m[o + 6] = (zx * py - zy * px) * width;
    m[o + 7] = 0;
    m[o + 8] = zx * along;
    m[o + 9] = zy * along;
    m[o + 10] = zz * along;
    m[o + 11] = 0;
    m[o + 12] = a[0];
    m[o + 13] = a[1];
    m[o + 14] = a[2];
    m[o + 15] = 1;
}

/** Springs of one look are instances of one coil. */
class Coils {
    constructor(springs, bodies, look) {
        this.springs = springs;
        this.bodies = bodies;
        this.from = [0, 0, 0];
        this.to = [0, 0, 0];
        this.rest = this.#middleLength() || look.spring;
        const geometry = this.#geometry(springs[0], look.spring);
        this.mesh = new InstancedMesh(geometry, new MeshLambertMaterial({ color: look.colour }), springs.length);
        this.mesh.instanceMatrix.setUsage(DynamicDrawUsage);
        this.mesh.frustumCulled = false;
        this.mesh.matrixAutoUpdate = false;
    }

    // What no GRAPHICS statement sizes is as wide as is well seen.
    #geometry({ statement, coils, diameter }, size) {
        const derived = !statement.startsWith("GRAPHICS");
        const radius = derived || !(diameter > 0) ? Math.min(size, 0.2 * this.rest) : diameter / 2;
        if (coils === 0) return damper(radius);
        const turns = derived ? Math.min(Math.max(Math.round(this.rest / (1.7 * radius)), 5), 16) : coils;
        const wire = Math.min(0.2 * radius, (0.3 * this.rest) / turns);
        return coil(turns, radius, wire, this.rest);
    }

    setTheme({ spring }) {
        this.mesh.material.color.set(spring);
    }

    #ends(k) {
        this.bodies.point(this.springs[k].i, this.from);
        this.bodies.point(this.springs[k].j, this.to);
    }

    // Length at which the wire is drawn round.
    #middleLength() {
        const lengths = this.springs.map((_, k) => {
            this.#ends(k);
            return length(this.from, this.to);
        });
        return lengths.sort((a, b) => a - b)[lengths.length >> 1];
    }

    update() {
        for (let k = 0; k < this.springs.length; k += 1) {
            this.#ends(k);
            stretchMatrix(this.mesh.instanceMatrix.array, 16 * k, this.from, this.to, 1);
        }
        this.mesh.instanceMatrix.needsUpdate = true;
    }
}

/** Springs as lines across the picture's plane of their first two axes, bent or straight. */
class SpringLines {
    constructor(springs, bodies, stage, look) {
        this.springs = springs;
        this.bodies = bodies;
        this.bends = springs.length <= BENT ? BENDS : 0;
        this.width = 0.5 * look.spring;
        this.frame = new Float32Array(16);
        this.from = [0, 0, 0];
        this.to = [0, 0, 0];
        this.strokes = new Strokes(springs.length * (this.bends + 1), { width: 2, colour: stage.palette.spring });
        stage.addStrokes(this.strokes);
        this.mesh = this.strokes.mesh;
    }

    setTheme({ spring }) {
        this.strokes.setColour(spring);
    }

    update() {
        for (let k = 0; k < this.springs.length; k += 1) {
            this.bodies.point(this.springs[k].i, this.from);
            this.bodies.point(this.springs[k].j, this.to);
            const long = length(this.from, this.to);
            stretchMatrix(this.frame, 0, this.from, this.to, Math.min(this.width, 0.15 * long), long);
            for (let n = 0; n <= this.bends; n += 1) this.#piece(8 * (k * (this.bends + 1) + n), n);
        }
        this.strokes.touched();
    }

    #piece(o, n) {
        this.#corner(o, n);
        this.#corner(o + 4, n + 1);
    }

    // Corner n of a line: on alternate sides of it, and on it at its ends.
    #corner(o, n) {
        const { array } = this.strokes;
        const along = n / (this.bends + 1);
        const aside = n === 0 || n === this.bends + 1 ? 0 : n % 2 ? 1 : -1;
        for (let c = 0; c < 3; c += 1) array[o + c] = this.frame[12 + c] + along * this.frame[8 + c] + aside * this.frame[c];
    }
}

export class Springs {
    constructor(springs, bodies, stage, look) {
        if (springs.length > COILED) {
            this.groups = [new SpringLines(springs, bodies, stage, look)];
            return;
        }
        const groups = new Map();
        for (const spring of springs) {
            const key = `${spring.statement.startsWith("GRAPHICS")} ${spring.coils} ${spring.diameter}`;
            if (!groups.has(key)) groups.set(key, []);
            groups.get(key).push(spring);
        }
        this.groups = [...groups.values()].map(
            (list) => new Coils(list, bodies, { ...look, colour: stage.palette.spring }),
        );
        for (const { mesh } of this.groups) stage.add(mesh);
    }

    update() {
        for (const group of this.groups) group.update();
    }

    setTheme(palette) {
        for (const group of this.groups) group.setTheme(palette);
    }

    set visible(shown) {
        for (const { mesh } of this.groups) mesh.visible = shown;
    }
}
