"""The state of a Radau step: accepted, tried, on its polynomial: records, predictions."""

from __future__ import annotations

from adamslite.integrators.accelerations import put_state
from adamslite.integrators.contract import Problem
from adamslite.integrators.linalg.plan import Plan
from adamslite.integrators.radau.coefficients import NODE
from adamslite.integrators.radau.control import BEFORE, ORIGIN, RATES, Control
from adamslite.integrators.radau.stages import stage_motion, stage_z
from adamslite.integrators.stepping.output import is_next, record_next
from adamslite.native.translate import Reals, copy, native, seldom


@native
@seldom
def restore_state(P: Problem, C: Control) -> None:
    """The last accepted state into the unknowns and the workspace."""
    n, first = P.sizes.n, P.sizes.m + P.sizes.nv
    Y = P.history[ORIGIN * (2 * n + P.sizes.ns) :]
    for i in range(n):
        P.q[i], P.u[i], P.a[i] = Y[i], Y[n + i], P.ra[i]
    copy(P.z, P.rz, first)
    for k in range(P.sizes.ns):
        P.z[first + k] = Y[2 * n + k]
    put_state(P, C.t, P.q, P.u, P.a, P.z, P.rd)


@native
def put_end(P: Problem, C: Control) -> None:
    """The end of the tried step into the unknowns and the workspace."""
    n, ns, first = P.sizes.n, P.sizes.ns, P.sizes.m + P.sizes.nv
    w, Y, z = 2 * n + ns, P.history, P.history[stage_z(P, 2) :]
    y, d = Y[3 * w :], Y[(RATES + 3) * w :]
    for i in range(n):
        P.q[i], P.u[i], P.a[i] = Y[ORIGIN * w + i] + y[i], y[n + i], d[n + i]
    copy(P.z, z, first + ns)
    for k in range(ns):
        P.rd[k] = d[2 * n + k]
    put_state(P, C.t + C.h, P.q, P.u, P.a, P.z, P.rd)


@native
def record(P: Problem, L: Plan, C: Control) -> bool:
    """Write the output times of the accepted step that there is room for; False when accelerations
    are not determined.
    """
    n, ns, first = P.sizes.n, P.sizes.ns, P.sizes.m + P.sizes.nv
    y, w, h = P.trial[0:], 2 * n + ns, C.h_last
    while is_next(P, C):
        share = min(1.0, 1.0 + (P.times[C.row] - C.t) / h)
        collocated(P, P.history, P.history, w, share, y)
        for i in range(n):
            y[i] += P.history[ORIGIN * w + i]
        copy(P.z[first:], y[2 * n :], ns)
        if not record_next(P, L, C, y):
            return False
    return True


@native
def put_between(P: Problem, t: float, h: float, x: float) -> None:
    """The tried step from ``t`` at the share ``x`` into the workspace."""
    n, ns, first = P.sizes.n, P.sizes.ns, P.sizes.m + P.sizes.nv
    w, Y, y, a, z = 2 * n + ns, P.history, P.trial[0:], P.x, P.F
    collocated(P, Y, Y, w, x, y)
    quadratic(P, x, Y[(RATES + 1) * w + n :], w, n, a)
    quadratic(P, x, Y[stage_z(P, 0) :], stage_z(P, 1) - stage_z(P, 0), first, z)
    for i in range(n):
        y[i] += Y[ORIGIN * w + i]
    copy(z[first:], y[2 * n :], ns)
    put_state(P, t + x * h, y, y[n:], a, z, P.rd)


@native
def collocated(P: Problem, start: Reals, rows: Reals, w: int, x: float, y: Reals) -> None:
    """y at the share ``x`` of a step, the cubic through its start and stages; constants exactly."""
    a, b = P.tableau[NODE], P.tableau[NODE + 1]
    f0 = (x - a) * (x - b) * (x - 1.0) / (-a * b)
    f1 = x * (x - b) * (x - 1.0) / (a * (a - b) * (a - 1.0))
    f2 = x * (x - a) * (x - 1.0) / (b * (b - a) * (b - 1.0))
    for i in range(w):
        z = rows[3 * w + i]
        y[i] = z + f0 * (start[i] - z) + f1 * (rows[w + i] - z) + f2 * (rows[2 * w + i] - z)


@native
def quadratic(P: Problem, x: float, rows: Reals, lead: int, count: int, z: Reals) -> None:
    """z at the share ``x`` of a step: through the values at its stages, ``lead`` apart."""
    a, b = P.tableau[NODE], P.tableau[NODE + 1]
    f1 = (x - b) * (x - 1.0) / ((a - b) * (a - 1.0))
    f2 = (x - a) * (x - 1.0) / ((b - a) * (b - 1.0))
    for k in range(count):
        last = rows[2 * lead + k]
        z[k] = last + f1 * (rows[k] - last) + f2 * (rows[lead + k] - last)


@native
def predict(P: Problem, C: Control) -> None:
    """First values of the stages: the polynomial of the step before continues, or without one
    accelerations stay; then the motion that follows from them.
    """
    h, before = C.h, C.h_last
    n, ns, first, X = P.sizes.n, P.sizes.ns, P.sizes.m + P.sizes.nv, P.tableau
    w, Y, e = 2 * n + ns, P.history, stage_z(P, 1) - stage_z(P, 0)
    for stage in range(3):
        y, z, c = Y[(1 + stage) * w :], Y[stage_z(P, stage) :], X[NODE + stage] * h
        if before > 0.0:
            collocated(P, Y[BEFORE * w :], Y[BEFORE * w :], w, 1.0 + c / before, y)
            quadratic(P, 1.0 + c / before, Y[stage_z(P, 3) :], e, first, z)
        else:
            for i in range(n):
                y[i] = Y[i] + c * (Y[n + i] + 0.5 * c * P.ra[i])
            for k in range(ns):
                y[2 * n + k] = Y[2 * n + k] + c * P.rd[k]
            copy(z, P.rz, first)
        for k in range(ns):
            z[first + k] = y[2 * n + k]
        for k in range(P.sizes.holonomic):
            z[first + ns + k] = 0.0
    stage_motion(P, h)
