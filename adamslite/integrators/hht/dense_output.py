"""HHT and NEWMARK within a step: values between its ends, and records of them.

Positions and states are cubics through both ends and their rates, velocities the derivatives of
those.
"""

from __future__ import annotations

from adamslite.integrators.accelerations import put_state
from adamslite.integrators.contract import Problem
from adamslite.integrators.hht.control import Control
from adamslite.integrators.linalg.plan import Plan
from adamslite.integrators.motion_equations import vector_rates, velocities
from adamslite.integrators.stepping.output import is_due, is_next, record_next
from adamslite.native.translate import Reals, copy, native


@native
def record(P: Problem, L: Plan, C: Control) -> bool:
    """Write the output times of the accepted step that there is room for; False when accelerations
    are not determined.
    """
    n, ns, first = P.sizes.n, P.sizes.ns, P.sizes.m + P.sizes.nv
    if not is_due(P, C):
        return True
    h, end, y, good = C.h, P.trial[0:], P.trial[2 * n + ns :], True
    if not C.open:
        copy(end[2 * n :], P.z[first:], ns)
        vector_rates(P, P.q, P.u, end[n:])
    while good and is_next(P, C):
        between(P, h, min(1.0, 1.0 + (P.times[C.row] - C.t) / h), end, y)
        good = record_next(P, L, C, y)
    if good and is_due(P, C):
        return True
    for k in range(ns):
        P.rd[k] = P.history[3 * n + ns + k]
        P.z[first + k] = end[2 * n + k]
    copy(P.z, P.rz, first)
    put_state(P, C.t, P.q, P.u, P.ra, P.z, P.rd)
    return good


@native
def put_between(P: Problem, C: Control, x: float) -> None:
    """The tried step at the share ``x`` into the workspace: cubics, and straight lines
    for accelerations, multipliers and variables.

    Velocities have a cubic of their own: in steps that end at an event the derivative of that of
    positions is round-off over the step.
    """
    n, ns, first, h = P.sizes.n, P.sizes.ns, P.sizes.m + P.sizes.nv, C.h
    D, y, a, z = P.history, P.trial[2 * n + ns :], P.x, P.F
    bodies_between(P, h, x, P.trial[0:], y)
    along, w0, w1 = x * x * (3.0 - 2.0 * x), h * x * (1.0 - x) * (1.0 - x), h * x * x * (x - 1.0)
    for i in range(n):
        a[i] = P.ra[i] + x * (P.a[i] - P.ra[i])
        y[n + i] = D[n + i] + along * (P.u[i] - D[n + i]) + w0 * P.ra[i] + w1 * P.a[i]
    for k in range(first):
        z[k] = P.rz[k] + x * (P.z[k] - P.rz[k])
    for k in range(ns):
        o = 3 * n + k
        step = P.z[first + k] - D[o]
        z[first + k] = D[o] + along * step + w0 * D[o + ns] + w1 * P.rd[k]
    put_state(P, C.t + x * h, y, y[n:], a, z, P.rd)


@native
def between(P: Problem, h: float, x: float, end: Reals, y: Reals) -> None:
    """Cubics at the share x of the step: q and u into ``y``, states into z; ``end`` holds q', s."""
    D, n, ns, first = P.history, P.sizes.n, P.sizes.ns, P.sizes.m + P.sizes.nv
    w = x * x * (3.0 - 2.0 * x)
    w0, w1 = h * x * (1.0 - x) * (1.0 - x), h * x * x * (x - 1.0)
    bodies_between(P, h, x, end, y)
    for k in range(ns):
        o = 3 * n + k
        step, v0, v1 = end[2 * n + k] - D[o], D[o + 3 * ns], D[o + ns]
        P.z[first + k] = D[o] + w * step + w0 * v0 + w1 * v1


@native
def bodies_between(P: Problem, h: float, x: float, end: Reals, y: Reals) -> None:
    """q and u at the share x of the step; q is at its end, ``end`` holds q' of that."""
    D, n = P.history, P.sizes.n
    w = x * x * (3.0 - 2.0 * x)
    w0, w1 = h * x * (1.0 - x) * (1.0 - x), h * x * x * (x - 1.0)
    d, d0, d1 = 6.0 * x * (1.0 - x) / h, (1.0 - x) * (1.0 - 3.0 * x), x * (3.0 * x - 2.0)
    for i in range(n):
        step, v0, v1 = P.q[i] - D[i], D[n + i], end[n + i]
        y[i] = D[i] + w * step + w0 * v0 + w1 * v1
        y[n + i] = d * step + d0 * v0 + d1 * v1
    velocities(P, y, y[n:], y[n:])
