"""TFSISO: a transfer function from one input to one output.

Equation (u the VARIABLE of ARRAY U, y the value of ARRAY Y, p = d/dt; coefficients by ascending
powers)::

    (a0 + a1 p + ... + an p^n) y = (b0 + b1 p + ... + bm p^m) u,    m <= n

    x1 = y - q0 u,     xi+1 = dxi/dt - qi u,     dxn/dt = -(a0 x1 + ... + an-1 xn)/an + qn u

with q0 + q1/p + q2/p^2 + ... the quotient of the polynomials.  States are therefore of the size of
y and its rates; where n > m + i, xi+1 is the i-th rate of y.

    statics:  a0 y = b0 u,  or x as it is with STATIC_HOLD

Source: K. Ogata, Modern Control Engineering, section 2.4 (state-space representation of equations
whose input is differentiated).  Which states ADAMS takes is not published; y is the same for all.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from adamslite.elements.bases.linear_system import LinearSystem, Matrices
from adamslite.elements.bases.system_element import (
    input_array,
    output_array,
    start_array,
    state_array,
    static_hold,
)
from adamslite.language.statement import statement, vector

if TYPE_CHECKING:
    from adamslite.language.interfaces import Lookup

MOST_COEFFICIENTS = 30


@statement("TFSISO")
class Tfsiso(LinearSystem):
    """A filter or controller by the polynomials of its transfer function.

    Expressions take the output by ``ARYVAL(id, 1)`` of ARRAY Y.  Results have states and output as
    DIFF/ARRAY_id_n and VARIABLE/ARRAY_id_1.
    """

    x: int | str = state_array(required=True)
    u: int | str = input_array(required=True)
    y: int | str = output_array(required=True)
    ic: int | str | None = start_array()
    numerator: tuple[float, ...] = vector(
        "NUMERATOR", size=1, most=MOST_COEFFICIENTS, required=True, unit="the user's",
        help="b0, b1, ..., bm",
    )  # fmt: skip
    denominator: tuple[float, ...] = vector(
        "DENOMINATOR", size=1, most=MOST_COEFFICIENTS, required=True, unit="the user's",
        help="a0, a1, ..., an; an is not zero",
    )  # fmt: skip
    static_hold: bool = static_hold()

    def matrices(self, deck: Lookup) -> Matrices | None:
        """The state equations above."""
        if not (self.numerator and self.denominator):
            return None  # of a statement with mistakes
        *a, highest = self.denominator
        n = len(a)
        if n == 0 or highest == 0.0 or degree(self.numerator) > n:
            return None  # a rule reports it
        a = [each / highest for each in a]
        q = quotient(self.numerator, self.denominator)
        shift = [[float(j == i + 1) for j in range(n)] for i in range(n - 1)]
        last = [-each for each in a]
        first = [float(j == 0) for j in range(n)]
        return Matrices([*shift, last], [[each] for each in q[1:]], [first], [[q[0]]])


def degree(polynomial: tuple[float, ...]) -> int:
    """The highest power with a coefficient; that of zero is 0."""
    return max((n for n, each in enumerate(polynomial) if each), default=0)


def quotient(numerator: tuple[float, ...], denominator: tuple[float, ...]) -> list[float]:
    """q0 ... qn of the quotient of two polynomials by falling powers; the first is not longer."""
    *a, highest = denominator
    n = len(a)
    b = [*numerator, *[0.0] * n]
    q: list[float] = []
    for i in range(n + 1):
        q.append((b[n - i] - sum(a[n - k] * q[i - k] for k in range(1, i + 1))) / highest)
    return q
