// Modes of small motions, animated about the state they were found at.
import { multiplyQuaternions } from "./bodies.js";
import { h, short } from "./dom.js";

const SWING = 0.12; // of the mechanism's radius: largest displacement at an amplitude of 1
const PERIOD = 2; // seconds on the screen

export class Modes {
    constructor(modes, bodies, radius, changed) {
        this.modes = modes;
        this.bodies = bodies;
        this.radius = radius;
        this.changed = changed;
        this.chosen = -1;
        this.amplitude = 1;
        this.base = new Float32Array(bodies.poses.length);
        this.turn = [0, 0, 0, 1];
        this.product = [0, 0, 0, 1];
        this.element = modes.length ? this.#panel() : null;
    }

    get active() {
        return this.chosen >= 0;
    }

    choose(index) {
        this.chosen = index === this.chosen ? -1 : index;
        this.since = null;
        if (this.active) {
            const mode = this.modes[this.chosen];
            this.bodies.setTime(mode.time);
            this.base.set(this.bodies.poses);
            this.scale = this.#scale(mode);
        }
        this.rows.forEach((row, k) => row.setAttribute("aria-pressed", String(k === this.chosen)));
        this.changed(this.active);
    }

    // So that what moves most moves by a fixed part of the mechanism. A turn of one radian moves
    // what is drawn by about the mechanism's radius.
    #scale({ shape }) {
        let most = 0;
        for (const [, ...parts] of shape) {
            const size = (c) => Math.hypot(parts[c], parts[c + 6]);
            most = Math.max(most, Math.hypot(size(0), size(1), size(2)), 0.5 * this.radius * Math.hypot(size(3), size(4), size(5)));
        }
        return most > 0 ? (SWING * this.radius) / most : 0;
    }

    /** Places the bodies for a moment of the animation. */
    place(now) {
        this.since ??= now;
        this.setPhase((2 * Math.PI * (now - this.since)) / (1000 * PERIOD));
    }

    /** Places the bodies: displacement = Re(shape exp(i phase)). */
    setPhase(phase) {
        const c = Math.cos(phase) * this.scale * this.amplitude;
        const s = Math.sin(phase) * this.scale * this.amplitude;
        for (const row of this.modes[this.chosen].shape) this.#displace(row, c, s);
    }

    #displace(row, c, s) {
        const part = (k) => c * row[1 + k] - s * row[7 + k];
        const o = 7 * row[0];
        const { base, turn, product } = this;
        const angle = Math.hypot(part(3), part(4), part(5));
        const sine = angle > 0 ? Math.sin(angle / 2) / angle : 0;
        turn[0] = part(3) * sine;
        turn[1] = part(4) * sine;
        turn[2] = part(5) * sine;
        turn[3] = Math.cos(angle / 2);
        multiplyQuaternions(turn, base.subarray(o + 3, o + 7), product);
        this.bodies.setPose(row[0], base[o] + part(0), base[o + 1] + part(1), base[o + 2] + part(2), ...product);
    }

    #panel() {
        this.rows = this.modes.map(({ frequency, damping, unit, time }, k) =>
            h(
                "button",
                { type: "button", class: "mode", "aria-pressed": "false", onclick: () => this.choose(k) },
                h("span", { class: "number" }, `${k + 1}`),
                h("span", { class: "value" }, `${short(frequency, 5)} ${unit}`),
                h("span", { class: "value" }, `${short(100 * damping, 3)} %`),
                h("span", { class: "value" }, short(time, 4)),
            ));
        const amplitude = h("input", {
            type: "range", min: 0.1, max: 3, step: 0.1, value: 1, "aria-label": "amplitude",
            oninput: () => {
                this.amplitude = Number(amplitude.value);
            },
        });
        return h(
            "div",
            { class: "modes" },
            h("p", { class: "hint" }, "Small motions about a state, drawn far larger and at one pace for all. Choose a mode to see it; choose it again to return to the motion."),
            h("div", { class: "mode head" }, h("span", {}, "#"), h("span", {}, "frequency"), h("span", {}, "damping ratio"), h("span", {}, "at time")),
            ...this.rows,
            h("label", { class: "amplitude" }, "Amplitude", amplitude),
        );
    }
}
