"""Dense elimination with row pivoting, four columns at a time.

    P A = L U,   L with a unit diagonal below, U on and above the diagonal

A panel of ``WIDTH`` columns is eliminated by itself; the rest of the matrix then takes one pass in
which every entry is loaded and stored once for four products, where elimination column by column
takes four.  Reference: Golub, Van Loan, Matrix Computations, 2013, section 3.2.11.
"""

from __future__ import annotations

from adamslite.integrators.linalg.norms import largest_of
from adamslite.integrators.linalg.plan import TINY
from adamslite.native.translate import Alone, Ints, Reals, native

# Share of the largest entry of its row below which a pivot is round-off.
NOISE = 1e-15
WIDTH = 4


@native
def lu_dense(A: Reals, o: int, s: int, pivots: Ints, po: int) -> bool:
    """LU of the s x s block at ``o`` with row pivoting; False when it is singular.

    ``pivots[po:po + s]`` take the order of the rows, ``pivots[po + s]`` how many are coupled.
    """
    n = coupled(A, o, s)
    pivots[po + s] = n
    for k in range(0, n, WIDTH):
        end = min(k + WIDTH, n)
        for c in range(k, end):
            if not eliminate_column(A, o, s, n, c, end, pivots, po):
                return False
        rest = n - end
        if rest > 0:
            for i in range(k + 1, end):
                for p in range(k, i):
                    subtract_row(A[o + i * s + p], A[o + p * s + end :], rest, A[o + i * s + end :])
            a, b, c, d = o + k * s, o + (k + 1) * s, o + (k + 2) * s, o + (k + 3) * s
            for i in range(end, n):
                r = o + i * s
                w, x, y, z = A[r + k], A[r + k + 1], A[r + k + 2], A[r + k + 3]
                if w != 0.0 or x != 0.0 or y != 0.0 or z != 0.0:
                    subtract_rows(
                        w, x, y, z, A[a + end :], A[b + end :], A[c + end :], A[d + end :], rest,
                        A[r + end :],
                    )  # fmt: skip
    return True


@native
def coupled(A: Reals, o: int, s: int) -> int:
    """Unknowns before those at the end that nothing but a one on the diagonal belongs to."""
    for n in range(s, 0, -1):
        k = n - 1
        if A[o + k * s + k] != 1.0:
            return n
        for j in range(k):
            if A[o + k * s + j] != 0.0 or A[o + j * s + k] != 0.0:
                return n
    return 0


@native
def eliminate_column(
    A: Reals, o: int, s: int, n: int, c: int, end: int, pivots: Ints, po: int
) -> bool:
    """Pivot among n rows of s entries, swap them, and eliminate column c from the columns before
    ``end``.
    """
    best, p = 0.0, c
    for i in range(c, n):
        size = abs(A[o + i * s + c])
        if size > best:
            best, p = size, i
    if not best > TINY:
        return False
    pivots[po + c] = p
    if p != c:
        swap_rows(s, A[o + c * s :], A[o + p * s :])
    w = 1.0 / A[o + c * s + c]
    for i in range(c + 1, n):
        factor = A[o + i * s + c] * w
        A[o + i * s + c] = factor
        if factor != 0.0:
            for j in range(c + 1, end):
                A[o + i * s + j] -= factor * A[o + c * s + j]
    return True


@native
def swap_rows(n: int, x: Alone, y: Alone) -> None:
    """x, y = y, x"""
    for j in range(n):
        x[j], y[j] = y[j], x[j]


@native
def subtract_row(w: float, a: Reals, n: int, y: Alone) -> None:
    """y -= w a"""
    for j in range(n):
        y[j] -= w * a[j]


@native
def subtract_rows(
    w: float, x: float, y: float, z: float,
    a: Reals, b: Reals, c: Reals, d: Reals, n: int, r: Alone,
) -> None:  # fmt: skip
    """r -= w a + x b + y c + z d"""
    for j in range(n):
        r[j] -= (w * a[j] + x * b[j]) + (y * c[j] + z * d[j])


@native
def solve_dense(A: Reals, o: int, s: int, pivots: Ints, po: int, x: Reals, xo: int) -> None:
    """Solve with the factors of :func:`lu_dense` in place."""
    n = pivots[po + s]
    for k in range(n):
        p = pivots[po + k]
        x[xo + k], x[xo + p] = x[xo + p], x[xo + k]
        x[xo + k] -= product(k, A[o + k * s :], x[xo:])
    for k in range(n - 1, -1, -1):
        total = x[xo + k] - product(n - k - 1, A[o + k * s + k + 1 :], x[xo + k + 1 :])
        x[xo + k] = total / A[o + k * s + k]


@native
def product(n: int, a: Reals, x: Reals) -> float:
    """a . x in four sums, which do not wait for each other."""
    p, q, r, s = 0.0, 0.0, 0.0, 0.0
    whole = n - n % 4
    for j in range(0, whole, 4):
        p += a[j] * x[j]
        q += a[j + 1] * x[j + 1]
        r += a[j + 2] * x[j + 2]
        s += a[j + 3] * x[j + 3]
    for j in range(whole, n):
        p += a[j] * x[j]
    return (p + q) + (r + s)


@native
def negative_pivots(
    A: Reals, o: int, s: int, work: Reals, found: Reals, at: int, late: float
) -> int:
    """Negative pivots of a block eliminated along its diagonal; the pivots go to ``found``.

    Their number is the signature when the matrix is symmetric (Sylvester) and changes when it
    becomes singular.  A pivot of zero eliminates nothing, nor does one that is round-off of its row
    (the inertia of a rod about its own axis, turned): what it would leave of the others is noise.
    With ``late`` above zero it waits for those after it (the point without mass of a PTCV), and so
    does one below this share of what it was before (the second of two rows that hold the same).
    """
    n = coupled(A, o, s)
    for i in range(n * s):
        work[i] = A[o + i]
    for k in range(s):
        found[at + k] = abs(A[o + k * s + k])
    count, waiting = 0, 0
    for k in range(n):
        pivot, rest = work[k * s + k], n - k - 1
        top = NOISE * largest_of(work[k * s + k + 1 :], rest)
        if abs(pivot) <= max(top, late * found[at + k]):
            pivot = 0.0
            waiting += 1
        found[at + k] = pivot
        if pivot < 0.0:
            count += 1
        for i in range(k + 1, n if pivot != 0.0 else 0):
            factor = work[i * s + k] / pivot
            if factor != 0.0:
                subtract_row(factor, work[k * s + k + 1 :], rest, work[i * s + k + 1 :])
                found[at + i] = max(found[at + i], abs(work[i * s + i]))
        if late > 0.0 and waiting > 0 and pivot != 0.0:
            out_of_waiting(work, s, n, k, found, at)
    if late > 0.0 and waiting > 0:
        count += late_negatives(A, o, s, n, work, found, at, late)
    return count


@native
def out_of_waiting(work: Reals, s: int, n: int, k: int, found: Reals, at: int) -> None:
    """Take pivot k out of the rows and columns before it that wait."""
    pivot = work[k * s + k]
    for w in range(k):
        if found[at + w] == 0.0:
            factor, across = work[w * s + k] / pivot, work[k * s + w]
            for i in range(k + 1, n):
                work[i * s + w] -= work[i * s + k] / pivot * across
                work[w * s + i] -= factor * work[k * s + i]
            for v in range(k):
                if found[at + v] == 0.0:
                    work[w * s + v] -= factor * work[k * s + v]


@native
def late_negatives(
    A: Reals, o: int, s: int, n: int, work: Reals, found: Reals, at: int, late: float
) -> int:
    """Negative ones among the pivots that have waited, where others have made them any."""
    count = 0
    for k in range(n):
        pivot = work[k * s + k]
        if found[at + k] == 0.0 and abs(pivot) > late * largest_of(A[o + k * s :], n):
            found[at + k] = pivot
            count += 1 if pivot < 0.0 else 0
            for i in range(n):
                factor = work[i * s + k] / pivot
                for j in range(n if found[at + i] == 0.0 else 0):
                    if found[at + j] == 0.0:
                        work[i * s + j] -= factor * work[k * s + j]
    return count
