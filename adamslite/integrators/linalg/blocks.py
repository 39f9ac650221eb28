"""Block elimination with an order fixed once per model.

The Newton matrix is stored as dense blocks between nodes (a point mass 3 unknowns, a part 6, the
multipliers of one joint, one variable).  :mod:`adamslite.equations.elimination_order` fixes the
elimination order and the fill; here is the numeric work only:

    A_kk <- A_kk^-1,   A_ik <- A_ik A_kk^-1,   A_ij <- A_ij - A_ik A_kj        for i, j after k.

Nodes on which nothing depends come first and have nothing below: A_ik = 0.

In a chain of point masses also A_kj <- A_kk A_kj: it keeps the inverse out of the chain of
dependent operations when solving.

Rows are pivoted inside a diagonal block.  A small model is one node, hence ordinary dense
elimination with partial pivoting.  Reference: Duff, Erisman, Reid, Direct Methods for Sparse
Matrices, 2017, ch. 7 and 11.
"""

from __future__ import annotations

from adamslite.integrators.linalg.dense import lu_dense, negative_pivots, solve_dense
from adamslite.integrators.linalg.plan import FACTOR, REAL, SIGNATURE, SOLVE, TINY, Plan
from adamslite.native.translate import Ints, Reals, call_address, inline, native


@native
def determinant3(A: Reals, o: int) -> float:
    """Determinant of the 3 x 3 block at ``o``."""
    a, b, c = A[o], A[o + 1], A[o + 2]
    d, e, f = A[o + 3], A[o + 4], A[o + 5]
    g, h, i = A[o + 6], A[o + 7], A[o + 8]
    return a * (e * i - f * h) + b * (f * g - d * i) + c * (d * h - e * g)


@native
@inline
def invert3(A: Reals, o: int) -> float:
    """Replace the 3 x 3 block at ``o`` with its inverse; returns its determinant."""
    a, b, c = A[o], A[o + 1], A[o + 2]
    d, e, f = A[o + 3], A[o + 4], A[o + 5]
    g, h, i = A[o + 6], A[o + 7], A[o + 8]
    p, q, r = e * i - f * h, f * g - d * i, d * h - e * g
    det = a * p + b * q + c * r
    w = 1.0 / det
    A[o], A[o + 1], A[o + 2] = p * w, (c * h - b * i) * w, (b * f - c * e) * w
    A[o + 3], A[o + 4], A[o + 5] = q * w, (a * i - c * g) * w, (c * d - a * f) * w
    A[o + 6], A[o + 7], A[o + 8] = r * w, (b * g - a * h) * w, (a * e - b * d) * w
    return det


@native
@inline
def invert2(A: Reals, o: int, s: int) -> float:
    """Replace the block of one or 2 x 2 entries at ``o`` with its inverse; returns its
    determinant.
    """
    a = A[o]
    if s == 1:
        A[o] = 1.0 / a
        return a
    b, c, d = A[o + 1], A[o + 2], A[o + 3]
    det = a * d - b * c
    w = 1.0 / det
    A[o], A[o + 1], A[o + 2], A[o + 3] = d * w, -b * w, -c * w, a * w
    return det


@native
def invert(A: Reals, o: int, s: int, pivots: Ints, po: int, work: Reals) -> bool:
    """Replace the s x s block at ``o`` with its inverse (Gauss-Jordan, row pivoting)."""
    if not lu_dense(A, o, s, pivots, po):
        return False
    for j in range(s):
        for i in range(s):
            work[j * s + i] = 0.0
        work[j * s + j] = 1.0
        solve_dense(A, o, s, pivots, po, work, j * s)
    for i in range(s):
        for j in range(s):
            A[o + i * s + j] = work[j * s + i]
    return True


@native
def times3(A: Reals, low: int, u: int, d: int) -> None:
    """A[d] -= A[low] A[u] for 3 x 3 blocks."""
    for i in range(3):
        x, y, z = A[low + 3 * i], A[low + 3 * i + 1], A[low + 3 * i + 2]
        for j in range(3):
            A[d + 3 * i + j] -= x * A[u + j] + y * A[u + 3 + j] + z * A[u + 6 + j]


@native
def right_times3(A: Reals, low: int, d: int) -> None:
    """A[low] = A[low] A[d] for 3 x 3 blocks."""
    for i in range(3):
        x, y, z = A[low + 3 * i], A[low + 3 * i + 1], A[low + 3 * i + 2]
        for j in range(3):
            A[low + 3 * i + j] = x * A[d + j] + y * A[d + 3 + j] + z * A[d + 6 + j]


@native
def times2(A: Reals, low: int, u: int, d: int) -> None:
    """A[d] -= A[low] A[u] for 2 x 2 blocks."""
    for i in range(2):
        x, y = A[low + 2 * i], A[low + 2 * i + 1]
        for j in range(2):
            A[d + 2 * i + j] -= x * A[u + j] + y * A[u + 2 + j]


@native
def right_times2(A: Reals, low: int, d: int) -> None:
    """A[low] = A[low] A[d] for 2 x 2 blocks."""
    for i in range(2):
        x, y = A[low + 2 * i], A[low + 2 * i + 1]
        for j in range(2):
            A[low + 2 * i + j] = x * A[d + j] + y * A[d + 2 + j]


@native
def times(A: Reals, low: int, u: int, d: int, si: int, sk: int, sj: int) -> None:
    """A[d] -= A[low] A[u], sizes (si, sk) and (sk, sj)."""
    for i in range(si):
        for k in range(sk):
            x = A[low + i * sk + k]
            if x != 0.0:
                for j in range(sj):
                    A[d + i * sj + j] -= x * A[u + k * sj + j]


@native
def right_times(A: Reals, low: int, d: int, si: int, sk: int, work: Reals) -> None:
    """A[low] = A[low] A[d], sizes (si, sk) and (sk, sk)."""
    for i in range(si):
        for j in range(sk):
            work[j] = 0.0
        for k in range(sk):
            x = A[low + i * sk + k]
            for j in range(sk):
                work[j] += x * A[d + k * sk + j]
        for j in range(sk):
            A[low + i * sk + j] = work[j]


@native
def left_times3(A: Reals, d: int, u: int) -> None:
    """A[u] = A[d] A[u] for 3 x 3 blocks."""
    for j in range(3):
        x, y, z = A[u + j], A[u + 3 + j], A[u + 6 + j]
        for i in range(3):
            A[u + 3 * i + j] = A[d + 3 * i] * x + A[d + 3 * i + 1] * y + A[d + 3 * i + 2] * z


@native
def is_link(L: Plan, k: int) -> bool:
    """A point mass with one other point mass left to couple to: a link of a chain."""
    if L.first[k + 1] - L.first[k] != 1:
        return False
    return L.size[k] == 3 and L.size[L.node[L.first[k]]] == 3


@native
def has_lower(L: Plan, k: int) -> bool:
    """Whether a node after k depends on it."""
    lo = L.first[k]
    return lo < L.first[k + 1] and L.lower[lo] >= 0


@native
def eliminate(L: Plan, LV: Reals, k: int, at: int, work: Reals) -> int:
    """Take the inverted pivot block k out of the blocks after it; ``at`` counts the targets."""
    if not has_lower(L, k):
        return at
    s, o, lo, hi = L.size[k], L.diagonal[k], L.first[k], L.first[k + 1]
    for e in range(lo, hi):
        si = L.size[L.node[e]]
        if s == 3 and si == 3:
            right_times3(LV, L.lower[e], o)
        elif s == 2 and si == 2:
            right_times2(LV, L.lower[e], o)
        else:
            right_times(LV, L.lower[e], o, si, s, work)
        for f in range(lo, hi):
            sj = L.size[L.node[f]]
            if s == 3 and si == 3 and sj == 3:
                times3(LV, L.lower[e], L.upper[f], L.target[at])
            elif s == 2 and si == 2 and sj == 2:
                times2(LV, L.lower[e], L.upper[f], L.target[at])
            else:
                times(LV, L.lower[e], L.upper[f], L.target[at], si, s, sj)
            at += 1
    return at


@native
def add_to_diagonal(L: Plan, d: Reals, A: Reals, x: Reals) -> None:
    """A_ii += d_i in the order of the unknowns; ``x``: workspace."""
    for i in range(L.place.size):
        x[L.place[i]] = d[i]
    for k in range(L.size.size):
        s = L.size[k]
        for i in range(s):
            A[L.diagonal[k] + i * (s + 1)] += x[L.start[k] + i]
    for k in range(L.fronts.size):
        F = L.fronts[k]
        for i in range(F.size):
            A[F.panel + i * (F.size + F.rest + 1)] += x[F.start + i]


@native
def factor(L: Plan, LV: Reals, pivots: Ints, work: Reals) -> bool:
    """Eliminate in place; returns False when a pivot block is singular.

    ``L`` is the elimination plan of :mod:`adamslite.equations.elimination_order`: size, first
    unknown and diagonal block of each node; for the entries e below node k
    (``first[k]:first[k+1]``) the other node, its lower and upper block, -1 where there is no lower
    one; ``target`` the blocks updated, entry by entry.
    """
    n = L.size.size
    if L.fronts.size > 0:
        call_address(L.code[REAL], L, LV, pivots, work, work, work, FACTOR, 0.0)
        return pivots[L.place.size] != 0
    if n == 1:
        return lu_dense(LV, 0, L.size[0], pivots, 0)
    at = 0
    for k in range(n):
        s, o = L.size[k], L.diagonal[k]
        if s == 3:
            det = invert3(LV, o)
            if not abs(det) > TINY:
                return False
        elif s <= 2:
            if not abs(invert2(LV, o, s)) > TINY:
                return False
        elif not invert(LV, o, s, pivots, L.start[k], work):
            return False
        at = eliminate(L, LV, k, at, work)
        if is_link(L, k):
            left_times3(LV, o, L.upper[L.first[k]])
    return True


@native
def signature(L: Plan, LV: Reals, pivots: Ints, work: Reals, found: Reals, late: float) -> int:
    """Factor and count negative pivots, ``late`` as there; -1 when singular."""
    n = L.size.size
    if L.fronts.size > 0:
        call_address(L.code[REAL], L, LV, pivots, work, found, work, SIGNATURE, late)
        return pivots[L.place.size]
    if n == 1:
        only = negative_pivots(LV, 0, L.size[0], work, found, 0, late)
        return only if lu_dense(LV, 0, L.size[0], pivots, 0) else -1
    at, count = 0, 0
    for k in range(n):
        s, o = L.size[k], L.diagonal[k]
        count += negative_pivots(LV, o, s, work, found, L.start[k], late)
        if not invert(LV, o, s, pivots, L.start[k], work):
            return -1
        lo = L.first[k]
        hi = L.first[k + 1] if has_lower(L, k) else lo
        for e in range(lo, hi):
            si = L.size[L.node[e]]
            right_times(LV, L.lower[e], o, si, s, work)
            for f in range(lo, hi):
                times(LV, L.lower[e], L.upper[f], L.target[at], si, s, L.size[L.node[f]])
                at += 1
    return count


@native
def solve(L: Plan, LV: Reals, pivots: Ints, b: Reals, x: Reals, work: Reals) -> None:
    """Replace ``b``, in the order of the unknowns, by the solution; ``x``, ``work``: workspace."""
    n = L.size.size
    if L.fronts.size > 0:
        call_address(L.code[REAL], L, LV, pivots, b, x, work, SOLVE, 0.0)
        return
    for i in range(L.place.size):
        x[L.place[i]] = b[i]
    if n == 1:
        solve_dense(LV, 0, L.size[0], pivots, 0, x, 0)
    else:
        forward(L, LV, x)
        backward(L, LV, x, work)
    for i in range(L.place.size):
        b[i] = x[L.place[i]]


@native
def forward(L: Plan, LV: Reals, x: Reals) -> None:
    """x_i -= A_ik x_k for every i after k."""
    for k in range(L.size.size):
        s, p, lo = L.size[k], L.start[k], L.first[k]
        for e in range(lo, L.first[k + 1] if has_lower(L, k) else lo):
            i, below = L.node[e], L.lower[e]
            if s == 3 and L.size[i] == 3:
                subtract3(LV[below:], x[p:], x[L.start[i] :])
            elif s == 2:
                subtract2(LV[below:], L.size[i], x[p:], x[L.start[i] :])
            else:
                subtract(LV[below:], L.size[i], s, x[p:], x[L.start[i] :])


@native
def backward(L: Plan, LV: Reals, x: Reals, y: Reals) -> None:
    """x_k = A_kk^-1 (x_k - sum A_kj x_j), in a chain with the product made before."""
    for k in range(L.size.size - 1, -1, -1):
        s, p, o, lo = L.size[k], L.start[k], L.diagonal[k], L.first[k]
        if is_link(L, k):
            replace3(LV[o:], x[p:])
            subtract3(LV[L.upper[lo] :], x[L.start[L.node[lo]] :], x[p:])
        else:
            for e in range(lo, L.first[k + 1]):
                j = L.node[e]
                if L.size[j] == 2:
                    subtract2(LV[L.upper[e] :], s, x[L.start[j] :], x[p:])
                else:
                    subtract(LV[L.upper[e] :], s, L.size[j], x[L.start[j] :], x[p:])
            if s == 3:
                replace3(LV[o:], x[p:])
            elif s <= 2:
                replace2(LV[o:], s, x[p:])
            else:
                replace(LV[o:], s, x[p:], y)


@native
def subtract3(A: Reals, x: Reals, y: Reals) -> None:
    """y -= A x for a 3 x 3 block."""
    a, b, c = x[0], x[1], x[2]
    p = A[0] * a + A[1] * b + A[2] * c
    q = A[3] * a + A[4] * b + A[5] * c
    r = A[6] * a + A[7] * b + A[8] * c
    y[0] -= p
    y[1] -= q
    y[2] -= r


@native
def subtract2(A: Reals, rows: int, x: Reals, y: Reals) -> None:
    """y -= A x for a block of two columns."""
    a, b = x[0], x[1]
    for i in range(rows):
        y[i] -= A[2 * i] * a + A[2 * i + 1] * b


@native
def subtract(A: Reals, rows: int, columns: int, x: Reals, y: Reals) -> None:
    """y -= A x."""
    for i in range(rows):
        total = 0.0
        for j in range(columns):
            total += A[i * columns + j] * x[j]
        y[i] -= total


@native
@inline
def replace3(A: Reals, x: Reals) -> None:
    """x = A x for a 3 x 3 block."""
    a, b, c = x[0], x[1], x[2]
    x[0] = A[0] * a + A[1] * b + A[2] * c
    x[1] = A[3] * a + A[4] * b + A[5] * c
    x[2] = A[6] * a + A[7] * b + A[8] * c


@native
@inline
def replace2(A: Reals, size: int, x: Reals) -> None:
    """x = A x for a block of one or 2 x 2 entries."""
    a = x[0]
    if size == 1:
        x[0] = A[0] * a
    else:
        b = x[1]
        x[0], x[1] = A[0] * a + A[1] * b, A[2] * a + A[3] * b


@native
def replace(A: Reals, size: int, x: Reals, y: Reals) -> None:
    """x = A x; ``y`` is workspace."""
    for i in range(size):
        y[i] = 0.0
        for j in range(size):
            y[i] += A[i * size + j] * x[j]
    for i in range(size):
        x[i] = y[i]
