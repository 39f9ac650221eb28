// The runs of a sweep: a slider for each number that varies, and the run that is nearest to them.
import { h, iconButton, short } from "./dom.js";

const LEVELS = 60; // values of a number up to which each is a place of its slider
const PLACES = 200; // of a slider over more of them
const DIGITS = 5;

const known = (values) => values.map((value) => value ?? NaN);
const withUnit = (value, unit) => [short(value, DIGITS), unit].filter(Boolean).join(" ");

/** A slider over the values of a number: of few, it stops at each; of many, a mark is where the
 *  run is that is shown. */
class Slider {
    constructor({ name, unit, values }, moved) {
        this.unit = unit;
        this.values = known(values);
        this.levels = [...new Set(this.values.filter(Number.isFinite))].sort((a, b) => a - b);
        [this.low, this.high] = [this.levels[0], this.levels[this.levels.length - 1]];
        this.stops = this.levels.length <= LEVELS;
        this.input = h("input", {
            type: "range", min: 0, max: this.stops ? this.levels.length - 1 : PLACES, step: 1, "aria-label": name,
            oninput: () => {
                this.target = this.#valueAt(Number(this.input.value));
                moved();
            },
        });
        this.mark = h("i", { class: "mark", "aria-hidden": "true", hidden: this.stops });
        this.output = h("output", {});
        this.element = h("div", { class: "number" }, h("span", { class: "name", title: name }, name), this.output, h("div", { class: "scale" }, this.mark, this.input));
    }

    get varies() {
        return this.levels.length > 1;
    }

    #valueAt(place) {
        return this.stops ? this.levels[place] : this.low + ((this.high - this.low) * place) / PLACES;
    }

    #share(value) {
        return this.high > this.low ? (value - this.low) / (this.high - this.low) : 0;
    }

    /** How far a run is from what is asked for, as a part of the range. */
    distance(run) {
        return this.#share(this.values[run]) - this.#share(this.target);
    }

    /** The value of the run that is shown. */
    show(run) {
        const text = withUnit(this.values[run], this.unit);
        this.output.textContent = text;
        this.input.setAttribute("aria-valuetext", text);
        this.mark.style.left = `calc(8px + (100% - 16px) * ${this.#share(this.values[run])})`; // as a knob goes
    }

    /** The slider goes to where a run is. */
    aimAt(run) {
        this.target = this.values[run];
        this.input.value = this.stops ? this.levels.indexOf(this.target) : Math.round(PLACES * this.#share(this.target));
    }
}

export class Runs {
    /** `table`: what the page has of the runs; `chosen(run)` is called when another one is. */
    constructor(table, chosen) {
        this.table = table;
        this.chosen = chosen;
        this.count = table.runs.length;
        this.index = -1;
        this.sliders = table.numbers.map((number) => new Slider(number, () => this.#moved())).filter((slider) => slider.varies);
        this.title = h("strong", { "aria-live": "polite" });
        this.note = h("p", { class: "note" });
        this.measures = h("dl", {});
        this.element = h(
            "section",
            { class: "runs", "aria-label": "runs of the sweep" },
            h("header", {}, this.title, iconButton("back", "The run before (,)", () => this.step(-1)), iconButton("forward", "The run after (.)", () => this.step(1))),
            ...this.sliders.map(({ element }) => element),
            this.note,
            this.measures,
        );
    }

    scene(run) {
        return this.table.scenes[run];
    }

    /** The place of the run with a number of the sweep, else the first that has a motion. */
    placeOf(number) {
        const found = this.table.runs.indexOf(number);
        return found >= 0 ? found : this.table.scenes.findIndex((scene) => scene !== null);
    }

    step(by) {
        this.choose((this.index + by + this.count) % this.count);
    }

    /** Shows a run, and moves the sliders to it. */
    choose(run) {
        for (const slider of this.sliders) slider.aimAt(run);
        this.#show(run);
    }

    #moved() {
        let [best, nearest] = [0, Infinity];
        for (let run = 0; run < this.count; run += 1) {
            const apart = this.sliders.reduce((sum, slider) => sum + slider.distance(run) ** 2, 0);
            if (apart < nearest) [best, nearest] = [run, apart];
        }
        this.#show(best);
    }

    #show(run) {
        for (const slider of this.sliders) slider.show(run);
        if (run === this.index) return;
        this.index = run;
        const { runs, outcomes, messages, failed, measures } = this.table;
        this.title.textContent = `Run ${runs[run]} of ${this.count}`;
        this.note.textContent = failed[run] ? `Failed: ${[outcomes[run], messages[run]].filter(Boolean).join(": ")}` : "";
        this.note.hidden = !failed[run];
        this.measures.replaceChildren(...measures.flatMap(({ name, unit, values }) => [
            h("dt", {}, name),
            h("dd", {}, failed[run] || values[run] === null ? "–" : withUnit(values[run], unit)),
        ]));
        this.chosen(run);
    }
}
