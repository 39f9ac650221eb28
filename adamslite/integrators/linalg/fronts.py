"""Elimination front by front, for patterns that fill (the multifrontal method).

A front is a dense matrix of its own unknowns and of those behind that are coupled to them.  What
its elimination leaves for these is added to the front of its parent in the tree:

    [D  U]      P D = L1 U1,   U <- L1^-1 P U,   B <- B U1^-1,   S <- S - B U
    [B  S]

D and U are one panel of rows, B another of columns, both in the array of the factors; S is on a
stack in the workspace until it is added to the parent, runs of neighbours at a time.  Rows are
pivoted inside of D.  Reference: Duff, Reid, ACM Trans. Math. Softw. 9 (1983) 302.
"""

from __future__ import annotations

from adamslite.integrators.linalg.dense import (
    eliminate_column,
    negative_pivots,
    product,
    subtract_row,
)
from adamslite.integrators.linalg.plan import SIGNATURE, SOLVE, Front, Plan
from adamslite.integrators.linalg.products import subtract_product
from adamslite.native.translate import Alone, Ints, Reals, native

# Columns that are eliminated before the rest of a front is: a multiple of 4.
PANEL = 48


@native
def work_on_fronts(
    L: Plan, LV: Reals, pivots: Ints, b: Reals, x: Reals, work: Reals, task: int, late: float
) -> int:
    """FACTOR; SOLVE for b, with the workspace x, or SIGNATURE with the pivots in x.

    ``pivots`` has the answer behind those of all unknowns: 0 where a pivot is too small, -1 for
    no signature.
    """
    answer = 1
    if task == SOLVE:
        solve(L, LV, pivots, b, x, work)
    else:
        answer = factor(L, LV, pivots, x, work, task == SIGNATURE, late)
    pivots[L.place.size] = answer
    return answer


@native
def factor(
    L: Plan, LV: Reals, pivots: Ints, found: Reals, work: Reals, signs: bool, late: float
) -> int:
    """Eliminate all fronts; with ``signs``, count negative pivots as if rows were not pivoted."""
    top, count = 0, 0
    for k in range(L.fronts.size):
        F = L.fronts[k]
        s, r = F.size, F.rest
        for i in range(r * r):
            work[top + i] = 0.0
        child = k - 1
        while child >= F.before:
            add_update(L, L.fronts[child], F, LV, work, top, 1)
            child = L.fronts[child].before - 1
        if signs:
            copy_square(LV[F.panel :], s + r, work[top + r * r :], s)
            count += negative_pivots(
                work, top + r * r, s, work[top + r * r + s * s :], found, F.start, late
            )
        if not factor_front(F, LV, pivots):
            return -1 if signs else 0
        subtract_product(LV[F.lower :], s, LV[F.panel + s :], s + r, work[top:], r, r, s, r)
        if top > F.keep:
            for i in range(r * r):
                work[F.keep + i] = work[top + i]
        top = F.keep + r * r
    return count if signs else 1


@native
def copy_square(a: Reals, lead: int, target: Reals, size: int) -> None:
    """The first rows and columns of a matrix with rows of ``lead``."""
    for i in range(size):
        for j in range(size):
            target[i * size + j] = a[i * lead + j]


@native
def add_update(
    L: Plan, child: Front, F: Front, LV: Reals, work: Reals, top: int, parts: int
) -> None:
    """Add what a child leaves to the front F, whose own S is at ``top``; numbers have one part, or
    a real and an imaginary one.
    """
    s, r, row = F.size, F.rest, child.keep
    for e in range(child.first_run, child.last_run):
        to = L.runs[e].to
        for i in range(to, to + L.runs[e].count):
            for f in range(child.first_run, child.last_run):
                at, count = L.runs[f].to, L.runs[f].count
                many, added = parts * count, work[parts * row :]
                if i < s:
                    add(many, added, LV[parts * (F.panel + i * (s + r) + at) :])
                elif at < s:
                    add(many, added, LV[parts * (F.lower + (i - s) * s + at) :])
                else:
                    add(many, added, work[parts * (top + (i - s) * r + at - s) :])
                row += count


@native
def add(n: int, x: Reals, y: Alone) -> None:
    """y += x"""
    for j in range(n):
        y[j] += x[j]


@native
def factor_front(F: Front, LV: Reals, pivots: Ints) -> bool:
    """D, U and B of a front; ``pivots`` take the order of its rows.  False when D is singular."""
    s, r, t = F.size, F.rest, F.size + F.rest
    D, B = LV[F.panel :], LV[F.lower :]
    for first in range(0, s, PANEL):
        end = min(first + PANEL, s)
        for c in range(first, end, 4):
            stop = min(c + 4, end)
            for j in range(c, stop):
                if not eliminate_column(D, 0, t, s, j, stop, pivots, F.start):
                    return False
            for i in range(c + 1, stop):
                for p in range(c, i):
                    subtract_row(D[i * t + p], D[p * t + stop :], end - stop, D[i * t + stop :])
            take_columns(D, t, D[stop * t :], t, s - stop, c, stop, stop, end)
            divide(D, t, B, s, r, c, stop)
            take_columns(D, t, B, s, r, c, stop, stop, end)
        finish_rows(D, t, first, end)
        take_columns(D, t, D[end * t :], t, s - end, first, end, end, t)
        take_columns(D, t, B, s, r, first, end, end, s)
    return True


@native
def take_columns(
    D: Reals, t: int, A: Reals, lead: int, rows: int, first: int, end: int, start: int, stop: int
) -> None:
    """A[:, start:stop] -= A[:, first:end] D[first:end, start:stop]"""
    width, B, C = stop - start, D[first * t + start :], A[start:]
    subtract_product(A[first:], lead, B, t, C, lead, rows, end - first, width)


@native
def finish_rows(D: Reals, t: int, first: int, end: int) -> None:
    """Rows of a panel behind it, which waited until none of its rows was to be swapped."""
    for c in range(first, end, 4):
        stop = min(c + 4, end)
        for i in range(c + 1, stop):
            for p in range(c, i):
                subtract_row(D[i * t + p], D[p * t + end :], t - end, D[i * t + end :])
        take_columns(D, t, D[stop * t :], t, end - stop, c, stop, end, t)


@native
def divide(D: Reals, t: int, B: Reals, s: int, rows: int, first: int, end: int) -> None:
    """B <- B U^-1 in the columns from ``first`` to ``end``, U the triangle of D there."""
    for j in range(first, end):
        w = 1.0 / D[j * t + j]
        for i in range(rows):
            total = B[i * s + j]
            for p in range(first, j):
                total -= B[i * s + p] * D[p * t + j]
            B[i * s + j] = total * w


@native
def solve(L: Plan, LV: Reals, pivots: Ints, b: Reals, x: Reals, work: Reals) -> None:
    """Replace ``b``, in the order of the unknowns, by the solution; ``x``, ``work``: workspace."""
    for i in range(L.place.size):
        x[L.place[i]] = b[i]
    for k in range(L.fronts.size):
        forward(L, L.fronts[k], LV, pivots, x)
    for k in range(L.fronts.size - 1, -1, -1):
        backward(L, L.fronts[k], LV, x, work)
    for i in range(L.place.size):
        b[i] = x[L.place[i]]


@native
def forward(L: Plan, F: Front, LV: Reals, pivots: Ints, x: Reals) -> None:
    """y = L1^-1 P x, and B y off the rest."""
    s, t, row, own = F.size, F.size + F.rest, F.lower, x[F.start :]
    for k in range(s):
        p = pivots[F.start + k]
        own[k], own[p] = own[p], own[k]
        own[k] -= product(k, LV[F.panel + k * t :], own)
    for e in range(F.first_run, F.last_run):
        for i in range(L.runs[e].at, L.runs[e].at + L.runs[e].count):
            x[i] -= product(s, LV[row:], own)
            row += s


@native
def backward(L: Plan, F: Front, LV: Reals, x: Reals, rest: Reals) -> None:
    """x = U1^-1 (y - U x_rest)"""
    s, r, t, at, own = F.size, F.rest, F.size + F.rest, 0, x[F.start :]
    for e in range(F.first_run, F.last_run):
        for i in range(L.runs[e].at, L.runs[e].at + L.runs[e].count):
            rest[at] = x[i]
            at += 1
    for k in range(s - 1, -1, -1):
        D = LV[F.panel + k * t :]
        total = own[k] - product(s - k - 1, D[k + 1 :], own[k + 1 :]) - product(r, D[s:], rest)
        own[k] = total / D[k]
