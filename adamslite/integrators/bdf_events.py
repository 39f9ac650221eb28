"""Backward differences within a tried step: where events are looked for.

Within the tried step, at the share x of it, with pi_j = prod_{m=0..j-1} (x + m)/(m + 1)

    y = sum_{j=0..k} D_j pi_j + d pi_k

goes through the new value and k past ones; accelerations, multipliers and variables in between are
taken from a straight line, for guards that depend on them.
"""

from __future__ import annotations

from adamslite.integrators.acceleration import put_state
from adamslite.integrators.base import NS, NV, M, N, Problem
from adamslite.translate import native


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
