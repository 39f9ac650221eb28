"""Output times of an analysis."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from adamslite.elements.simulate import MOST_STEPS, STEPS, output_steps
from adamslite.errors import UsageError

if TYPE_CHECKING:
    from adamslite.elements.simulate import Simulate

# A last interval shorter than this share of the whole is no interval of its own.
ROUND_OFF = 1e-9
# Times that are looked at together.
PART = 2**16


def output_times(command: Simulate, start: float) -> np.ndarray:
    """Times (nt,) from ``start`` to END (or over DURATION), STEPS of them or one every DTOUT.

    A SIMULATE without an end has the one time ``start``.

    Raises
    ------
    UsageError
        When END is not after ``start``, or there are more than ``MOST_STEPS`` output steps.
    """
    end = command.end if command.end is not None else None
    if end is None and command.duration is not None:
        end = start + command.duration
    if end is None:
        return np.array([start])
    return spread_times(start, end, command.steps, command.dtout)


def spread_times(start: float, end: float, steps: int | None, dtout: float | None) -> np.ndarray:
    """Times from ``start`` to ``end``: ``steps`` equal intervals, or one every ``dtout``."""
    if end < start or (steps is not None and steps < 1):
        raise UsageError(
            f"The end time {end:g} must not lie before {start:g}, with at least one step."
        )
    if output_steps(end - start, steps, dtout) > MOST_STEPS:
        raise UsageError(
            f"There may be {MOST_STEPS:.0e} output steps: fewer STEPS, a longer DTOUT."
        )
    if steps is None and dtout:
        whole = (end - start) / dtout
        steps = max(1, round(whole))
        if abs(steps - whole) > ROUND_OFF * max(1.0, whole):
            return np.append(np.arange(start, end - ROUND_OFF * dtout, dtout), end)
    return np.linspace(start, end, (steps or STEPS) + 1)


def largest_step(times: np.ndarray) -> float:
    """Between output times (nt,), of which there may be too many for another array as long."""
    parts = (times[first : first + PART + 1] for first in range(0, len(times) - 1, PART))
    return max((float(np.diff(part).max()) for part in parts), default=0.0)
