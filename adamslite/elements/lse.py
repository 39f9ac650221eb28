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
    from adamslite.elements.matrix import Matrix
    from adamslite.language.interfaces import Key, Lookup


#: Elements that take as long to look at as a state takes to make.
LOOKED_AT = 100


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

    def bringing(self, deck: Lookup) -> int:
        """States and outputs, and of elements that are looked at some for each."""
        found = self._complete(deck) or {}
        sizes = ((each.rows, each.columns) for each in found.values())
        return sum(rows + rows * columns // LOOKED_AT for rows, columns in sizes)

    def counts(self, deck: Lookup) -> dict[str, int] | None:
        """Rows of A or B, and of C or D, without making them."""
        found = self._complete(deck)
        if found is None:
            return None
        rows = {field: each.rows for field, each in found.items()}
        return {
            "x": max(rows.get("a", 0), rows.get("b", 0)),
            "y": max(rows.get("c", 0), rows.get("d", 0)),
        }

    def _complete(self, deck: Lookup) -> dict[str, Matrix] | None:
        """The matrices; None where one of them has mistakes of its own."""
        found = {field: deck.find("MATRIX", key) for field, key in self.named.items()}
        if any(each is None or not each.complete for each in found.values()):
            return None
        return found

    def matrices(self, deck: Lookup) -> Matrices | None:
        """The rows of A to D; None where one of them has mistakes of its own."""
        found = self._complete(deck)
        if found is None:
            return None
        return Matrices(*(found[field].table if field in found else () for field in "abcd"))
