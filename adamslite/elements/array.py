"""ARRAY: a list of numbers or of VARIABLEs.

Equation (a_n = ARYVAL(id, n), n from 1)::

    IC   a_n = NUMBERS_n                U   a_n = value of the VARIABLE VARIABLES_n
    X    a_n = state n                  Y   a_n = output n      of the LSE or TFSISO that names it
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from adamslite.elements.bases.system_element import Values
from adamslite.language.expression import Call, Num, Ref
from adamslite.language.statement import (
    Statement,
    choice,
    integer,
    references,
    statement,
    vector,
)

if TYPE_CHECKING:
    from adamslite.language.expression import Node


@statement("ARRAY", planned=("ROUTINE",), data=True)
class Array(Statement):
    """Values that expressions take by number: ``ARYVAL(id, n)``."""

    kind: str = choice(
        options=("IC", "X", "Y", "U"), default="IC",
        help="constants, states, outputs, or VARIABLEs as inputs",
    )  # fmt: skip
    size: int | None = integer("SIZE", help="how many values there are")
    numbers: tuple[float, ...] = vector(
        "NUMBERS", size=1, most=10**6, default=(), unit="the user's", help="the constants of IC"
    )
    variables: tuple[int | str, ...] = references(
        "VARIABLES", to="VARIABLE", help="the VARIABLEs of U"
    )

    def constants(self) -> dict[str, float]:
        """The constants, as calls of ARYVAL."""
        return {f"ARYVAL({self.key},{n})": value for n, value in enumerate(self.numbers, 1)}

    def numbered(self) -> Sequence[Node]:
        """The values."""
        if self.kind in ("X", "Y"):
            return Values(self.kind, self.key, self.size)
        if self.kind == "U":
            return tuple(Call("VARVAL", (Ref("VARIABLE", key),)) for key in self.variables)
        return tuple(Num(value, name) for name, value in self.constants().items())
