// The page of a solved deck, or of the runs of a sweep: reads the scene and shows it.
import { App } from "./app.js";
import { Archive } from "./decode.js";
import { h, icon } from "./dom.js";
import { filmStrip } from "./picture.js";
import { Runs } from "./runs.js";
import { wishes } from "./wishes.js";

function text(id) {
    return document.getElementById(id)?.textContent ?? "";
}

/** The page's handle for tests and scripts. */
function handle(app) {
    const { bodies } = app;
    const found = (name) => {
        const b = bodies.find(name);
        if (b < 0) throw new Error(`there is no body ${name}`);
        return b;
    };
    return {
        ready: Promise.resolve(),
        seek: (time) => app.player.seek(time),
        play: () => app.player.play(),
        pause: () => app.player.pause(),
        get time() { return app.player.time; },
        get playing() { return app.player.playing; },
        get rate() { return app.player.rate; },
        get theme() { return app.theme; },
        get selected() { return app.selection.body < 0 ? null : bodies.list[app.selection.body].name; },
        get plotCursor() { return app.plots.cursorTime; },
        get plotted() { return [...app.plots.names]; },
        bodyPosition: (name) => [...bodies.objects[found(name)].matrixWorld.elements.slice(12, 15)],
        bodyAttitude: (name) => [...bodies.poses.subarray(7 * found(name) + 3, 7 * found(name) + 7)],
        pick: (x, y) => {
            const b = app.picker.at(x, y);
            return b < 0 ? null : bodies.list[b].name;
        },
        screenPosition: (name) => app.screen(found(name)),
        select: (name) => app.select(name ? found(name) : -1),
        plot: (names) => app.plots.set(names),
        curves: () => app.curvesText(),
        view: (name) => app.camera.view(name, false),
        mode: (index, phase = 0) => {
            app.modes.choose(index);
            if (app.modes.active) app.modes.setPhase(phase);
        },
        renderFrame: () => app.renderFrame(),
        cameraFrame: () => app.camera.describe(),
        get run() { return app.runs ? app.runs.table.runs[app.runs.index] : null; },
        chooseRun: (number) => app.runs.choose(app.runs.placeOf(number)),
        app,
    };
}

/** One run: the only one of a page, or that of a sweep which is chosen. */
class Show {
    constructor(scene, archive, wish) {
        Object.assign(this, { scene, archive, wish, app: null });
        this.licenses = text("licenses");
        if (!scene.runs) {
            this.#build(scene);
            return;
        }
        this.runs = new Runs(archive.list(scene.runs), (run) => this.#run(run));
        this.nothing = h("p", { class: "failure", role: "status", hidden: true });
        const root = document.getElementById("app");
        root.classList.add("sweep");
        root.append(this.runs.element, this.nothing);
        this.runs.choose(this.runs.placeOf(null));
        const asked = this.runs.placeOf(wish.run);
        if (asked !== this.runs.index) this.runs.choose(asked);
    }

    #run(run) {
        const found = this.runs.scene(run);
        document.getElementById("app").classList.toggle("without", found === null);
        this.nothing.hidden = found !== null;
        if (found !== null) this.#build({ ...this.scene, ...found });
        else {
            this.app?.player.pause();
            this.nothing.textContent = `Run ${this.runs.table.runs[run]} has no motion. ${this.runs.note.textContent}`.trim();
        }
    }

    #build(scene) {
        const { archive, licenses, runs, app: before } = this;
        if (!before) {
            this.app = new App(scene, archive, licenses, this.wish, { runs });
        } else {
            const { state, theme, plots } = before;
            const wish = { ...this.wish, time: state.time, theme, plot: [...plots.names] };
            this.app = new App(scene, archive, licenses, wish, { before, runs });
            this.app.restore(state);
            this.app.renderFrame();
            before.free();
        }
        window.adamslite = handle(this.app);
    }
}

function start() {
    const root = document.getElementById("app");
    try {
        const wish = wishes(location.hash);
        const { app } = new Show(JSON.parse(text("scene")), new Archive(text("data")), wish);
        wish.apply(app);
        if (wish.film) filmStrip(app, wish.film);
        else app.renderFrame();
        if (wish.plays) app.player.play();
    } catch (error) {
        const why = /WebGL/i.test(error.message) ? "This browser shows no 3-D graphics (WebGL), which the page needs." : `The page cannot be shown: ${error.message}`;
        root.replaceChildren(h("p", { class: "failure" }, icon("help"), why));
        throw error;
    }
}

start();
