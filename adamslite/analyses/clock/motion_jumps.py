"""Motions whose displacement or velocity jumps with time, which no mechanism can follow.

What drives a constraint is compared on both sides of every stop, at a distance e and nearer,

    jump(e) = [f(t + e) - e f'(t + e)] - [f(t - e) + e f'(t - e)]

A jump stays as e shrinks; a slope that is only steep leaves the less of it, and one without bound
counts as a jump.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from adamslite.analyses.clock.enclosures import enclose
from adamslite.analyses.clock.kept_answers import kept
from adamslite.equations.broken_motion import Break

if TYPE_CHECKING:
    from adamslite.analyses.clock.clock import Clock, Program

# Distances from a stop, as shares of the run, and what must be left of a jump at the smaller one.
FAR, NEAR, LEFT = 1e-8, 1e-11, 0.5
WORDS = {"position": "displacement", "velocity": "velocity"}


def first_jump(clock: Clock, stops: np.ndarray, start: float, error: float) -> Break | None:
    """The first stop (k,) at which something that drives a constraint jumps by more than
    ``error``.
    """
    inside, found = stops[:-1], []
    if not inside.size:
        return None
    span = float(stops[-1]) - start
    for face, statement, program in clock.driven():
        jumps = _jumps(program, inside.tobytes(), span, error)
        found += [Break(statement, t, WORDS[face], "jumps") for t in inside[jumps][:1].tolist()]
    return min(found, key=lambda each: each.time, default=None)


def _size(found: np.ndarray) -> int:
    return found.size


@kept(_size)
def _jumps(program: Program, stops: bytes, span: float, error: float) -> np.ndarray:
    """Which stops are jumps of a program, (k,)."""
    times = np.frombuffer(stops)
    around = [times + share * span for share in (-FAR, -NEAR, 0.0, NEAR, FAR)]
    at = np.concatenate(around)
    bounds = enclose(program, at, at).reshape(4, len(around), -1)
    value, rate = bounds[0], bounds[2]
    with np.errstate(all="ignore"):
        far, near = (
            np.abs((value[behind] - e * rate[behind]) - (value[before] + e * rate[before]))
            for e, before, behind in ((FAR * span, 0, 4), (NEAR * span, 1, 3))
        )
    size = np.maximum(1.0, np.abs(value[2]))
    size = np.where(np.isfinite(size), size, 1.0)
    return ~(near <= error * size) & ~(near < LEFT * far)


def without_value(clock: Clock, time: float) -> Break | None:
    """A MOTION whose displacement or velocity has no finite value at a time."""
    at = np.array([time])
    for face, statement, program in clock.driven():
        if statement.keyword == "MOTION" and not np.isfinite(enclose(program, at, at)[0]).all():
            return Break(statement, time, WORDS[face], "has no finite value")
    return None
