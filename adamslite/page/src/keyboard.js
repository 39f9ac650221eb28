// Keys and what they do; the list is also the page's help.
import { h, iconButton } from "./dom.js";

export function keysOf(app) {
    return [
        [[" "], "Space", "play or pause", () => app.player.toggle()],
        [["ArrowLeft"], "←", "one output step back", () => app.player.stepBy(-1)],
        [["ArrowRight"], "→", "one output step on", () => app.player.stepBy(1)],
        [["Home"], "Home", "to the start", () => app.player.seek(app.clock.first)],
        [["End"], "End", "to the end", () => app.player.seek(app.clock.last)],
        [["+", "="], "+", "faster", () => app.player.changeRate(1)],
        [["-"], "-", "slower", () => app.player.changeRate(-1)],
        [["f"], "F", "frame the whole motion", () => app.camera.fit()],
        [["i"], "I", "isometric view", () => app.camera.view("iso")],
        [["x"], "X", "view along x", () => app.camera.view("x")],
        [["y"], "Y", "view along y", () => app.camera.view("y")],
        [["z"], "Z", "view along z", () => app.camera.view("z")],
        [["l"], "L", "names of bodies", () => app.showing.toggle("labels")],
        [["g"], "G", "force arrows", () => app.showing.toggle("force")],
        [["r"], "R", "reaction arrows", () => app.showing.toggle("reaction")],
        ...(app.runs ? [
            [[","], ",", "the run before", () => app.runs.step(-1)],
            [["."], ".", "the run after", () => app.runs.step(1)],
        ] : []),
        [["p"], "P", "panel with the plots", () => app.togglePanel()],
        [["t"], "T", "dark or light", () => app.toggleTheme()],
        [["?", "h"], "?", "this list", () => app.help.toggle()],
        [["Escape"], "Esc", "close, let go of what is picked", () => app.escape()],
    ];
}

// Keys that move a slider of its own.
const MOVING = new Set(["ArrowLeft", "ArrowRight", "ArrowUp", "ArrowDown", "Home", "End", "PageUp", "PageDown"]);

export function listenToKeys(keys, signal) {
    document.addEventListener("keydown", (event) => {
        const field = event.target.closest?.("input:not([type=range]):not([type=checkbox]), select, textarea");
        if (event.ctrlKey || event.metaKey || event.altKey || field) return;
        if (MOVING.has(event.key) && event.target.closest?.(".runs input")) return;
        const found = keys.find(([names]) => names.includes(event.key) || names.includes(event.key.toLowerCase()));
        if (!found) return;
        event.preventDefault();
        found[3]();
    }, { signal });
}

/** The list of keys, over the page. */
export class Help {
    constructor(keys) {
        const rows = keys.flatMap(([, name, what]) => [h("dt", {}, h("kbd", {}, name)), h("dd", {}, what)]);
        this.element = h(
            "div",
            { class: "card help", hidden: true, role: "dialog", "aria-label": "keys" },
            h("header", {}, h("strong", {}, "Keys and pointer"), iconButton("close", "Close (Esc)", () => this.toggle(false))),
            h("dl", {}, ...rows),
            h("p", { class: "hint" }, "Drag turns the view, the right button or two fingers move it, the wheel zooms; a click picks a body."),
        );
    }

    toggle(shown = this.element.hidden) {
        this.element.hidden = !shown;
    }
}
