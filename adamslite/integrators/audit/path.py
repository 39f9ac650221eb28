"""The path of an accepted step, for its audit: the curve of order 6 through both of its ends.

    x(s) = sum_{j=0..5} c_j s^j,    x, x', x'' as accepted at s = 0 and s = 1;    u = x'/h

for every place and for the Cayley vector of every part counted from its attitude at the start, so
that velocities are exactly the derivatives of positions: work of a force with a potential does not
depend on how the curve runs between its ends.  Multipliers and variables follow straight lines or,
where a force depends on them, are solved for; states of DIFF follow cubics.

Reference: Prenter, Splines and Variational Methods, 1975, section 3.2 (Hermite interpolation).
"""

from __future__ import annotations

from adamslite.integrators.accelerations import acceleration_matrix, settle
from adamslite.integrators.contract import NB, NS, NV, M, N, Problem
from adamslite.integrators.linalg.blocks import factor
from adamslite.integrators.linalg.plan import Plan
from adamslite.integrators.motion_equations import BODY, PART, attitude, put_motion, put_time
from adamslite.native.translate import Reals, native

# Places in P.audit: numbers of the present step and of the run so far, where its arrays begin (both
# ends of the step as workspaces; the curve, 6 numbers for each unknown of a body; vectors u, a, z,
# s'; values at the points of a panel; 1 for each constraint row that moves;
# what may be taken back: header and first workspace; what integrators go on with: acceleration
# matrix, its pivots, counts), momenta.
(
    TIME, SPAN, KINETIC, STORED, FORCES, SIZE, BUDGET,
    GAP, WORST, WORST_AT, SQUARES, QUADRATURE, LARGEST, CREATED, LEAST_CREATED, MOST_CREATED,
    CREATED_AT, MISSED, SPLITS,
    SOLVED, ELASTIC_THERE, AT_PREVIOUS, AT_PRESENT, AT_CURVE, AT_VECTORS, AT_POINTS, AT_MOVING,
    DRIFT, SPIN_DRIFT, PUSH, TURN, PUSHES, TURNS, EXTERNAL, AT_SPARE, AT_KEPT,
) = range(36)  # fmt: skip
MOMENTUM, SPIN, FIRST_MOMENTUM, HEAD = 36, 39, 42, 48


@native
def lay_path(P: Problem, h: float) -> None:
    """The coefficients of the curve between the two ends kept in ``P.audit``."""
    A = P.audit
    old, new = A[int(A[AT_PREVIOUS]) :], A[int(A[AT_PRESENT]) :]
    for b in range(P.sizes[NB]):
        i, o = P.body[BODY * b + 1], P.body[BODY * b + 2]
        for k in range(3):
            curve = A[int(A[AT_CURVE]) + 6 * (i + k) :]
            c = o + k
            fit_curve(curve, h, new[c] - old[c], old[c + 3], new[c + 3], old[c + 6], new[c + 6])
        if P.body[BODY * b] == PART:
            lay_turn(P, h, old[o + 9 :], new[o + 9 :], A[int(A[AT_CURVE]) + 6 * i + 18 :])


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
    A, W = P.audit, P.W
    old, base, h = A[int(A[AT_PREVIOUS]) :], int(A[AT_CURVE]), A[SPAN]
    u, x = A[int(A[AT_VECTORS]) :], P.work
    put_time(P, A[TIME] + s * h)
    for b in range(P.sizes[NB]):
        i, o = P.body[BODY * b + 1], P.body[BODY * b + 2]
        for k in range(P.body[BODY * b]):
            c = A[base + 6 * (i + k) :]
            x[k] = s * (c[1] + s * (c[2] + s * (c[3] + s * (c[4] + s * c[5]))))
            x[6 + k] = c[1] + s * (
                2.0 * c[2] + s * (3.0 * c[3] + s * (4.0 * c[4] + s * 5.0 * c[5]))
            )
        for k in range(3):
            W[o + k], u[i + k] = old[o + k] + x[k], x[6 + k] / h
            W[o + 3 + k] = u[i + k]
        if P.body[BODY * b] == PART:
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
    A, W, first = P.audit, P.W, P.sizes[M] + P.sizes[NV]
    old, new, h = A[int(A[AT_PREVIOUS]) :], A[int(A[AT_PRESENT]) :], A[SPAN]
    for k in range(first):
        o = P.scalar[k]
        W[o] = old[o] + s * (new[o] - old[o])
    for k in range(P.sizes[NS]):
        o = P.scalar[first + k]
        w0, w1 = h * s * (1.0 - s) * (1.0 - s), h * s * s * (s - 1.0)
        along = s * s * (3.0 - 2.0 * s) * (new[o] - old[o])
        W[o] = old[o] + along + w0 * old[o + 1] + w1 * new[o + 1]


@native
def solve_on_path(P: Problem, L: Plan, s: float) -> bool:
    """Accelerations, multipliers and variables of the workspace's positions and velocities."""
    A, W, n = P.audit, P.W, P.sizes[N]
    first, ns = P.sizes[M] + P.sizes[NV], P.sizes[NS]
    u = A[int(A[AT_VECTORS]) :]
    a, z, rates = u[n:], u[2 * n :], u[2 * n + first + ns :]
    old, new = A[int(A[AT_PREVIOUS]) :], A[int(A[AT_PRESENT]) :]
    for b in range(P.sizes[NB]):
        i, o = P.body[BODY * b + 1], P.body[BODY * b + 2]
        for k in range(P.body[BODY * b]):
            at = o + 6 + k if k < 3 else o + 9 + k
            a[i + k] = old[at] + s * (new[at] - old[at])
    for k in range(first + ns):
        z[k] = W[P.scalar[k]]
    for k in range(ns):
        o = P.scalar[first + k] + 1
        rates[k] = old[o] + s * (new[o] - old[o])
        W[o] = rates[k]
    put_motion(P, u, a)
    acceleration_matrix(P)
    return factor(L, P.LA, P.pivots_a, P.work) and settle(P, L, u, a, z, rates)
