// Output times of a result, and where a time lies between them.

export class Clock {
    constructor(times) {
        this.times = times;
        this.first = times.length ? times[0] : 0;
        this.last = times.length ? times[times.length - 1] : 0;
        this.index = 0;
        this.fraction = 0;
    }

    get duration() {
        return this.last - this.first;
    }

    clamp(time) {
        return Math.min(Math.max(time, this.first), this.last);
    }

    /** Sets index and fraction: time = (1 - fraction) times[index] + fraction times[index + 1]. */
    locate(time) {
        const { times } = this;
        let low = 0;
        let high = times.length - 1;
        if (high < 1 || !(time > times[0])) return this.#set(0, 0);
        if (time >= times[high]) return this.#set(high, 0);
        while (high - low > 1) {
            const middle = (low + high) >> 1;
            if (times[middle] <= time) low = middle;
            else high = middle;
        }
        return this.#set(low, (time - times[low]) / (times[high] - times[low]));
    }

    #set(index, fraction) {
        this.index = index;
        this.fraction = fraction;
        return this;
    }

    /** The output time `count` places further on. */
    step(time, count) {
        this.locate(time);
        const from = count < 0 && this.fraction > 0 ? this.index + 1 : this.index;
        const to = Math.min(Math.max(from + count, 0), this.times.length - 1);
        return this.times[to] ?? 0;
    }
}
