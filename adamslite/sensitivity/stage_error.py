"""What a step of the Radau formula is off by in the sensitivities.

As for the run itself (:mod:`adamslite.integrators.radau.error`): one Newton step on the equations
at the start of the step, differentiated, with the factors of the real eigenvalue g and

    y' = (g e - sum_i e_i (y_i - y_0))/h

gives the difference e of y_1 from a formula of order 3.  It is of the order h^4, where that of y_1
is h^6: of a smooth motion with the frequency f they are powers of h f, and a share of e against y
would count as its power 3/2.  Behind events less is gained: 5/4 is measured.

Reference: Hairer, Wanner, Solving ODE II, 1996, section IV.8 (eq. 8.19).
"""

from __future__ import annotations

from adamslite.integrators.contract import Problem
from adamslite.integrators.implicit.formulation import equations_kept, is_stabilised
from adamslite.integrators.linalg.blocks import solve
from adamslite.integrators.linalg.norms import largest_of
from adamslite.integrators.linalg.plan import TINY, Plan
from adamslite.integrators.motion_equations import project_on_constraints
from adamslite.integrators.radau.coefficients import REAL, WEIGHT
from adamslite.integrators.radau.state import quadratic
from adamslite.native.translate import Reals, copy, native
from adamslite.sensitivity.contract import Forward, Tangents
from adamslite.sensitivity.tangents import put_direction, spun, tangent

# The order of the error over that of the estimate, as measured.
POWER = 1.25


@native
def note_stage_errors(
    P: Problem, L: Plan, D: Tangents, S: Forward, start: Reals, z_at: int, z_width: int, h: float
) -> None:
    """Add the estimates of all numbers, for a step from the workspace ``start``; the z of stages
    are at ``z_at`` of histories.
    """
    n, w = P.sizes.n, S.width
    copy(P.W, start, P.W.size)
    for number in range(D.count):
        H = S.history[number * S.room :]
        quadratic(P, 0.0, H[z_at:], z_width, P.sizes.m + P.sizes.nv, S.z)
        newton_error(P, L, D, S, number, H, h)
        for i in range(w):  # stages no longer count from the start
            for row in range(0 if n <= i and i < 2 * n else 3):
                H[(1 + row) * w + i] += H[i]
        for part in range(2):
            at, error = 2 * number + part, largest_of(S.y[part * n :], n)
            S.top[at] = max(S.top[at], largest_of(H[3 * w + part * n :], n))
            top = max(S.top[at], max(S.floor[number], TINY))
            S.spent[at] += top * (error / top) ** POWER


@native
def newton_error(
    P: Problem, L: Plan, D: Tangents, S: Forward, number: int, H: Reals, h: float
) -> None:
    """The estimate for one number, into the first row of ``S.y``: of places, velocities, states."""
    n, ns, w, rest = P.sizes.n, P.sizes.ns, S.width, P.sizes.n + P.sizes.m + P.sizes.nv
    error, v, cu = S.y[0:], S.y[w:], P.tableau[REAL] / h
    a, b, c = P.tableau[WEIGHT] / h, P.tableau[WEIGHT + 1] / h, P.tableau[WEIGHT + 2] / h
    for i in range(w):
        y = H[i] if n <= i and i < 2 * n else 0.0
        v[i] = -a * (H[w + i] - y) - b * (H[2 * w + i] - y) - c * (H[3 * w + i] - y)
        error[i] = 0.0
    error_motion(P, S, H, cu)
    put_direction(P, D, S.y[2 * w :], S.a, S.z, v[2 * n :], 0.0)
    tangent(P, D, number, equations_kept(P), P.F)
    solve(L, P.LV, P.pivots, P.F, P.x, P.work)
    for i in range(n):
        error[i] = 0.0 - P.F[i]
    for k in range(ns):
        error[2 * n + k] = 0.0 - P.F[rest + k]
    error_motion(P, S, H, cu)
    if is_stabilised(P):
        copy(S.mu, P.F[rest + ns :], P.sizes.holonomic)
        project_on_constraints(P, S.mu, S.a)
        for i in range(n):
            error[n + i] -= S.a[i]


@native
def error_motion(P: Problem, S: Forward, H: Reals, cu: float) -> None:
    """Sensitivities with the error of places, and velocities and accelerations that belong to it;
    the error of velocities.
    """
    n, w = P.sizes.n, S.width
    error, v, y, rate = S.y[0:], S.y[w:], S.y[2 * w :], S.y[3 * w :]
    for i in range(w):
        y[i] = H[i] + error[i]
    for i in range(n):
        rate[i] = v[i] + cu * error[i]
    spun(P, y, rate, -1.0, y[n:])
    for i in range(n):
        error[n + i] = y[n + i] - H[n + i]
        S.a[i] = v[n + i] + cu * error[n + i]
