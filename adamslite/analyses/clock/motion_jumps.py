"""Motions whose displacement or velocity jumps with time, which no mechanism can follow.

What drives a constraint is compared on both sides of every stop, at a distance e and nearer,

    jump(e) = [f(t + e) - e f'(t + e)] - [f(t - e) + e f'(t - e)]

A jump stays as e shrinks; a slope that is only steep leaves the less of it, and one without bound
counts as a jump.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

import numpy as np

from adamslite.analyses.clock.changes import kept
from adamslite.analyses.clock.clock import Clock
from adamslite.analyses.clock.enclosures import enclose
from adamslite.analyses.clock.stops import edges
from adamslite.equations.broken_motion import Break

if TYPE_CHECKING:
    from adamslite.analyses.clock.clock import Program
    from adamslite.equations.system import System

# Distances from a stop, as shares of the run, and what must be left of a jump at the smaller one.
FAR, NEAR, LEFT = 1e-8, 1e-11, 0.5
# Jumps that a kinematic analysis passes without a word, times named of each statement.
SLIGHT, MOST_NAMED = 1e-6, 4
UNDETERMINED = "speeds, accelerations and reactions are not determined there"
WORDS = {"position": "displacement", "velocity": "velocity"}


def first_jump(clock: Clock, stops: np.ndarray, start: float, error: float) -> Break | None:
    """The first stop (k,) at which something that drives a constraint jumps by more than
    ``error``.
    """
    found = _breaks(clock, stops[:-1], float(stops[-1]) - start, error)
    return min(found, key=lambda each: each.time, default=None)


def _breaks(clock: Clock, stops: np.ndarray, span: float, error: float) -> Iterator[Break]:
    """Every jump at one of ``stops`` (k,) of a run over ``span``, statement by statement."""
    if not stops.size:
        return
    for face, statement, program in clock.driven():
        for t in stops[_jumps(program, stops.tobytes(), span, error)].tolist():
            yield Break(statement, t, WORDS[face], "jumps")


def followed_jumps(system: System, times: np.ndarray) -> tuple[np.ndarray, Break | None, str]:
    """What becomes of jumps in a kinematic analysis: the output times (nt,) before the first jump
    of a displacement, that jump, and in words the jumps of speeds, which it passes.
    """
    clock, start = Clock(system.kernels), float(times[0])
    stops = np.append(start, edges(system, clock, times)[0][:-1])
    found = [*_breaks(clock, stops, float(times[-1]) - start, SLIGHT)]
    broken = [each for each in found if each.quantity == WORDS["position"] and each.time > start]
    first = min(broken, key=lambda each: each.time, default=None)
    by_label: dict[str, list[str]] = {}
    for each in found:
        if each.quantity == WORDS["velocity"]:
            by_label.setdefault(each.statement.label, []).append(f"{each.time:.6g}")
    texts = [
        f"{label} at t = {', '.join(at[:MOST_NAMED])}" + " and later" * (len(at) > MOST_NAMED)
        for label, at in by_label.items()
    ]
    note = f"{'; '.join(texts)}: {UNDETERMINED}" if texts else ""
    return (times[times < first.time] if first else times), first, note


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
