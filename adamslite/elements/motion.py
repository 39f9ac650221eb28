"""MOTION: a freedom that follows a function of time.

Equation (q the freedom, e = FUNCTION)::

    DISPLACEMENT   q - e = 0                 a rotation is taken modulo a full turn
    VELOCITY       dq/dt - e = 0
    ACCELERATION   dq/dt - s = 0,  ds/dt = e,  s(0) = ICVEL

VELOCITY and ACCELERATION constrain the velocity: no position is held, it follows by integration
from the start.  Without ICDISP that is where the bodies are, without ICVEL s(0) is the speed they
have.  ACCELERATION brings a state s of its own, written as ``DIFF/MOTION_id``, so that
the highest level a constraint is stated on stays the velocity.

Freedoms: translation along and rotation about z of J of a joint, or, between markers I and J,

    X, Y, Z      (r_I - r_J) . x_J, y_J, z_J
    B1, B2, B3   body-fixed 1-2-3 angles of I seen from J

Sign: I relative to J; the reaction reported is the force and torque on I that makes it move.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from adamslite.elements.bases.arguments import routine_name
from adamslite.elements.bases.constraint import Constraint
from adamslite.elements.bases.joint_coordinates import angle_to, relative_velocity, spin, turn
from adamslite.language.expression import Call, Ref
from adamslite.language.statement import (
    STATEMENTS,
    Statement,
    choice,
    expression,
    number,
    reference,
)
from adamslite.language.statement import statement as register
from adamslite.symbolic.formulas import root
from adamslite.symbolic.scope import dot

if TYPE_CHECKING:
    from adamslite.elements.bases.joint_coordinates import Turn
    from adamslite.elements.joint import Joint
    from adamslite.language.expression import Node
    from adamslite.language.interfaces import DrawnModel, Lookup
    from adamslite.symbolic.scope import Scope
    from adamslite.symbolic.types import Expr, Seen

AXES = ("X", "Y", "Z")
ANGLES = ("B1", "B2", "B3")


@register("MOTION")
class Motion(Constraint, Statement):
    """Prescribes the motion of a joint, or of one marker relative to another."""

    alternatives = ((("joint",), ("i", "j")),)

    joint: int | str | None = reference("JOINT", to="JOINT", help="the joint that is driven")
    i: int | str | None = reference("I", to="MARKER", help="marker that is driven, without JOINT")
    j: int | str | None = reference("J", to="MARKER", help="marker it is driven against")
    axis: str | None = choice(
        options=("TRANSLATION", "ROTATION", *AXES, *ANGLES),
        help="the freedom: TRANSLATION or ROTATION of a joint, else X to B3",
    )
    level: str = choice(
        options=("DISPLACEMENT", "VELOCITY", "ACCELERATION"), default="DISPLACEMENT",
        help="what FUNCTION gives",
    )  # fmt: skip
    icdisp: float | None = number(
        "ICDISP", unit="length or angle", help="displacement at the start (not for DISPLACEMENT)"
    )
    icvel: float | None = number(
        "ICVEL", unit="length or angle per time", help="velocity at the start (for ACCELERATION)"
    )
    function: Node = expression(
        "FUNCTION", required=True, unit="length or angle, or its derivatives",
        help="a function of TIME only",
    )  # fmt: skip
    routine: str | None = routine_name()

    @property
    def state(self) -> str:
        """Name of the DIFF that integrates an acceleration."""
        return f"MOTION_{self.key}"

    def companions(self, deck: Lookup) -> tuple[Statement, ...]:
        """The DIFF of an acceleration."""
        if self.level != "ACCELERATION":
            return ()
        start = (self.icvel or 0.0,)
        return (
            STATEMENTS["DIFF"](id=self.state, ic=start, function=self.function, spans=self.spans),
        )

    def is_rate(self, model: DrawnModel) -> bool:
        """Whether FUNCTION is a velocity or an acceleration."""
        return self.level != "DISPLACEMENT"

    def driven(self, joint: Joint | None) -> str | None:
        """The freedom: AXIS, or the only one of the joint; None when there is no such one."""
        if joint is None:
            return self.axis if self.axis in (*AXES, *ANGLES) else None
        free = joint.coordinates
        if self.axis is None:
            return free[0] if len(free) == 1 else None
        return self.axis if self.axis in free else None

    def initial(self) -> list[tuple[str, str, float | None, float | None]]:
        """(field, freedom, displacement, velocity) requested at the start; None where free."""
        if self.level == "DISPLACEMENT" or self.icdisp is None:
            return []
        return [("icdisp", self.axis or "", self.icdisp, None)]

    @property
    def row_names(self) -> tuple[str, ...]:
        """What is prescribed."""
        if self.joint is None:
            return (f"{self.axis} of I from J",)
        return (f"{(self.axis or 'freedom').lower()} of JOINT/{self.joint}",)

    def derived(self, model: DrawnModel) -> dict[str, object]:
        """The freedom, and the expression its value or rate follows."""
        joint = None if self.joint is None else model.element("JOINT", self.joint)
        followed = self.function
        if self.level == "ACCELERATION":
            followed = Call("DIF", (Ref("DIFF", self.state.upper()),))
        return {"freedom": self.driven(joint), "followed": followed}

    def constraints(self: Seen, scope: Scope) -> list[Expr]:
        """The row that vanishes."""
        at = self if self.joint is None else self.joint
        name = {"TRANSLATION": "Z", "ROTATION": "turn"}.get(self.freedom, self.freedom)
        if name in AXES:
            axis = AXES.index(name)
            if self.level == "DISPLACEMENT":
                along = scope.axes(at.j)[axis]
                return [dot(scope.position(at.i, at.j), along) - self.followed]
            return [relative_velocity(scope, at.i, at.j, axis) - self.followed]
        if name == "turn" and self.level != "DISPLACEMENT":
            return [spin(scope, at.i, at.j) - self.followed]
        rotation = turn(scope, at.i, at.j) if name == "turn" else body_123(scope, at.i, at.j, name)
        if self.level == "DISPLACEMENT":
            return [angle_to(rotation, self.followed)]
        return [_rate(scope, rotation) - self.followed]


def body_123(scope: Scope, i: int, j: int, name: str) -> Turn:
    """One of the angles of R = Rx(B1) Ry(B2) Rz(B3), as sine and cosine."""
    (xi, yi, zi), (xj, yj, zj) = scope.axes(i), scope.axes(j)
    if name == "B1":
        return -dot(zi, yj), dot(zi, zj)
    if name == "B3":
        return -dot(yi, xj), dot(xi, xj)
    return dot(zi, xj), root(dot(zi, yj) ** 2 + dot(zi, zj) ** 2)


def _rate(scope: Scope, rotation: Turn) -> Expr:
    """Rate of the angle of a turn."""
    s, c = rotation
    return (c * scope.derivative(s) - s * scope.derivative(c)) / (s**2 + c**2)
