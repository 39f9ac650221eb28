"""VTORQUE: a torque given by its three components.

Equation::

    torque on I = TX x_RM + TY y_RM + TZ z_RM

The opposite torque acts on the part of JFLOAT.  Sign: right hand about the axes of RM::

      part of I  o =>>  T         part of JFLOAT  o <<=  -T

Source: Adams/Solver statement VTORQUE.
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
from adamslite.elements.bases.wrench import Wrench
from adamslite.language.expression import Num
from adamslite.language.statement import Statement, expression, reference, statement
from adamslite.symbolic.scope import ZERO, Load, along_axes

if TYPE_CHECKING:
    from adamslite.language.expression import Node
    from adamslite.symbolic.scope import Scope
    from adamslite.symbolic.types import Seen


@statement("VTORQUE")
class Vtorque(Wrench, Statement):
    """A vector torque on the part of marker I.

    The reaction goes to the part of the floating marker JFLOAT, or to the part ``J_PART`` directly;
    a reaction on the ground has no effect.  Omitted components are zero; without RM the components
    are about the ground axes.
    """

    i: int | str = reference("I", to="MARKER", required=True, help="marker the torque acts on")
    jfloat: int | str | None = reaction_marker()
    j_part: int | str | None = reaction_part()
    rm: int | str = component_axes()
    tx: Node = expression("TX", unit="torque", default=Num(0.0), help="torque about x of RM")
    ty: Node = expression("TY", unit="torque", default=Num(0.0), help="torque about y of RM")
    tz: Node = expression("TZ", unit="torque", default=Num(0.0), help="torque about z of RM")
    txyz: Node | None = component_vector("TXYZ", unit="torque")
    function: Node | None = components_of_routine("tx", "ty", "tz", unit="torque")
    routine: str | None = routine_name()

    def loads(self: Seen, scope: Scope) -> list[Load]:
        """The torque on I and its reaction."""
        torque = along_axes(scope.axes(self.rm), (self.tx, self.ty, self.tz))
        reaction = self.jfloat if self.jfloat is not None else self.j_part
        return [Load(self.i, ZERO, torque, reaction, follows=True)]
