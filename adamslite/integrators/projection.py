"""Projection onto the constraints, along the shortest path in the mass metric.

    [M, G^T; G, 0] (dq, .) = (0, g(q)),    q <- q - dq    until |g| is round-off
    [M, G^T; G, 0] (du, .) = (0, G u + g_t),   u <- u - du

with the acceleration matrix that is factored in ``P.LA``.  Where forces depend on accelerations M
is the effective mass.  Reference: Hairer, Wanner, Solving ODE II, 1996, section VII.2.
"""

from __future__ import annotations

from adamslite.integrators.contract import POSITION_ROWS, RATE_ROWS, VELOCITY_ROWS, Problem
from adamslite.integrators.linalg.blocks import solve
from adamslite.integrators.linalg.norms import exceeds
from adamslite.integrators.linalg.plan import HUGE, Plan
from adamslite.integrators.motion_equations import (
    PART,
    back_rotate,
    put_motion,
    put_pose,
    run_groups,
)
from adamslite.integrators.step_back import GOLDEN
from adamslite.native.translate import Reals, native

SWEEPS = 8
# Violations below this share of the largest coordinate are round-off.
ROUND_OFF = 4e-16
# Smaller ones that no longer shrink are, too; and what is small enough after all sweeps.
STALLED, CLOSED = 1e-12, 1e-10

RATES = VELOCITY_ROWS | RATE_ROWS


@native
def project(P: Problem, L: Plan, q: Reals, u: Reals) -> bool:
    """Move q and u onto the constraints; False when positions do not come nearer.

    ``P.report.moved`` is the largest change of a position, rotation or velocity, against
    max(1, |value|).
    """
    last = HUGE
    reach = 1.0
    P.report.moved = 0.0
    for i in range(P.sizes.n):
        reach = max(reach, abs(q[i]))
    for _sweep in range(SWEEPS):
        put_pose(P, q)
        size = violation(P, POSITION_ROWS)
        if size <= ROUND_OFF * reach or (size < STALLED * reach and size > 0.5 * last):
            put_motion(P, u, P.a)
            violation(P, RATES)
            solve(L, P.LA, P.pivots_a, P.F, P.x, P.work)
            note_move(P, u)
            for i in range(P.sizes.n):
                u[i] -= P.F[i]
            return True
        if not size < 10.0 * last:
            return False
        last = size
        solve(L, P.LA, P.pivots_a, P.F, P.x, P.work)
        note_move(P, q)
        move(P, q)
    return last < CLOSED * reach


@native
def note_move(P: Problem, value: Reals) -> None:
    """The largest entry of the increment in F, against max(1, |value|), into the report."""
    top = P.report.moved
    for i in range(P.sizes.n):
        if exceeds(abs(P.F[i]), top * max(1.0, abs(value[i]))):
            top = abs(P.F[i]) / max(1.0, abs(value[i]))
    P.report.moved = top


@native
def violation(P: Problem, phases: int) -> float:
    """The rows of ``phases`` at the places of their multipliers in F; returns the largest."""
    n, m, holonomic = P.sizes.n, P.sizes.m, P.sizes.holonomic
    for i in range(P.sizes.nz):
        P.F[i] = 0.0
    run_groups(P, phases, P.F)
    if P.sizes.si2 and phases & VELOCITY_ROWS:
        for k in range(holonomic):
            P.F[n + k] = P.F[P.sizes.nz - holonomic + k]
            P.F[P.sizes.nz - holonomic + k] = 0.0
    for k in range(P.dead.size):
        P.F[P.dead[k]] = 0.0
    largest = 0.0
    for k in range(n, n + m):
        if exceeds(abs(P.F[k]), largest):
            largest = abs(P.F[k])
    return largest


@native
def move(P: Problem, q: Reals) -> None:
    """q <- q - dq with the turns of dq in ground axes."""
    for b in range(P.sizes.nb):
        i = P.body[b].first
        if P.body[b].width == PART:
            back_rotate(q, P.F, i, P.F)
            for k in range(3, 6):
                q[i + k] -= P.F[i + k]
        for k in range(3):
            q[i + k] -= P.F[i + k]


@native
def sensitivity(P: Problem, L: Plan) -> float:
    """The largest answer of positions, against max(1, |value|), when each constraint row is off by
    a value between 0.5 and 1.5 (no pattern that a mechanism could have): grows like 1/d towards
    a posture of lost rank.
    """
    n, top = P.sizes.n, 0.0
    for i in range(P.sizes.nz):
        P.F[i] = 0.0
    for k in range(P.sizes.m):
        P.F[n + k] = 0.5 + GOLDEN * (k + 1) - int(GOLDEN * (k + 1))
    for k in range(P.dead.size):
        P.F[P.dead[k]] = 0.0
    solve(L, P.LA, P.pivots_a, P.F, P.x, P.work)
    for i in range(n):
        if exceeds(abs(P.F[i]), top * max(1.0, abs(P.q[i]))):
            top = abs(P.F[i]) / max(1.0, abs(P.q[i]))
    return top
