"""The state of HHT and NEWMARK between steps.

``P.history`` holds of the accepted state q, u, b and, for DIFF, s, s', b of s', s' one step
earlier; ``P.ra`` holds a.
"""

from __future__ import annotations

from adamslite.integrators.accelerations import put_state
from adamslite.integrators.contract import Problem
from adamslite.integrators.hht.control import Control
from adamslite.integrators.stepping.outcome import count_from_here, keep_solution
from adamslite.native.translate import copy, native, seldom


@native
def start_values(P: Problem) -> None:
    """The accelerations in place are the first: b = a."""
    D, n, ns = P.history, P.sizes.n, P.sizes.ns
    copy(D[2 * n :], P.a, n)
    for k in range(ns):
        for row in range(1, 4):
            D[3 * n + row * ns + k] = P.rd[k]
    keep_solution(P)


@native
def keep_rates(P: Problem) -> None:
    """b, accelerations, multipliers and derivatives of the states at the accepted state."""
    D, n, ns, alpha = P.history, P.sizes.n, P.sizes.ns, P.settings.alpha
    A, B = P.ra, D[2 * n :]
    for i in range(n):
        B[i] = (1.0 + alpha) * P.a[i] - alpha * A[i]
    for k in range(ns):
        o = 3 * n + k
        D[o + 3 * ns] = D[o + ns]
        D[o + 2 * ns] = (1.0 + alpha) * P.rd[k] - alpha * D[o + ns]
        D[o + ns] = P.rd[k]
    keep_solution(P)


@native
def start_from_here(P: Problem) -> None:
    """The workspace's state starts the next step; its attitudes become the base."""
    D, n, first = P.history, P.sizes.n, P.sizes.m + P.sizes.nv
    count_from_here(P)
    for i in range(n):
        D[i], D[n + i] = P.q[i], P.u[i]
    copy(D[3 * n :], P.z[first:], P.sizes.ns)


@native
@seldom
def restore_state(P: Problem, C: Control) -> None:
    """The accepted state into the unknowns and the workspace."""
    D, n, ns, first = P.history, P.sizes.n, P.sizes.ns, P.sizes.m + P.sizes.nv
    for i in range(n):
        P.q[i], P.u[i], P.a[i] = D[i], D[n + i], P.ra[i]
    copy(P.z, P.rz, first)
    for k in range(ns):
        P.z[first + k], P.rd[k] = D[3 * n + k], D[3 * n + ns + k]
    put_state(P, C.t, P.q, P.u, P.a, P.z, P.rd)
