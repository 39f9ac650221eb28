"""Stages of the explicit formula: sums over rows of the tableau, and rates of a state.

    k_i = f(t + c_i h, y + h sum a_ij k_j),    f(t, y) = (T^-1 u, a, s')

Accelerations come body by body when nothing ties bodies together, else from the index-1 equations.
"""

from __future__ import annotations

from adamslite.integrators.accelerations import (
    accelerations,
    factor_accelerations,
    put_state,
    settle,
)
from adamslite.integrators.contract import Problem
from adamslite.integrators.explicit.control import (
    BODIES,
    INVERSE,
    LANES,
    MASSES,
    NEXT_STATE,
    OLD,
    TIED,
    Control,
)
from adamslite.integrators.explicit.dop853 import (
    QUICK,
    QUICK_RESULT,
    QUICK_TIMES,
    RESULT,
    ROW,
    TIMES,
)
from adamslite.integrators.explicit.lanes import from_lanes, lane_accelerations
from adamslite.integrators.linalg.plan import Plan
from adamslite.integrators.motion_equations import PART, vector_rates
from adamslite.integrators.projection import project
from adamslite.integrators.stepping.outcome import count_from_here
from adamslite.integrators.stepping.output import WITHIN
from adamslite.integrators.unconstrained import free_accelerations, mass_accelerations
from adamslite.native.translate import Alone, Reals, copy, native


@native
def combine(P: Problem, C: Control, row: int, w: int, h: float, x: Reals, y: Reals) -> None:
    """y = x + h sum (weight k) over one row of the tableau."""
    if C.kind >= MASSES:
        K, V, n, k = P.history, P.tableau[ROW * row + 2 :], C.width, h * C.h
        start_twice(
            x, x[n:], h * P.tableau[ROW * row + 1],
            K[n * int(V[0]) :], K[n * int(V[3]) :], K[n * int(V[6]) :], K[n * int(V[9]) :],
            h * V[1], h * V[4], h * V[7], h * V[10], k * V[2], k * V[5], k * V[8], k * V[11],
            n, y, y[n:],
        )  # fmt: skip
        add_combined(P, C, row, 4, w, h, y)
    else:
        copy(y, x, w)
        add_combined(P, C, row, 0, w, h, y)


@native
def start_twice(
    x: Reals, v: Reals, s: float, a: Reals, b: Reals, c: Reals, d: Reals,
    ca: float, cb: float, cc: float, cd: float,
    ea: float, eb: float, ec: float, ed: float, n: int, q: Alone, u: Alone,
) -> None:  # fmt: skip
    """u = v + ca a + ..., q = x + s v + ea a + ... in one pass."""
    for i in range(n):
        u[i] = v[i] + ((ca * a[i] + cb * b[i]) + (cc * c[i] + cd * d[i]))
        q[i] = (x[i] + s * v[i]) + ((ea * a[i] + eb * b[i]) + (ec * c[i] + ed * d[i]))


@native
def add_combined(P: Problem, C: Control, row: int, first: int, w: int, h: float, y: Reals) -> None:
    """y += h sum (weight k) over one row of the tableau, from its term ``first`` on.

    Masses keep no rates of positions: those of stage i are u + h sum a_ij a_j, so that positions
    get h^2 sum (weight A)_j a_j.
    """
    K, o, n = P.history, ROW * row, C.width
    for g in range(first, int(P.tableau[o]), 4):
        V = P.tableau[o + 2 + 3 * g :]
        if C.kind >= MASSES:
            add_twice(
                K[n * int(V[0]) :], K[n * int(V[3]) :], K[n * int(V[6]) :], K[n * int(V[9]) :],
                h * V[1], h * V[4], h * V[7], h * V[10],
                h * C.h * V[2], h * C.h * V[5],
                h * C.h * V[8], h * C.h * V[11], n, y, y[n:],
            )  # fmt: skip
        else:
            add_once(
                K[w * int(V[0]) :], K[w * int(V[3]) :], K[w * int(V[6]) :], K[w * int(V[9]) :],
                h * V[1], h * V[4], h * V[7], h * V[10], w, y,
            )  # fmt: skip


@native
def add_once(
    a: Reals, b: Reals, c: Reals, d: Reals,
    ca: float, cb: float, cc: float, cd: float, w: int, y: Alone,
) -> None:  # fmt: skip
    """y += ca a + cb b + cc c + cd d"""
    for i in range(w):
        y[i] += (ca * a[i] + cb * b[i]) + (cc * c[i] + cd * d[i])


@native
def add_twice(
    a: Reals, b: Reals, c: Reals, d: Reals,
    ca: float, cb: float, cc: float, cd: float,
    ea: float, eb: float, ec: float, ed: float, n: int, q: Alone, u: Alone,
) -> None:  # fmt: skip
    """u += ca a + ..., q += ea a + ... in one pass."""
    for i in range(n):
        u[i] += (ca * a[i] + cb * b[i]) + (cc * c[i] + cd * d[i])
        q[i] += (ea * a[i] + eb * b[i]) + (ec * c[i] + ed * d[i])


@native
def rates_at(P: Problem, L: Plan, C: Control, t: float, y: Reals, k: Reals) -> bool:
    """k = f(t, y); False when the accelerations cannot be solved for."""
    n, first = P.sizes.n, P.sizes.m + P.sizes.nv
    inverse = P.history[INVERSE * C.size :]
    if C.kind == LANES:
        return lane_accelerations(P, C, t, y, k)
    if C.kind == MASSES:
        return mass_accelerations(P, t, y, y[n:], inverse, inverse[n:], k)
    if C.kind == BODIES:
        good = free_accelerations(P, t, y, y[n:], inverse, k[n:])
        vector_rates(P, y, y[n:], k)
        return good
    copy(P.z[first:], y[2 * n :], P.sizes.ns)
    # Once the matrix of the step's start was too old for a stage, each of the rest gets its own.
    before = P.count.factorizations
    if C.stale:
        good = accelerations(P, L, t, y, y[n:], P.a, P.z, P.rd)
    else:
        put_state(P, t, y, y[n:], P.a, P.z, P.rd)
        good = settle(P, L, y[n:], P.a, P.z, P.rd)
        C.stale = P.count.factorizations > before
    keep_rates(P, y, k)
    return good


@native
def keep_rates(P: Problem, y: Reals, k: Reals) -> None:
    """k = (T^-1 u, a, s') from what was solved for."""
    n = P.sizes.n
    vector_rates(P, y, y[n:], k)
    copy(k[n:], P.a, n)
    for i in range(P.sizes.ns):
        k[2 * n + i] = P.rd[i]


@native
def exact_rates(P: Problem, L: Plan, C: Control, t: float, y: Reals, k: Reals) -> bool:
    """Rates at a state that is kept: projected onto the constraints, with a new matrix; writes
    q, u, a and the workspace.
    """
    n, first = P.sizes.n, P.sizes.m + P.sizes.nv
    if C.kind != TIED:
        good = rates_at(P, L, C, t, y, k)
        put_free_state(P, C, t, y, k)
        return good
    copy(P.z[first:], y[2 * n :], P.sizes.ns)
    put_state(P, t, y, y[n:], P.a, P.z, P.rd)
    good = factor_accelerations(P, L)
    if good and P.sizes.m > 0:
        good = project(P, L, y, y[n:])
    if good:
        put_state(P, t, y, y[n:], P.a, P.z, P.rd)
        good = settle(P, L, y[n:], P.a, P.z, P.rd)
    keep_rates(P, y, k)
    take_state(P, C, y, P.q, P.u)
    return good


@native
def end_rates(P: Problem, L: Plan, C: Control, t: float, y: Reals, k: Reals) -> bool:
    """Rates at the end of a step, which the formula of four stages knows already."""
    if not C.quick:
        return exact_rates(P, L, C, t, y, k)
    if not C.lazy or (C.row < P.times.size and P.times[C.row] <= t + WITHIN * C.h):
        put_free_state(P, C, t, y, k)
    return True


@native
def put_free_state(P: Problem, C: Control, t: float, y: Reals, k: Reals) -> None:
    """A state of free bodies and its rates into q, u, a and the workspace."""
    put_rates(P, C, k)
    take_state(P, C, y, P.q, P.u)
    put_state(P, t, P.q, P.u, P.a, P.z, P.rd)


@native
def put_rates(P: Problem, C: Control, k: Reals) -> None:
    """Accelerations from the rates of free bodies."""
    if C.kind == LANES:
        from_lanes(P, C.lane, k, P.a)
    else:
        first = C.width - P.sizes.n
        copy(P.a, k[first:], P.sizes.n)


@native
def stages(P: Problem, L: Plan, C: Control, h: float) -> bool:
    """Rates of all stages and the new state; False when one could not be had.

    Stages drift off the constraints by an error r of low order. Where constraints lose rank within
    the step that is an error r/d of accelerations: there every stage is projected.
    """
    w = C.size
    K, t = P.history, C.t
    y, new = K[OLD * w :], K[NEXT_STATE * w :]
    C.stale = False
    projected = P.sizes.m > 0 and P.undoing.backs > 0
    first, last = QUICK if C.quick else 0, QUICK_RESULT if C.quick else RESULT
    nodes = P.tableau[QUICK_TIMES if C.quick else ROW * TIMES :]
    for i in range(1, last + 1):
        combine(P, C, first + i - 1, w, h, y, new)
        at, k = t + h * nodes[i], K[i * C.width :]
        if not (exact_rates(P, L, C, at, new, k) if projected else rates_at(P, L, C, at, new, k)):
            return False
    combine(P, C, first + last, w, h, y, new)
    return True


@native
def restore_state(P: Problem, C: Control) -> None:
    """The accepted state back into q, u, a, z and the workspace after records were made."""
    w = C.size
    n, first = P.sizes.n, P.sizes.m + P.sizes.nv
    y = P.history[OLD * w :]
    take_state(P, C, y, P.q, P.u)
    if C.kind == LANES:
        from_lanes(P, C.lane, P.history, P.a)
    else:
        copy(P.a, P.ra, n)
    for i in range(first):
        P.z[i] = P.rz[i]
    for i in range(P.sizes.ns):
        P.z[first + i], P.rd[i] = y[2 * n + i], P.history[2 * n + i]
    put_state(P, C.t, P.q, P.u, P.a, P.z, P.rd)


@native
def take_state(P: Problem, C: Control, y: Reals, q: Reals, u: Reals) -> None:
    """Positions and velocities (n,) of a state."""
    if C.kind == LANES:
        from_lanes(P, C.lane, y, q)
        from_lanes(P, C.lane, y[C.half :], u)
    else:
        for i in range(P.sizes.n):
            q[i], u[i] = y[i], y[P.sizes.n + i]


@native
def base_here(P: Problem, C: Control) -> None:
    """Count rotation vectors from the accepted attitude."""
    if C.kind >= MASSES:
        return
    count_from_here(P)
    n, y, k = P.sizes.n, P.history[OLD * C.size :], P.history[0:]
    for b in range(P.sizes.nb):
        if P.body[b].width == PART:
            for i in range(P.body[b].first + 3, P.body[b].first + 6):
                y[i], k[i] = 0.0, y[n + i]
