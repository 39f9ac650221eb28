"""ARRAY: a list of numbers or of VARIABLEs.

Equation (a_n = ARYVAL(id, n), n from 1)::

    IC   a_n = NUMBERS_n                U   a_n = value of the VARIABLE VARIABLES_n

X and Y name the states and the outputs of a system element; without one they have no values.
"""

from __future__ import annotations

from adamslite.language.expression import Call, Node, Num, Ref
from adamslite.language.statement import (
    Statement,
    choice,
    integer,
    references,
    statement,
    vector,
)


@statement("ARRAY", planned=("ROUTINE",), data=True)
class Array(Statement):
    """Constants or VARIABLEs that expressions take by number: ``ARYVAL(id, n)``."""

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

    def numbered(self) -> tuple[Node, ...]:
        """The values."""
        if self.kind == "U":
            return tuple(Call("VARVAL", (Ref("VARIABLE", key),)) for key in self.variables)
        return tuple(Num(value, name) for name, value in self.constants().items())
