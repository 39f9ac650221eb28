"""Quantities of a signal: the mean of a plateau, the time of an arrival, a peak without ringing.

Equations, for samples f(t_0) .. f(t_n) joined by straight lines:

    plateau    integral of f over [a, b] / (b - a)
    arrival    the first t in [a, b] with f(t) = level; half rise: level = (before + after) / 2
    smoothed   g(t) = integral of f over [t - w/2, t + w/2] / w

The moving average is centred, so it shifts no phase. Where less than w/2 is left on a side it is
narrowed on both sides alike; the first and the last sample stay as they are.

All are exact for the straight lines, whatever the spacing of the samples.
"""

from __future__ import annotations

import numpy as np


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
