// Springs: coils that stretch between two moving points.
import { InstancedMesh, DynamicDrawUsage, MeshLambertMaterial } from "three";
import { coil, damper } from "./geometry.js";

const FINE = 40; // springs up to which a coil has its full number of facets

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
        return coil(turns, radius, wire, this.rest, this.springs.length <= FINE);
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

export class Springs {
    constructor(springs, bodies, stage, look) {
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
        for (const { mesh } of this.groups) mesh.material.color.set(palette.spring);
    }

    set visible(shown) {
        for (const { mesh } of this.groups) mesh.visible = shown;
    }
}
