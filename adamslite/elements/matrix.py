"""MATRIX: a table of numbers.

Equation (VALUES v, counted from 0; rows and columns of the matrix from 1)::

    RORDER   A[r][c] = v[r COLUMNS + c]        CORDER   A[r][c] = v[c ROWS + r]

    SPARSE   VALUES = row, column, number, row, column, number, ...      all others are 0
    FILE     the lines of a table .csv; a first line of names is left out
"""

from __future__ import annotations

from pathlib import Path

from adamslite.elements.bases import data_file
from adamslite.language.statement import Statement, choice, flag, integer, statement, text, vector

TRIPLE = 3
#: Elements of a SPARSE matrix, zeros included: as many as VALUES can give.
MOST = 10**6


@statement("MATRIX", planned=("NAME",), data=True)
class Matrix(Statement):
    """Numbers that other statements use: LSE, NFORCE, CURVE."""

    alternatives = ((("full",), ("sparse",)), (("values",), ("file",)))

    full: str = choice(
        "FULL", options=("RORDER", "CORDER"), default="RORDER", help="order of VALUES"
    )
    sparse: bool = flag("SPARSE", help="VALUES has only some of the elements, with their places")
    rows: int = integer("ROWS", default=0, help="number of rows; may be left out with FILE")
    columns: int = integer("COLUMNS", default=0, help="number of columns, the same")
    values: tuple[float, ...] = vector(
        "VALUES", size=1, most=MOST, default=(), unit="the user's", help="the elements"
    )
    file: str | None = text("FILE", help="a table .csv in the folder of the deck or below")

    def loaded(self, folder: Path) -> Matrix:
        """With the elements of its file, where there is one that can be read."""
        if self.file is None or self.given("values"):
            return self
        try:
            columns = data_file.columns(folder, self.file)
        except data_file.UnusableFile:
            return self
        read = {
            "full": "CORDER",
            "rows": self.rows if self.given("rows") else len(columns[0]),
            "columns": self.columns if self.given("columns") else len(columns),
            "values": tuple(value for column in columns for value in column),
        }
        given = {name: each for name, each in vars(self).items() if name in self.field_names}
        return Matrix(**{**given, **read})

    @property
    def too_large(self) -> bool:
        """Whether a SPARSE matrix has more elements than are worked with."""
        return self.sparse and self.rows > 0 < self.columns and self.rows * self.columns > MOST

    @property
    def misplaced(self) -> str:
        """The first place of a SPARSE matrix that it does not have; empty when there is none."""
        places = self._places if self.sparse else []
        wrong = (
            (r, c)
            for r, c, _ in places
            if r % 1 or c % 1 or not (1 <= r <= self.rows and 1 <= c <= self.columns)
        )
        return next((f"{r:g}, {c:g}" for r, c in wrong), "")

    @property
    def _places(self) -> list[tuple[float, ...]]:
        return [self.values[k : k + TRIPLE] for k in range(0, len(self.values), TRIPLE)]

    @property
    def expected(self) -> int:
        """How many VALUES there should be; of a SPARSE matrix the next number of triples."""
        if self.sparse:
            return TRIPLE * -(-len(self.values) // TRIPLE)
        return self.rows * self.columns

    @property
    def complete(self) -> bool:
        """Whether there is a number for every element."""
        sizes = self.rows > 0 < self.columns and not self.too_large
        return sizes and 0 < len(self.values) == self.expected and not self.misplaced

    @property
    def table(self) -> list[tuple[float, ...]]:
        """The rows."""
        if self.sparse:
            found = [[0.0] * self.columns for _ in range(self.rows)]
            for r, c, value in self._places:
                found[int(r) - 1][int(c) - 1] = value
            return [tuple(row) for row in found]
        if self.full == "CORDER":
            return [self.values[r :: self.rows] for r in range(self.rows)]
        n = self.columns
        return [self.values[n * r : n * r + n] for r in range(self.rows)]
