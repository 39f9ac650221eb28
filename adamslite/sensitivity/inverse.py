"""The inverse of a small matrix that many systems are solved with.

Substitution with LU factors waits in each row for the row before; the rows of A^-1 b wait for
nothing.  With 30 unknowns the inverse, three times the effort of the factors, is worth it from some
five solutions on.  What is solved so has an error of cond(A) round-off, as by the factors, but a
residual that may be larger: it serves where iterations see to that.

References: Golub, Van Loan, Matrix Computations, 2013, section 3.4.9 (Gauss-Jordan); Higham,
Accuracy and Stability of Numerical Algorithms, 2002, section 14.1.
"""

from __future__ import annotations

from adamslite.integrators.linalg.dense import product, subtract_row, swap_rows
from adamslite.integrators.linalg.plan import TINY, Plan
from adamslite.native.translate import Ints, Reals, native

# From this many unknowns on factors are cheaper.
SMALL = 32


@native
def is_small(L: Plan) -> bool:
    """Whether the matrix is dense and small."""
    return L.fronts.size == 0 and L.size.size == 1 and L.size[0] <= SMALL


@native
def invert_small(L: Plan, A: Reals, pivots: Ints) -> bool:
    """Replace the matrix by the inverse of P A, whose exchanges of rows go to ``pivots``; False
    when it is singular.
    """
    s = L.size[0]
    for k in range(s):
        best, p = 0.0, k
        for i in range(k, s):
            size = abs(A[i * s + k])
            if size > best:
                best, p = size, i
        if not best > TINY:
            return False
        pivots[k] = p
        if p != k:
            swap_rows(s, A[k * s :], A[p * s :])
        w = 1.0 / A[k * s + k]
        A[k * s + k] = 1.0
        for j in range(s):
            A[k * s + j] *= w
        for i in range(s):
            f = A[i * s + k]
            if i != k and f != 0.0:
                A[i * s + k] = 0.0
                subtract_row(f, A[k * s :], s, A[i * s :])
    return True


@native
def times_small_inverse(L: Plan, A: Reals, pivots: Ints, b: Reals, x: Reals, y: Reals) -> None:
    """Replace ``b``, in the order of the unknowns, by the solution; ``x``, ``y``: workspace."""
    s = L.size[0]
    y[s] = 0.0  # what is left out is there
    for i in range(L.place.size):
        x[L.place[i]] = b[i]
    for k in range(s):
        p = pivots[k]
        x[k], x[p] = x[p], x[k]
    for i in range(s):
        y[i] = product(s, A[i * s :], x)
    for i in range(L.place.size):
        b[i] = y[L.place[i]]
