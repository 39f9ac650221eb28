// Names beside the bodies.
import { Vector3 } from "three";
import { h } from "./dom.js";

const MOST = 80;

export class Labels {
    constructor(layer, bodies, stage) {
        this.layer = layer;
        this.bodies = bodies;
        this.stage = stage;
        this.shown = false;
        this.selected = -1;
        this.spans = new Map();
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
        for (const [b, span] of this.spans) {
            this.bodies.point([b, 0, 0, 0], this.buffer);
            this.place.fromArray(this.buffer).project(camera);
            const seen = Math.abs(this.place.x) < 1 && Math.abs(this.place.y) < 1 && this.place.z < 1;
            span.style.display = seen ? "" : "none";
            const x = ((this.place.x + 1) / 2) * width;
            const y = ((1 - this.place.y) / 2) * height;
            if (seen) span.style.transform = `translate(${x.toFixed(1)}px, ${y.toFixed(1)}px)`;
        }
    }
}
