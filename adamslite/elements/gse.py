"""GSE: state equations of a routine of the user.

Equation (x the values of ARRAY X, u of ARRAY U, y of ARRAY Y)::

    dx/dt = f(x, u, t),     y = g(x, u, t)          USER returns f_1 ... f_NS, g_1 ... g_NO

    statics:  f = 0,  or x as it is with STATIC_HOLD
    the discrete states of XD stay as ICD has them
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import TYPE_CHECKING, ClassVar

from adamslite.elements.bases.arguments import routine_name
from adamslite.elements.bases.system_element import (
    SystemElement,
    input_array,
    output_array,
    start_array,
    state_array,
    static_hold,
)
from adamslite.language.expression import Num
from adamslite.language.statement import expression, integer, number, reference, statement, texts

if TYPE_CHECKING:
    from adamslite.language.expression import Node
    from adamslite.language.interfaces import Lookup


@statement("GSE", planned=("IMPLICIT", "STATICS_ONLY"))
class Gse(SystemElement):
    """A controller or element whose equations are in a program beside the deck.

    ``--user`` binds numbers or a function of Python to the routine: the rates of the NS states,
    then the NO outputs.  Discrete states can be read, but not computed: only numbers can be bound
    where there are any.
    """

    kinds: ClassVar[Mapping[str, str]] = {**SystemElement.kinds, "xd": "X", "icd": "IC"}
    starts: ClassVar[Mapping[str, str]] = {**SystemElement.starts, "xd": "icd"}

    ns: int = integer("NS", default=0, help="number of states")
    no: int = integer("NO", default=0, help="number of outputs")
    nd: int = integer("ND", default=0, help="number of discrete states")
    x: int | str | None = state_array()
    u: int | str | None = input_array()
    y: int | str | None = output_array()
    ic: int | str | None = start_array()
    xd: int | str | None = reference("XD", to="ARRAY", help="ARRAY X of the discrete states")
    icd: int | str | None = reference(
        "ICD", to="ARRAY", start=True, help="ARRAY IC of the discrete states"
    )
    sample_period: Node | None = expression(
        "SAMPLE_PERIOD", unit="time", inert=True, help="time between samples of discrete states"
    )
    sample_offset: float = number(
        "SAMPLE_OFFSET", unit="time", default=0.0, inert=True, help="time of the first sample"
    )
    static_hold: bool = static_hold()
    function: Node = expression(
        "FUNCTION", required=True, unit="those of x per time, of y", help="USER(...), the routine"
    )
    routine: str | None = routine_name()
    interface: tuple[str, ...] = texts(
        "INTERFACE", help="library::name of each of its routines; that of the rates names it"
    )
    returned: tuple[Node, ...] = ()

    def counts(self, deck: Lookup) -> dict[str, int] | None:
        """NS, NO and ND."""
        if len(self.returned) != self.routine_count(1):
            return None
        return {"x": self.ns, "y": self.no, "xd": self.nd}

    def bringing(self, deck: Lookup) -> int:
        """States and outputs."""
        return sum(max(count, 0) for count in (self.ns, self.no, self.nd))

    def equations(self, deck: Lookup) -> Iterator[tuple[str, Iterator[Node]]]:
        """What the routine returns; discrete states do not change."""
        yield "x", iter(self.returned[: self.ns])
        yield "y", iter(self.returned[self.ns :])
        yield "xd", (Num(0.0) for _ in range(self.nd))

    def holds(self, field: str) -> bool:
        """Discrete states stay in statics, too."""
        return field == "xd" or self.static_hold

    def routine_count(self, fields: int) -> int:
        """Numbers that its routine returns."""
        return max(self.ns, 0) + max(self.no, 0)

    @property
    def numbers_only(self) -> bool:
        """Where discrete states would have to be computed."""
        return self.nd > 0

    def of_routine(self, fields: Sequence[str], values: Sequence[Node | None]) -> dict[str, object]:
        """They are rates and outputs; FUNCTION stays the call."""
        return {"returned": tuple(values)}
