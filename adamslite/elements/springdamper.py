"""SPRINGDAMPER: a linear spring with a damper beside it.

Equation::

    TRANSLATIONAL  force on I along u = FORCE - K (DM(I,J) - LENGTH) - C VR(I,J)
    ROTATIONAL     torque on I about z = TORQUE - KT (AZ(I,J) - ANGLE) - CT WZ(I,J,J)

with ``u = (r_I - r_J)/|r_I - r_J|``; the opposite acts on J.  Sign: positive pushes apart::

      <---- J o-/\\/\\/\\-o I ---->     force > 0
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from adamslite.language.expression import COMPONENTS, GROUND_FRAME, Call, Op, Ref, measure
from adamslite.language.function import FUNCTIONS
from adamslite.language.statement import Statement, choice, number, reference, statement
from adamslite.symbolic.scope import ORIGIN, ZERO, Load, scale, towards

if TYPE_CHECKING:
    from adamslite.language.expression import Node
    from adamslite.language.interfaces import DrawnModel
    from adamslite.symbolic.scope import Scope
    from adamslite.symbolic.types import Seen


@statement("SPRINGDAMPER")
class Springdamper(Statement):
    """A spring and damper between two markers; in the rotational form their z axes are parallel."""

    kind: str = choice(
        options=("TRANSLATIONAL", "ROTATIONAL"), default="TRANSLATIONAL",
        help="along the line between the markers, or about their common z axis",
    )  # fmt: skip
    i: int | str = reference("I", to="MARKER", required=True, help="marker the force acts on")
    j: int | str = reference("J", to="MARKER", required=True, help="marker that takes the reaction")
    k: float = number("K", unit="force/length", default=0.0, help="stiffness")
    c: float = number("C", unit="force time/length", default=0.0, help="damping")
    force: float = number("FORCE", unit="force", default=0.0, help="force at LENGTH")
    length: float = number("LENGTH", unit="length", default=0.0, help="length at which it is FORCE")
    kt: float = number("KT", unit="torque/angle", default=0.0, help="torsional stiffness")
    ct: float = number("CT", unit="torque time/angle", default=0.0, help="torsional damping")
    torque: float = number("TORQUE", unit="torque", default=0.0, help="torque at ANGLE")
    angle: float = number("ANGLE", unit="angle", default=0.0, help="angle at which it is TORQUE")

    def loads(self: Seen, scope: Scope) -> list[Load]:
        """The force or torque on I and its reaction on J."""
        i, j = self.i, self.j
        if self.kind == "ROTATIONAL":
            twist = FUNCTIONS["AZ"].body(scope, i, j) - self.angle
            value = self.torque - self.kt * twist - self.ct * FUNCTIONS["WZ"].body(scope, i, j, j)
            return [Load(i, ZERO, scale(value, scope.axes(j)[2]), j)]
        stretch = FUNCTIONS["DM"].body(scope, i, j) - self.length
        speed = FUNCTIONS["VR"].body(scope, i, j, ORIGIN)
        value = self.force - self.k * stretch - self.c * speed
        return [Load(i, scale(value, towards(scope.position(i, j))), ZERO, j)]

    @property
    def result_names(self) -> tuple[str, ...]:
        """f: the force or torque on I, positive when it pushes apart."""
        return ("f",)

    def outputs(self, model: DrawnModel) -> list[Node]:
        """Values of ``result_names``: the load on I along the line, or about z of J."""
        own, i, j = (Ref("SPRINGDAMPER", self.key), Ref("MARKER", self.i), Ref("MARKER", self.j))
        if self.kind == "ROTATIONAL":
            return [measure("SPDP", own, 8, j)]
        along = [
            Op("*", (measure("SPDP", own, c), Call(name, (i, j, GROUND_FRAME))))
            for c, name in zip(COMPONENTS, ("DX", "DY", "DZ"), strict=False)
        ]
        return [Op("/", (Op("+", (Op("+", (along[0], along[1])), along[2])), Call("DM", (i, j))))]
