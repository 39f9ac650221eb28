// How large the mechanism is, and where it goes: points of it over the whole motion.
import { Matrix4, Quaternion } from "three";

const POINTS = 120000; // of bodies and times together

// Half sides of a shape's box and its centre, in its frame.
const HALVES = {
    cylinder: ({ length, radius }) => [[radius, radius, Math.abs(length) / 2], [0, 0, length / 2]],
    frustum: ({ length, bottom, top }) => {
        const radius = Math.max(bottom, top);
        return [[radius, radius, Math.abs(length) / 2], [0, 0, length / 2]];
    },
    box: ({ x, y, z }) => [[x / 2, y / 2, z / 2], [x / 2, y / 2, z / 2]],
    inertia_box: ({ x, y, z }) => [[x / 2, y / 2, z / 2], [0, 0, 0]],
    ellipsoid: ({ x, y, z }) => [[x / 2, y / 2, z / 2], [0, 0, 0]],
    sphere: ({ radius }) => [[radius, radius, radius], [0, 0, 0]],
    torus: ({ major, minor }) => [[major + minor, major + minor, minor], [0, 0, 0]],
    circle: ({ radius }) => [[radius, radius, 0], [0, 0, 0]],
    arc: ({ radius }) => [[radius, radius, 0], [0, 0, 0]],
    wheel: ({ radius, width }) => [[radius, radius, width / 2], [0, 0, 0]],
    rod: ({ to }) => [to.map((side) => side / 2), to.map((side) => side / 2)],
    plane: ({ xmin, xmax, ymin, ymax }) => [
        [(xmax - xmin) / 2, (ymax - ymin) / 2, 0],
        [(xmax + xmin) / 2, (ymax + ymin) / 2, 0],
    ],
    point: () => [[0, 0, 0], [0, 0, 0]],
};

/** Corners of a shape's box as points [body, x, y, z]. */
export function corners(shape) {
    if (!(shape.kind in HALVES)) return [];
    const [half, centre] = HALVES[shape.kind](shape);
    const [x, y, z, qx, qy, qz, qw] = shape.frame;
    const m = new Matrix4().makeRotationFromQuaternion(new Quaternion(qx, qy, qz, qw)).setPosition(x, y, z).elements;
    const signs = [-1, 1];
    return signs.flatMap((a) => signs.flatMap((b) => signs.map((c) => {
        const p = [centre[0] + a * half[0], centre[1] + b * half[1], centre[2] + c * half[2]];
        return [shape.body, ...[0, 1, 2].map((k) => m[k] * p[0] + m[k + 4] * p[1] + m[k + 8] * p[2] + m[k + 12])];
    })));
}

// Points of a wheel that a cable runs over.
function rim([body, x, y, z], radius) {
    return [[-1, 0], [1, 0], [0, -1], [0, 1]].map(([a, b]) => [body, x + a * radius, y + b * radius, z]);
}

/** All points [body, x, y, z] that the picture has to hold. */
function anchors(scene) {
    // A point without mass stands for a contact and may run to where nothing is.
    const helper = ({ kind, mass }) => kind === "point_mass" && !mass;
    const solid = scene.shapes.filter(({ kind, body }) => kind !== "plane" && !helper(scene.bodies[body]));
    const ends = (list) => list.flatMap(({ i, j }) => [i.slice(0, 4), j.slice(0, 4)]);
    const cables = scene.cables.flatMap(({ nodes }) =>
        nodes.flatMap((node) => (node.point ? [node.point] : rim(node.wheel, node.radius))));
    const origins = scene.bodies.flatMap((body, b) => (body.kind === "ground" || helper(body) ? [] : [[b, 0, 0, 0]]));
    return [
        ...solid.flatMap(corners),
        ...scene.outlines.flatMap(({ points }) => points),
        ...ends(scene.springs),
        ...ends(scene.joints),
        ...ends(scene.links),
        ...cables,
        ...origins,
    ];
}

const finite = (x, y, z) => Number.isFinite(x + y + z);

/** Points of the mechanism over the whole motion, three numbers each. */
export function sweep(scene, bodies) {
    const all = anchors(scene);
    const still = all.filter(([b]) => !bodies.moving[b]);
    const moving = all.filter(([b]) => bodies.moving[b]);
    const { times } = bodies.clock;
    const frames = moving.length ? Math.max(Math.min(times.length, Math.floor(POINTS / moving.length), 80), 2) : 0;
    const cloud = [];
    const place = [0, 0, 0];
    const put = (at) => {
        bodies.point(at, place);
        if (finite(...place)) cloud.push(...place);
    };
    still.forEach(put);
    for (let k = 0; k < frames; k += 1) {
        bodies.setTime(times[Math.round((k * (times.length - 1)) / (frames - 1))]);
        moving.forEach(put);
    }
    bodies.setTime(bodies.clock.first);
    if (!cloud.length) cloud.push(0, 0, 0);
    return Float32Array.from(cloud);
}

/** Lowest and highest coordinates of a cloud, its centre and half its diagonal. */
export function bounds(cloud) {
    const low = [Infinity, Infinity, Infinity];
    const high = [-Infinity, -Infinity, -Infinity];
    for (let k = 0; k < cloud.length; k += 1) {
        const c = k % 3;
        low[c] = Math.min(low[c], cloud[k]);
        high[c] = Math.max(high[c], cloud[k]);
    }
    const centre = low.map((from, c) => (from + high[c]) / 2);
    const radius = Math.hypot(...low.map((from, c) => high[c] - from)) / 2;
    return { low, high, centre, radius: radius > 0 ? radius : 1 };
}
