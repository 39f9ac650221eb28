"""Block elimination in complex numbers, with the plan and the order of the real one.

A complex array holds the real and the imaginary part of each entry one after the other, so that its
entry k is (A[2k], A[2k + 1]).  The blocks, their places and the formulas are those of
:mod:`adamslite.integrators.linalg.blocks`.
"""

from __future__ import annotations

from adamslite.integrators.linalg.blocks import TINY, has_lower
from adamslite.integrators.linalg.plan import COMPLEX, FACTOR, SOLVE, Plan
from adamslite.native.translate import Ints, Reals, call_address, native


@native
def subtract_product(A: Reals, d: int, x: float, y: float, B: Reals, u: int, count: int) -> None:
    """A[d:] -= (x + i y) B[u:], ``count`` entries."""
    for j in range(count):
        p, q = B[2 * (u + j)], B[2 * (u + j) + 1]
        A[2 * (d + j)] -= x * p - y * q
        A[2 * (d + j) + 1] -= x * q + y * p


@native
def lu_complex(A: Reals, o: int, s: int, pivots: Ints, po: int) -> bool:
    """LU of the s x s block at ``o`` with row pivoting; the diagonal of U is left inverted."""
    for k in range(s):
        best, p = 0.0, k
        for i in range(k, s):
            at = 2 * (o + i * s + k)
            size = abs(A[at]) + abs(A[at + 1])
            if size > best:
                best, p = size, i
        if not best > TINY:
            return False
        pivots[po + k] = p
        if p != k:
            for j in range(2 * s):
                a, b = 2 * (o + k * s) + j, 2 * (o + p * s) + j
                A[a], A[b] = A[b], A[a]
        at = 2 * (o + k * s + k)
        x, y = A[at] / best, A[at + 1] / best
        size = best * (x * x + y * y)
        A[at], A[at + 1] = x / size, -y / size
        for i in range(k + 1, s):
            to = 2 * (o + i * s + k)
            x, y = A[to] * A[at] - A[to + 1] * A[at + 1], A[to] * A[at + 1] + A[to + 1] * A[at]
            A[to], A[to + 1] = x, y
            if x != 0.0 or y != 0.0:
                subtract_product(A, o + i * s + k + 1, x, y, A, o + k * s + k + 1, s - k - 1)
    return True


@native
def solve_lu_complex(A: Reals, o: int, s: int, pivots: Ints, po: int, x: Reals, xo: int) -> None:
    """Solve with the factors of :func:`lu_complex` in place."""
    for k in range(s):
        a, b = 2 * (xo + k), 2 * (xo + pivots[po + k])
        x[a], x[b] = x[b], x[a]
        x[a + 1], x[b + 1] = x[b + 1], x[a + 1]
        take_product(A[2 * (o + k * s) :], x[2 * xo :], k, x[a:])
    for k in range(s - 1, -1, -1):
        to = 2 * (xo + k)
        take_product(A[2 * (o + k * s + k + 1) :], x[to + 2 :], s - k - 1, x[to:])
        at, to = 2 * (o + k * s + k), 2 * (xo + k)
        p, q = x[to], x[to + 1]
        x[to], x[to + 1] = A[at] * p - A[at + 1] * q, A[at] * q + A[at + 1] * p


@native
def take_product(A: Reals, x: Reals, count: int, y: Reals) -> None:
    """y[0] -= A . x of ``count`` entries, in sums that do not wait for each other."""
    a, b, c, d = 0.0, 0.0, 0.0, 0.0
    for j in range(count):
        p, q, r, s = A[2 * j], A[2 * j + 1], x[2 * j], x[2 * j + 1]
        a += p * r
        b += q * s
        c += p * s
        d += q * r
    y[0] -= a - b
    y[1] -= c + d


@native
def invert_complex(A: Reals, o: int, s: int, pivots: Ints, po: int, work: Reals) -> bool:
    """Replace the s x s block at ``o`` with its inverse."""
    if not lu_complex(A, o, s, pivots, po):
        return False
    for j in range(s):
        for i in range(2 * s):
            work[2 * j * s + i] = 0.0
        work[2 * (j * s + j)] = 1.0
        solve_lu_complex(A, o, s, pivots, po, work, j * s)
    for i in range(s):
        for j in range(s):
            A[2 * (o + i * s + j)] = work[2 * (j * s + i)]
            A[2 * (o + i * s + j) + 1] = work[2 * (j * s + i) + 1]
    return True


@native
def right_times_complex(A: Reals, low: int, d: int, si: int, sk: int, work: Reals) -> None:
    """A[low] = A[low] A[d], sizes (si, sk) and (sk, sk)."""
    for i in range(si):
        for j in range(2 * sk):
            work[j] = 0.0
        for k in range(sk):
            at = 2 * (low + i * sk + k)
            subtract_product(work, 0, -A[at], -A[at + 1], A, d + k * sk, sk)
        for j in range(2 * sk):
            A[2 * (low + i * sk) + j] = work[j]


@native
def factor_complex(L: Plan, A: Reals, pivots: Ints, work: Reals) -> bool:
    """Eliminate in place; False when a pivot block is singular."""
    n = L.size.size
    if L.fronts.size > 0:
        call_address(L.code[COMPLEX], L, A, pivots, work, work, work, FACTOR)
        return pivots[L.place.size] != 0
    if n == 1:
        return lu_complex(A, 0, L.size[0], pivots, 0)
    at = 0
    for k in range(n):
        s, o, lo = L.size[k], L.diagonal[k], L.first[k]
        if not invert_complex(A, o, s, pivots, L.start[k], work):
            return False
        hi = L.first[k + 1] if has_lower(L, k) else lo
        for e in range(lo, hi):
            si = L.size[L.node[e]]
            right_times_complex(A, L.lower[e], o, si, s, work)
            for f in range(lo, hi):
                sj, d, low = L.size[L.node[f]], L.target[at], L.lower[e]
                at += 1
                for i in range(si):
                    for m in range(s):
                        p = 2 * (low + i * s + m)
                        subtract_product(A, d + i * sj, A[p], A[p + 1], A, L.upper[f] + m * sj, sj)
    return True


@native
def solve_complex(L: Plan, A: Reals, pivots: Ints, b: Reals, x: Reals, work: Reals) -> None:
    """Replace ``b``, in the order of the unknowns, by the solution; ``x``, ``work``: workspace."""
    n = L.size.size
    if L.fronts.size > 0:
        call_address(L.code[COMPLEX], L, A, pivots, b, x, work, SOLVE)
        return
    for i in range(L.place.size):
        p = 2 * L.place[i]
        x[p], x[p + 1] = b[2 * i], b[2 * i + 1]
    if n == 1:
        solve_lu_complex(A, 0, L.size[0], pivots, 0, x, 0)
    else:
        forward_complex(L, A, x)
        backward_complex(L, A, x, work)
    for i in range(L.place.size):
        p = 2 * L.place[i]
        b[2 * i], b[2 * i + 1] = x[p], x[p + 1]


@native
def forward_complex(L: Plan, A: Reals, x: Reals) -> None:
    """x_i -= A_ik x_k for every i after k."""
    for k in range(L.size.size):
        lo = L.first[k]
        for e in range(lo, L.first[k + 1] if has_lower(L, k) else lo):
            i = L.node[e]
            subtract_complex(A, L.lower[e], L.size[i], L.size[k], x, L.start[k], L.start[i])


@native
def backward_complex(L: Plan, A: Reals, x: Reals, work: Reals) -> None:
    """x_k = A_kk^-1 (x_k - sum A_kj x_j)."""
    for k in range(L.size.size - 1, -1, -1):
        s, p = L.size[k], L.start[k]
        for e in range(L.first[k], L.first[k + 1]):
            j = L.node[e]
            subtract_complex(A, L.upper[e], s, L.size[j], x, L.start[j], p)
        for i in range(2 * s):
            work[i] = -x[2 * p + i]
            x[2 * p + i] = 0.0
        for i in range(s):
            take_product(A[2 * (L.diagonal[k] + i * s) :], work, s, x[2 * (p + i) :])


@native
def subtract_complex(A: Reals, o: int, rows: int, columns: int, x: Reals, p: int, q: int) -> None:
    """x[q:] -= A[o] x[p:]."""
    for i in range(rows):
        take_product(A[2 * (o + i * columns) :], x[2 * p :], columns, x[2 * (q + i) :])
