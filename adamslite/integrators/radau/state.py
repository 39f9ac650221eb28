"""The state of the Radau formula between steps: control numbers, accepted state, tried step."""

from __future__ import annotations

from adamslite.integrators.accelerations import put_state
from adamslite.integrators.contract import Problem
from adamslite.integrators.radau.control import ORIGIN, RATES, Control
from adamslite.integrators.radau.stages import stage_z
from adamslite.native.translate import native, seldom


@native
@seldom
def restore_state(P: Problem, C: Control) -> None:
    """The last accepted state into the unknowns and the workspace."""
    n, first = P.sizes.n, P.sizes.m + P.sizes.nv
    Y = P.history[ORIGIN * (2 * n + P.sizes.ns) :]
    for i in range(n):
        P.q[i], P.u[i], P.a[i] = Y[i], Y[n + i], P.ra[i]
    for k in range(first):
        P.z[k] = P.rz[k]
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
    for k in range(first + ns):
        P.z[k] = z[k]
    for k in range(ns):
        P.rd[k] = d[2 * n + k]
    put_state(P, C.t + C.h, P.q, P.u, P.a, P.z, P.rd)
