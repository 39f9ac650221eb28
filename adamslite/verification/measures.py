"""Measures: one number from one channel, such as a mean, a peak or an arrival time.

    mean VARIABLE/tip from 0.004 to 0.009 = 214302 tol rel 1e-3
    arrival SFORCE/240.f through -292810 from 0.02 = 0.080613 tol rel 5e-3
    max SFORCE/240.f smoothed 0.004 = 371318 tol rel 2e-2

Over the window [t0, t1]:  mean = integral of the channel / (t1 - t0), max, min,
range = max - min, last = value at t1;  `arrival NAME through LEVEL` is the first time in the window
at which the channel has that level, `value NAME at T` the value at T. `smoothed WIDTH` takes the
centred moving average of the channel first.

For samples f(t_0) .. f(t_n) joined by straight lines:

    plateau    integral of f over [a, b] / (b - a)
    arrival    the first t in [a, b] with f(t) = level; half rise: level = (before + after) / 2
    smoothed   g(t) = integral of f over [t - w/2, t + w/2] / w

The moving average is centred, so it shifts no phase. Where less than w/2 is left on a side it is
narrowed on both sides alike; the first and the last sample stay as they are.  All are exact for the
straight lines, whatever the spacing of the samples.
"""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from adamslite.results.comparison import SAME_TIME, Difference, Mismatch, Tolerance, sampler
from adamslite.results.results import Results

#: Word of a measure -> function of the (nt,) times and (nt,) values inside the window.
KINDS: dict[str, Callable[[np.ndarray, np.ndarray], float]] = {
    "mean": lambda times, history: plateau(times, history, times[0], times[-1]),
    "max": lambda times, history: float(history.max()),
    "min": lambda times, history: float(history.min()),
    "range": lambda times, history: float(np.ptp(history)),
    "last": lambda times, history: float(history[-1]),
}

#: The word that takes one time instead of a window, and the one that takes a level as well.
VALUE, ARRIVAL = "value", "arrival"


@dataclass(frozen=True, kw_only=True)
class Measure:
    """A number that a run must give.

    Parameters
    ----------
    kind : str
        A word of `KINDS`, `arrival` or `value`.
    channel : str
        Result name.
    start, end : float or None
        Window [time]; None is the first, the last output time. For `value` both are its time.
    level : float or None
        Of `arrival`, in the unit of the channel.
    smoothed : float
        Width of the moving average that is taken first [time].
    value : float
        What must come out, in the unit of the channel; for `arrival` [time].
    tolerance : Tolerance
        How far it may be off; `rel` and `peak` both refer to `value`.
    """

    kind: str
    channel: str
    start: float | None = None
    end: float | None = None
    level: float | None = None
    smoothed: float = 0.0
    value: float
    tolerance: Tolerance

    def difference(self, results: Results, interpolate: str | None = None) -> Difference:
        """Compare the measure of `results` with its reference value."""
        value, wanted = np.array([self.measured(results, interpolate)]), np.array([self.value])
        off = float(self.tolerance.off(value, wanted)[0])
        allowed = float(self.tolerance.allowed(wanted)[0])
        return Difference(
            name=f"{self.kind} {self.channel}",
            worst=off,
            allowed=allowed,
            time=self.end if self.kind == VALUE else None,
            inside=bool(off <= allowed),
        )

    def measured(self, results: Results, interpolate: str | None = None) -> float:
        """Take the measure of `results`; `interpolate` is for `value` between output times."""
        if self.channel not in results:
            raise Mismatch(f"the results have no channel '{self.channel}'")
        times, history = results.time, results[self.channel]
        if self.smoothed and times.size:
            history = moving_average(times, history, self.smoothed)
        if self.kind == VALUE:
            sample = sampler(results, np.array([self.end]), interpolate)
            return float(sample(history)[0])
        window = self._window(times)
        if self.kind == ARRIVAL:
            return self._arrival(times[window], history[window])
        return KINDS[self.kind](times[window], history[window])

    def _arrival(self, times: np.ndarray, history: np.ndarray) -> float:
        assert self.level is not None  # an arrival has one
        when = arrival(times, history, self.level, times[0], times[-1])
        if when is None:
            raise Mismatch(
                f"'{self.channel}' never passes {self.level:g} from t = {times[0]:g} to "
                f"{times[-1]:g}: it stays in {history.min():g} to {history.max():g}"
            )
        return when

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


def plateau(times: np.ndarray, values: np.ndarray, start: float, end: float) -> float:
    """Mean over a window.

    Parameters
    ----------
    times : (n,)
        Increasing [time].
    values : (n,)
        Any unit.
    start, end : float
        Window inside the times [time]; when both are the same, the value there is returned.
    """
    if end == start:
        return float(np.interp(start, times, values))
    inside = (times > start) & (times < end)
    t = np.concatenate([[start], times[inside], [end]])
    return float(np.trapezoid(np.interp(t, times, values), t) / (end - start))


def arrival(
    times: np.ndarray, values: np.ndarray, level: float, start: float, end: float
) -> float | None:
    """First time in a window at which the signal reaches a level, from above or below.

    Parameters
    ----------
    times, values : (n,)
        Samples; `times` increase.
    level : float
        For the half rise of a front, the mean of the plateaus before and behind it.
    start, end : float
        Window inside the times [time].

    Returns
    -------
    float or None
        None when the level is not reached.
    """
    inside = (times > start) & (times < end)
    t = np.concatenate([[start], times[inside], [end]])
    above = np.interp(t, times, values) - level
    if above[0] == 0.0:
        return float(start)
    passed = np.flatnonzero(above[1:] * above[0] <= 0.0)
    if not passed.size:
        return None
    i = passed[0]
    return float(t[i] + (t[i + 1] - t[i]) * above[i] / (above[i] - above[i + 1]))


def moving_average(times: np.ndarray, values: np.ndarray, width: float) -> np.ndarray:
    """Centred mean over `width`, at every sample: (n,).

    A ripple of period `width` vanishes, and a front becomes a ramp of that width around the time at
    which it was.

    Parameters
    ----------
    times, values : (n,)
        Samples; `times` increase.
    width : float
        [time]; 0 returns the samples.
    """
    half = np.minimum(np.minimum(times - times[0], times[-1] - times), width / 2)
    total = _integral(times, values, times + half) - _integral(times, values, times - half)
    wide = half > 0
    return np.where(wide, total / np.where(wide, 2 * half, 1.0), values)


def _integral(times: np.ndarray, values: np.ndarray, at: np.ndarray) -> np.ndarray:
    """Integral of the samples from the first time to each of `at`: (m,)."""
    steps = np.diff(times)
    sums = np.concatenate([[0.0], np.cumsum(steps * (values[1:] + values[:-1]) / 2)])
    i = np.clip(np.searchsorted(times, at, side="right") - 1, 0, max(times.size - 2, 0))
    return sums[i] + (at - times[i]) * (values[i] + np.interp(at, times, values)) / 2
