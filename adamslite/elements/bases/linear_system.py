"""The states and outputs of a linear system as DIFFs and VARIABLEs.

Equation (u the VARIABLEs of an ARRAY U, x_i the DIFF ``ARRAY_X_i`` where X is the id of the ARRAY
X, y_k the VARIABLE ``ARRAY_Y_k``)::

    dx_i/dt = sum_j A_ij x_j + sum_j B_ij u_j,     y_k = sum_j C_kj x_j + sum_j D_kj u_j

Zeros of the matrices are left out of the sums.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import NamedTuple, overload

from adamslite.language.expression import Call, Node, Num, Op, Ref
from adamslite.language.interfaces import Key, Lookup
from adamslite.language.statement import STATEMENTS, Field, Statement, flag, reference

Table = Sequence[Sequence[float]]
MOST = 10**6
KINDS = {"X": ("DIFF", "DIF"), "Y": ("VARIABLE", "VARVAL")}


class Matrices(NamedTuple):
    """Rows of A (n, n), B (n, m), C (p, n) and D (p, m); an empty one is zero."""

    a: Table
    b: Table
    c: Table
    d: Table


class Values(Sequence[Node]):
    """The values of an ARRAY X or Y, at most SIZE; its system decides how many there are."""

    def __init__(self, kind: str, array: Key, size: int | None) -> None:
        self.kind, self.array = kind, array
        self.most = MOST if size is None else size

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


def state_array(required: bool = True) -> Field:
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


class LinearSystem(Statement):
    """What LSE and TFSISO share."""

    x: Key
    u: Key | None
    y: Key | None
    ic: Key | None
    static_hold: bool

    def matrices(self, deck: Lookup) -> Matrices | None:
        """The matrices of the system; None where one of them cannot be read."""
        raise NotImplementedError

    def companions(self, deck: Lookup) -> tuple[Statement, ...]:
        """The states and the outputs.

        Sizes that do not fit are reported by rules; here what fits is taken.
        """
        found = self.matrices(deck)
        if found is None:
            return ()
        return (*self._states(deck, found), *self._outputs(deck, found))

    def _states(self, deck: Lookup, system: Matrices) -> Iterator[Statement]:
        ic = deck.find("ARRAY", self.ic) if self.ic is not None else None
        starts = ic.numbers if ic is not None else ()
        for n, rate in enumerate(self._sums(deck, system.a, system.b), 1):
            yield STATEMENTS["DIFF"](
                id=value_name(self.x, n), ic=starts[n - 1 : n] or (0.0,), function=rate,
                static_hold=self.static_hold, spans=self.spans,
            )  # fmt: skip

    def _outputs(self, deck: Lookup, system: Matrices) -> Iterator[Statement]:
        if self.y is None:
            return
        for n, value in enumerate(self._sums(deck, system.c, system.d), 1):
            yield STATEMENTS["VARIABLE"](id=value_name(self.y, n), function=value, spans=self.spans)

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
