"""One number made from one channel: a plateau's mean, a peak, a final value.

    mean VARIABLE/tip from 0.004 to 0.009 = 214302 tol rel 1e-3

Over the window [t0, t1]:  mean = integral of the channel (trapezoidal rule) / (t1 - t0),
max, min, range = max - min, last = value at t1;  `value NAME at T` is the value at T.
"""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from adamslite.compare import SAME_TIME, Difference, Mismatch, Tolerance, sampler
from adamslite.results import Results


def _mean(times: np.ndarray, history: np.ndarray) -> float:
    if times.size == 1:
        return float(history[0])
    return float(np.trapezoid(history, times) / (times[-1] - times[0]))


#: Word of a measure -> function of the (nt,) times and (nt,) values inside the window.
KINDS: dict[str, Callable[[np.ndarray, np.ndarray], float]] = {
    "mean": _mean,
    "max": lambda times, history: float(history.max()),
    "min": lambda times, history: float(history.min()),
    "range": lambda times, history: float(np.ptp(history)),
    "last": lambda times, history: float(history[-1]),
}

#: The word that takes one time instead of a window.
VALUE = "value"


@dataclass(frozen=True, kw_only=True)
class Measure:
    """A number that a run must give.

    Parameters
    ----------
    kind : str
        A word of `KINDS`, or `value`.
    channel : str
        Result name.
    start, end : float or None
        Window [time]; None is the first, the last output time. For `value` both are its time.
    value : float
        What must come out, in the unit of the channel.
    tolerance : Tolerance
        How far it may be off; `rel` and `peak` both refer to `value`.
    """

    kind: str
    channel: str
    start: float | None = None
    end: float | None = None
    value: float
    tolerance: Tolerance

    def difference(self, results: Results, interpolate: str | None = None) -> Difference:
        """Compare the measure of `results` with its reference value."""
        if self.channel not in results:
            raise Mismatch(f"the results have no channel '{self.channel}'")
        off = abs(self._measured(results, interpolate) - self.value)
        allowed = float(self.tolerance.allowed(np.array([self.value]))[0])
        return Difference(
            name=f"{self.kind} {self.channel}",
            worst=off,
            allowed=allowed,
            time=self.end if self.kind == VALUE else None,
            inside=bool(off <= allowed),
        )

    def _measured(self, results: Results, interpolate: str | None) -> float:
        if self.kind == VALUE:
            sample = sampler(results, np.array([self.end]), interpolate)
            return float(sample(results[self.channel])[0])
        window = self._window(results.time)
        return KINDS[self.kind](results.time[window], results[self.channel][window])

    def _window(self, times: np.ndarray) -> np.ndarray:
        if times.size == 0:
            raise Mismatch("the results hold no output time at all")
        slack = SAME_TIME * float(np.ptp(times))
        start = times[0] if self.start is None else self.start
        end = times[-1] if self.end is None else self.end
        window = (times >= start - slack) & (times <= end + slack)
        if not window.any() or start < times[0] - slack or end > times[-1] + slack:
            raise Mismatch(
                f"the window {start:g} to {end:g} of '{self.kind} {self.channel}' is not covered "
                f"by the results, which go from t = {times[0]:g} to {times[-1]:g}"
            )
        return window
