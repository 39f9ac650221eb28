// A picture of the scene with its title, time and legend, for files.
import { viridis } from "./colours.js";
import { ends } from "./dom.js";

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
    const [gap, width, height, base] = [8, 130, 10, 54].map((size) => size * scale);
    let x = 16 * scale;
    const write = (text, colour) => {
        pen.fillStyle = colour;
        pen.fillText(text, x, base);
        x += pen.measureText(text).width + gap;
    };
    pen.font = `${12 * scale}px ${FONT}`;
    write(app.scene.units.force ? `tension (${app.scene.units.force})` : "tension", palette.muted);
    const [low, high] = ends(range);
    write(low, palette.ink);
    for (let step = 0; step < width; step += 1) {
        pen.fillStyle = `rgb(${viridis(step / width, theme).join(" ")})`;
        pen.fillRect(Math.round(x) + step, base - height, 1, height);
    }
    x += width + gap;
    write(high, palette.ink);
}

/** The three axes and gravity, as beside the scene. */
function triad(pen, app, scale, height) {
    const { lines, names, arrow, letter, down } = app.triad;
    pen.save();
    pen.translate(50 * scale, height - 50 * scale);
    pen.scale(scale, scale);
    pen.font = `italic 600 12px ${FONT}`;
    pen.textAlign = "center";
    pen.textBaseline = "middle";
    pen.lineCap = "round";
    const write = (text) => {
        pen.globalAlpha = Number(text.getAttribute("opacity") ?? 1);
        pen.fillText(text.textContent, Number(text.getAttribute("x")), Number(text.getAttribute("y")));
        pen.globalAlpha = 1;
    };
    lines.forEach((line, k) => {
        pen.strokeStyle = line.getAttribute("stroke");
        pen.fillStyle = pen.strokeStyle;
        pen.lineWidth = 2.5;
        pen.stroke(new Path2D(`M0,0L${line.getAttribute("x2")},${line.getAttribute("y2")}`));
        write(names[k]);
    });
    pen.strokeStyle = app.stage.palette.ink;
    pen.fillStyle = app.stage.palette.ink;
    pen.lineWidth = 1.6;
    if (down && arrow.getAttribute("opacity") !== "0") pen.stroke(new Path2D(arrow.getAttribute("d")));
    if (down) write(letter);
    pen.restore();
}

/** Names of bodies where they are shown. */
function names(pen, app, scale) {
    pen.font = `${11 * scale}px ${FONT}`;
    pen.fillStyle = app.stage.palette.ink;
    for (const [b, span] of app.labels.spans) {
        const [x, y] = app.screen(b);
        if (span.style.display !== "none") pen.fillText(span.textContent, (x + 12) * scale, (y - 8) * scale);
    }
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
    names(pen, app, scale);
    triad(pen, app, scale, source.height);
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
