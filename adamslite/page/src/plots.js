// Curves over time: one plot for each quantity, with a cursor that is the time of the scene.
import uPlot from "uplot";
import { between, difference } from "./channels.js";
import { curveColour } from "./colours.js";
import { h, iconButton, Pace, READABLE, short, SMOOTH } from "./dom.js";

const WHEEL = 0.85; // of the window that one click of the wheel keeps

const EVENTS = 30; // up to which each has a line in the plots

const css = (name) => getComputedStyle(document.documentElement).getPropertyValue(name).trim();

const gaps = (values) => Array.from(values, (value) => (Number.isFinite(value) ? value : null));

/** One plot: all its curves have one unit. */
class Plot {
    constructor(owner, unit, names, difference = false) {
        this.owner = owner;
        this.unit = unit;
        this.names = names;
        this.difference = difference;
        this.holder = h("div", { class: "curves" });
        this.legend = h("ul", { class: "legend" });
        this.cursor = h("div", { class: "cursor" });
        this.element = h("section", { class: difference ? "plot difference" : "plot" }, this.#head(), this.holder, this.legend);
        this.values = [];
    }

    #head() {
        const { owner } = this;
        const what = this.difference ? `Difference to ${owner.against.name}` : this.#quantity();
        return h(
            "header",
            {},
            h("h3", {}, what),
            iconButton("zoom", "Whole time (double click); the wheel zooms, dragging with shift selects", () => owner.zoom(null)),
            iconButton("image", "Save this plot as PNG", () => owner.save.plot(this)),
            iconButton("table", "Save the curves shown as CSV", () => owner.save.curves()),
        );
    }

    // One name, the statement that all belong to, or the first of the names.
    #quantity() {
        if (this.names.length === 1) return this.names[0];
        const statements = new Set(this.names.map((name) => name.slice(0, name.lastIndexOf("."))));
        return statements.size === 1 && !statements.has("") ? [...statements][0] : this.names.join(", ");
    }

    #axisName() {
        const unit = this.unit ? `(${this.unit})` : "";
        return this.names.length === 1 && !this.difference ? `${this.names[0]} ${unit}`.trim() : unit;
    }

    /** Times and values of the curves, gaps where there is no number, and how they are drawn. */
    #series() {
        const tables = this.difference ? this.#differences() : this.#curves();
        const series = tables.flatMap(({ names, look }) => names.map((name) => ({ stroke: this.owner.colour(name), ...look })));
        return { data: uPlot.join(tables.map(({ times, values }) => [Array.from(times), ...values.map(gaps)])), series };
    }

    #curves() {
        const { channels, against } = this.owner;
        const table = (from, names, look) => ({ times: from.times, names, values: names.map((name) => from.data(name)), look });
        const own = table(channels, this.names, { width: 2 });
        const shared = this.names.filter((name) => against?.channels.has(name));
        return shared.length ? [own, table(against.channels, shared, { width: 1.5, dash: [6, 4] })] : [own];
    }

    #differences() {
        const { channels, against } = this.owner;
        this.differences = new Map(this.names.map((name) => [name, difference(channels, against.channels, name)]));
        return [...this.differences].map(([name, { times, values }]) => ({ times, names: [name], values: [values], look: { width: 1.75 } }));
    }

    build(width, height) {
        this.chart?.destroy();
        const { data, series } = this.#series();
        const ink = css("--muted");
        const grid = { stroke: css("--rule"), width: 1 };
        const axis = { stroke: ink, grid, ticks: { ...grid, size: 4 }, font: "11px system-ui, sans-serif", labelFont: "11px system-ui, sans-serif" };
        const unit = this.owner.timeUnit;
        this.chart = new uPlot(
            {
                width,
                height,
                series: [{}, ...series.map((each) => ({ ...each, points: { show: data[0].length < 3 } }))],
                legend: { show: false },
                scales: { x: { time: false, range: (u, low, high) => (high > low ? [low, high] : spread(low, high)) }, y: { range: (u, low, high) => spread(low, high) } },
                cursor: { show: false },
                pxAlign: 0,
                padding: [8, 12, 0, 0],
                axes: [
                    { ...axis, label: unit ? `time (${unit})` : "time", labelSize: 16, size: 30, labelGap: 0 },
                    { ...axis, label: this.#axisName(), labelSize: 16, size: 52, labelGap: 0, values: (u, ticks) => ticks.map((tick) => (tick === null ? "" : short(tick, 6))) },
                ],
                hooks: { drawClear: [(u) => this.owner.drawEvents(u)], setScale: [() => this.moveCursor(this.owner.time)] },
            },
            data,
            this.holder,
        );
        this.chart.over.append(this.cursor);
        this.owner.listen(this.chart);
        if (this.owner.window) this.chart.setScale("x", this.owner.window);
        this.#legend();
        this.moveCursor(this.owner.time);
        this.read(this.owner.time);
    }

    #legend() {
        this.values = [];
        const rows = this.names.map((name) => {
            const value = h("span", { class: "value" });
            this.values.push(value);
            const label = this.owner.channels.label(name);
            return h(
                "li",
                {},
                h("i", { class: "swatch", style: `background: ${this.owner.colour(name)}` }),
                h("span", { class: "name", title: label }, this.difference ? `Δ ${name}` : name),
                value,
                this.difference ? null : iconButton("close", `Remove ${name}`, () => this.owner.toggle(name)),
            );
        });
        this.legend.replaceChildren(...rows);
    }

    moveCursor(time) {
        if (!this.chart) return;
        const { min, max } = this.chart.scales.x;
        const inside = time >= min && time <= max;
        this.cursor.style.display = inside ? "" : "none";
        if (inside) this.cursor.style.transform = `translateX(${this.chart.valToPos(time, "x").toFixed(2)}px)`;
    }

    read(time) {
        this.names.forEach((name, k) => {
            if (this.values[k]) this.values[k].textContent = this.#reading(name, time);
        });
    }

    #reading(name, time) {
        const { channels, against } = this.owner;
        const unit = this.unit ? ` ${this.unit}` : "";
        if (this.difference) {
            const { times, values } = this.differences.get(name);
            return short(between(times, values, time), 3) + unit;
        }
        const own = short(channels.at(name, time), 5);
        if (!against?.channels.has(name)) return own + unit;
        return `${own} | ${short(against.channels.at(name, time), 5)}${unit}`;
    }
}

/** A little more than the values; around a constant, a tenth of it. */
function spread(low, high) {
    if (low === null || low === undefined) return [0, 1];
    const room = high > low ? 0.06 * (high - low) : Math.abs(low) * 0.1 || 1;
    return [low - room, high + room];
}

export class Plots {
    /** `seek(time)` is called when a place on a plot is chosen; `save` writes files. */
    constructor({ channels, against, timeUnit, events, seek, save }) {
        Object.assign(this, { channels, against, timeUnit, events, seek, save });
        this.time = 0;
        this.theme = "light";
        this.pace = new Pace(READABLE);
        this.motion = new Pace(SMOOTH);
        this.window = null;
        this.names = [];
        this.plots = [];
        this.element = h("div", { class: "plots" });
        this.hint = h("p", { class: "hint" });
        this.resizing = new ResizeObserver(() => this.layout());
        this.resizing.observe(this.element);
    }

    /** Draws nothing from now on. */
    leave() {
        this.resizing.disconnect();
        for (const plot of this.plots) plot.chart?.destroy();
    }

    colour(name) {
        return curveColour(this.names.indexOf(name), this.theme);
    }

    toggle(name) {
        this.set(this.names.includes(name) ? this.names.filter((each) => each !== name) : [...this.names, name]);
    }

    /** Shows these channels, those of one unit together. */
    set(names) {
        this.names = names.filter((name) => this.channels.has(name));
        for (const plot of this.plots) plot.chart?.destroy();
        this.plots = this.channels.groups(this.names).flatMap((together) => {
            const unit = this.channels.unit(together[0]);
            const shared = together.filter((name) => this.against?.channels.has(name));
            const plots = [new Plot(this, unit, together)];
            return shared.length ? [...plots, new Plot(this, unit, shared, true)] : plots;
        });
        this.element.replaceChildren(...this.plots.map(({ element }) => element), this.hint);
        const dashed = this.against ? ` Dashed: ${this.against.name}.` : "";
        this.hint.textContent = this.names.length
            ? `Drag over a plot to move through time; the wheel zooms.${dashed}`
            : "Choose a channel above to plot it.";
        this.built = null;
        this.layout();
    }

    layout() {
        const width = Math.floor(this.element.clientWidth) - 2;
        const key = `${width} ${this.names.join()}`;
        if (width < 60 || key === this.built) return;
        this.built = key;
        for (const plot of this.plots) plot.build(width, plot.difference ? 130 : this.plots.length > 2 ? 170 : 210);
    }

    setTheme(theme) {
        this.theme = theme;
        this.built = null;
        this.layout();
    }

    setTime(time, playing = false) {
        this.time = time;
        if (!this.motion.due(playing)) return;
        for (const plot of this.plots) plot.moveCursor(time);
        if (!this.pace.due(playing)) return;
        for (const plot of this.plots) plot.read(time);
    }

    /** Time at which the cursor of the first plot stands, as it is drawn. */
    get cursorTime() {
        const plot = this.plots[0];
        if (!plot?.chart || plot.cursor.style.display === "none") return null;
        return plot.chart.posToVal(new DOMMatrix(plot.cursor.style.transform).e, "x");
    }

    /** Shows a part of the time, {min, max}, in all plots; null: all of it. */
    zoom(window) {
        const { times } = this.channels;
        const [first, last] = [times[0], times[times.length - 1]];
        this.window = window && { min: Math.max(window.min, first), max: Math.min(window.max, last) };
        if (this.window && this.window.max - this.window.min >= last - first) this.window = null;
        for (const { chart } of this.plots) chart?.setScale("x", this.window ?? { min: first, max: last });
    }

    drawEvents(u) {
        if (this.events.length > EVENTS) return;
        const { ctx, bbox } = u;
        ctx.save();
        ctx.strokeStyle = css("--muted");
        ctx.setLineDash([2 * devicePixelRatio, 4 * devicePixelRatio]);
        for (const { time } of this.events) {
            const x = u.valToPos(time, "x", true);
            if (x < bbox.left || x > bbox.left + bbox.width) continue;
            ctx.beginPath();
            ctx.moveTo(x, bbox.top);
            ctx.lineTo(x, bbox.top + bbox.height);
            ctx.stroke();
        }
        ctx.restore();
    }

    // Dragging moves the time; with shift it selects a window; the wheel zooms about the pointer.
    listen(chart) {
        const { over } = chart;
        const timeAt = ({ clientX }) => chart.posToVal(clientX - over.getBoundingClientRect().left, "x");
        let from = null;
        over.style.touchAction = "pan-y";
        over.addEventListener("pointerdown", (event) => {
            if (event.button !== 0) return;
            over.setPointerCapture(event.pointerId);
            from = event.shiftKey ? timeAt(event) : null;
            if (from === null) this.seek(timeAt(event));
        });
        over.addEventListener("pointermove", (event) => {
            if (!over.hasPointerCapture(event.pointerId)) return;
            if (from === null) this.seek(timeAt(event));
            else this.#select(chart, from, timeAt(event));
        });
        over.addEventListener("pointerup", (event) => {
            if (from !== null) this.#selected(chart, from, timeAt(event));
            from = null;
        });
        over.addEventListener("dblclick", () => this.zoom(null));
        over.addEventListener("wheel", (event) => this.#wheel(chart, event, timeAt(event)), { passive: false });
    }

    #select(chart, from, to) {
        const [left, right] = [from, to].map((time) => chart.valToPos(time, "x")).sort((a, b) => a - b);
        chart.setSelect({ left, top: 0, width: right - left, height: chart.over.clientHeight }, false);
    }

    #selected(chart, from, to) {
        chart.setSelect({ left: 0, top: 0, width: 0, height: 0 }, false);
        if (from !== to) this.zoom({ min: Math.min(from, to), max: Math.max(from, to) });
    }

    #wheel(chart, event, time) {
        event.preventDefault();
        const { min, max } = chart.scales.x;
        const scale = event.deltaY < 0 ? WHEEL : 1 / WHEEL;
        this.zoom({ min: time - (time - min) * scale, max: time + (max - time) * scale });
    }
}
