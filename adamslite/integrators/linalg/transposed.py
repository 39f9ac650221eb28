"""Systems with the transposed matrix, by the factors that the elimination has left.

    P A = L U:    A^T x = b    by    U^T y = b,  L^T z = y,  x = P^T z

Blocks and fronts are gone through in the same order as for A, columns in place of rows, so that
the effort is that of one more solution.  Reference: Golub, Van Loan, Matrix Computations, 2013,
section 3.4.
"""

from __future__ import annotations

from adamslite.integrators.linalg.blocks import has_lower, is_link
from adamslite.integrators.linalg.dense import subtract_row
from adamslite.integrators.linalg.plan import Front, Plan
from adamslite.native.translate import Ints, Reals, native


@native
def solve_transposed(L: Plan, LV: Reals, pivots: Ints, b: Reals, x: Reals, work: Reals) -> None:
    """Replace ``b``, in the order of the equations, by the solution in the order of the unknowns;
    ``x``, ``work``: workspace.
    """
    n = L.size.size
    for i in range(L.place.size):
        x[L.place[i]] = b[i]
    if L.fronts.size > 0:
        for k in range(L.fronts.size):
            down_front(L, L.fronts[k], LV, x)
        for k in range(L.fronts.size - 1, -1, -1):
            up_front(L, L.fronts[k], LV, pivots, x)
    elif n == 1:
        dense_transposed(LV, 0, L.size[0], pivots, 0, x, 0)
    else:
        down_blocks(L, LV, x, work)
        up_blocks(L, LV, x)
    for i in range(L.place.size):
        b[i] = x[L.place[i]]


@native
def dense_transposed(A: Reals, o: int, s: int, pivots: Ints, po: int, x: Reals, xo: int) -> None:
    """With the factors of a dense matrix, in place."""
    n = pivots[po + s]
    for k in range(n):
        x[xo + k] /= A[o + k * s + k]
        subtract_row(x[xo + k], A[o + k * s + k + 1 :], n - k - 1, x[xo + k + 1 :])
    for k in range(n - 1, -1, -1):
        subtract_row(x[xo + k], A[o + k * s :], k, x[xo:])
    for k in range(n - 1, -1, -1):
        p = pivots[po + k]
        x[xo + k], x[xo + p] = x[xo + p], x[xo + k]


@native
def subtract_columns(A: Reals, rows: int, columns: int, x: Reals, y: Reals) -> None:
    """y -= A^T x for a block of ``rows`` by ``columns``."""
    for i in range(rows):
        for j in range(columns):
            y[j] -= A[i * columns + j] * x[i]


@native
def times_transposed(A: Reals, size: int, x: Reals, y: Reals) -> None:
    """x = A^T x; ``y`` is workspace."""
    for j in range(size):
        y[j] = 0.0
    for i in range(size):
        for j in range(size):
            y[j] += A[i * size + j] * x[i]
    for j in range(size):
        x[j] = y[j]


@native
def down_blocks(L: Plan, LV: Reals, x: Reals, work: Reals) -> None:
    """y_k = A_kk^-T x_k, x_j -= A_kj^T y_k; in a chain the product is there already."""
    for k in range(L.size.size):
        s, p, linked = L.size[k], L.start[k], is_link(L, k)
        if not linked:
            times_transposed(LV[L.diagonal[k] :], s, x[p:], work)
        for e in range(L.first[k], L.first[k + 1]):
            j = L.node[e]
            subtract_columns(LV[L.upper[e] :], s, L.size[j], x[p:], x[L.start[j] :])
        if linked:
            times_transposed(LV[L.diagonal[k] :], s, x[p:], work)


@native
def up_blocks(L: Plan, LV: Reals, x: Reals) -> None:
    """x_k -= A_ik^T x_i for every i after k."""
    for k in range(L.size.size - 1, -1, -1):
        s, p, lo = L.size[k], L.start[k], L.first[k]
        for e in range(lo, L.first[k + 1] if has_lower(L, k) else lo):
            i = L.node[e]
            subtract_columns(LV[L.lower[e] :], L.size[i], s, x[L.start[i] :], x[p:])


@native
def down_front(L: Plan, F: Front, LV: Reals, x: Reals) -> None:
    """y = U1^-T x, and U^T y off the rest."""
    s, t, own = F.size, F.size + F.rest, x[F.start :]
    for k in range(s):
        row = F.panel + k * t
        own[k] /= LV[row + k]
        subtract_row(own[k], LV[row + k + 1 :], s - k - 1, own[k + 1 :])
        at = row + s
        for e in range(F.first_run, F.last_run):
            subtract_row(own[k], LV[at:], L.runs[e].count, x[L.runs[e].at :])
            at += L.runs[e].count


@native
def up_front(L: Plan, F: Front, LV: Reals, pivots: Ints, x: Reals) -> None:
    """x = P^T L1^-T (y - B^T x_rest)"""
    s, t, row, own = F.size, F.size + F.rest, F.lower, x[F.start :]
    for e in range(F.first_run, F.last_run):
        for i in range(L.runs[e].at, L.runs[e].at + L.runs[e].count):
            subtract_row(x[i], LV[row:], s, own)
            row += s
    for k in range(s - 1, -1, -1):
        subtract_row(own[k], LV[F.panel + k * t :], k, own)
    for k in range(s - 1, -1, -1):
        p = pivots[F.start + k]
        own[k], own[p] = own[p], own[k]
