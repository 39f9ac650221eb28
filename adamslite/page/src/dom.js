// Small helpers for the page's elements.

/** An element with attributes, listeners (on...) and children. */
export function h(tag, attributes = {}, ...children) {
    const element = document.createElement(tag);
    for (const [name, value] of Object.entries(attributes)) {
        if (name.startsWith("on")) element.addEventListener(name.slice(2), value);
        else if (value === true) element.setAttribute(name, "");
        else if (value !== false && value !== null && value !== undefined) element.setAttribute(name, value);
    }
    element.append(...children.filter((child) => child !== null && child !== undefined));
    return element;
}

// Icons on a field of 24 x 24, drawn with lines of the text's colour.
const ICONS = {
    play: '<path d="M7 4.5v15l12-7.5z" fill="currentColor"/>',
    pause: '<path d="M7 5h3.5v14H7zM13.5 5H17v14h-3.5z" fill="currentColor" stroke="none"/>',
    back: '<path d="M17 5 8 12l9 7z" fill="currentColor"/><path d="M6 5v14"/>',
    forward: '<path d="m7 5 9 7-9 7z" fill="currentColor"/><path d="M18 5v14"/>',
    start: '<path d="m19 5-7 7 7 7zM11 5l-7 7 7 7z" fill="currentColor"/>',
    loop: '<path d="M4 11a7 7 0 0 1 7-6h6m0 0-3-3m3 3-3 3M20 13a7 7 0 0 1-7 6H7m0 0 3-3m-3 3 3 3"/>',
    fit: '<path d="M4 9V4h5M15 4h5v5M20 15v5h-5M9 20H4v-5"/><circle cx="12" cy="12" r="2.5"/>',
    iso: '<path d="m12 3 8 4.5v9L12 21l-8-4.5v-9zM12 12l8-4.5M12 12v9M12 12 4 7.5"/>',
    show: '<path d="M2.5 12S6 5.5 12 5.5 21.5 12 21.5 12 18 18.5 12 18.5 2.5 12 2.5 12z"/><circle cx="12" cy="12" r="3"/>',
    theme: '<circle cx="12" cy="12" r="8.5"/><path d="M12 3.5a8.5 8.5 0 0 1 0 17z" fill="currentColor"/>',
    image: '<rect x="3" y="5" width="18" height="14" rx="2"/><circle cx="8.5" cy="10" r="1.5"/><path d="m4 18 6-5 3 2.5 3.5-4L21 16"/>',
    table: '<rect x="3" y="5" width="18" height="14" rx="2"/><path d="M3 10h18M3 14.5h18M9 5v14"/>',
    help: '<circle cx="12" cy="12" r="9"/><path d="M9.5 9.5a2.5 2.5 0 1 1 3.5 2.3c-.7.3-1 .8-1 1.700M12 16.5v.5"/>',
    close: '<path d="m6 6 12 12M18 6 6 18"/>',
    panel: '<rect x="3" y="4.5" width="18" height="15" rx="2"/><path d="M14.5 4.5v15"/>',
    zoom: '<circle cx="10.5" cy="10.5" r="6.5"/><path d="m15.5 15.5 5 5M8 10.5h5M10.5 8v5"/>',
    follow: '<circle cx="12" cy="12" r="3"/><circle cx="12" cy="12" r="7"/><path d="M12 2v5M12 17v5M2 12h5M17 12h5"/>',
    path: '<path d="M3 17c4 0 3-10 8-10s3 8 10 6"/><circle cx="20" cy="13" r="1.5" fill="currentColor"/>',
    plus: '<path d="M12 5v14M5 12h14"/>',
};

export function icon(name) {
    const holder = document.createElement("span");
    holder.className = "icon";
    holder.innerHTML = `<svg viewBox="0 0 24 24" aria-hidden="true">${ICONS[name]}</svg>`;
    return holder;
}

/** A button with an icon; `title` is what it does, for pointers and readers of screens. */
export function iconButton(name, title, onclick, attributes = {}) {
    return h("button", { type: "button", class: "tool", title, "aria-label": title, onclick, ...attributes }, icon(name));
}

/** A number with `digits` significant digits, short. */
export function short(value, digits = 4) {
    if (!Number.isFinite(value)) return "–";
    if (value === 0) return "0";
    const size = Math.abs(value);
    if (size >= 1e5 || size < 1e-3) return value.toExponential(digits - 1).replace(/\.?0+e/, "e").replace("e+", "e");
    return String(Number(value.toPrecision(digits)));
}

/** The ends of a range with as many digits as tell them apart. */
export function ends([low, high]) {
    const digits = [3, 4, 5, 6].find((count) => short(low, count) !== short(high, count)) ?? 3;
    return [short(low, digits), short(high, digits)];
}

/** Largest of 1, 2, 5 times a power of ten that is not above `value`. */
export function niceStep(value) {
    const power = 10 ** Math.floor(Math.log10(value));
    const part = value / power;
    return power * (part >= 5 ? 5 : part >= 2 ? 2 : 1);
}

/** Whether something is due again that changes while playing: painting it in every frame would take
 *  longer than the scene. `period`: milliseconds from one time to the next. */
export class Pace {
    constructor(period) {
        this.period = period;
        this.last = -Infinity;
    }

    due(playing, now = performance.now()) {
        if (playing && now - this.last < this.period) return false;
        this.last = now;
        return true;
    }
}

export const READABLE = 100; // milliseconds between numbers that a reader can follow
export const SMOOTH = 30; // and between places of a line that moves
