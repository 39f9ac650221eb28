"""NFORCE: linear forces and torques on several markers, each by the displacements of all.

Equation, components along the axes of J (d_k = r_k - r_J of marker I_k, k = 1 ... n)::

    x_k = (d_k, AX(I_k,J), AY(I_k,J), AZ(I_k,J)),    v_k: velocity, angular velocity of I_k from J

    (force, torque on I_k)_k = FORCE - K (x - LENGTH) - C v       x, v, FORCE, LENGTH: 6 n values
    on J                     = - sum force_k,   - sum (torque_k + d_k x force_k)

K and C are MATRIXes of 6n rows and columns, FORCE and LENGTH of 6n rows and one column.  C = CRATIO
K when CRATIO is given.  Sign: a positive diagonal of K pulls I back to LENGTH.
Source: Adams/Solver statement NFORCE.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING

from adamslite.elements.bases.wrench import SIX, Row
from adamslite.language.statement import STATEMENTS, Statement, number, reference, references
from adamslite.language.statement import statement as register

if TYPE_CHECKING:
    from adamslite.language.interfaces import Key, Lookup

WIDTH = len(SIX)
Block = tuple[Row, ...]


def _matrix(key: str, help: str) -> Key | None:
    return reference(key, to="MATRIX", help=help)


@register("NFORCE")
class Nforce(Statement):
    """A structure between markers, by its stiffness.

    It is made of FIELDs, ``FIELD/NFORCE_id_i_k``: the load on marker i by the displacement of
    marker k, the preload where i is k.  NFORCE(id, marker, comp, rm) measures all of it.
    """

    imarkers: tuple[int | str, ...] = references(
        "IMARKERS", to="MARKER", required=True, help="markers the forces act on"
    )
    j: int | str = reference(
        "J", to="MARKER", required=True, help="reference marker, which takes the reaction"
    )
    kmatrix: int | str | None = _matrix("KMATRIX", "stiffness, 6n by 6n")
    cmatrix: int | str | None = _matrix("CMATRIX", "damping, 6n by 6n")
    cratio: float | None = number("CRATIO", unit="time", help="damping over stiffness")
    length: int | str | None = _matrix("LENGTH", "displacements with the load FORCE, 6n by 1")
    force: int | str | None = _matrix("FORCE", "load at LENGTH, 6n by 1")

    def table(self, deck: Lookup, field: str) -> list[tuple[float, ...]]:
        """The rows of a matrix; zeros where it is not given, or not of this size."""
        n = WIDTH * len(self.imarkers)
        columns = 1 if field in ("length", "force") else n
        key = getattr(self, field)
        matrix = None if key is None else deck.find("MATRIX", key)
        if matrix is None or not matrix.complete or (matrix.rows, matrix.columns) != (n, columns):
            return [(0.0,) * columns] * n
        return matrix.table

    def companions(self, deck: Lookup) -> tuple[Statement, ...]:
        """A FIELD for each pair of markers between which something acts."""
        stiffness, damping = self.table(deck, "kmatrix"), self.table(deck, "cmatrix")
        if self.cratio is not None:
            damping = [tuple(self.cratio * value for value in row) for row in stiffness]
        rest = [value for (value,) in self.table(deck, "length")]
        loads = [
            force + sum(k * x for k, x in zip(row, rest, strict=True))
            for (force,), row in zip(self.table(deck, "force"), stiffness, strict=True)
        ]
        return tuple(self._fields(stiffness, damping, loads))

    def _fields(
        self, stiffness: Sequence[Row], damping: Sequence[Row], loads: Sequence[float]
    ) -> Iterator[Statement]:
        for n, i in enumerate(self.imarkers):
            for m, by in enumerate(self.imarkers):
                k, c = _block(stiffness, n, m), _block(damping, n, m)
                force = tuple(loads[WIDTH * n : WIDTH * n + WIDTH]) if n == m else (0.0,) * WIDTH
                if any(map(any, (*k, *c, force))):
                    yield STATEMENTS["FIELD"](
                        id=f"{self.keyword}_{self.key}_{i}_{by}", i=i, j=self.j,
                        by=None if n == m else by, kmatrix=_columns(k), cmatrix=_columns(c),
                        force=force, spans=self.spans,
                    )  # fmt: skip


def _block(rows: Sequence[Row], n: int, m: int) -> Block:
    """Six rows and six columns of a matrix."""
    return tuple(row[WIDTH * m : WIDTH * m + WIDTH] for row in rows[WIDTH * n : WIDTH * n + WIDTH])


def _columns(block: Block) -> Row:
    return tuple(block[r][c] for c in SIX for r in SIX)
