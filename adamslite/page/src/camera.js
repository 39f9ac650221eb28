// The camera: orbit, views, fit to the whole motion, following a body.
import { MOUSE, Vector3 } from "three";
import { OrbitControls } from "three/examples/jsm/controls/OrbitControls.js";
import { axesOf } from "./ground.js";

const MARGIN = 1.08;
const GLIDE = 260; // milliseconds of a change of view
const FLAT = 0.3; // extent across a motion, as a part of its size, up to which it is flat

/** Right, up and towards the viewer, for a front view. */
function frontAxes(up, sign) {
    const { vertical } = axesOf(up);
    const upward = new Vector3().setComponent(vertical, sign);
    const right = vertical === 0 ? new Vector3(0, 1, 0) : new Vector3(1, 0, 0);
    return { right, upward, toward: right.clone().cross(upward) };
}

const sum = (...terms) => terms.reduce((total, [vector, part]) => total.addScaledVector(vector, part), new Vector3());

export class Camera {
    /** `cloud`: points of the whole motion; `box`: their bounds. */
    constructor(stage, cloud, box, up, sign, changed) {
        this.stage = stage;
        this.camera = stage.camera;
        this.cloud = cloud;
        this.more = [];
        this.reserved = 0; // pixels at the top that other things lie over
        this.box = box;
        this.changed = changed;
        this.axes = frontAxes(up, sign);
        this.camera.up.copy(this.axes.upward);
        this.controls = new OrbitControls(this.camera, stage.canvas);
        this.controls.enableDamping = false;
        this.controls.zoomToCursor = true;
        this.controls.mouseButtons = { LEFT: MOUSE.ROTATE, MIDDLE: MOUSE.PAN, RIGHT: MOUSE.PAN };
        this.controls.addEventListener("change", () => this.#moved());
        this.controls.addEventListener("start", () => {
            this.fitted = false;
            this.glide = null;
        });
        this.followed = -1;
        this.last = new Vector3();
        this.here = new Vector3();
        this.view("start", false);
    }

    #moved() {
        const distance = this.camera.position.distanceTo(new Vector3(...this.box.centre));
        const { radius } = this.box;
        this.camera.near = Math.max(distance - 4 * radius, distance * 0.003, radius * 1e-4);
        this.camera.far = distance + 8 * radius;
        this.camera.updateProjectionMatrix();
        this.camera.updateMatrixWorld();
        this.changed();
    }

    #directionOf(name) {
        const { right, upward, toward } = this.axes;
        if (name === "x") return new Vector3(1, 0, 0);
        if (name === "y") return new Vector3(0, 1, 0);
        if (name === "z") return new Vector3(0, 0, 1);
        if (name === "iso") return sum([toward, 1], [right, 0.85], [upward, 0.75]).normalize();
        const extent = this.box.high.map((to, c) => to - this.box.low[c]);
        const across = Math.abs(toward.dot(new Vector3(...extent)));
        if (across < FLAT * 2 * this.box.radius) return sum([toward, 1], [right, 0.32], [upward, 0.2]).normalize();
        return sum([toward, 1], [right, 0.7], [upward, 0.45]).normalize();
    }

    /** Looks along x, y or z, isometrically ("iso"), or as at the start, at the whole motion. */
    view(name, gliding = true) {
        this.direction = this.#directionOf(name);
        this.fit(gliding);
    }

    /** Frames the whole motion without turning. */
    fit(gliding = true) {
        const direction = this.fitted || !this.camera.position.lengthSq() ? this.direction : this.#looking();
        const { position, target } = this.#framing(direction ?? this.direction);
        this.fitted = true;
        if (gliding) this.glide = { position, target, since: null, from: this.#state() };
        else this.#put(position, target);
        this.changed();
    }

    /** Points that the picture has to hold besides the mechanism. */
    include(points) {
        this.more = points;
        this.refit();
    }

    /** After the picture has changed its size, what was framed is framed again. */
    refit() {
        if (this.fitted && this.followed < 0) this.fit(false);
    }

    #state() {
        return { position: this.camera.position.clone(), target: this.controls.target.clone() };
    }

    #looking() {
        return this.camera.position.clone().sub(this.controls.target).normalize();
    }

    #put(position, target) {
        this.camera.position.copy(position);
        this.controls.target.copy(target);
        this.controls.update();
        this.#moved();
    }

    // A point at (x, y) across and z towards the camera is in the picture when x - cx <=
    // (distance - z) right and cx - x <= (distance - z) left, tangents of half the picture's angle.
    // The largest z + x / right and z - x / left tell how near the camera may come and, at any
    // distance, between which limits the centre cx lies; so for the height with y.
    #framing(direction) {
        const across = new Vector3().crossVectors(this.camera.up, direction);
        if (across.lengthSq() < 1e-6) across.copy(this.axes.right);
        across.normalize();
        const over = new Vector3().crossVectors(direction, across);
        const tall = Math.tan((this.camera.fov * Math.PI) / 360) / MARGIN;
        const wide = tall * this.camera.aspect;
        const width = this.#span(across, direction, wide, wide);
        const height = this.#span(over, direction, tall * (1 - (2 * this.reserved) / this.stage.height), tall);
        const depth = direction.dot(new Vector3(...this.box.centre));
        const distance = Math.max(width.distance, height.distance, depth + 0.35 * this.box.radius);
        const target = sum([across, width.centre(distance)], [over, height.centre(distance)], [direction, depth]);
        return { target, position: target.clone().addScaledVector(direction, distance - depth) };
    }

    #span(axis, direction, plus, minus) {
        let above = -Infinity;
        let below = -Infinity;
        for (const points of [this.cloud, this.more]) {
            for (let k = 0; k < points.length; k += 3) {
                const x = axis.x * points[k] + axis.y * points[k + 1] + axis.z * points[k + 2];
                const z = direction.x * points[k] + direction.y * points[k + 1] + direction.z * points[k + 2];
                above = Math.max(above, z + x / plus);
                below = Math.max(below, z - x / minus);
            }
        }
        return {
            distance: (above * plus + below * minus) / (plus + minus),
            centre: (distance) => ((above - distance) * plus + (distance - below) * minus) / 2,
        };
    }

    /** Moves with the body b from now on; -1: with none. */
    follow(b, bodies) {
        this.followed = b;
        if (b >= 0) bodies.point([b, 0, 0, 0], this.here.set(0, 0, 0).toArray(this.buffer ?? (this.buffer = [])));
        if (b >= 0) this.last.fromArray(this.buffer);
        this.changed();
    }

    /** Once a frame, after bodies have moved. */
    update(bodies, now) {
        if (this.followed >= 0) this.#keepUp(bodies);
        if (this.glide) this.#advance(now);
    }

    #keepUp(bodies) {
        bodies.point([this.followed, 0, 0, 0], this.buffer);
        this.here.fromArray(this.buffer);
        if (!Number.isFinite(this.here.x)) return;
        const moved = this.here.clone().sub(this.last);
        if (moved.lengthSq() === 0) return;
        this.last.copy(this.here);
        this.camera.position.add(moved);
        this.controls.target.add(moved);
        this.controls.update();
    }

    #advance(now) {
        const { glide } = this;
        glide.since ??= now;
        const part = Math.min((now - glide.since) / GLIDE, 1);
        const eased = part * part * (3 - 2 * part);
        this.#put(
            glide.from.position.clone().lerp(glide.position, eased),
            glide.from.target.clone().lerp(glide.target, eased),
        );
        if (part === 1) this.glide = null;
        else this.changed();
    }

    /** From where a reader looks; null in place of a place where the whole motion is framed. */
    get state() {
        const free = this.fitted ? null : this.#state();
        return { direction: this.direction, free };
    }

    restore({ direction, free }) {
        this.direction = direction;
        if (free) {
            this.fitted = false;
            this.#put(free.position, free.target);
        } else {
            this.fitted = true;
            this.fit(false);
        }
    }

    describe() {
        const { position, fov, near, far, aspect } = this.camera;
        return { position: position.toArray(), target: this.controls.target.toArray(), fov, near, far, aspect };
    }
}
