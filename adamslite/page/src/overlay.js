// What lies over the picture: legend of tensions, axes with gravity, scale of the grid.
import { Quaternion } from "three";
import { viridisGradient } from "./colours.js";
import { ends, h } from "./dom.js";

const AXIS = 26; // pixels
const AXES = ["x", "y", "z"];
const TONES = ["#d55e00", "#009e73", "#0072b2"];
const SVG = "http://www.w3.org/2000/svg";

function svg(tag, attributes, text = "") {
    const element = document.createElementNS(SVG, tag);
    for (const [name, value] of Object.entries(attributes)) element.setAttribute(name, value);
    element.textContent = text;
    return element;
}

/** The legend of what the colour of a cable says. */
export class TensionLegend {
    constructor(range, unit) {
        this.bar = h("div", { class: "bar" });
        const [low, high] = ends(range).map((text) => h("span", { class: "value" }, text));
        this.element = h("div", { class: "card tension" }, unit ? `tension (${unit})` : "tension", low, this.bar, high);
    }

    setTheme(theme) {
        this.bar.style.background = viridisGradient(theme);
    }
}

/** The three axes as the camera sees them, and gravity as an arrow. */
export class Triad {
    constructor(gravity) {
        const size = Math.hypot(...gravity);
        this.down = size > 0 ? gravity.map((part) => part / size) : null;
        this.root = svg("svg", { class: "triad", viewBox: "-48 -48 96 96", "aria-hidden": "true" });
        this.lines = TONES.map((stroke) => svg("line", { stroke, "stroke-width": 2.5, "stroke-linecap": "round" }));
        this.names = AXES.map((name, k) => svg("text", { fill: TONES[k], "text-anchor": "middle", "dy": "0.35em" }, name));
        this.arrow = svg("path", { class: "gravity" });
        this.letter = svg("text", { class: "gravity", "text-anchor": "middle", "dy": "0.35em" }, "g");
        this.root.append(...(this.down ? [this.arrow, this.letter] : []), ...this.lines, ...this.names);
        this.element = this.root;
        this.seen = new Quaternion(0, 0, 0, 0);
    }

    /** After the camera has turned. */
    update(camera) {
        if (camera.quaternion.equals(this.seen)) return;
        this.seen.copy(camera.quaternion);
        const e = camera.matrixWorldInverse.elements;
        AXES.forEach((_, k) => this.#axis(k, e[4 * k], -e[4 * k + 1]));
        if (!this.down) return;
        const [gx, gy, gz] = this.down;
        const x = e[0] * gx + e[4] * gy + e[8] * gz;
        const y = -(e[1] * gx + e[5] * gy + e[9] * gz);
        this.#gravity(x, y);
    }

    #axis(k, x, y) {
        this.lines[k].setAttribute("x2", (AXIS * x).toFixed(1));
        this.lines[k].setAttribute("y2", (AXIS * y).toFixed(1));
        this.names[k].setAttribute("x", ((AXIS + 9) * x).toFixed(1));
        this.names[k].setAttribute("y", ((AXIS + 9) * y).toFixed(1));
        const hidden = Math.hypot(x, y) < 0.18 ? "0" : "1";
        this.names[k].setAttribute("opacity", hidden);
    }

    // From a third of the axes' length outwards, beside an axis it would lie on.
    #gravity(x, y) {
        const size = Math.hypot(x, y);
        const seen = size > 0.2;
        this.arrow.setAttribute("opacity", seen ? "1" : "0");
        this.letter.setAttribute("opacity", seen ? "1" : "0");
        if (!seen) return;
        const point = (along, across) => `${(along * x - (across * y) / size).toFixed(1)},${(along * y + (across * x) / size).toFixed(1)}`;
        this.arrow.setAttribute("d", `M${point(8, 0)}L${point(30, 0)}M${point(23, -4)}L${point(30, 0)}L${point(23, 4)}`);
        this.letter.setAttribute("x", (40 * x).toFixed(1));
        this.letter.setAttribute("y", (40 * y).toFixed(1));
    }
}
