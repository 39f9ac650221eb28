// A picture of the scene with its title, time and legend, for files.
import { viridis } from "./colours.js";
import { short } from "./dom.js";

const FONT = "system-ui, -apple-system, 'Segoe UI', 'DejaVu Sans', sans-serif";

function caption(pen, app, scale, width, height) {
    const { scene, stage, player, clock } = app;
    const margin = 16 * scale;
    pen.textBaseline = "alphabetic";
    pen.fillStyle = stage.palette.ink;
    pen.font = `600 ${15 * scale}px ${FONT}`;
    pen.fillText(scene.title || scene.name, margin, margin + 12 * scale, width - 2 * margin);
    if (!(clock.duration > 0)) return;
    const time = `t = ${player.time.toFixed(player.digits)} ${scene.units.time}`;
    pen.font = `${14 * scale}px ${FONT}`;
    pen.fillText(time, width - margin - pen.measureText(time).width, height - margin);
}

function legend(pen, app, scale) {
    const { range } = app.cables;
    if (!range) return;
    const { palette, theme } = app.stage;
    const [left, top, width, height] = [16, 44, 180, 10].map((size) => size * scale);
    pen.font = `${12 * scale}px ${FONT}`;
    pen.fillStyle = palette.muted;
    pen.fillText(app.scene.units.force ? `tension (${app.scene.units.force})` : "tension", left, top + 8 * scale);
    for (let x = 0; x < width; x += 1) {
        pen.fillStyle = `rgb(${viridis(x / width, theme).join(" ")})`;
        pen.fillRect(left + x, top + 14 * scale, 1, height);
    }
    pen.fillStyle = palette.muted;
    [0, 0.5, 1].forEach((part) => {
        const text = short(range[0] + part * (range[1] - range[0]), 3);
        const shift = part * pen.measureText(text).width;
        pen.fillText(text, left + part * width - shift, top + 38 * scale);
    });
}

/** A canvas with what is shown now. */
export function picture(app) {
    const { stage } = app;
    app.renderFrame();
    const source = stage.canvas;
    const canvas = document.createElement("canvas");
    canvas.width = source.width;
    canvas.height = source.height;
    const pen = canvas.getContext("2d");
    pen.drawImage(source, 0, 0);
    const scale = source.width / stage.width;
    legend(pen, app, scale);
    caption(pen, app, scale, source.width, source.height);
    return canvas;
}

/** Pictures at several times, as data URLs in the document, for a program that reads it. */
export function filmStrip(app, times) {
    const holder = document.createElement("pre");
    holder.id = "film";
    holder.textContent = times
        .map((time) => {
            app.player.seek(time);
            return picture(app).toDataURL("image/png");
        })
        .join("\n");
    document.body.append(holder);
}
