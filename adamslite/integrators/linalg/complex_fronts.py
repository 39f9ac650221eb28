"""Elimination front by front in complex numbers, as :mod:`adamslite.integrators.linalg.fronts`.

Entry k of an array is (A[2k], A[2k + 1]).  The diagonal of U is left inverted.
"""

from __future__ import annotations

from adamslite.integrators.linalg.complex_blocks import subtract_product, take_product
from adamslite.integrators.linalg.fronts import add_update
from adamslite.integrators.linalg.plan import SOLVE, TINY, Front, Plan
from adamslite.native.translate import Ints, Reals, native


@native
def work_on_complex_fronts(
    L: Plan, A: Reals, pivots: Ints, b: Reals, x: Reals, work: Reals, task: int
) -> int:
    """FACTOR, or SOLVE for b with the workspace x; ``pivots`` has behind those of all unknowns
    whether no pivot is too small.
    """
    answer = 1
    if task == SOLVE:
        solve(L, A, pivots, b, x, work)
    elif not factor(L, A, pivots, work):
        answer = 0
    pivots[L.place.size] = answer
    return answer


@native
def factor(L: Plan, A: Reals, pivots: Ints, work: Reals) -> bool:
    """Eliminate all fronts."""
    top = 0
    for k in range(L.fronts.size):
        F = L.fronts[k]
        r = F.rest
        for i in range(2 * r * r):
            work[2 * top + i] = 0.0
        child = k - 1
        while child >= F.before:
            add_update(L, L.fronts[child], F, A, work, top, 2)
            child = L.fronts[child].before - 1
        if not factor_rows(F, A, pivots):
            return False
        take_rows(F, A, work, top)
        if top > F.keep:
            for i in range(2 * r * r):
                work[2 * F.keep + i] = work[2 * top + i]
        top = F.keep + r * r
    return True


@native
def factor_rows(F: Front, A: Reals, pivots: Ints) -> bool:
    """D and U of a front, row pivoting inside of D; False when D is singular."""
    s, t = F.size, F.size + F.rest
    for k in range(s):
        best, p = 0.0, k
        for i in range(k, s):
            at = 2 * (F.panel + i * t + k)
            size = abs(A[at]) + abs(A[at + 1])
            if size > best:
                best, p = size, i
        if not best > TINY:
            return False
        pivots[F.start + k] = p
        if p != k:
            for j in range(2 * t):
                a, b = 2 * (F.panel + k * t) + j, 2 * (F.panel + p * t) + j
                A[a], A[b] = A[b], A[a]
        at = 2 * (F.panel + k * t + k)
        x, y = A[at] / best, A[at + 1] / best
        size = best * (x * x + y * y)
        A[at], A[at + 1] = x / size, -y / size
        for i in range(k + 1, s):
            take_pivot_row(A, F.panel + i * t, F.panel + k * t, k, t)
    return True


@native
def take_pivot_row(A: Reals, row: int, pivot: int, k: int, stop: int) -> None:
    """Take the row at ``pivot``, whose entry k is inverted, out of that at ``row``."""
    at, to = 2 * (pivot + k), 2 * (row + k)
    x, y = A[to] * A[at] - A[to + 1] * A[at + 1], A[to] * A[at + 1] + A[to + 1] * A[at]
    A[to], A[to + 1] = x, y
    if x != 0.0 or y != 0.0:
        subtract_product(A, row + k + 1, x, y, A, pivot + k + 1, stop - k - 1)


@native
def take_rows(F: Front, A: Reals, work: Reals, top: int) -> None:
    """B <- B U1^-1 and S <- S - B U."""
    s, r, t = F.size, F.rest, F.size + F.rest
    for i in range(r):
        row = F.lower + i * s
        for k in range(s):
            take_pivot_row(A, row, F.panel + k * t, k, s)
        for k in range(s):
            at = 2 * (row + k)
            subtract_product(work, top + i * r, A[at], A[at + 1], A, F.panel + k * t + s, r)


@native
def solve(L: Plan, A: Reals, pivots: Ints, b: Reals, x: Reals, work: Reals) -> None:
    """Replace ``b``, in the order of the unknowns, by the solution; ``x``, ``work``: workspace."""
    for i in range(L.place.size):
        p = 2 * L.place[i]
        x[p], x[p + 1] = b[2 * i], b[2 * i + 1]
    for k in range(L.fronts.size):
        forward(L, L.fronts[k], A, pivots, x)
    for k in range(L.fronts.size - 1, -1, -1):
        backward(L, L.fronts[k], A, x, work)
    for i in range(L.place.size):
        p = 2 * L.place[i]
        b[2 * i], b[2 * i + 1] = x[p], x[p + 1]


@native
def forward(L: Plan, F: Front, A: Reals, pivots: Ints, x: Reals) -> None:
    """y = L1^-1 P x, and B y off the rest."""
    s, t, row, own = F.size, F.size + F.rest, F.lower, F.start
    for k in range(s):
        a, b = 2 * (own + k), 2 * (own + pivots[own + k])
        x[a], x[b] = x[b], x[a]
        x[a + 1], x[b + 1] = x[b + 1], x[a + 1]
        take_product(A[2 * (F.panel + k * t) :], x[2 * own :], k, x[a:])
    for e in range(F.first_run, F.last_run):
        for i in range(L.runs[e].at, L.runs[e].at + L.runs[e].count):
            take_product(A[2 * row :], x[2 * own :], s, x[2 * i :])
            row += s


@native
def backward(L: Plan, F: Front, A: Reals, x: Reals, rest: Reals) -> None:
    """x = U1^-1 (y - U x_rest)"""
    s, r, t, at, own = F.size, F.rest, F.size + F.rest, 0, F.start
    for e in range(F.first_run, F.last_run):
        for i in range(L.runs[e].at, L.runs[e].at + L.runs[e].count):
            rest[at], rest[at + 1] = x[2 * i], x[2 * i + 1]
            at += 2
    for k in range(s - 1, -1, -1):
        row = F.panel + k * t
        at, to = 2 * (row + k), 2 * (own + k)
        take_product(A[at + 2 :], x[to + 2 :], s - k - 1, x[to:])
        take_product(A[2 * (row + s) :], rest, r, x[to:])
        p, q = x[to], x[to + 1]
        x[to], x[to + 1] = A[at] * p - A[at + 1] * q, A[at] * q + A[at + 1] * p
