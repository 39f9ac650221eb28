"""FIELD: a spring and damper whose six directions are coupled by matrices.

Equation, components along the axes of J (d = r_I - r_J)::

    x = (d, AX(I,J), AY(I,J), AZ(I,J)),    v = (velocity, angular velocity of I seen from J)

    force, torque on I = FORCE - KMATRIX (x - LENGTH) - CMATRIX v      or  FUNCTION
    on J               = -force,  -torque - d x force

With BY, x and v are those of that marker relative to J, and the load is on I all the same.
CMATRIX = CRATIO KMATRIX when CRATIO is given.  A matrix is given column by column: its first
six values are the effect of a unit displacement along x of J.  Sign: a positive diagonal pulls I
back to LENGTH.  The angles are projections; two of the three must stay small.
Source: Adams/Solver statement FIELD.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from adamslite.elements.bases.arguments import components_of_routine, routine_name
from adamslite.elements.bases.wrench import NOTHING, Compliance, between, by_columns, times
from adamslite.language.expression import Num
from adamslite.language.statement import (
    Statement,
    choice,
    expression,
    number,
    reference,
    statement,
    vector,
)

if TYPE_CHECKING:
    from adamslite.language.expression import Node
    from adamslite.language.interfaces import DrawnModel
    from adamslite.symbolic.scope import Load, Scope
    from adamslite.symbolic.types import Seen

COMPONENTS = ("fx", "fy", "fz", "tx", "ty", "tz")


def _component(key: str, unit: str) -> Node:
    help = f"{unit} along {key[1].lower()} of J, instead of the matrices (an extension)"
    return expression(key, unit=unit, default=Num(0.0), help=help)


@statement("FIELD")
class Field(Compliance, Statement):
    """A linear force and torque in all six directions, with coupling."""

    i: int | str = reference("I", to="MARKER", required=True, help="marker the force acts on")
    j: int | str = reference(
        "J", to="MARKER", required=True, help="reference marker, which takes the reaction"
    )
    by: int | str | None = reference(
        "BY", to="MARKER", help="marker whose displacement counts; I unless given (an extension)"
    )
    kmatrix: tuple[float, ...] = vector(
        "KMATRIX", size=36, unit="force/length, torque/angle, ...", default=NOTHING * 6,
        help="stiffness, column by column",
    )  # fmt: skip
    cmatrix: tuple[float, ...] = vector(
        "CMATRIX", size=36, unit="those of KMATRIX, times time", default=NOTHING * 6,
        help="damping, column by column",
    )  # fmt: skip
    cratio: float | None = number("CRATIO", unit="time", help="damping over stiffness")
    length: tuple[float, ...] = vector(
        "LENGTH", size=6, unit="length, angle", default=NOTHING,
        help="displacement at which the force is FORCE",
    )  # fmt: skip
    force: tuple[float, ...] = vector(
        "FORCE", size=6, unit="force, torque", default=NOTHING, help="force and torque at LENGTH"
    )

    formulation: str = choice(
        "FORMULATION", options=("LINEAR", "NONLINEAR"), default="LINEAR",
        help="the law: that of the matrices, or (NONLINEAR) FUNCTION",
    )  # fmt: skip
    fx: Node = _component("FX", "force")
    fy: Node = _component("FY", "force")
    fz: Node = _component("FZ", "force")
    tx: Node = _component("TX", "torque")
    ty: Node = _component("TY", "torque")
    tz: Node = _component("TZ", "torque")
    function: Node | None = components_of_routine(*COMPONENTS, unit="force, torque")
    routine: str | None = routine_name()

    @property
    def nonlinear(self) -> bool:
        """Whether the load is given by expressions."""
        return any(self.given(name) for name in (*COMPONENTS, "function"))

    def loads(self: Seen, scope: Scope) -> list[Load]:
        """The wrench on I and what J gets."""
        if not self.written:
            return Compliance.loads(self, scope)
        return between(scope, self.i, self.j, [getattr(self, name) for name in COMPONENTS])

    def derived(self, model: DrawnModel) -> dict[str, object]:
        """The matrices of the law."""
        stiffness = by_columns(self.kmatrix)
        damping = by_columns(self.cmatrix)
        return {
            "written": "yes" if self.nonlinear else None,
            "stiffness": stiffness,
            "damping": damping if self.cratio is None else times(self.cratio, stiffness),
            "rest": self.length,
            "preload": self.force,
        }
