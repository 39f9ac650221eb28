"""Linear systems: rows of matrices as expressions.

Equation (u the VARIABLEs of an ARRAY U, x of an ARRAY X, y of an ARRAY Y)::

    dx_i/dt = sum_j A_ij x_j + sum_j B_ij u_j,     y_k = sum_j C_kj x_j + sum_j D_kj u_j

Zeros of the matrices are left out of the sums.
"""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING, NamedTuple

from adamslite.elements.bases.system_element import SystemElement, Values
from adamslite.language.expression import Num, Op

if TYPE_CHECKING:
    from adamslite.language.expression import Node
    from adamslite.language.interfaces import Key, Lookup

Table = Sequence[Sequence[float]]


class Matrices(NamedTuple):
    """Rows of A (n, n), B (n, m), C (p, n) and D (p, m); an empty one is zero."""

    a: Table
    b: Table
    c: Table
    d: Table


class LinearSystem(SystemElement):
    """What LSE and TFSISO share."""

    x: Key
    u: Key | None

    @abstractmethod
    def matrices(self, deck: Lookup) -> Matrices | None:
        """The matrices of the system; None where one of them cannot be read."""

    def counts(self, deck: Lookup) -> dict[str, int] | None:
        """Rows of A or B, and of C or D."""
        found = self.matrices(deck)
        if found is None:
            return None
        return {"x": max(len(found.a), len(found.b)), "y": max(len(found.c), len(found.d))}

    def equations(self, deck: Lookup) -> Iterator[tuple[str, Iterator[Node]]]:
        """The rows of A x + B u and C x + D u."""
        found = self.matrices(deck)
        if found is not None:
            yield "x", self._sums(deck, found.a, found.b)
            yield "y", self._sums(deck, found.c, found.d)

    def _sums(self, deck: Lookup, of_x: Table, of_u: Table) -> Iterator[Node]:
        """P x + Q u, row by row.

        The term on the diagonal comes first, so that rows differ in numbers alone: they share one
        kernel.
        """
        inputs = deck.find("ARRAY", self.u) if self.u is not None else None
        u = inputs.numbered() if inputs is not None and inputs.kind == "U" else ()
        x = Values("X", self.x, None)
        for row in range(max(len(of_x), len(of_u))):
            own_first = sorted(_terms(of_x, row, x), key=lambda term: term[0] != row)
            yield total([term for _, term in (*own_first, *_terms(of_u, row, u))])


def _terms(table: Table, row: int, values: Sequence[Node]) -> Iterator[tuple[int, Node]]:
    """Number of the column and product of each element that is not zero."""
    factors = table[row] if row < len(table) else ()
    for n, (factor, value) in enumerate(zip(factors, values, strict=False)):
        if factor:
            yield n, Op("*", (Num(factor), value))


def total(terms: Sequence[Node]) -> Node:
    """The sum, as a balanced tree: its depth grows with the logarithm of the number of terms."""
    if len(terms) < 2:
        return terms[0] if terms else Num(0.0)
    half = len(terms) // 2
    return Op("+", (total(terms[:half]), total(terms[half:])))
