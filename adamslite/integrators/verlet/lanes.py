"""The steps of VERLET with the numbers of all point masses by component.

    S = x of all bodies, y, z, then vx, vy, vz        F = forces, the same way

in rows of equal length, so that a step is a few loops over all bodies without a place to look up,
and :mod:`adamslite.kernels.code.lane_writer` evaluates the loads.
"""

from __future__ import annotations

from adamslite.integrators.contract import Problem
from adamslite.integrators.lanes import run_lanes
from adamslite.integrators.linalg.plan import HUGE
from adamslite.integrators.motion_equations import put_time
from adamslite.integrators.verlet.control import NUMBERS, Control
from adamslite.integrators.verlet.sampling import (
    HOPELESS,
    LARGE,
    leave,
    note_steps,
    steps_per_estimate,
)
from adamslite.kernels.code.workspace import HEAD
from adamslite.native.translate import Alone, maximum, native


@native
def take_lane_steps(P: Problem, C: Control, t: float, h: float, count: int) -> float:
    """``count`` steps of half a kick, drift, half a kick, where the two half kicks between steps
    are one; returns the largest local error seen against ERROR, 1e300 for a blow-up.  Where a state
    is asked for the steps are left, with ``C.step``.
    """
    row = P.lane.size // NUMBERS
    n, every, first = 3 * row, steps_per_estimate(P, C, h), begin_lanes(P, C, t, row)
    x, v, F = P.lane[0:], P.lane[n:], P.lane[2 * n :]
    before, inverse = P.lane[3 * n :], P.lane[4 * n :]
    # Steps until the acceleration is kept, with which that of the step after is compared.
    top, looks = C.top, C.looks
    for s in range(first, count + 1):
        if P.settings.stop or (P.block.hold and s > first):
            return leave(P, C, s, top, looks)
        P.W[0] = t + s * h
        if s > 0 and P.sizes.n_head > HEAD:
            put_time(P, t + s * h)
        run_lanes(P, x, row, F)
        if s > 0 and looks == every - 1:
            error = change_of(F, inverse, before, x, row) * h * h / (6.0 * P.settings.error)
            if not error < LARGE:
                error = HUGE
            top = maximum(top, error)
            if not top < HOPELESS and not C.fixed:
                return top
            C.spent += every * error
        if looks == 0:
            keep_accelerations(F, inverse, before, row)
            looks = every
        looks -= 1
        kick, drift = 0.5 * h if s == 0 or s == count else h, h if s < count else 0.0
        for k in range(3):
            at, fall = k * row, kick * P.gravity[k]
            kick_and_drift(x[at:], v[at:], F[at:], inverse, row, kick, fall, drift)
    C.top, C.mean = top, 0.0
    if not take_lanes(P, row):
        return HUGE
    note_steps(P, C, count)
    return 0.0 if C.fixed else top


@native
def begin_lanes(P: Problem, C: Control, t: float, row: int) -> int:
    """The step to begin with; zero unless the try was left."""
    first, C.step = C.step, 0
    if first == 0:
        fill_lanes(P, row)
        put_time(P, t)
        C.top, C.spent, C.looks = 0.0, 0.0, 0
    return first


@native
def fill_lanes(P: Problem, row: int) -> None:
    """Places, velocities and inverse masses of all bodies; no forces."""
    lane, n = P.lane, 3 * row
    for b in range(P.sizes.nb):
        lane[4 * n + b] = 1.0 / P.mass[b]
        for k in range(3):
            i, at = P.body[b].first + k, k * row + b
            lane[at], lane[n + at], lane[2 * n + at] = P.q[i], P.u[i], 0.0


@native
def take_lanes(P: Problem, row: int) -> bool:
    """Places and velocities into q and u; False when they are not numbers."""
    good = True
    for k in range(3):
        for b in range(P.sizes.nb):
            i, at = P.body[b].first + k, k * row + b
            P.q[i], P.u[i] = P.lane[at], P.lane[3 * row + at]
            good = good and abs(P.q[i]) + abs(P.u[i]) < LARGE
    return good


@native
def kick_and_drift(
    x: Alone, v: Alone, F: Alone, inverse: Alone, n: int, kick: float, fall: float, drift: float
) -> None:
    """v -= kick M^-1 F - fall, x += drift v, F = 0 of one component."""
    for i in range(n):
        u = v[i] + fall - kick * inverse[i] * F[i]
        v[i] = u
        x[i] += drift * u
        F[i] = 0.0


@native
def keep_accelerations(F: Alone, inverse: Alone, before: Alone, row: int) -> None:
    """What forces accelerate, with the other sign, to compare the next ones with."""
    for k in range(0, 3 * row, row):
        for b in range(row):
            before[k + b] = inverse[b] * F[k + b]


@native
def change_of(F: Alone, inverse: Alone, before: Alone, x: Alone, row: int) -> float:
    """The largest change of an acceleration against max(1, |x|)."""
    top = 0.0
    for k in range(0, 3 * row, row):
        for b in range(row):
            change = abs(inverse[b] * F[k + b] - before[k + b])
            top = maximum(top, change / max(1.0, abs(x[k + b])))
    return top
