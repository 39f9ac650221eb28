// The body that was picked: its name, position and speed, following it, its path.
import { h, iconButton, Pace, READABLE, short } from "./dom.js";
import { Strokes } from "./strokes.js";

const PIECES = 600; // of a path
const NOTHING = 1e-7; // of the size of the scene: what is smaller is zero

export class Selection {
    constructor(app) {
        this.app = app;
        this.body = -1;
        this.path = null;
        this.pace = new Pace(READABLE);
        this.title = h("strong", {});
        this.sub = h("span", { class: "sub" });
        this.facts = h("dl", {});
        this.followButton = iconButton("follow", "Follow this body", () => this.#follow(), { "aria-pressed": "false" });
        this.pathButton = iconButton("path", "Show its path", () => this.showPath(!this.path), { "aria-pressed": "false" });
        this.element = h(
            "div",
            { class: "card selection", hidden: true },
            h("header", {}, h("div", {}, this.title, this.sub), this.followButton, this.pathButton, iconButton("close", "Close (Esc)", () => app.select(-1))),
            this.facts,
        );
    }

    set(b) {
        const { app } = this;
        this.showPath(false);
        if (this.body >= 0) app.shapes.paint(this.body, null);
        this.body = b;
        this.element.hidden = b < 0;
        this.#setFollowing(false);
        app.labels.set({ selected: b });
        if (b < 0) return;
        app.shapes.paint(b, app.stage.palette.path);
        const { name, label, mass } = app.bodies.list[b];
        this.title.textContent = label || name;
        this.sub.textContent = label && label !== name ? name : "";
        this.rows = {};
        const unit = app.scene.units;
        this.#fact("mass", "mass").textContent = mass ? `${short(mass, 5)} ${unit.mass}` : "–";
        const turns = app.bodies.attitudes[b].moves ? ["turning"] : [];
        for (const key of ["position", "speed", ...turns, ...(app.against ? ["apart"] : [])]) this.#fact(key, key);
        this.update();
    }

    #fact(key, name) {
        if (key === "mass") this.facts.replaceChildren();
        this.rows[key] = h("dd", {});
        this.facts.append(h("dt", {}, name), this.rows[key]);
        return this.rows[key];
    }

    update() {
        if (this.body < 0 || !this.pace.due(this.app.player.playing)) return;
        const { bodies, scene, against, box, clock } = this.app;
        const { length, time } = scene.units;
        const per = time ? `/${time}` : "";
        const known = (value, scale) => short(Math.abs(value) < NOTHING * scale ? 0 : value, 4);
        const place = bodies.poses.subarray(7 * this.body, 7 * this.body + 3);
        this.rows.position.textContent = `${Array.from(place, (c) => known(c, box.radius)).join(", ")} ${length}`;
        const pace = clock.duration > 0 ? 1 / clock.duration : 0;
        this.rows.speed.textContent = `${known(bodies.speed(this.body), box.radius * pace)} ${length && per ? length + per : ""}`;
        if (this.rows.turning) this.rows.turning.textContent = `${known(bodies.angularSpeed(this.body), pace)} ${per ? `rad${per}` : ""}`;
        if (against) this.rows.apart.textContent = `${short(against.distance(bodies, this.body), 3)} ${length} from ${against.name}`;
    }

    #follow() {
        this.#setFollowing(this.followButton.getAttribute("aria-pressed") === "false");
    }

    #setFollowing(on) {
        this.followButton.setAttribute("aria-pressed", String(on));
        this.app.camera.follow(on ? this.body : -1, this.app.bodies);
    }

    /** The way of the body's origin over the whole motion. */
    showPath(on) {
        const { app } = this;
        if (this.path) app.stage.removeStrokes(this.path);
        this.path = null;
        this.pathButton.setAttribute("aria-pressed", String(on));
        const track = app.bodies.positions[this.body];
        if (on && track?.moves) {
            const count = Math.min(track.rows - 1, PIECES);
            this.path = new Strokes(count, { width: 2, colour: app.stage.palette.path, shading: 0 });
            const put = (row, o) => {
                for (let c = 0; c < 3; c += 1) this.path.array[o + c] = track.at(row, 0, c);
            };
            for (let k = 0; k < count; k += 1) {
                put(Math.round((k * (track.rows - 1)) / count), 8 * k);
                put(Math.round(((k + 1) * (track.rows - 1)) / count), 8 * k + 4);
            }
            this.path.touched();
            app.stage.addStrokes(this.path);
        }
        app.invalidate();
    }
}
