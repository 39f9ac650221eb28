"""REQUEST: up to eight quantities to write at every output time.

Values (components F1 ... F8; I relative to J, along the axes of RM, ground when omitted)::

    DISPLACEMENT   DM  DX  DY  DZ    0   PSI  THETA PHI
    VELOCITY       VM  VX  VY  VZ    WM  WX   WY    WZ
    ACCELERATION   ACCM ACCX ACCY ACCZ  WDTM WDTX WDTY WDTZ
    FORCE          FM  FX  FY  FZ    TM  TX   TY    TZ     on I, of the elements between I and J
    F1=e\\ ...     the expressions
    VARIABLES      VARVAL of each, as F1, F2, ...

The file .req (OUTPUT/REQSAVE) has all but F1 and F5, with six digits; in the file .res
(RESULTS/XRF) CNAMES names the components, and one without a name is left out.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from adamslite.elements.bases.arguments import components_of_routine, routine_name
from adamslite.language.expression import GROUND_FRAME, Call, Num, Ref
from adamslite.language.function import FUNCTIONS
from adamslite.language.statement import (
    Statement,
    choice,
    expression,
    reference,
    references,
    statement,
    text,
    texts,
)

if TYPE_CHECKING:
    from adamslite.language.expression import Node
    from adamslite.language.interfaces import DrawnModel

MEASURES = {
    "DISPLACEMENT": ("DM", "DX", "DY", "DZ", None, "PSI", "THETA", "PHI"),
    "VELOCITY": ("VM", "VX", "VY", "VZ", "WM", "WX", "WY", "WZ"),
    "FORCE": ("FM", "FX", "FY", "FZ", "TM", "TX", "TY", "TZ"),
    "ACCELERATION": ("ACCM", "ACCX", "ACCY", "ACCZ", "WDTM", "WDTX", "WDTY", "WDTZ"),
}

COMPONENTS = tuple(f"f{n}" for n in range(1, 9))
SIZES = ("DM", "VM", "ACCM", "WM", "WDTM")


def _component(number: int) -> Node | None:
    return expression(f"F{number}", unit="the user's", help=f"component {number}")


@statement("REQUEST")
class Request(Statement):
    """Output of a marker's motion, of a force, or of expressions."""

    alternatives = ((("kind",), COMPONENTS, ("variables",)),)

    kind: str | None = choice(
        options=("DISPLACEMENT", "VELOCITY", "ACCELERATION", "FORCE"), help="what is written"
    )
    i: int | str | None = reference("I", to="MARKER", help="marker that is measured")
    j: int | str = reference("J", to="MARKER", default=0, help="marker it is measured from")
    rm: int | str = reference("RM", to="MARKER", default=0, help="marker whose axes are used")
    f1: Node | None = _component(1)
    f2: Node | None = _component(2)
    f3: Node | None = _component(3)
    f4: Node | None = _component(4)
    f5: Node | None = _component(5)
    f6: Node | None = _component(6)
    f7: Node | None = _component(7)
    f8: Node | None = _component(8)
    variables: tuple[int | str, ...] = references(
        "VARIABLES", to="VARIABLE", help="VARIABLEs whose values are written"
    )
    function: Node | None = components_of_routine(*COMPONENTS, unit="the user's")
    routine: str | None = routine_name()
    comment: str | None = text("COMMENT", "C", help="a title")
    title: str | None = text("TITLE", help="titles of the components")
    cnames: tuple[str, ...] = texts("CNAMES", help="names of the components")
    clabels: tuple[str, ...] = texts("CLABELS", help="labels of the components")
    cunits: tuple[str, ...] = texts("CUNITS", help="units of the components")
    results_name: str | None = text("RESULTS_NAME", help="name of the result set")

    @property
    def functions(self) -> tuple[Node | None, ...]:
        """F1 ... F8, None where omitted."""
        return (self.f1, self.f2, self.f3, self.f4, self.f5, self.f6, self.f7, self.f8)

    @property
    def result_names(self) -> tuple[str, ...]:
        """F1 ... F8: all of them for a kind, those given otherwise."""
        if self.variables:
            return tuple(f"F{n}" for n in range(1, len(self.variables) + 1))
        given = [self.kind is not None or f is not None for f in self.functions]
        return tuple(f"F{n}" for n, is_there in enumerate(given, 1) if is_there)

    def outputs(self, model: DrawnModel) -> list[Node]:
        """Values of ``result_names``."""
        if self.variables:
            return [Call("VARVAL", (Ref("VARIABLE", key),)) for key in self.variables]
        if self.kind is None:
            return [f for f in self.functions if f is not None]
        assert self.i is not None  # a rule requires it
        frames = (Ref("MARKER", self.i), Ref("MARKER", self.j), Ref("MARKER", self.rm))
        return [self._measure(name, frames) for name in MEASURES[self.kind]]

    def _measure(self, name: str | None, frames: tuple[Ref, Ref, Ref]) -> Node:
        if name is None:
            return Num(0.0)
        taken = FUNCTIONS[name].parameters
        # Angles and sizes take two frames; a fourth is the frame of the derivative, ground here.
        args = frames[:2] if len(taken) == 2 or name in SIZES else frames
        return Call(name, args + (GROUND_FRAME,) * (len(taken) - len(args)))
