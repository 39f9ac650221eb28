"""Complex systems with the transposed matrix, by the factors that the elimination has left.

As :mod:`adamslite.integrators.linalg.transposed`; entry k of an array is (A[2k], A[2k + 1]), and
the diagonal of U is left inverted.
"""

from __future__ import annotations

from adamslite.integrators.linalg.blocks import has_lower
from adamslite.integrators.linalg.complex_blocks import subtract_product
from adamslite.integrators.linalg.plan import Front, Plan
from adamslite.native.translate import Ints, Reals, native


@native
def solve_transposed_complex(
    L: Plan, A: Reals, pivots: Ints, b: Reals, x: Reals, work: Reals
) -> None:
    """Replace ``b``, in the order of the equations, by the solution in the order of the unknowns;
    ``x``, ``work``: workspace.
    """
    for i in range(L.place.size):
        p = 2 * L.place[i]
        x[p], x[p + 1] = b[2 * i], b[2 * i + 1]
    if L.fronts.size > 0:
        for k in range(L.fronts.size):
            down_front(L, L.fronts[k], A, x)
        for k in range(L.fronts.size - 1, -1, -1):
            up_front(L, L.fronts[k], A, pivots, x)
    elif L.size.size == 1:
        dense_transposed(A, L.size[0], pivots, x)
    else:
        down_blocks(L, A, x, work)
        up_blocks(L, A, x)
    for i in range(L.place.size):
        p = 2 * L.place[i]
        b[2 * i], b[2 * i + 1] = x[p], x[p + 1]


@native
def times_entry(A: Reals, a: int, x: Reals, k: int) -> None:
    """x[k] *= A[a]"""
    p, q = x[2 * k], x[2 * k + 1]
    x[2 * k] = A[2 * a] * p - A[2 * a + 1] * q
    x[2 * k + 1] = A[2 * a] * q + A[2 * a + 1] * p


@native
def take_row(A: Reals, row: int, count: int, x: Reals, k: int, to: int) -> None:
    """x[to:] -= A[row:] x[k], ``count`` entries."""
    subtract_product(x, to, x[2 * k], x[2 * k + 1], A, row, count)


@native
def swap_back(pivots: Ints, first: int, size: int, x: Reals) -> None:
    """Undo the exchanges of rows."""
    for k in range(size - 1, -1, -1):
        a, b = 2 * (first + k), 2 * (first + pivots[first + k])
        x[a], x[b] = x[b], x[a]
        x[a + 1], x[b + 1] = x[b + 1], x[a + 1]


@native
def dense_transposed(A: Reals, s: int, pivots: Ints, x: Reals) -> None:
    """With the factors of a dense matrix, in place."""
    for k in range(s):
        times_entry(A, k * s + k, x, k)
        take_row(A, k * s + k + 1, s - k - 1, x, k, k + 1)
    for k in range(s - 1, -1, -1):
        take_row(A, k * s, k, x, k, 0)
    swap_back(pivots, 0, s, x)


@native
def down_blocks(L: Plan, A: Reals, x: Reals, work: Reals) -> None:
    """y_k = A_kk^-T x_k, x_j -= A_kj^T y_k."""
    for k in range(L.size.size):
        s, p, o = L.size[k], L.start[k], L.diagonal[k]
        for j in range(2 * s):
            work[j] = 0.0
        for i in range(s):
            at = 2 * (p + i)
            subtract_product(work, 0, 0.0 - x[at], 0.0 - x[at + 1], A, o + i * s, s)
        for j in range(2 * s):
            x[2 * p + j] = work[j]
        for e in range(L.first[k], L.first[k + 1]):
            j = L.node[e]
            for i in range(s):
                take_row(A, L.upper[e] + i * L.size[j], L.size[j], x, p + i, L.start[j])


@native
def up_blocks(L: Plan, A: Reals, x: Reals) -> None:
    """x_k -= A_ik^T x_i for every i after k."""
    for k in range(L.size.size - 1, -1, -1):
        s, lo = L.size[k], L.first[k]
        for e in range(lo, L.first[k + 1] if has_lower(L, k) else lo):
            i = L.node[e]
            for r in range(L.size[i]):
                take_row(A, L.lower[e] + r * s, s, x, L.start[i] + r, L.start[k])


@native
def down_front(L: Plan, F: Front, A: Reals, x: Reals) -> None:
    """y = U1^-T x, and U^T y off the rest."""
    s, t, own = F.size, F.size + F.rest, F.start
    for k in range(s):
        row = F.panel + k * t
        times_entry(A, row + k, x, own + k)
        take_row(A, row + k + 1, s - k - 1, x, own + k, own + k + 1)
        at = row + s
        for e in range(F.first_run, F.last_run):
            take_row(A, at, L.runs[e].count, x, own + k, L.runs[e].at)
            at += L.runs[e].count


@native
def up_front(L: Plan, F: Front, A: Reals, pivots: Ints, x: Reals) -> None:
    """x = P^T L1^-T (y - B^T x_rest)"""
    s, t, row, own = F.size, F.size + F.rest, F.lower, F.start
    for e in range(F.first_run, F.last_run):
        for i in range(L.runs[e].at, L.runs[e].at + L.runs[e].count):
            take_row(A, row, s, x, i, own)
            row += s
    for k in range(s - 1, -1, -1):
        take_row(A, F.panel + k * t, k, x, own + k, own)
    swap_back(pivots, own, s, x)
