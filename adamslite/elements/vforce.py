"""VFORCE: a force given by its three components.

Equation::

    force on I at I's origin = FX x_RM + FY y_RM + FZ z_RM

The opposite force acts on the part of JFLOAT at the present place of I::

      part of I  o ---->  F         part of JFLOAT  o <----  -F     (same point in space)
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from adamslite.elements.bases.arguments import (
    component_axes,
    component_vector,
    components_of_routine,
    reaction_marker,
    reaction_part,
    routine_name,
)
from adamslite.language.expression import Num
from adamslite.language.statement import Statement, expression, reference, statement
from adamslite.symbolic.scope import ZERO, Load, along_axes

if TYPE_CHECKING:
    from adamslite.language.expression import Node
    from adamslite.language.interfaces import DrawnModel
    from adamslite.symbolic.scope import Scope
    from adamslite.symbolic.types import Seen


@statement("VFORCE")
class Vforce(Statement):
    """A vector force on marker I.

    The reaction goes to the part of the floating marker JFLOAT, or to the part ``J_PART`` directly;
    a reaction on the ground has no effect.  Omitted components are zero; without RM the components
    are along the ground axes.
    """

    alternatives = ((("jfloat",), ("j_part",)),)

    i: int | str = reference("I", to="MARKER", required=True, help="marker the force acts on")
    jfloat: int | str | None = reaction_marker()
    j_part: int | str | None = reaction_part()
    rm: int | str = component_axes()
    fx: Node = expression("FX", unit="force", default=Num(0.0), help="component along x of RM")
    fy: Node = expression("FY", unit="force", default=Num(0.0), help="component along y of RM")
    fz: Node = expression("FZ", unit="force", default=Num(0.0), help="component along z of RM")
    fxyz: Node | None = component_vector("FXYZ", unit="force")
    function: Node | None = components_of_routine("fx", "fy", "fz", unit="force")
    routine: str | None = routine_name()

    def loads(self: Seen, scope: Scope) -> list[Load]:
        """The force on I; the reaction follows I."""
        force = along_axes(scope.axes(self.rm), (self.fx, self.fy, self.fz))
        reaction = self.jfloat if self.jfloat is not None else self.j_part
        return [Load(self.i, force, ZERO, reaction, follows=True)]

    @property
    def result_names(self) -> tuple[str, ...]:
        """Components along the axes of RM."""
        return ("fx", "fy", "fz")

    def outputs(self, model: DrawnModel) -> list[Node]:
        """Values of ``result_names``."""
        return [self.fx, self.fy, self.fz]
