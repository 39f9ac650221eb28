"""LSE: linear state equations.

Equation (x the values of ARRAY X, u of ARRAY U, y of ARRAY Y)::

    dx/dt = A x + B u,     y = C x + D u         A (n, n)  B (n, m)  C (p, n)  D (p, m)

    statics:  A x + B u = 0,  or x as it is with STATIC_HOLD
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
from adamslite.language.statement import reference, statement

if TYPE_CHECKING:
    from adamslite.language.interfaces import Key, Lookup


@statement("LSE")
class Lse(LinearSystem):
    """A controller, filter or reduced structure by its matrices.

    Expressions take states and outputs by ``ARYVAL(id, n)`` of their ARRAY.  Results have them as
    DIFF/ARRAY_id_n and VARIABLE/ARRAY_id_n.
    """

    x: int | str = state_array(required=True)
    u: int | str | None = input_array()
    y: int | str | None = output_array()
    ic: int | str | None = start_array()
    a: int | str = reference("A", to="MATRIX", required=True, help="MATRIX of the states")
    b: int | str | None = reference("B", to="MATRIX", help="MATRIX from inputs to rates; needs U")
    c: int | str | None = reference("C", to="MATRIX", help="MATRIX from states to Y; needs Y")
    d: int | str | None = reference("D", to="MATRIX", help="MATRIX from U to Y; needs both")
    static_hold: bool = static_hold()

    @property
    def named(self) -> dict[str, Key]:
        """Ids of the matrices that are given, by field."""
        return {field: key for field in "abcd" if (key := getattr(self, field)) is not None}

    def matrices(self, deck: Lookup) -> Matrices | None:
        """The rows of A to D; None where one of them has mistakes of its own."""
        found = {field: deck.find("MATRIX", key) for field, key in self.named.items()}
        if any(each is None or not each.complete for each in found.values()):
            return None
        return Matrices(*(found[field].table if field in found else () for field in "abcd"))
