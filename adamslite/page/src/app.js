// What a page shows of one run: builds what is drawn, and keeps it in step with time.
import { Vector3 } from "three";
import { Against } from "./against.js";
import { Arrows, KINDS } from "./arrows.js";
import { Bodies } from "./bodies.js";
import { Cables } from "./cables.js";
import { Camera } from "./camera.js";
import { ChannelPicker, Channels } from "./channels.js";
import { Clock } from "./clock.js";
import { h, iconButton, short } from "./dom.js";
import { bounds, sweep } from "./extent.js";
import { Ground } from "./ground.js";
import { Joints } from "./joints.js";
import { Help, keysOf, listenToKeys } from "./keyboard.js";
import { Labels } from "./labels.js";
import { Modes } from "./modes.js";
import { TensionLegend, Triad } from "./overlay.js";
import { about, bodyList, Panel, showMenu } from "./panel.js";
import { filmStrip, picture } from "./picture.js";
import { Picker } from "./picking.js";
import { Player } from "./player.js";
import { Plots } from "./plots.js";
import { curvesTable, Save } from "./save.js";
import { Selection } from "./selection.js";
import { Shapes, stays } from "./shapes.js";
import { Springs } from "./springs.js";
import { Stage } from "./stage.js";
import { BodyLines } from "./strokes.js";

const CROWD = 100; // bodies
const CLICK = 5; // pixels that a pointer may move in a click

/** A cloud and the corners of a box, so that pictures of several runs have one scale. */
function enlarged(cloud, box) {
    if (!box) return cloud;
    return Float32Array.from([...cloud, ...box.low, ...box.high]);
}

export class App {
    /** `before`: the same of another run, whose place this one takes; `runs`: those of a sweep. */
    constructor(scene, archive, licenses, wish, { before = null, runs = null } = {}) {
        this.scene = scene;
        this.wish = wish;
        this.archive = archive;
        this.runs = runs;
        this.gone = new AbortController();
        this.clock = new Clock(this.archive.track(scene.times)?.data ?? new Float32Array(0));
        this.theme = wish.theme ?? (matchMedia("(prefers-color-scheme: dark)").matches ? "dark" : "light");
        document.documentElement.dataset.theme = this.theme;
        this.canvas = before?.canvas ?? h("canvas", { class: "scene", tabindex: 0, "aria-label": "the mechanism" });
        before?.leave();
        const swinging = new Set(scene.modes.flatMap(({ shape }) => shape.map(([b]) => b)));
        this.bodies = new Bodies(scene.bodies, this.archive, this.clock, swinging);
        this.#buildScene(before);
        this.#buildPage(licenses);
        this.camera.reserved = (this.tension ? 36 : 0) + (this.wish.bare ? 32 : 0);
        this.setTheme(this.theme);
        this.#resize();
        this.resizing = new ResizeObserver(() => this.#resize());
        this.resizing.observe(this.viewport);
        this.player.seek(wish.time ?? this.clock.first);
    }

    #buildScene(before) {
        const { scene, archive, bodies } = this;
        this.stage = new Stage(this.canvas, this.theme, bodies.count > CROWD && !this.wish.film, before?.stage.renderer);
        const cloud = enlarged(sweep(scene, bodies), before?.box);
        this.box = bounds(cloud);
        const { radius } = this.box;
        const crowd = Math.max(1, Math.sqrt(scene.joints.length / 12));
        const look = { rod: 0.008 * radius, point: 0.008 * radius, joint: (0.022 * radius) / crowd, spring: 0.05 * radius };
        const [stage, vertical] = [this.stage, "xyz".indexOf(scene.up)];
        const sign = scene.gravity[vertical] > 0 ? -1 : 1;
        stage.setUpward(new Vector3().setComponent(vertical, sign));
        for (const object of bodies.objects) stage.scene.add(object);
        this.ground = new Ground(this.box, scene.up, sign, stage);
        this.shapes = new Shapes(scene, bodies, stage, look);
        this.joints = new Joints(scene.joints, bodies, stage, look);
        this.springs = new Springs(scene.springs, bodies, stage, look);
        this.cables = new Cables(scene, archive, bodies, stage);
        this.stays = new BodyLines(stays(scene, this.shapes), bodies, { width: 1.5, colour: stage.palette.joint, shading: 0 });
        stage.addStrokes(this.stays.strokes);
        this.links = new BodyLines(scene.links.map(({ i, j }) => [i, j]), bodies, { width: 2, colour: stage.palette.line });
        stage.addStrokes(this.links.strokes);
        this.arrows = new Arrows(scene.arrows, archive, bodies, stage, radius);
        this.against = scene.against ? new Against(scene, archive, stage, look) : null;
        this.camera = new Camera(stage, cloud, this.box, scene.up, sign, () => this.invalidate());
        this.modes = new Modes(scene.modes, bodies, radius, (active) => this.#modeChanged(active));
    }

    #buildPage(licenses) {
        const { scene, bodies } = this;
        const layer = h("div", { class: "labels" });
        this.labels = new Labels(layer, bodies, this.stage);
        this.selection = new Selection(this);
        this.picker = new Picker(this.stage, bodies, this.shapes.pickable);
        this.save = new Save(this);
        this.player = new Player(this.clock, scene.units.time, scene.events, (time) => this.#shown(time), () => this.#woken());
        this.channels = new Channels(scene.channels, this.archive);
        this.plots = new Plots({
            channels: this.channels, against: this.against, timeUnit: scene.units.time, events: scene.events,
            seek: (time) => this.player.seek(time), save: this.save,
        });
        const list = new ChannelPicker(this.channels, () => this.plots.names, (name) => this.plots.toggle(name), this.gone.signal);
        this.panel = new Panel([
            { name: "Plots", element: h("div", {}, list.element, this.plots.element) },
            { name: "Bodies", element: bodyList(bodies, scene.units, (b) => this.select(b)) },
            ...(this.modes.element ? [{ name: "Modes", element: this.modes.element }] : []),
            { name: "About", element: about(scene, licenses, (time) => this.player.seek(time), this.clock.times.length, this.channels.times.length) },
        ]);
        this.showing = showMenu(this.#switches());
        this.tension = this.cables.range ? new TensionLegend(this.cables.range, scene.units.force) : null;
        this.triad = new Triad(scene.gravity);
        this.keys = keysOf(this);
        this.help = new Help(this.keys);
        this.scaleText = h("span", { class: "grid-scale" }, `grid ${short(this.ground.step)} ${scene.units.length}`);
        const overlays = [layer, this.tension?.element, this.triad.element, this.scaleText, this.#ghostNote(), this.selection.element, this.showing.menu, this.help.element];
        this.viewport = h("main", { class: "viewport" }, this.canvas, ...overlays);
        const root = document.getElementById("app");
        this.elements = [this.#header(), this.viewport, this.panel.element, this.player.element];
        root.append(...this.elements);
        root.classList.toggle("bare", this.wish.bare);
        if (this.wish.size) [root.style.width, root.style.height] = this.wish.size.map((side) => `${side}px`);
        this.plots.set(this.wish.plot ?? scene.channels.shown ?? this.channels.first());
        this.#listen();
    }

    #ghostNote() {
        return this.against ? h("span", { class: "ghost-note" }, h("i", { class: "swatch" }), this.against.name) : null;
    }

    #switches() {
        const { scene, arrows } = this;
        const names = { force: "Forces", torque: "Torques", reaction: "Reactions" };
        const units = { force: scene.units.force, reaction: scene.units.force, torque: [scene.units.force, scene.units.length].filter(Boolean).join(" ") };
        const longest = (kind) => `${names[kind]} (longest ${short(arrows.scale(kind), 3)} ${units[kind]})`;
        const drawn = (name, title, on, set) => ({ name, title, on, change: (shown) => this.#change(() => set(shown)) });
        return [
            drawn("labels", "Names of bodies", false, (shown) => this.labels.set({ shown })),
            ...KINDS.filter((kind) => arrows.has(kind)).map((kind) =>
                drawn(kind, longest(kind), false, (shown) => this.#showArrows(kind, shown))),
            ...(scene.joints.length ? [drawn("joints", "Joints", true, (shown) => { this.joints.visible = shown; })] : []),
            ...(scene.springs.length ? [drawn("springs", "Springs", true, (shown) => { this.springs.visible = shown; })] : []),
            ...(this.against ? [drawn("against", this.against.name, true, (shown) => { this.against.visible = shown; })] : []),
            drawn("ground", "Grid", true, (shown) => { this.ground.visible = shown; }),
        ];
    }

    #showArrows(kind, shown) {
        this.arrows.show(kind, shown);
        this.camera.include(this.arrows.tips());
        this.stale = true;
    }

    #change(act) {
        act();
        this.invalidate();
    }

    #header() {
        const { scene, camera } = this;
        const view = (name) => h("button", { type: "button", class: "tool letter", title: `View along ${name} (${name.toUpperCase()})`, onclick: () => camera.view(name) }, name);
        return h(
            "header",
            { class: "bar" },
            h("div", { class: "titles" }, h("h1", {}, scene.title || scene.name), h("p", { title: scene.outcome }, [scene.deck, scene.outcome].filter(Boolean).join(" · "))),
            h(
                "nav",
                { class: "tools", "aria-label": "view" },
                iconButton("fit", "Frame the whole motion (F)", () => camera.fit()),
                iconButton("iso", "Isometric view (I)", () => camera.view("iso")),
                view("x"), view("y"), view("z"),
                h("span", { class: "gap" }),
                iconButton("show", "What is drawn", () => { this.showing.menu.hidden = !this.showing.menu.hidden; }),
                iconButton("image", "Save the picture as PNG", () => this.save.picture()),
                iconButton("theme", "Dark or light (T)", () => this.toggleTheme()),
                iconButton("panel", "Panel with the plots (P)", () => this.togglePanel()),
                iconButton("help", "Keys (?)", () => this.help.toggle()),
            ),
        );
    }

    #listen() {
        const { signal } = this.gone;
        let down = null;
        this.canvas.addEventListener("pointerdown", ({ offsetX, offsetY }) => {
            down = [offsetX, offsetY];
            this.showing.menu.hidden = true;
        }, { signal });
        this.canvas.addEventListener("pointerup", ({ offsetX, offsetY, button }) => {
            if (button === 0 && down && Math.hypot(offsetX - down[0], offsetY - down[1]) < CLICK) this.select(this.picker.at(offsetX, offsetY));
            down = null;
        }, { signal });
        matchMedia("(prefers-color-scheme: dark)").addEventListener("change", ({ matches }) => this.setTheme(matches ? "dark" : "light"), { signal });
        listenToKeys(this.keys, signal);
    }

    /** What a reader has chosen, for another run that takes this one's place. */
    get state() {
        const { player, plots, panel, selection, bodies, showing, camera } = this;
        return {
            time: player.time, playing: player.playing, rate: player.rate, loops: player.loops,
            window: plots.window, tab: panel.chosen, shown: showing.state(), camera: camera.state,
            selected: selection.body < 0 ? null : bodies.list[selection.body].name,
        };
    }

    restore({ playing, rate, loops, window, tab, shown, camera, selected }) {
        this.camera.restore(camera);
        this.showing.restore(shown);
        this.panel.chooseName(tab);
        if (window) this.plots.zoom(window);
        if (selected !== null) this.select(this.bodies.find(selected));
        this.player.setLoop(loops);
        this.player.setRate(rate);
        if (playing) this.player.play();
    }

    /** Hears and shows nothing from now on; its picture stays until another is drawn. */
    leave() {
        this.gone.abort();
        this.resizing.disconnect();
        cancelAnimationFrame(this.pending);
        this.player.playing = false;
        this.camera.controls.dispose();
        this.plots.leave();
        for (const element of this.elements) element.remove();
    }

    /** Gives back what the graphics card holds of it. */
    free() {
        this.stage.free();
    }

    #resize() {
        const { clientWidth, clientHeight } = this.viewport;
        if (!clientWidth || !clientHeight) return;
        this.stage.resize(clientWidth, clientHeight);
        this.camera.refit();
        this.invalidate();
    }

    #shown(time) {
        if (this.modes?.active) this.modes.choose(this.modes.chosen);
        this.plots?.setTime(time, this.player?.playing);
        this.stale = true;
        this.invalidate();
    }

    /** Playing has begun or ended: numbers are brought up to date. */
    #woken() {
        this.plots?.setTime(this.player.time);
        this.stale = true;
        this.invalidate();
    }

    #modeChanged(active) {
        if (active) this.player.pause();
        this.stale = true;
        this.invalidate();
    }

    invalidate() {
        if (this.pending) return;
        this.pending = requestAnimationFrame((now) => this.#frame(now));
    }

    #frame(now) {
        this.pending = null;
        this.player.advance(now);
        if (this.modes.active) this.modes.place(now);
        this.#draw(now);
        if (this.player.playing || this.modes.active) this.invalidate();
    }

    #draw(now) {
        if (this.stale || this.modes.active) this.#place();
        this.camera.update(this.bodies, now);
        this.stage.render();
        this.labels.update();
        this.triad.update(this.stage.camera);
    }

    /** Puts everything where it belongs at the time shown. */
    #place() {
        this.stale = false;
        if (!this.modes.active) this.bodies.setTime(this.player.time);
        for (const part of [this.shapes, this.joints, this.springs, this.cables, this.links, this.stays, this.arrows]) part.update();
        this.against?.setTime(this.player.time);
        this.selection.update();
    }

    /** Draws now, whether anything has changed or not. */
    renderFrame() {
        this.stale = true;
        this.#draw(performance.now());
    }

    /** Pixels of the picture at which a body's origin is. */
    screen(b) {
        const place = new Vector3(...this.bodies.point([b, 0, 0, 0], [])).project(this.stage.camera);
        return [((place.x + 1) / 2) * this.stage.width, ((1 - place.y) / 2) * this.stage.height];
    }

    select(b) {
        this.selection.set(b);
        this.invalidate();
    }

    escape() {
        this.help.toggle(false);
        this.showing.menu.hidden = true;
        this.select(-1);
    }

    togglePanel() {
        document.getElementById("app").classList.toggle("wide");
        this.#resize();
    }

    toggleTheme() {
        this.setTheme(this.theme === "dark" ? "light" : "dark");
    }

    setTheme(theme) {
        this.theme = theme;
        document.documentElement.dataset.theme = theme;
        const { stage } = this;
        stage.setTheme(theme);
        for (const part of [this.ground, this.shapes, this.joints, this.springs, this.arrows]) part.setTheme(stage.palette);
        this.cables.setTheme(theme, stage.palette);
        this.links.strokes.setColour(stage.palette.line);
        this.stays.strokes.setColour(stage.palette.joint);
        this.tension?.setTheme(theme);
        this.plots.setTheme(theme);
        this.select(this.selection.body);
    }

    picture() {
        return picture(this);
    }

    curvesText() {
        return curvesTable(this.plots);
    }
}
