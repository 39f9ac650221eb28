"""The path of an accepted step, for its audit: a curve of order 6 through both ends.

    x(s) = sum_{j=0..5} c_j s^j,    x, x', x'' as accepted at s = 0 and s = 1;    u = x'/h

for every place and for the Cayley vector of every part counted from its attitude at the start, so
that velocities are exactly the derivatives of positions: work of a force with a potential does not
depend on how the curve runs between its ends.  Multipliers and variables follow straight lines or,
where a force depends on them, are solved for; states of DIFF follow cubics.

Reference: Prenter, Splines and Variational Methods, 1975, section 3.2 (Hermite interpolation).
"""

from __future__ import annotations

from adamslite.integrators.accelerations import factor_accelerations, settle
from adamslite.integrators.contract import Problem
from adamslite.integrators.linalg.plan import Plan
from adamslite.integrators.motion_equations import PART, attitude, put_motion, put_time
from adamslite.native.translate import Reals, native


@native
def lay_path(P: Problem, h: float) -> None:
    """The coefficients of the curve between the two ends kept in ``P.audit``."""
    old, new = P.audit.previous, P.audit.present
    for b in range(P.sizes.nb):
        i, o = P.body[b].first, P.body[b].at
        for k in range(3):
            curve = P.audit.curve[6 * (i + k) :]
            c = o + k
            fit_curve(curve, h, new[c] - old[c], old[c + 3], new[c + 3], old[c + 6], new[c + 6])
        if P.body[b].width == PART:
            lay_turn(P, h, old[o + 9 :], new[o + 9 :], P.audit.curve[6 * i + 18 :])


@native
def lay_turn(P: Problem, h: float, old: Reals, new: Reals, curve: Reals) -> None:
    """The curve of a rotation vector; ``old`` and ``new`` are w, al and R of both ends."""
    c, v, r = P.work[0:], P.work[3:], P.work[6:]
    for i in range(3):
        for j in range(3):
            total = 0.0
            for k in range(3):
                total += new[6 + 3 * i + k] * old[6 + 3 * j + k]
            r[3 * i + j] = total
    scale = 2.0 / (1.0 + r[0] + r[4] + r[8])
    c[0], c[1], c[2] = scale * (r[7] - r[5]), scale * (r[2] - r[6]), scale * (r[3] - r[1])
    along = 0.25 * (c[0] * new[0] + c[1] * new[1] + c[2] * new[2])
    for k in range(3):
        n, p = (k + 1) % 3, (k + 2) % 3
        v[k] = new[k] - 0.5 * (c[n] * new[p] - c[p] * new[n]) + along * c[k]
    bend = 0.0
    for k in range(3):
        bend += 0.25 * (v[k] * new[k] + c[k] * new[3 + k])
    for k in range(3):
        n, p = (k + 1) % 3, (k + 2) % 3
        turned = v[n] * new[p] - v[p] * new[n] + c[n] * new[3 + p] - c[p] * new[3 + n]
        late = new[3 + k] - 0.5 * turned + bend * c[k] + along * v[k]
        fit_curve(curve[6 * k :], h, c[k], old[k], v[k], old[3 + k], late)


@native
def fit_curve(c: Reals, h: float, way: float, v0: float, v1: float, a0: float, a1: float) -> None:
    """Quintic from 0 to ``way`` with given first and second derivatives at its ends."""
    p, q, r, s = h * v0, h * v1, 0.5 * h * h * a0, 0.5 * h * h * a1
    c[0], c[1], c[2] = 0.0, p, r
    c[3] = 10.0 * way - 6.0 * p - 4.0 * q - 3.0 * r + s
    c[4] = -15.0 * way + 8.0 * p + 7.0 * q + 3.0 * r - 2.0 * s
    c[5] = 6.0 * way - 3.0 * (p + q) - r + s


@native
def put_on_path(P: Problem, s: float) -> None:
    """The share ``s`` of the step into the workspace; velocities also into the vectors."""
    W, old, h = P.W, P.audit.previous, P.audit.now.span
    u, x = P.audit.vectors, P.work
    put_time(P, P.audit.now.t + s * h)
    for b in range(P.sizes.nb):
        i, o = P.body[b].first, P.body[b].at
        for k in range(P.body[b].width):
            c = P.audit.curve[6 * (i + k) :]
            x[k] = s * (c[1] + s * (c[2] + s * (c[3] + s * (c[4] + s * c[5]))))
            x[6 + k] = c[1] + s * (
                2.0 * c[2] + s * (3.0 * c[3] + s * (4.0 * c[4] + s * 5.0 * c[5]))
            )
        for k in range(3):
            W[o + k], u[i + k] = old[o + k] + x[k], x[6 + k] / h
            W[o + 3 + k] = u[i + k]
        if P.body[b].width == PART:
            attitude(x[3], x[4], x[5], old, o + 15, W, o + 15)
            n = 1.0 / (h * (1.0 + 0.25 * (x[3] * x[3] + x[4] * x[4] + x[5] * x[5])))
            u[i + 3] = n * (x[9] + 0.5 * (x[4] * x[11] - x[5] * x[10]))
            u[i + 4] = n * (x[10] + 0.5 * (x[5] * x[9] - x[3] * x[11]))
            u[i + 5] = n * (x[11] + 0.5 * (x[3] * x[10] - x[4] * x[9]))
            for k in range(3):
                W[o + 9 + k] = u[i + 3 + k]
    put_scalars_between(P, s)


@native
def put_scalars_between(P: Problem, s: float) -> None:
    """Multipliers and variables on straight lines, states of DIFF on cubics."""
    W, first = P.W, P.sizes.m + P.sizes.nv
    old, new, h = P.audit.previous, P.audit.present, P.audit.now.span
    for k in range(first):
        o = P.scalar[k]
        W[o] = old[o] + s * (new[o] - old[o])
    for k in range(P.sizes.ns):
        o = P.scalar[first + k]
        w0, w1 = h * s * (1.0 - s) * (1.0 - s), h * s * s * (s - 1.0)
        along = s * s * (3.0 - 2.0 * s) * (new[o] - old[o])
        W[o] = old[o] + along + w0 * old[o + 1] + w1 * new[o + 1]


@native
def solve_on_path(P: Problem, L: Plan, s: float) -> bool:
    """Accelerations, multipliers and variables of the workspace's positions and velocities."""
    W, n = P.W, P.sizes.n
    first, ns = P.sizes.m + P.sizes.nv, P.sizes.ns
    u = P.audit.vectors
    a, z, rates = u[n:], u[2 * n :], u[2 * n + first + ns :]
    old, new = P.audit.previous, P.audit.present
    for b in range(P.sizes.nb):
        i, o = P.body[b].first, P.body[b].at
        for k in range(P.body[b].width):
            at = o + 6 + k if k < 3 else o + 9 + k
            a[i + k] = old[at] + s * (new[at] - old[at])
    for k in range(first + ns):
        z[k] = W[P.scalar[k]]
    for k in range(ns):
        o = P.scalar[first + k] + 1
        rates[k] = old[o] + s * (new[o] - old[o])
        W[o] = rates[k]
    put_motion(P, u, a)
    return factor_accelerations(P, L) and settle(P, L, u, a, z, rates)
