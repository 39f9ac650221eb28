"""Backward differences at events: within a tried step, and the first step behind one.

Within the tried step, at the share x of it, with pi_j = prod_{m=0..j-1} (x + m)/(m + 1)

    y = sum_{j=0..k} D_j pi_j + d pi_k

goes through the new value and k past ones; accelerations, multipliers and variables in between are
taken from a straight line, for guards that depend on them.
"""

from __future__ import annotations

from adamslite.integrators.acceleration import accelerations, put_state
from adamslite.integrators.base import ERROR, NS, NV, M, N, Plan, Problem
from adamslite.integrators.equations import vector_rates
from adamslite.translate import native

# Where accelerations are looked at behind an event, as a share of the step that is thought of.
LOOK_AHEAD = 0.1
# The first step behind an event in multiples of (ERROR/|a'|)^(1/2).
CAREFUL = 0.8


@native
def put_between(P: Problem, k: int, t: float, h: float, x: float) -> None:
    """The tried step from ``t`` of size ``h`` at the share ``x`` into the workspace; d stands in
    the second part of ``P.trial``.
    """
    n, ns, first = P.sizes[N], P.sizes[NS], P.sizes[M] + P.sizes[NV]
    w = 2 * n + ns
    D, d, y = P.history, P.trial[w:], P.trial[2 * w :]
    for i in range(w):
        y[i] = D[i]
    p = 1.0
    for j in range(k):
        p *= (x + j) / (j + 1)
        for i in range(w):
            y[i] += p * D[(j + 1) * w + i]
    a, z = P.x, P.F
    for i in range(w):
        y[i] += p * d[i]
    for i in range(n):
        a[i] = P.ra[i] + x * (P.a[i] - P.ra[i])
    for i in range(first):
        z[i] = P.rz[i] + x * (P.z[i] - P.rz[i])
    for i in range(ns):
        z[first + i] = y[2 * n + i]
    put_state(P, t + x * h, y, y[n:], a, z, P.rd)


@native
def jerk(P: Problem, L: Plan, t: float, ahead: float) -> float:
    """|a'| against max(1, |u|) at the start of a history, from accelerations a little further on.

    The state, accelerations and algebraic unknowns are the accepted ones (q, u, ra, rz).
    """
    n, ns, first = P.sizes[N], P.sizes[NS], P.sizes[M] + P.sizes[NV]
    w = 2 * n + ns
    y, rates, top = P.trial[0:], P.trial[w:], 0.0
    vector_rates(P, P.q, P.u, y)
    for i in range(n):
        y[i], y[n + i] = P.q[i] + ahead * y[i], P.u[i] + ahead * P.ra[i]
    for k in range(ns):
        rates[k] = P.rd[k]
        P.z[first + k] = P.rz[first + k] + ahead * P.rd[k]
    if accelerations(P, L, t + ahead, y, y[n:], P.a, P.z, P.rd):
        for i in range(n):
            top = max(top, abs(P.a[i] - P.ra[i]) / max(1.0, abs(P.u[i])))
        for k in range(ns):
            top = max(top, abs(P.rd[k] - rates[k]) / max(1.0, abs(P.rz[first + k])))
    for i in range(n):
        P.a[i] = P.ra[i]
    for k in range(first + ns):
        P.z[k] = P.rz[k]
    for k in range(ns):
        P.rd[k] = rates[k]
    return top / ahead


@native
def restart_step(P: Problem, L: Plan, t: float, h: float) -> float:
    """``h``, or less where a step of order 1 would err too much in the velocities: h^2 |a'|/2."""
    change = jerk(P, L, t, LOOK_AHEAD * h)
    if not change > 0.0:
        return h
    return min(h, CAREFUL * (P.settings[ERROR] / change) ** 0.5)
