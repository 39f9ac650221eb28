"""Fewer rows where a screen shows no more."""

from __future__ import annotations

import numpy as np

FRAMES = (200, 900)
"""Least and most frames of a motion."""
BUDGET = 400_000
"""Numbers of all bodies in all frames."""
POINTS = (150, 2000)
"""Least and most points of a channel."""
CHANNEL_BUDGET = 800_000
"""Numbers of all channels."""
RUNS_BUDGET, RUNS_CHANNEL_BUDGET = 6_000_000, 8_000_000
"""The same of all runs in a page that has several."""
FEWEST = 60
"""Frames and points of a run that are enough among many."""


def frames(time: np.ndarray, numbers: int, runs: int = 1) -> np.ndarray:
    """The rows that are drawn, of motions with so many numbers a frame: the first, the last, and
    those nearest to equal steps of time; `runs`: how many motions are in the page.
    """
    most = int(np.clip(BUDGET // max(numbers, 1), *FRAMES))
    if runs > 1:
        most = max(min(most, RUNS_BUDGET // (runs * max(numbers, 1))), FEWEST)
    if len(time) <= most:
        return np.arange(len(time))
    wanted = np.linspace(time[0], time[-1], most)
    after = np.clip(np.searchsorted(time, wanted), 1, len(time) - 1)
    nearer = after - (wanted - time[after - 1] < time[after] - wanted)
    return np.unique(np.concatenate([[0], nearer, [len(time) - 1]]))


def points(time: np.ndarray, values: np.ndarray, runs: int = 1) -> tuple[np.ndarray, np.ndarray]:
    """Times and values (n, nc) that show the same lines: of each stretch of rows, every channel
    keeps its least and its largest value, in their order; `runs`: how many are in the page.

    Source: the min-max decimation of oscilloscopes.
    """
    count = int(np.clip(CHANNEL_BUDGET // max(values.shape[1], 1), *POINTS))
    if runs > 1:
        count = max(min(count, RUNS_CHANNEL_BUDGET // (runs * max(values.shape[1], 1))), FEWEST)
    if len(time) <= count:
        return time, values
    bounds = np.linspace(1, len(time) - 1, count // 2).astype(int)
    kept_times, kept = [time[:1]], [values[:1]]
    for start, stop in zip(bounds[:-1], bounds[1:], strict=True):
        if stop > start:
            kept_times.append(time[[start, stop - 1]])
            kept.append(_extremes(values[start:stop]))
    return np.concatenate([*kept_times, time[-1:]]), np.concatenate([*kept, values[-1:]])


def _extremes(values: np.ndarray) -> np.ndarray:
    """The least and the largest of each column, (2, nc), in the order in which they come."""
    numbers = np.isfinite(values)
    least = np.argmin(np.where(numbers, values, np.inf), axis=0)
    most = np.argmax(np.where(numbers, values, -np.inf), axis=0)
    rows = np.sort(np.stack([least, most]), axis=0)
    return np.take_along_axis(values, rows, axis=0)
