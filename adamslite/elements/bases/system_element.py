"""States and outputs of system elements, which ARRAYs hold, as DIFFs and VARIABLEs.

Names (A the id of the ARRAY, n from 1)::

    DIFF/ARRAY_A_n    ARYVAL(A, n) of an ARRAY X      VARIABLE/ARRAY_A_n    of an ARRAY Y
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Iterator, Mapping, Sequence
from typing import TYPE_CHECKING, ClassVar, overload

from adamslite.language.expression import Call, Node, Ref
from adamslite.language.statement import STATEMENTS, Statement, flag, reference

if TYPE_CHECKING:
    from adamslite.language.interfaces import Key, Lookup
    from adamslite.language.statement import Field

MOST = 10**6
KINDS = {"X": ("DIFF", "DIF"), "Y": ("VARIABLE", "VARVAL")}


class Values(Sequence[Node]):
    """The values of an ARRAY X or Y, at most SIZE; its system decides how many there are."""

    def __init__(self, kind: str, array: Key, size: int | None) -> None:
        self.kind, self.array = kind, array
        self.most = MOST if size is None else min(max(size, 0), MOST)

    def __len__(self) -> int:
        return self.most

    @overload
    def __getitem__(self, number: int) -> Node: ...
    @overload
    def __getitem__(self, number: slice) -> Sequence[Node]: ...
    def __getitem__(self, number: int | slice) -> Node | Sequence[Node]:
        if isinstance(number, slice):
            return [self[n] for n in range(*number.indices(self.most))]
        keyword, function = KINDS[self.kind]
        return Call(function, (Ref(keyword, value_name(self.array, number + 1)),))


def value_name(array: Key, number: int) -> str:
    """Name of the statement that is a value, counted from 1, of an ARRAY X or Y."""
    return f"ARRAY_{array}_{number}".upper()


def state_array(required: bool = False) -> Field:
    """Where the states are."""
    return reference("X", to="ARRAY", required=required, help="ARRAY X of the states")


def input_array(required: bool = False) -> Field:
    """Where the inputs are."""
    return reference("U", to="ARRAY", required=required, help="ARRAY U of the inputs")


def output_array(required: bool = False) -> Field:
    """Where the outputs are."""
    return reference("Y", to="ARRAY", required=required, help="ARRAY Y of the outputs")


def start_array() -> Field:
    """Where the system starts."""
    what = "ARRAY IC of x at the start; 0 where it is left out"
    return reference("IC", to="ARRAY", start=True, help=what)


def static_hold() -> Field:
    """What statics do with the states."""
    return flag("STATIC_HOLD", help="statics keep x; without it they find the x where dx/dt = 0")


class SystemElement(Statement, ABC):
    """What LSE, TFSISO and GSE share.

    ``kinds``: of the ARRAYs that its fields name.  ``starts``: the field with the start values of
    the states in another field.
    """

    kinds: ClassVar[Mapping[str, str]] = {"x": "X", "u": "U", "y": "Y", "ic": "IC"}
    starts: ClassVar[Mapping[str, str]] = {"x": "ic"}

    static_hold: bool

    @abstractmethod
    def counts(self, deck: Lookup) -> dict[str, int] | None:
        """How many states and outputs there are, by field; None where mistakes leave it open."""

    @abstractmethod
    def equations(self, deck: Lookup) -> Iterator[tuple[str, Iterator[Node]]]:
        """Rates of the states, values of the outputs, by field.

        Sizes that do not fit are reported by rules; here what fits is taken.
        """

    def holds(self, field: str) -> bool:
        """Whether statics keep the states of a field."""
        return self.static_hold

    def companions(self, deck: Lookup) -> tuple[Statement, ...]:
        """The states and the outputs."""
        if self.counts(deck) is None:
            return ()
        return tuple(self._values(deck))

    def _values(self, deck: Lookup) -> Iterator[Statement]:
        for field, nodes in self.equations(deck):
            array = getattr(self, field)
            if array is None:
                continue
            starts = self._starts(deck, field)
            for n, node in enumerate(nodes, 1):
                id = value_name(array, n)
                if self.kinds[field] == "Y":
                    yield STATEMENTS["VARIABLE"](id=id, function=node, spans=self.spans)
                else:
                    yield STATEMENTS["DIFF"](
                        id=id, ic=starts[n - 1 : n] or (0.0,), function=node,
                        static_hold=self.holds(field), spans=self.spans,
                    )  # fmt: skip

    def _starts(self, deck: Lookup, field: str) -> tuple[float, ...]:
        key = getattr(self, self.starts[field]) if field in self.starts else None
        found = deck.find("ARRAY", key) if key is not None else None
        return () if found is None else found.numbers
