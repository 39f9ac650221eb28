// Unit geometries that shapes and symbols are scaled from. Axes of symmetry lie along z.
import {
    BoxGeometry, BufferAttribute, CylinderGeometry, LatheGeometry, OctahedronGeometry,
    PlaneGeometry, SphereGeometry, TorusGeometry, TubeGeometry, Vector2, Vector3, Curve,
} from "three";
import { mergeGeometries } from "three/examples/jsm/utils/BufferGeometryUtils.js";

/** A frustum from z = 0 (radius `bottom`) to z = 1 (radius `top`), its sector beginning at x. */
export function frustum(bottom, top, angle, sides) {
    const whole = angle >= 2 * Math.PI - 1e-6;
    const around = Math.max(Math.ceil((sides * Math.min(angle, 2 * Math.PI)) / (2 * Math.PI)), 3);
    const geometry = new CylinderGeometry(top, bottom, 1, around, 1, false, Math.PI / 2, whole ? 2 * Math.PI : angle);
    return geometry.rotateX(Math.PI / 2).translate(0, 0, 0.5);
}

export const box = () => new BoxGeometry(1, 1, 1);
export const ball = (sides) => new SphereGeometry(1, Math.min(sides, 28), Math.min(sides, 28) >> 1);
export const torus = (major, minor) => new TorusGeometry(major, minor, 14, 56);

/** A rectangle from (0, 0) to (1, 1). */
export const rectangle = () => new PlaneGeometry(1, 1).translate(0.5, 0.5, 0);

function painted(geometry, value) {
    const plain = geometry.index ? geometry.toNonIndexed() : geometry;
    const colours = new Float32Array(3 * plain.getAttribute("position").count).fill(value);
    plain.setAttribute("color", new BufferAttribute(colours, 3));
    return plain;
}

// Half of the section of a sheave of radius and width 1: hub, web, rim with a groove.
const SECTION = [
    [0, 0.5], [0.2, 0.5], [0.2, 0.2], [0.74, 0.2], [0.74, 0.5], [0.97, 0.5], [0.9, 0.18],
];

/** A sheave of radius and width 1, centred, with one dark spoke that shows its turning. */
export function wheel(sides) {
    const half = SECTION.map(([r, z]) => new Vector2(r, z));
    const profile = [...half, ...half.slice().reverse().map(({ x, y }) => new Vector2(x, -y))].reverse();
    const body = new LatheGeometry(profile, sides).rotateX(Math.PI / 2);
    const flat = body.toNonIndexed();
    flat.computeVertexNormals();
    const spoke = new BoxGeometry(0.58, 0.11, 0.62).translate(0.47, 0, 0);
    return mergeGeometries([painted(flat, 1), painted(spoke, 0.12)]);
}

const END = 0.06; // of a spring's length

class Helix extends Curve {
    constructor(coils, radius) {
        super();
        this.coils = coils;
        this.radius = radius;
    }

    // Straight along the axis in the first and the last part, in coils between.
    getPoint(t, target = new Vector3()) {
        const part = Math.min(Math.max((t - END) / (1 - 2 * END), 0), 1);
        const ease = Math.min(1, Math.min(t, 1 - t) / END);
        const angle = 2 * Math.PI * this.coils * part;
        const radius = this.radius * ease;
        return target.set(radius * Math.cos(angle), radius * Math.sin(angle), t);
    }
}

/** A coil spring from z = 0 to z = 1 whose wire is round at the length `length`. */
export function coil(coils, radius, wire, length) {
    const curve = new Helix(coils, radius / length);
    const along = Math.ceil(coils * 16) + 8;
    return new TubeGeometry(curve, along, wire / length, 6, false).scale(length, length, 1);
}

/** A damper from z = 0 to z = 1: cup and piston rod. */
export function damper(radius) {
    const cup = frustum(1, 1, 2 * Math.PI, 24).scale(radius, radius, 0.6);
    const rod = frustum(1, 1, 2 * Math.PI, 12).scale(0.3 * radius, 0.3 * radius, 0.4).translate(0, 0, 0.6);
    return mergeGeometries([cup, rod]);
}

const merged = (...parts) => mergeGeometries(parts);

/** Bars, rings and balls of symbols: with fewer facets where there are many symbols. */
function parts(fine) {
    const [around, across] = fine ? [14, 7] : [7, 4];
    return {
        bar: (radius, length) => new CylinderGeometry(radius, radius, length, around).rotateX(Math.PI / 2),
        ring: (radius, wire) => new TorusGeometry(radius, wire, across, fine ? 20 : 8),
        sphere: (radius) => new SphereGeometry(radius, around, across),
    };
}

// Symbols of joints, of size 1, along the z axis of the joint's I marker.
const SYMBOLS = {
    REVOLUTE: ({ bar, ring }) => merged(bar(0.3, 2), ring(0.62, 0.17)),
    CYLINDRICAL: ({ bar }) => merged(bar(0.3, 3), bar(0.6, 1.2)),
    TRANSLATIONAL: () => merged(new BoxGeometry(1.1, 1.1, 1.4), new BoxGeometry(0.4, 0.4, 3.2)),
    SPHERICAL: ({ sphere }) => sphere(0.65),
    FIXED: () => merged(new BoxGeometry(1.1, 1.1, 0.3), new BoxGeometry(0.3, 1.1, 1.1), new BoxGeometry(1.1, 0.3, 1.1)),
    UNIVERSAL: ({ bar, sphere }) => merged(bar(0.22, 2), bar(0.22, 2).rotateX(Math.PI / 2), sphere(0.42)),
    PLANAR: ({ bar }) => merged(new BoxGeometry(2.4, 2.4, 0.12), bar(0.15, 1.4)),
    SCREW: ({ bar, ring }) => merged(bar(0.35, 2.4), ...[-0.8, -0.4, 0, 0.4, 0.8].map((z) => ring(0.45, 0.12).translate(0, 0, z))),
    OTHER: () => new OctahedronGeometry(0.6),
};
SYMBOLS.HOOKE = SYMBOLS.UNIVERSAL;
SYMBOLS.CONVEL = SYMBOLS.UNIVERSAL;

export const symbolKind = (kind) => (kind in SYMBOLS ? kind : "OTHER");
export const symbol = (kind, fine) => SYMBOLS[kind](parts(fine));

/** An arrow of length 1 along z: its shaft (drawn shorter by the head) and its head. */
export const arrowShaft = () => new CylinderGeometry(1, 1, 1, 12).rotateX(Math.PI / 2).translate(0, 0, 0.5);
export const arrowHead = () => new CylinderGeometry(0, 1, 1, 16).rotateX(Math.PI / 2).translate(0, 0, -0.5);
