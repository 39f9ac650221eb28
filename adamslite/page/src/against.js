// A second result drawn as a ghost behind the first, and how far the two lie apart.
import { Bodies } from "./bodies.js";
import { Channels } from "./channels.js";
import { Clock } from "./clock.js";
import { Shapes } from "./shapes.js";

const OPACITY = 0.4;

export class Against {
    constructor(scene, archive, stage, look) {
        const { against } = scene;
        this.name = against.name || "the other result";
        this.clock = new Clock(archive.track(against.times)?.data ?? new Float32Array(0));
        const described = scene.bodies.map((_, b) => against.bodies[b] ?? null);
        this.known = described.map((body) => body !== null);
        this.bodies = new Bodies(described, archive, this.clock);
        this.channels = new Channels(against.channels, archive);
        const own = {
            shapes: scene.shapes.filter(({ body }) => this.known[body] && scene.bodies[body].kind !== "ground"),
            outlines: scene.outlines.filter(({ points }) => points.every(([body]) => this.known[body])),
        };
        const colourOf = () => stage.palette.ghost;
        this.shapes = new Shapes(own, this.bodies, stage, look, { opacity: OPACITY, colourOf });
    }

    setTime(time) {
        this.bodies.setTime(time);
        this.shapes.update();
    }

    set visible(shown) {
        for (const group of this.shapes.groups) group.mesh.visible = shown;
        for (const { strokes } of this.shapes.lines) strokes.mesh.visible = shown;
    }

    /** Distance between a body's two places now; NaN when the second result has no such body. */
    distance(bodies, b) {
        if (!this.known[b]) return NaN;
        const [p, q] = [bodies.poses, this.bodies.poses];
        return Math.hypot(p[7 * b] - q[7 * b], p[7 * b + 1] - q[7 * b + 1], p[7 * b + 2] - q[7 * b + 2]);
    }
}
