"""Products of dense matrices whose rows need not follow each other without a gap.

Four rows take four products each in one pass over a strip: 16 multiplications for 12 numbers that
are loaded or stored, and the strip of B stays in the first levels of the cache.  Reference: Goto,
van de Geijn, ACM Trans. Math. Softw. 34 (2008) 12.
"""

from __future__ import annotations

from adamslite.integrators.linalg.dense import subtract_row, subtract_rows
from adamslite.native.translate import Alone, Reals, native

# Columns and rows of B that are taken at a time.
STRIP, DEPTH = 128, 48


@native
def subtract_product(
    A: Reals, la: int, B: Reals, lb: int, C: Reals, lc: int, m: int, k: int, n: int
) -> None:
    """C -= A B of the sizes (m, k) and (k, n), with rows that begin every la, lb and lc numbers."""
    for j in range(0, n, STRIP):
        width = min(STRIP, n - j)
        for p in range(0, k, DEPTH):
            depth = min(DEPTH, k - p)
            subtract_strip(A[p:], la, B[p * lb + j :], lb, C[j:], lc, m, depth, width)


@native
def subtract_strip(
    A: Reals, la: int, B: Reals, lb: int, C: Reals, lc: int, m: int, k: int, n: int
) -> None:
    """The same for a strip of B."""
    whole_m, whole_k = m - m % 4, k - k % 4
    for i in range(0, whole_m, 4):
        c = C[i * lc :]
        for p in range(0, whole_k, 4):
            subtract_tile(
                A[i * la + p :], la, B[p * lb :], lb, c, c[lc:], c[2 * lc :], c[3 * lc :], n
            )
        for r in range(i, i + 4):
            for p in range(whole_k, k):
                subtract_row(A[r * la + p], B[p * lb :], n, C[r * lc :])
    for i in range(whole_m, m):
        for p in range(0, whole_k, 4):
            a, b = A[i * la + p :], B[p * lb :]
            subtract_rows(
                a[0], a[1], a[2], a[3], b, b[lb:], b[2 * lb :], b[3 * lb :], n, C[i * lc :]
            )
        for p in range(whole_k, k):
            subtract_row(A[i * la + p], B[p * lb :], n, C[i * lc :])


@native
def subtract_tile(
    A: Reals, la: int, B: Reals, lb: int, x: Alone, y: Alone, z: Alone, w: Alone, n: int
) -> None:
    """Rows x, y, z, w of C less the product of four rows of A with four of B."""
    a, b, c, d = A[0], A[1], A[2], A[3]
    e, f, g, h = A[la], A[la + 1], A[la + 2], A[la + 3]
    i, k, o, p = A[2 * la], A[2 * la + 1], A[2 * la + 2], A[2 * la + 3]
    q, r, s, t = A[3 * la], A[3 * la + 1], A[3 * la + 2], A[3 * la + 3]
    second, third, fourth = B[lb:], B[2 * lb :], B[3 * lb :]
    for j in range(n):
        b1, b2, b3, b4 = B[j], second[j], third[j], fourth[j]
        x[j] -= (a * b1 + b * b2) + (c * b3 + d * b4)
        y[j] -= (e * b1 + f * b2) + (g * b3 + h * b4)
        z[j] -= (i * b1 + k * b2) + (o * b3 + p * b4)
        w[j] -= (q * b1 + r * b2) + (s * b3 + t * b4)
