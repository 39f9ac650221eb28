"""ARRAY: a list of numbers or of VARIABLEs.

Equation (a_n = ARYVAL(id, n), n from 1)::

    IC   a_n = NUMBERS_n                U   a_n = value of the VARIABLE VARIABLES_n
    X    a_n = state n                  Y   a_n = output n      of the LSE or TFSISO that names it
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, overload

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
    from adamslite.language.interfaces import Key


def constant_name(array: Key, number: int) -> str:
    """What a constant, counted from 1, of an ARRAY IC is called."""
    return f"ARYVAL({array},{number})"


class Constants(Sequence["Node"]):
    """The values of an ARRAY IC as nodes, made when they are asked for: there may be a million."""

    def __init__(self, array: Key, numbers: tuple[float, ...]) -> None:
        self.array, self.numbers = array, numbers

    def __len__(self) -> int:
        return len(self.numbers)

    @overload
    def __getitem__(self, number: int) -> Node: ...
    @overload
    def __getitem__(self, number: slice) -> Sequence[Node]: ...
    def __getitem__(self, number: int | slice) -> Node | Sequence[Node]:
        if isinstance(number, slice):
            return [self[n] for n in range(*number.indices(len(self)))]
        n = range(len(self))[number]
        return Num(self.numbers[n], constant_name(self.array, n + 1))

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Constants):
            return NotImplemented
        return self.array == other.array and self.numbers == other.numbers


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
        key = self.key
        return {constant_name(key, n): value for n, value in enumerate(self.numbers, 1)}

    def numbered(self) -> Sequence[Node]:
        """The values."""
        if self.kind in ("X", "Y"):
            return Values(self.kind, self.key, self.size)
        if self.kind == "U":
            return tuple(Call("VARVAL", (Ref("VARIABLE", key),)) for key in self.variables)
        return Constants(self.key, self.numbers)
