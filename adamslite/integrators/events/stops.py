"""Stops: the times at which a branch of the clock changes, known before the run.

They stand in ``P.stops``, the end of the run last; between two of them every guard of the clock has
the branch that it has in the middle.

Where an expression of time changes within less than a step, ``P.paces`` says how long steps may be.
"""

from __future__ import annotations

from math import floor

from adamslite.integrators.contract import (
    CLOCKS,
    FENCE,
    H_MAX,
    H_MIN,
    INTERPOLATE,
    LONGEST,
    NW,
    PACE,
    SINCE_WHEN,
    T_END,
    Problem,
)
from adamslite.integrators.event_rows import CLOCK, PACE_AT, STOP_AT
from adamslite.integrators.events.guards import branch_of
from adamslite.integrators.motion_equations import guard_values, put_time
from adamslite.native.translate import native

# Steps below this share of the run are round-off of the time.
LEAST_STEP = 1e-14
# Further from an output time than this many steps they need not fit.
MANY_STEPS = 100.0


@native
def set_pace(P: Problem, t: float) -> None:
    """Look up how long steps may be from ``t`` on; a step that is undone leads back."""
    at = int(P.search[PACE_AT])
    while at > 0 and P.paces[PACE * at + SINCE_WHEN] > t:
        at -= 1
    while PACE * (at + 1) < P.paces.size and P.paces[PACE * (at + 1) + SINCE_WHEN] <= t:
        at += 1
    P.search[PACE_AT] = float(at)


@native
def longest_step(P: Problem) -> float:
    """HMAX, or what the present pace leaves of it."""
    return min(P.settings[H_MAX], P.paces[PACE * int(P.search[PACE_AT]) + LONGEST])


@native
def horizon(P: Problem) -> float:
    """The time that the present step must not pass."""
    return min(present_stop(P), P.paces[PACE * int(P.search[PACE_AT]) + FENCE])


@native
def present_stop(P: Problem) -> float:
    """The next time at which branches of the clock change, or the end."""
    return P.stops[int(P.search[STOP_AT])]


@native
def end_of_pace(P: Problem) -> float:
    """When steps may get longer, or must get shorter."""
    after = PACE * (int(P.search[PACE_AT]) + 1)
    return P.paces[after + SINCE_WHEN] if after < P.paces.size else P.settings[T_END]


@native
def step_limit(P: Problem, following: int) -> float:
    """The time that the present step must not pass: the horizon, or before it the output time of
    row ``following``, when outputs are stepped onto.
    """
    limit = horizon(P)
    if P.settings[INTERPOLATE] == 0.0 and following < P.times.size:
        limit = min(limit, P.times[following])
    return limit


@native
def fitted(P: Problem, h: float, left: float) -> float:
    """The step not longer than ``h`` that reaches an output time ``left`` away in equal steps."""
    count = floor(left / h + 1.0 - 1e-7)
    return left / max(1.0, count) if count < MANY_STEPS else h


@native
def least_step(P: Problem) -> float:
    """HMIN, as far as it is above what round-off of the time leaves of a step."""
    return min(P.settings[H_MIN], LEAST_STEP * max(P.settings[T_END], P.settings[H_MAX]))


@native
def is_stop(P: Problem, t: float) -> bool:
    """Whether branches of the clock change at time ``t``, where a step has ended."""
    return t >= present_stop(P) and int(P.search[STOP_AT]) < P.stops.size - 1


@native
def set_clock(P: Problem, t: float) -> None:
    """Branches of the clock between ``t`` and the next stop: those in the middle."""
    W, first = P.W, P.sizes[NW]
    if P.sizes[CLOCKS] == 0:
        return
    for k in range(P.sizes[CLOCKS]):
        W[first + k] = 0.0
    put_time(P, 0.5 * (t + present_stop(P)))
    guard_values(P, CLOCK)
    for k in range(P.sizes[CLOCKS]):
        W[first + k] = branch_of(P.kind[k], P.guard[first + k])


@native
def next_stop(P: Problem, t: float) -> None:
    """Branches of the clock behind the stop at ``t``."""
    P.search[STOP_AT] += 1.0
    set_clock(P, t)


@native
def sample_clock(P: Problem) -> int:
    """Values of the guards of the clock at every asked time into the record; how many there are."""
    first, count = P.sizes[NW], P.sizes[CLOCKS]
    for k in range(count):
        P.W[first + k] = 0.0
    for row in range(P.times.size):
        put_time(P, P.times[row])
        guard_values(P, CLOCK)
        for k in range(count):
            P.record[row * count + k] = P.guard[first + k]
    return count
