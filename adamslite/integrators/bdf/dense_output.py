"""Between the steps of the BDF: the polynomial through past values and the new one.

With pi_j = prod_{m=0..j-1} (x + m)/(m + 1), at the share x of the tried step,

    y = sum_{j=0..k} D_j pi_j + d pi_k

goes through the new value and k past ones; for guards accelerations in between are the slope of the
cubic through velocities, multipliers and variables a straight line.  Behind an accepted step the
differences contain d.
"""

from __future__ import annotations

from adamslite.integrators.accelerations import put_state
from adamslite.integrators.bdf.control import Control
from adamslite.integrators.bdf.state import restore_state
from adamslite.integrators.contract import Problem
from adamslite.integrators.linalg.plan import Plan
from adamslite.integrators.stepping.output import is_due, is_next, record_next
from adamslite.native.translate import Reals, native


@native
def interpolate(D: Reals, w: int, k: int, t: float, h: float, at: float, y: Reals) -> None:
    """The history's polynomial at time ``at``, into ``y``."""
    for i in range(w):
        y[i] = D[i]
    p = 1.0
    for j in range(k):
        p *= (at - t + h * j) / (h * (j + 1))
        for i in range(w):
            y[i] += p * D[(j + 1) * w + i]


@native
def record(P: Problem, L: Plan, C: Control) -> bool:
    """Write the output times of the accepted step that there is room for; False when accelerations
    are not determined.
    """
    y, n, ns, before = P.trial, P.sizes.n, P.sizes.ns, C.row
    first = P.sizes.m + P.sizes.nv
    while is_next(P, C):
        interpolate(P.history, C.width, C.order, C.t, C.h, P.times[C.row], y)
        for i in range(ns):
            P.z[first + i] = y[2 * n + i]
        if not record_next(P, L, C, y):
            return False
    if C.row > before and not is_due(P, C):
        restore_state(P, C)
    return True


@native
def put_between(P: Problem, C: Control, x: float) -> None:
    """The tried step at the share ``x`` into the workspace; d stands in the second part of
    ``P.trial``.
    """
    n, ns, first, w = P.sizes.n, P.sizes.ns, P.sizes.m + P.sizes.nv, C.width
    D, d, y = P.history, P.trial[w:], P.trial[2 * w :]
    for i in range(w):
        y[i] = D[i]
    p = 1.0
    for j in range(C.order):
        p *= (x + j) / (j + 1)
        for i in range(w):
            y[i] += p * D[(j + 1) * w + i]
    a, z = P.x, P.F
    for i in range(w):
        y[i] += p * d[i]
    for i in range(n):
        bend = 6.0 * (P.u[i] - D[n + i]) / C.h - 3.0 * (P.ra[i] + P.a[i])
        a[i] = P.ra[i] + x * (P.a[i] - P.ra[i] + (1.0 - x) * bend)
    for i in range(first):
        z[i] = P.rz[i] + x * (P.z[i] - P.rz[i])
    for i in range(ns):
        z[first + i] = y[2 * n + i]
    put_state(P, C.t + x * C.h, y, y[n:], a, z, P.rd)
