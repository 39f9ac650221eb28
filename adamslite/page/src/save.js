// Files that a reader takes along: pictures and tables of what is shown.
import uPlot from "uplot";
import { h } from "./dom.js";

function download(name, url) {
    h("a", { href: url, download: name }).click();
}

export class Save {
    constructor(app) {
        this.app = app;
    }

    get #stem() {
        return this.app.scene.name || "scene";
    }

    picture() {
        download(`${this.#stem}.png`, this.app.picture().toDataURL("image/png"));
    }

    /** A plot with its title and legend, as PNG. */
    plot(plot) {
        const { canvas } = plot.chart.ctx;
        const scale = window.devicePixelRatio || 1;
        const style = getComputedStyle(document.documentElement);
        const line = 18 * scale;
        const out = document.createElement("canvas");
        out.width = canvas.width;
        out.height = canvas.height + line * (plot.names.length + 0.5);
        const pen = out.getContext("2d");
        pen.fillStyle = style.getPropertyValue("--panel");
        pen.fillRect(0, 0, out.width, out.height);
        pen.drawImage(canvas, 0, 0);
        pen.font = `${12 * scale}px system-ui, sans-serif`;
        plot.names.forEach((name, k) => {
            const y = canvas.height + line * (k + 0.75);
            pen.fillStyle = plot.owner.colour(name);
            pen.fillRect(12 * scale, y - 5 * scale, 16 * scale, 3 * scale);
            pen.fillStyle = style.getPropertyValue("--ink");
            pen.fillText(plot.difference ? `difference of ${name}` : name, 36 * scale, y);
        });
        download(`${this.#stem}-plot.png`, out.toDataURL("image/png"));
    }

    /** The curves shown, within the window of time shown, as CSV. */
    curves() {
        const text = this.app.curvesText();
        const url = URL.createObjectURL(new Blob([text], { type: "text/csv" }));
        download(`${this.#stem}-curves.csv`, url);
        setTimeout(() => URL.revokeObjectURL(url), 10000);
    }
}

const quoted = (text) => (/[",\n]/.test(text) ? `"${text.replaceAll('"', '""')}"` : text);

/** CSV of some channels: time first, units in square brackets; with those of a second result. At
 *  a time that only one of the two has, the other's cells are empty. */
export function curvesTable(plots) {
    const { channels, against, names, window, timeUnit } = plots;
    const headed = (name, unit) => quoted(unit ? `${name} [${unit}]` : name);
    const shared = names.filter((each) => against?.channels.has(each));
    const heads = [
        ...names.map((name) => headed(name, channels.unit(name))),
        ...shared.map((name) => headed(`${against.name}: ${name}`, channels.unit(name))),
    ];
    const tables = [[Array.from(channels.times), ...names.map((name) => Array.from(channels.data(name)))]];
    if (shared.length) tables.push([Array.from(against.channels.times), ...shared.map((name) => Array.from(against.channels.data(name)))]);
    const [times, ...columns] = uPlot.join(tables);
    const cell = (value) => (Number.isFinite(value) ? Number(value.toPrecision(7)) : "");
    const rows = times.flatMap((time, k) => {
        if (window && (time < window.min || time > window.max)) return [];
        return [[cell(time), ...columns.map((values) => cell(values[k]))].join(",")];
    });
    return `${[[headed("time", timeUnit), ...heads].join(","), ...rows].join("\n")}\n`;
}
