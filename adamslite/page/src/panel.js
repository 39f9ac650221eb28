// The panel beside the picture: plots, bodies, modes, and what is known about the run.
import { h, short } from "./dom.js";

const LISTED = 300;

/** Tabs: {name, element}; only one is seen. */
export class Panel {
    constructor(tabs) {
        this.tabs = tabs;
        this.buttons = tabs.map(({ name }, k) =>
            h("button", { type: "button", role: "tab", onclick: () => this.choose(k) }, name));
        this.pages = tabs.map(({ element }) => h("div", { class: "page", role: "tabpanel" }, element));
        this.element = h("aside", { class: "panel" }, h("div", { class: "tabs", role: "tablist" }, ...this.buttons), ...this.pages);
        this.choose(0);
    }

    chooseName(name) {
        const index = this.tabs.findIndex((tab) => tab.name.toLowerCase() === name.toLowerCase());
        if (index >= 0) this.choose(index);
    }

    choose(index) {
        this.chosen = this.tabs[index].name;
        this.buttons.forEach((button, k) => button.setAttribute("aria-selected", String(k === index)));
        this.pages.forEach((page, k) => {
            page.hidden = k !== index;
        });
    }
}

/** The list of bodies, by words in their names. */
export function bodyList(bodies, units, select) {
    const list = h("div", { class: "bodies" });
    const shown = bodies.list.flatMap(({ kind }, b) => (kind === "none" ? [] : [b]));
    const row = (b) => {
        const { name, label, mass } = bodies.list[b];
        return h(
            "button",
            { type: "button", class: "body", onclick: () => select(b) },
            h("i", { class: "swatch", style: `background: ${bodies.colours[b]}` }),
            h("span", { class: "name" }, name),
            h("span", { class: "what" }, label && label !== name ? label : ""),
            h("span", { class: "unit" }, mass ? `${short(mass, 4)} ${units.mass}` : ""),
        );
    };
    const refresh = () => {
        const words = input.value.toLowerCase().split(/\s+/).filter(Boolean);
        const found = shown.filter((b) => words.every((word) => bodies.title(b).toLowerCase().includes(word)));
        const more = found.length - LISTED;
        list.replaceChildren(
            ...found.slice(0, LISTED).map(row),
            ...(more > 0 ? [h("p", { class: "hint" }, `and ${more} more: type to narrow`)] : []),
        );
    };
    const input = h("input", { type: "search", placeholder: `Search ${shown.length} bodies`, "aria-label": "search bodies", oninput: refresh });
    refresh();
    return h("div", { class: "picker" }, input, list);
}

/** What the run was and how it ended; `drawn` and `plotted`: how many times the page has. */
export function about(scene, licenses, seek, drawn, plotted) {
    const unit = scene.units.time;
    const items = [...scene.events].map(({ time, text }) =>
        h("li", {}, h("button", { type: "button", class: "link", onclick: () => seek(time) }, `${short(time, 6)} ${unit}`), ` ${text}`));
    const units = Object.entries(scene.units).filter(([, symbol]) => symbol).map(([what, symbol]) => `${what} ${symbol}`).join(", ");
    return h(
        "div",
        { class: "about" },
        h("h3", {}, scene.title || scene.name),
        h("p", {}, [scene.deck, scene.outcome].filter(Boolean).join(": ")),
        h("p", { class: "hint" }, units ? `Units: ${units}.` : "The deck names no units."),
        h("p", { class: "hint" }, `Motion is drawn from ${drawn} times, curves from ${plotted}; between them lines are straight.`),
        ...(scene.notes.length ? [h("h3", {}, "Notes"), h("ul", {}, ...scene.notes.map((note) => h("li", {}, note)))] : []),
        ...(items.length ? [h("h3", {}, "Events"), h("ul", { class: "events" }, ...items)] : []),
        h("details", {}, h("summary", {}, "Licences of the libraries in this page"), h("pre", {}, licenses.trim())),
    );
}

/** Switches of what is drawn. */
export function showMenu(options) {
    const boxes = options.map(({ name, title, on, change }) => {
        const box = h("input", { type: "checkbox", checked: on, onchange: () => change(box.checked) });
        return { name, box, row: h("label", {}, box, title) };
    });
    const menu = h("div", { class: "card menu", hidden: true }, ...boxes.map(({ row }) => row));
    const toggle = (name) => boxes.find((each) => each.name === name)?.box.click();
    const state = () => boxes.map(({ name, box }) => [name, box.checked]);
    const restore = (wanted) => {
        const shown = new Map(wanted);
        for (const { name, box } of boxes) if (shown.has(name) && shown.get(name) !== box.checked) box.click();
    };
    return { menu, toggle, state, restore };
}
