// Names beside the bodies.
import { Vector3 } from "three";
import { h } from "./dom.js";

const MOST = 80;
const LETTER = 6.3; // pixels of a name
const LINE = 17;

export class Labels {
    constructor(layer, bodies, stage) {
        this.layer = layer;
        this.bodies = bodies;
        this.stage = stage;
        this.shown = false;
        this.selected = -1;
        this.spans = new Map();
        this.taken = [];
        this.place = new Vector3();
        this.buffer = [0, 0, 0];
        const named = bodies.list.flatMap(({ kind }, b) => (kind === "ground" || kind === "none" ? [] : [b]));
        const first = named.filter((b) => bodies.list[b].kind !== "point_mass" || bodies.list[b].label);
        this.candidates = (first.length ? first : named).slice(0, MOST);
    }

    get #wanted() {
        const list = this.shown ? this.candidates : [];
        return this.selected >= 0 && !list.includes(this.selected) ? [...list, this.selected] : list;
    }

    set({ shown = this.shown, selected = this.selected }) {
        this.shown = shown;
        this.selected = selected;
        this.layer.replaceChildren();
        this.spans.clear();
        for (const b of this.#wanted) {
            const { name, label } = this.bodies.list[b];
            const span = h("span", { class: b === selected ? "label selected" : "label" }, label || name);
            this.layer.append(span);
            this.spans.set(b, span);
        }
        this.update();
    }

    update() {
        const { width, height, camera } = this.stage;
        this.taken.length = 0;
        for (const [b, span] of this.spans) {
            this.bodies.point([b, 0, 0, 0], this.buffer);
            this.place.fromArray(this.buffer).project(camera);
            const seen = Math.abs(this.place.x) < 1 && Math.abs(this.place.y) < 1 && this.place.z < 1;
            const x = ((this.place.x + 1) / 2) * width;
            const y = ((1 - this.place.y) / 2) * height;
            const shown = seen && (b === this.selected || this.#free(x, y, span.textContent.length));
            span.style.display = shown ? "" : "none";
            if (shown) span.style.transform = `translate(${x.toFixed(1)}px, ${y.toFixed(1)}px)`;
        }
    }

    // Whether no other name is there; if so, it is taken from now on.
    #free(x, y, letters) {
        const right = x + LETTER * letters + 10;
        const free = this.taken.every(([left, end, at]) => x > end || right < left || Math.abs(y - at) > LINE);
        if (free) this.taken.push([x, right, y]);
        return free;
    }
}
