"""MATRIX: a table of numbers.

Equation (VALUES v, counted from 0)::

    RORDER   A[r][c] = v[r COLUMNS + c]        CORDER   A[r][c] = v[c ROWS + r]
"""

from __future__ import annotations

from adamslite.language.statement import Statement, choice, integer, statement, vector


@statement("MATRIX", planned=("SPARSE", "FILE", "NAME"), data=True)
class Matrix(Statement):
    """Numbers that other statements use, such as the points of a curve."""

    full: str = choice(
        "FULL", options=("RORDER", "CORDER"), default="RORDER", help="order of VALUES"
    )
    rows: int = integer("ROWS", required=True, help="number of rows")
    columns: int = integer("COLUMNS", required=True, help="number of columns")
    values: tuple[float, ...] = vector(
        "VALUES", size=1, most=10**6, required=True, unit="the user's", help="all elements"
    )

    @property
    def complete(self) -> bool:
        """Whether there are as many values as elements."""
        return len(self.values) == self.rows * self.columns

    @property
    def table(self) -> list[tuple[float, ...]]:
        """The rows."""
        if self.full == "CORDER":
            return [self.values[r :: self.rows] for r in range(self.rows)]
        n = self.columns
        return [self.values[n * r : n * r + n] for r in range(self.rows)]
