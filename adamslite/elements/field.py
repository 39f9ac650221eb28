"""FIELD: a spring and damper whose six directions are coupled by matrices.

Equation, components along the axes of J (d = r_I - r_J)::

    x = (d, AX(I,J), AY(I,J), AZ(I,J)),    v = (velocity, angular velocity of I seen from J)

    force, torque on I = FORCE - KMATRIX (x - LENGTH) - CMATRIX v
    on J               = -force,  -torque - d x force

With BY, x and v are those of that marker relative to J, and the load is on I all the same.
CMATRIX = CRATIO KMATRIX when CRATIO is given.  A matrix is given column by column: its first
six values are the effect of a unit displacement along x of J.  Sign: a positive diagonal pulls I
back to LENGTH.  The angles are projections; two of the three must stay small.
Source: Adams/Solver statement FIELD.
"""

from __future__ import annotations

from adamslite.elements.bases.wrench import NOTHING, Compliance, by_columns, times
from adamslite.language.interfaces import DrawnModel
from adamslite.language.statement import Statement, choice, number, reference, statement, vector


@statement("FIELD", planned=("FUNCTION", "ROUTINE"))
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
        "FORMULATION", options=("LINEAR", "NONLINEAR"), supported=("LINEAR",), default="LINEAR",
        help="the law: that of the matrices",
    )  # fmt: skip

    def derived(self, model: DrawnModel) -> dict[str, object]:
        """The matrices of the law."""
        stiffness = by_columns(self.kmatrix)
        damping = by_columns(self.cmatrix)
        return {
            "stiffness": stiffness,
            "damping": damping if self.cratio is None else times(self.cratio, stiffness),
            "rest": self.length,
            "preload": self.force,
        }
