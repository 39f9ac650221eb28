// What an address asks of the page behind its #, as in page.html#t=1.5&theme=dark&view=iso:
// t, theme, view, plot (channels, commas between), select, show (labels, force, ...), tab, mode (a
// number from 1) and its phase; run (of a sweep, its number); bare (the scene alone), size (1280x720, of the scene), film (times,
// commas between: pictures at these times). A page that is asked for none of t, mode, bare and film
// plays at once, unless its reader wants less motion.

const list = (text) => (text === null ? undefined : text.split(",").filter(Boolean));
const number = (text) => (text === null || !Number.isFinite(Number(text)) ? undefined : Number(text));

export function wishes(hash) {
    const asked = new URLSearchParams(hash.replace(/^#/, ""));
    const theme = asked.get("theme");
    return {
        time: number(asked.get("t")),
        theme: theme === "dark" || theme === "light" ? theme : undefined,
        plot: list(asked.get("plot")),
        plays: !["t", "mode", "bare", "film"].some((key) => asked.has(key)) && !matchMedia("(prefers-reduced-motion: reduce)").matches,
        run: number(asked.get("run")),
        bare: asked.has("bare"),
        size: asked.get("size")?.split("x").map(Number),
        film: list(asked.get("film"))?.map(Number),
        apply: (app) => apply(asked, app),
    };
}

function apply(asked, app) {
    if (asked.has("view")) app.camera.view(asked.get("view"), false);
    for (const name of list(asked.get("show")) ?? []) app.showing.toggle(name);
    const body = asked.has("select") ? app.bodies.find(asked.get("select")) : -1;
    if (body >= 0) app.select(body);
    const mode = number(asked.get("mode"));
    if (mode >= 1 && mode <= app.modes.modes.length) {
        app.modes.choose(mode - 1);
        app.modes.setPhase(number(asked.get("phase")) ?? 0);
    }
    if (asked.has("tab")) app.panel.chooseName(asked.get("tab"));
}
