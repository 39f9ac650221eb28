// Channels of a result: their values, and the searchable list from which curves are chosen.
import { h, icon } from "./dom.js";

const NOISE = 1e-6; // of the values of a channel: a smaller change is none
const LISTED = 150;
const ALIKE = 30; // ratio of sizes up to which channels without a unit share a plot

/** Value at a time on the straight line between those of a table; none outside it. */
export function between(times, values, time) {
    let low = 0;
    let high = times.length - 1;
    if (high < 0 || !(time >= times[0] && time <= times[high])) return NaN;
    while (high - low > 1) {
        const middle = (low + high) >> 1;
        if (times[middle] <= time) low = middle;
        else high = middle;
    }
    const f = high > low ? (time - times[low]) / (times[high] - times[low]) : 0;
    if (f === 0) return values[low];
    return f === 1 ? values[high] : values[low] + f * (values[high] - values[low]);
}

/** One result less another, at the times of the one with fewer of them: there the lines between
 *  the other's output times are shorter, and times of both are exact. */
export function difference(one, other, name) {
    const fewer = one.times.length <= other.times.length ? one : other;
    const times = fewer.times;
    return { times, values: Float64Array.from(times, (time) => one.at(name, time) - other.at(name, time)) };
}

export class Channels {
    constructor({ times, list }, archive) {
        this.archive = archive;
        this.times = archive.track(times)?.data ?? new Float32Array(0);
        this.list = archive.list(list);
        this.byName = new Map(this.list.map((channel) => [channel.name, channel]));
        this.values = new Map();
    }

    has(name) {
        return this.byName.has(name);
    }

    unit(name) {
        return this.byName.get(name)?.unit ?? "";
    }

    label(name) {
        return this.byName.get(name)?.label ?? "";
    }

    data(name) {
        if (!this.values.has(name)) this.values.set(name, this.archive.track(this.byName.get(name).values).data);
        return this.values.get(name);
    }

    /** Value at a time, on the straight line between output times. */
    at(name, time) {
        return between(this.times, this.data(name), time);
    }

    /** Channels whose name, label or unit hold all words, in the order of the result. */
    search(words) {
        const parts = words.toLowerCase().split(/\s+/).filter(Boolean);
        return this.list.filter(({ name, label, unit }) => {
            const text = `${name} ${label ?? ""} ${unit}`.toLowerCase();
            return parts.every((part) => text.includes(part));
        });
    }

    /** Names that share a plot: those of one unit; without a unit, those of like size. */
    groups(names) {
        const groups = [];
        for (const name of names) {
            const found = groups.find(([first]) => this.unit(first) === this.unit(name) && this.#alike(first, name));
            if (found) found.push(name);
            else groups.push([name]);
        }
        return groups;
    }

    #alike(one, other) {
        if (this.unit(one)) return true;
        const [a, b] = [this.#size(one), this.#size(other)];
        return Math.max(a, b) <= ALIKE * Math.min(a, b);
    }

    /** What is plotted at first: requests that change, else the coordinate that moves most. */
    first() {
        const requests = this.list.filter(({ name }) => name.startsWith("REQUEST/") && this.#changes(name));
        const groups = this.groups(requests.slice(0, 40).map(({ name }) => name));
        if (groups.length) return groups.slice(0, 2).flatMap((group) => group.slice(0, 3));
        for (const kind of [/\.[xyz]$/, /\.w[xyz]$/, /./]) {
            const found = this.#widest(this.list.filter(({ name }) => kind.test(name)));
            if (found) return [found];
        }
        return this.list.slice(0, 1).map(({ name }) => name);
    }

    #widest(list) {
        const spans = list.map(({ name }) => [this.#span(name), name]).sort((a, b) => b[0] - a[0]);
        const largest = list.reduce((most, { name }) => Math.max(most, this.#size(name)), 0);
        return spans.length && spans[0][0] > NOISE * largest ? spans[0][1] : undefined;
    }

    #changes(name) {
        return this.#span(name) > NOISE * this.#size(name);
    }

    #size(name) {
        return this.data(name).reduce((most, value) => Math.max(most, Number.isFinite(value) ? Math.abs(value) : 0), 0);
    }

    #span(name) {
        let low = Infinity;
        let high = -Infinity;
        for (const value of this.data(name)) {
            if (value < low) low = value;
            if (value > high) high = value;
        }
        return high - low;
    }
}

/** The field for words and the list of what they find. */
export class ChannelPicker {
    constructor(channels, chosen, toggle, signal) {
        this.channels = channels;
        this.chosen = chosen;
        this.toggle = toggle;
        this.input = h("input", {
            type: "search", placeholder: `Search ${channels.list.length} channels: name, unit`, "aria-label": "search channels",
            oninput: () => this.refresh(), onfocus: () => this.open(true),
        });
        this.list = h("div", { class: "channels", role: "listbox", hidden: true });
        this.element = h("div", { class: "picker" }, this.input, this.list);
        this.element.addEventListener("keydown", (event) => {
            if (event.key !== "Escape") return;
            this.open(false);
            this.input.blur();
        });
        document.addEventListener("pointerdown", ({ target }) => {
            if (!this.element.contains(target)) this.open(false);
        }, { signal });
    }

    open(shown) {
        this.list.hidden = !shown;
        if (shown) this.refresh();
    }

    refresh() {
        const found = this.channels.search(this.input.value);
        const rows = found.slice(0, LISTED).map((channel) => this.#row(channel));
        const rest = found.length - rows.length;
        if (rest > 0) rows.push(h("p", { class: "hint" }, `and ${rest} more: type to narrow`));
        if (!found.length) rows.push(h("p", { class: "hint" }, "no channel has these words"));
        this.list.replaceChildren(...rows);
    }

    #row({ name, unit, label }) {
        const chosen = this.chosen().includes(name);
        return h(
            "button",
            {
                type: "button", role: "option", class: "channel", "aria-selected": String(chosen),
                onclick: () => {
                    this.toggle(name);
                    this.refresh();
                },
            },
            icon(chosen ? "close" : "plus"),
            h("span", { class: "name" }, name),
            h("span", { class: "what" }, label && label !== name ? label : ""),
            h("span", { class: "unit" }, unit),
        );
    }
}
