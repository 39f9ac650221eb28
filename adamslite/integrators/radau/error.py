"""The error estimate of the Radau formula.

One Newton step, with the factors of the real eigenvalue g, on the equations at the start of the
step with y' = (g (y - y_0) - sum_i e_i (y_i - y_0))/h: the difference of y_1 from a formula of
order 3, with stiff components filtered.  After a failure and at the start once more from there.
Tested in q, u and s against ERROR max(1, |y|).
Reference: Hairer, Wanner, Solving ODE II, 1996, section IV.8 (eq. 8.19, 8.20).
"""

from __future__ import annotations

from adamslite.integrators.contract import Problem
from adamslite.integrators.implicit.formulation import equations_kept, is_stabilised
from adamslite.integrators.implicit.tolerance import beyond_round_off, most_wrong, weighted
from adamslite.integrators.linalg.blocks import solve
from adamslite.integrators.linalg.plan import Plan
from adamslite.integrators.motion_equations import (
    project_on_constraints,
    put_motion,
    put_scalars,
    put_time,
    residual,
    velocities,
)
from adamslite.integrators.newton import apply_increment
from adamslite.integrators.radau.coefficients import REAL, WEIGHT
from adamslite.integrators.radau.control import ORIGIN, Control
from adamslite.integrators.radau.stages import put_counted
from adamslite.native.translate import Reals, copy, native


@native
def local_error(P: Problem, L: Plan, C: Control) -> float:
    """Estimated error over ERROR; a second look after a failure and at the start."""
    n, ns, first = P.sizes.n, P.sizes.ns, P.sizes.m + P.sizes.nv
    w = 2 * n + ns
    base, error = P.trial[0:], P.trial[w:]
    copy(base, P.history, w)
    for k in range(first):
        P.z[k] = P.rz[k]
    norm = newton_error(P, L, C, base, error)
    if norm > 1.0 and C.cautious:
        for i in range(w):
            base[i] += error[i]
        norm = newton_error(P, L, C, base, error)
    if norm > 1.0:
        norm = beyond_round_off(P, norm, C.norm, P.history[ORIGIN * w :], P.tableau[REAL] / C.h)
        # A longer step has less of it.
        C.cautious = norm > 1.0
    P.report.error = norm
    return norm


@native
def newton_error(P: Problem, L: Plan, C: Control, base: Reals, error: Reals) -> float:
    """One Newton step from ``base`` with y' = (g error - sum_i e_i (y_i - y_0))/h; over ERROR."""
    n, ns, first, h = P.sizes.n, P.sizes.ns, P.sizes.m + P.sizes.nv, C.h
    w, Y, cu, v = 2 * n + ns, P.history, P.tableau[REAL] / h, P.trial[2 * (2 * n + ns) :]
    a, b, c = P.tableau[WEIGHT] / h, P.tableau[WEIGHT + 1] / h, P.tableau[WEIGHT + 2] / h
    for i in range(w):
        y = Y[i]
        v[i] = -a * (Y[w + i] - y) - b * (Y[2 * w + i] - y) - c * (Y[3 * w + i] - y)
        error[i] = 0.0
    for k in range(P.sizes.holonomic):
        P.mu[k] = 0.0
    copy(P.z[first:], base[2 * n :], ns)
    put_time(P, C.t)
    error_motion(P, cu, base, error, v)
    residual(P, equations_kept(P), P.F)
    solve(L, P.LV, P.pivots, P.F, P.x, P.work)
    apply_increment(P, P.F, error, P.z, P.mu, is_stabilised(P))
    for k in range(ns):
        error[2 * n + k] = P.z[first + k] - base[2 * n + k]
    error_motion(P, cu, base, error, v)
    origin = Y[ORIGIN * w :]
    size = weighted(error, origin, n, ns, True)
    P.report.where = most_wrong(size, error, origin, n, ns, True)
    return size / P.settings.error


@native
def error_motion(P: Problem, cu: float, base: Reals, error: Reals, v: Reals) -> None:
    """Velocities and accelerations that belong to the error of q, into the workspace and
    ``error``.
    """
    n = P.sizes.n
    for i in range(n):
        P.a[i] = v[i] + cu * error[i]
        P.q[i] = base[i] + error[i]
    velocities(P, P.q, P.a, P.u)
    put_counted(P, P.q)
    if is_stabilised(P):
        project_on_constraints(P, P.mu, P.x)
        for i in range(n):
            P.u[i] += P.x[i]
    for i in range(n):
        error[n + i] = P.u[i] - base[n + i]
        P.a[i] = v[n + i] + cu * error[n + i]
    put_motion(P, P.u, P.a)
    put_scalars(P, P.z, v[2 * n :])
