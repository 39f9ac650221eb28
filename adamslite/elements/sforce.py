"""SFORCE: a force along a line or a torque about an axis, given by an expression.

Equation::

    TRANSLATIONAL              force on I = e u,  -force on J,   u = (r_I - r_J) / |r_I - r_J|
    TRANSLATIONAL, ACTIONONLY  force on I = e z_J
    ROTATIONAL                 torque on I = e z_J,  -torque on J (not with ACTIONONLY)

Sign: positive pushes I and J apart, so a spring is ``-k*(DM(I,J)-L0)``::

      <---- J o - - - - - - o I ---->     e > 0
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from adamslite.elements.bases.arguments import reaction_part, routine_name
from adamslite.language.statement import Statement, choice, expression, flag, reference, statement
from adamslite.symbolic.scope import ZERO, Load, scale, towards

if TYPE_CHECKING:
    from adamslite.language.expression import Node
    from adamslite.language.interfaces import DrawnModel
    from adamslite.symbolic.scope import Scope
    from adamslite.symbolic.types import Seen


@statement("SFORCE")
class Sforce(Statement):
    """A single-component force (or torque) between two markers.

    ``J_PART`` names the part that takes the reaction; a reaction on the ground has no effect.
    """

    kind: str = choice(
        options=("TRANSLATIONAL", "ROTATIONAL"), default="TRANSLATIONAL",
        help="force along the line between the markers, or torque about z of J",
    )  # fmt: skip
    i: int | str = reference("I", to="MARKER", required=True, help="marker the force acts on")
    j: int | str = reference("J", to="MARKER", required=True, help="marker that takes the reaction")
    j_part: int | str | None = reaction_part()
    actiononly: bool = flag("ACTIONONLY", help="along z of J, and nothing acts on J")
    function: Node = expression(
        "FUNCTION", required=True, unit="force, or torque", help="the force on I"
    )
    routine: str | None = routine_name()

    def loads(self: Seen, scope: Scope) -> list[Load]:
        """The force on I and its reaction on J."""
        reaction = None if self.actiononly else self.j
        if self.kind == "ROTATIONAL":
            torque = scale(self.function, scope.axes(self.j)[2])
            return [Load(self.i, ZERO, torque, reaction)]
        along = (
            scope.axes(self.j)[2] if self.actiononly else towards(scope.position(self.i, self.j))
        )
        return [Load(self.i, scale(self.function, along), ZERO, reaction)]

    @property
    def result_names(self) -> tuple[str, ...]:
        """f: the value of FUNCTION."""
        return ("f",)

    def outputs(self, model: DrawnModel) -> list[Node]:
        """Values of ``result_names``."""
        return [self.function]
