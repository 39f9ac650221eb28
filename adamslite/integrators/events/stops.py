"""Stops: the times at which a branch of the clock changes, known before the run.

They stand in ``P.stops``, the end of the run last; between two of them every guard of the clock has
the branch that it has in the middle.

Where an expression of time changes within less than a step, ``P.paces`` says how long steps may be.
"""

from __future__ import annotations

from math import floor

from adamslite.integrators.contract import LEAST_STEP, Problem
from adamslite.integrators.events.guards import branch_of
from adamslite.integrators.motion_equations import CLOCK, guard_values, put_time
from adamslite.native.translate import native, rare

# A pace of so many of these can be fitted to a stop: half of it is not too short.
DIVISIBLE = 4.0
# Further from an output time than this many steps they need not fit.
MANY_STEPS = 100.0
# What a number of steps may exceed a whole one by without one step more.
WHOLE = 1e-7


@native
def set_pace(P: Problem, t: float) -> None:
    """Look up how long steps may be from ``t``, within round-off; an undone step leads back."""
    at, reached = P.search.pace_at, t + least_step(P)
    while at > 0 and P.paces[at].since > reached:
        at -= 1
    while at + 1 < P.paces.size and P.paces[at + 1].since <= reached:
        at += 1
    P.search.pace_at = at


@native
def longest_step(P: Problem) -> float:
    """HMAX, or what the present pace leaves of it, but not round-off of the time."""
    pace = max(P.paces[P.search.pace_at].longest, DIVISIBLE * least_step(P))
    return min(P.settings.h_max, pace)


@native
def horizon(P: Problem) -> float:
    """The time that the present step must not pass."""
    return min(present_stop(P), P.paces[P.search.pace_at].fence)


@native
def present_stop(P: Problem) -> float:
    """The next time at which branches of the clock change, or the end."""
    return P.stops[P.search.stop_at]


@native
def end_of_pace(P: Problem) -> float:
    """When steps may get longer, or must get shorter."""
    after = P.search.pace_at + 1
    return P.paces[after].since if after < P.paces.size else P.settings.t_end


@native
def step_limit(P: Problem, following: int) -> float:
    """The time that the present step must not pass: the horizon, or before it the output time of
    row ``following``, when outputs are stepped onto.
    """
    limit = horizon(P)
    if not P.settings.interpolate and following < P.times.size:
        limit = min(limit, P.times[following])
    return limit


@native
def fitted(h: float, left: float, round_off: float) -> float:
    """The step not longer than ``h`` that reaches an output time ``left`` away in equal steps, but
    for ``round_off``.
    """
    count = floor((left - round_off) / h + 1.0 - WHOLE)
    return left / max(1.0, count) if count < MANY_STEPS else h


@native
def least_step(P: Problem) -> float:
    """HMIN, as far as it is above what round-off of the time leaves of a step."""
    return min(P.settings.h_min, LEAST_STEP * max(P.settings.t_end, P.settings.h_max))


@native
def is_stop(P: Problem, t: float) -> bool:
    """Whether branches of the clock change at time ``t``, where a step has ended."""
    return t >= present_stop(P) and P.search.stop_at < P.stops.size - 1


@native
def set_clock(P: Problem, t: float) -> None:
    """Branches of the clock between ``t`` and the next stop: those in the middle."""
    W, first = P.W, P.sizes.nw
    if P.sizes.clocks == 0:
        return
    for k in range(P.sizes.clocks):
        W[first + k] = 0.0
    put_time(P, 0.5 * (t + present_stop(P)))
    guard_values(P, CLOCK)
    for k in range(P.sizes.clocks):
        W[first + k] = branch_of(P.kind[k], P.guard[first + k])


@native
def next_stop(P: Problem, t: float) -> None:
    """Branches of the clock behind the stop at ``t``."""
    P.search.stop_at += 1
    set_clock(P, t)


@native
@rare
def sample_clock(P: Problem) -> int:
    """Values of the guards of the clock at every output time into the record; their number."""
    first, count = P.sizes.nw, P.sizes.clocks
    for k in range(count):
        P.W[first + k] = 0.0
    for row in range(P.times.size):
        put_time(P, P.times[row])
        guard_values(P, CLOCK)
        for k in range(count):
            P.record[row * count + k] = P.guard[first + k]
    return count
