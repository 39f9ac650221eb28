// Shapes of the bodies: what GRAPHICS statements say, and what stands for a body without them.
import { DoubleSide } from "three";
import { Balls } from "./balls.js";
import { GROUND } from "./colours.js";
import { corners } from "./extent.js";
import * as geometry from "./geometry.js";
import { Instances, placed } from "./instances.js";
import { BodyLines } from "./strokes.js";

const FULL = 2 * Math.PI;
const NONE = [0, 0, 0];
const MANY = 200; // copies up to which edges are drawn
const CROWD = 60; // copies from which on a shape has few facets

const isBall = ({ solid: { key } }) => key === "ball";
const angleOf = (shape) => (shape.angle ? Math.min(Math.abs(shape.angle), FULL) : FULL);

/** Along a negative length a shape ends where it would begin. */
function alongZ(length) {
    return { shift: [0, 0, Math.min(length, 0)], size: Math.abs(length) };
}

function cylinder({ length, radius, angle }) {
    const { shift, size } = alongZ(length);
    const sector = angleOf({ angle });
    return {
        key: `cylinder ${sector}`,
        make: (sides) => geometry.frustum(1, 1, sector, sides),
        shift,
        scale: [radius, radius, size],
        edges: true,
    };
}

function frustum({ length, bottom, top, angle }) {
    const { shift, size } = alongZ(length);
    const [below, above] = length < 0 ? [top, bottom] : [bottom, top];
    const widest = Math.max(below, above);
    const sector = angleOf({ angle });
    return {
        key: `frustum ${below / widest} ${above / widest} ${sector}`,
        make: (sides) => geometry.frustum(below / widest, above / widest, sector, sides),
        shift,
        scale: [widest, widest, size],
        edges: true,
    };
}

/** A box between opposite corners; its sides may be negative. */
function boxAt(low, sides) {
    return {
        key: "box",
        make: () => geometry.box(),
        shift: low.map((from, k) => from + sides[k] / 2),
        scale: sides.map((side) => Math.abs(side)),
        edges: true,
    };
}

function rod({ to, radius }, look) {
    const length = Math.hypot(...to) || 1e-9;
    return {
        key: "rod",
        make: (sides) => geometry.frustum(1, 1, FULL, Math.min(sides, 14)),
        shift: NONE,
        scale: [radius ?? look.rod, radius ?? look.rod, length],
        along: to,
    };
}

function ellipsoid({ x, y, z }) {
    const scale = [x / 2, y / 2, z / 2].map(Math.abs);
    const round = scale.every((axis) => Math.abs(axis - scale[0]) <= 1e-6 * scale[0]);
    return { ...BALL, key: round ? "ball" : "ellipsoid", make: (sides) => geometry.ball(sides), scale };
}

const BALL = { key: "ball", shift: NONE };
const SOLIDS = {
    cylinder,
    frustum,
    rod,
    box: ({ x, y, z }) => boxAt(NONE, [x, y, z]),
    inertia_box: ({ x, y, z }) => ({ ...boxAt([-x / 2, -y / 2, -z / 2], [x, y, z]), see_through: true }),
    ellipsoid,
    sphere: ({ radius }) => ({ ...BALL, scale: [radius, radius, radius] }),
    point: (_, look) => ({ ...BALL, scale: [look.point, look.point, look.point] }),
    torus: ({ major, minor }) => ({
        key: `torus ${minor / major}`,
        make: () => geometry.torus(1, minor / major),
        shift: NONE,
        scale: [major, major, major],
    }),
    wheel: ({ radius, width }) => ({
        key: "wheel",
        make: (sides) => geometry.wheel(sides > 28 ? 48 : 24),
        shift: NONE,
        scale: [radius, radius, width],
        edges: true,
    }),
    plane: ({ xmin, xmax, ymin, ymax }) => ({
        key: "plane",
        make: () => geometry.rectangle(),
        shift: [Math.min(xmin, xmax), Math.min(ymin, ymax), 0],
        scale: [Math.abs(xmax - xmin), Math.abs(ymax - ymin), 1],
        see_through: true,
        two_sided: true,
    }),
};

/** Quaternion that turns z into a direction. */
function quaternionTo([x, y, z]) {
    const length = Math.hypot(x, y, z) || 1;
    const w = 1 + z / length;
    if (w < 1e-9) return [1, 0, 0, 0];
    const [qx, qy] = [-y / length, x / length];
    const norm = Math.hypot(qx, qy, w);
    return [qx / norm, qy / norm, 0, w / norm];
}

function turned(frame, along) {
    const local = placed(frame, NONE, [1, 1, 1]);
    return local.multiply(placed([0, 0, 0, ...quaternionTo(along)], NONE, [1, 1, 1]));
}

function localMatrix(frame, solid) {
    if (!solid.along) return placed(frame, solid.shift, solid.scale);
    return turned(frame, solid.along).multiply(placed([0, 0, 0, 0, 0, 0, 1], NONE, solid.scale));
}

/** Points [body, x, y, z] of a circle or an arc in the xy plane of its frame. */
function arcPoints({ body, frame, radius, angle }) {
    const sector = angleOf({ angle });
    const count = Math.max(Math.ceil((64 * sector) / FULL), 4);
    const matrix = placed(frame, NONE, [1, 1, 1]).elements;
    return Array.from({ length: count + 1 }, (_, k) => {
        const x = radius * Math.cos((sector * k) / count);
        const y = radius * Math.sin((sector * k) / count);
        return [body, ...[0, 1, 2].map((c) => matrix[c] * x + matrix[c + 4] * y + matrix[c + 12])];
    });
}

function closedOutline({ points, closed }) {
    return closed && points.length > 2 ? [...points, points[0]] : points;
}

function groupBy(items, keyOf) {
    const groups = new Map();
    for (const item of items) {
        const key = keyOf(item);
        if (!groups.has(key)) groups.set(key, []);
        groups.get(key).push(item);
    }
    return groups;
}

// Joints that hold a point of a body; others may lie anywhere on a line or a plane.
const HOLDING = new Set(["REVOLUTE", "SPHERICAL", "UNIVERSAL", "HOOKE", "CONVEL", "FIXED", "ATPOINT"]);

/** Thin lines from a body to its joints that no shape of it reaches. */
export function stays(scene, shapes) {
    const lines = [];
    for (const joint of scene.joints.filter(({ kind }) => HOLDING.has(kind))) {
        for (const [b, x, y, z] of [joint.i, joint.j]) {
            const reach = scene.bodies[b].kind === "part" ? shapes.reach(b) : Infinity;
            if (Math.hypot(x, y, z) > reach) lines.push([[b, 0, 0, 0], [b, x, y, z]]);
        }
    }
    return lines;
}

export class Shapes {
    /** `look`: radii of what has no size of its own; `colourOf`: colour of a body. */
    constructor(scene, bodies, stage, look, options = {}) {
        const { shapes, outlines } = scene;
        this.scene = scene;
        this.bodies = bodies;
        this.colourOf = options.colourOf ?? ((b) => bodies.colours[b]);
        const opacity = options.opacity ?? 1;
        const solids = shapes.filter(({ kind }) => kind in SOLIDS).map((shape) => this.#item(shape, look));
        const rods = solids.filter(({ solid }) => solid.along);
        const crowd = rods.length > CROWD ? new Set(rods) : new Set();
        const meshes = solids.filter((item) => !crowd.has(item));
        const groups = groupBy(meshes, ({ solid }) => `${solid.key} ${solid.see_through ?? false}`);
        this.groups = [...groups.values()].map((items) => this.#group(items, opacity, stage));
        for (const group of this.groups) stage.add(...group.objects);
        this.lines = [...this.#lines(shapes, outlines, stage, opacity), ...this.#bars([...crowd], stage, opacity)];
    }

    #item(shape, look) {
        const solid = SOLIDS[shape.kind](shape, look);
        const colour = this.colourOf(shape.body);
        return { body: shape.body, solid, local: localMatrix(shape.frame, solid), colour };
    }

    #group(items, opacity, stage) {
        const [{ solid }] = items;
        if (items.every(isBall)) return new Balls(items, this.bodies, stage, opacity);
        const sides = items.length > CROWD ? 8 : items.length > 8 ? 24 : 48;
        return new Instances(solid.make(sides), items, this.bodies, {
            opacity: solid.see_through ? 0.35 * opacity : opacity,
            side: solid.two_sided || solid.key.includes("cylinder") ? DoubleSide : undefined,
            behind: opacity < 1,
            edges: Boolean(solid.edges) && items.length <= MANY && opacity === 1,
        });
    }

    // One set of lines for each colour.
    #lines(shapes, outlines, stage, opacity) {
        const arcs = shapes.filter(({ kind }) => kind === "circle" || kind === "arc").map(arcPoints);
        const drawn = [...arcs, ...outlines.map(closedOutline)].filter((points) => points.length > 1);
        const groups = groupBy(drawn, ([[body]]) => this.colourOf(body) ?? GROUND);
        return [...groups].map(([colour, polylines]) => {
            const lines = new BodyLines(polylines, this.bodies, { colour, width: 2.5, opacity });
            stage.addStrokes(lines.strokes);
            return lines;
        });
    }

    // Rods in a crowd are lines from end to end.
    #bars(rods, stage, opacity) {
        return [...groupBy(rods, ({ colour }) => colour)].map(([colour, items]) => {
            // Along the z axis of a rod's matrix lies its whole length.
            const ends = items.map(({ body, local: { elements: m } }) => [
                [body, m[12], m[13], m[14]],
                [body, m[12] + m[8], m[13] + m[9], m[14] + m[10]],
            ]);
            const bars = new BodyLines(ends, this.bodies, { colour, width: 4, opacity });
            stage.addStrokes(bars.strokes);
            return bars;
        });
    }

    update() {
        for (const group of this.groups) group.update();
        for (const line of this.lines) line.update();
    }

    /** Radius about a body's origin within which its shapes lie; infinite without any. */
    reach(b) {
        const own = this.scene.shapes.filter(({ body }) => body === b);
        const distances = own.flatMap(corners).map(([, x, y, z]) => Math.hypot(x, y, z));
        return distances.length ? Math.max(...distances) : Infinity;
    }

    get pickable() {
        return this.groups.map(({ mesh }) => mesh);
    }

    setTheme(palette) {
        for (const group of this.groups) group.setTheme?.(palette);
    }

    paint(b, colour) {
        for (const group of this.groups) group.paint(b, colour ? () => colour : ({ body }) => this.colourOf(body));
    }
}
