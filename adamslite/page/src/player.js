// Playing: the time shown, how fast it runs, and the bar with its controls.
import { h, icon, iconButton, niceStep, Pace, READABLE, short } from "./dom.js";

const RATES = [0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1, 2, 5, 10, 20, 50, 100];
const PLEASANT = 8; // seconds within which a whole result plays when nothing else is said
const PATIENCE = 20;

/** Real time when it takes one to twenty seconds, else the rate nearest to eight seconds. */
export function pleasantRate(duration) {
    if (!(duration > 0) || (duration >= 1 && duration <= PATIENCE)) return 1;
    const power = niceStep(duration / PLEASANT);
    return Number(power.toPrecision(1));
}

/** Digits behind the point with which neighbouring times differ. */
function decimals(duration) {
    return duration > 0 ? Math.min(Math.max(2 - Math.floor(Math.log10(duration)), 0), 9) : 3;
}

export class Player {
    /** `show(time)` is called for every new time, `wake()` when playing begins or ends. */
    constructor(clock, unit, events, show, wake) {
        this.clock = clock;
        this.unit = unit;
        this.show = show;
        this.wake = wake;
        this.time = clock.first;
        this.playing = false;
        this.loops = true;
        this.rate = pleasantRate(clock.duration);
        this.digits = decimals(clock.duration);
        this.pace = new Pace(READABLE);
        this.element = this.#bar(events);
        this.#readout();
    }

    #bar(events) {
        const { clock } = this;
        const still = !(clock.duration > 0);
        this.button = iconButton("play", "Play or pause (space)", () => this.toggle(), { class: "tool play", disabled: still });
        this.slider = h("input", {
            type: "range", min: 0, max: 10000, step: "any", value: 0, class: "time", "aria-label": "time", disabled: still,
            oninput: () => this.seek(clock.first + (this.slider.value / 10000) * clock.duration),
        });
        // What is seen of the slider is moved, not painted again.
        this.fill = h("i", { class: "fill" });
        this.knob = h("i", { class: "knob" });
        this.output = h("output", { class: "readout" });
        this.loopButton = iconButton("loop", "Repeat", () => this.setLoop(!this.loops), { "aria-pressed": "true" });
        return h(
            "footer",
            { class: "player" },
            iconButton("start", "To the start (Home)", () => this.seek(clock.first), { disabled: still }),
            iconButton("back", "One output step back (left arrow)", () => this.stepBy(-1), { disabled: still }),
            this.button,
            iconButton("forward", "One output step on (right arrow)", () => this.stepBy(1), { disabled: still }),
            h("div", { class: "track" }, this.fill, h("div", { class: "rail" }, this.knob), this.slider, h("div", { class: "ticks" }, ...events.map((event) => this.#tick(event)))),
            this.output,
            this.#rates(),
            this.loopButton,
        );
    }

    #tick({ time, text }) {
        const part = this.clock.duration > 0 ? (time - this.clock.first) / this.clock.duration : 0;
        return h("i", { class: "tick", style: `left: ${100 * part}%`, title: `${short(time, 6)} ${this.unit}: ${text}` });
    }

    #rates() {
        const rates = [...new Set([...RATES, this.rate])].sort((a, b) => a - b);
        const name = (rate) => `${rate < 1e-3 || rate >= 1e4 ? rate.toExponential() : rate}×`;
        this.select = h(
            "select",
            { class: "rate", title: "Speed: seconds of the result in one second (+ and -)", "aria-label": "speed", onchange: () => this.setRate(Number(this.select.value)) },
            ...rates.map((rate) => h("option", { value: rate, selected: rate === this.rate }, name(rate))),
        );
        return this.select;
    }

    setLoop(loops) {
        this.loops = loops;
        this.loopButton.setAttribute("aria-pressed", String(loops));
    }

    setRate(rate) {
        this.rate = rate;
        this.select.value = String(rate);
    }

    /** The next faster (+1) or slower (-1) speed. */
    changeRate(by) {
        const { options, selectedIndex } = this.select;
        const next = Math.min(Math.max(selectedIndex + by, 0), options.length - 1);
        this.setRate(Number(options[next].value));
    }

    play() {
        if (!(this.clock.duration > 0)) return;
        if (this.time >= this.clock.last) this.seek(this.clock.first);
        this.#set(true);
    }

    pause() {
        this.#set(false);
    }

    toggle() {
        if (this.playing) this.pause();
        else this.play();
    }

    #set(playing) {
        this.playing = playing;
        this.since = null;
        this.button.replaceChildren(icon(playing ? "pause" : "play"));
        this.button.setAttribute("aria-pressed", String(playing));
        this.#readout();
        this.wake();
    }

    stepBy(count) {
        this.pause();
        this.seek(this.clock.step(this.time, count));
    }

    seek(time) {
        this.time = this.clock.clamp(time);
        this.#readout();
        this.show(this.time);
    }

    /** Once a frame: moves on by the time that has passed since the last one. */
    advance(now) {
        if (!this.playing) return;
        const passed = this.since === null ? 0 : Math.min((now - this.since) / 1000, 0.25);
        this.since = now;
        const next = this.time + passed * this.rate;
        if (next < this.clock.last) this.seek(next);
        else this.#atEnd(next);
    }

    #atEnd(next) {
        if (this.loops) {
            this.seek(this.clock.first + ((next - this.clock.first) % this.clock.duration));
            return;
        }
        this.seek(this.clock.last);
        this.pause();
    }

    #readout() {
        const { clock, time } = this;
        const part = clock.duration > 0 ? (time - clock.first) / clock.duration : 0;
        this.fill.style.transform = `scaleX(${part.toFixed(5)})`;
        this.knob.style.transform = `translateX(${(100 * part).toFixed(3)}%)`;
        if (!this.pace.due(this.playing)) return;
        this.output.textContent = `${time.toFixed(this.digits)} / ${clock.last.toFixed(this.digits)} ${this.unit}`;
        if (!this.playing || part === 0) this.slider.value = String(10000 * part);
    }
}
