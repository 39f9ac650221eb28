"""The explicit formula at events: the tried step in between, and the start behind a crossing.

Within the tried step a cubic goes through both ends with their rates; it only has to say which
branch changes first and about where, because the step is taken again to end there.
"""

from __future__ import annotations

from adamslite.integrators.acceleration import put_state
from adamslite.integrators.base import NS, NV, M, N, Problem
from adamslite.integrators.events import OPEN, SHARE, judge, open_search
from adamslite.translate import native


@native
def locate_between(P: Problem, t: float, h: float, width: int, old: int, late: int) -> None:
    """Look for the first change of a branch within the tried step, whose end is in the workspace.

    ``width``: rates of a stage; in ``P.history`` stages from 0, stage ``late`` belonging to the
    end, the state at the start from ``old`` and behind it the one at the end.
    """
    open_search(P, t, h)
    while P.search[OPEN] != 0.0:
        put_cubic(P, t, h, P.search[SHARE], width, old, late)
        judge(P)
    put_state(P, t + h, P.q, P.u, P.a, P.z, P.rd)


@native
def put_cubic(P: Problem, t: float, h: float, x: float, width: int, old: int, late: int) -> None:
    """The tried step at the share ``x`` into the workspace, with straight lines for accelerations,
    multipliers and variables.
    """
    n, ns, first = P.sizes[N], P.sizes[NS], P.sizes[M] + P.sizes[NV]
    w = 2 * n + ns
    y0, y1, k0, k1 = P.history[old:], P.history[old + w :], P.history, P.history[late * width :]
    y, a, z = P.trial, P.x, P.F
    along = x * x * (3.0 - 2.0 * x)
    w0, w1 = h * x * (1.0 - x) * (1.0 - x), h * x * x * (x - 1.0)
    for i in range(w):
        y[i] = y0[i] + along * (y1[i] - y0[i])
    for i in range(width):
        y[w - width + i] += w0 * k0[i] + w1 * k1[i]
    for i in range(w - width):
        y[i] += w0 * y0[width + i] + w1 * y1[width + i]
    for i in range(n):
        a[i] = P.ra[i] + x * (P.a[i] - P.ra[i])
    for k in range(first):
        z[k] = P.rz[k] + x * (P.z[k] - P.rz[k])
    for k in range(ns):
        z[first + k] = y[2 * n + k]
    put_state(P, t + x * h, y, y[n:], a, z, P.rd)
