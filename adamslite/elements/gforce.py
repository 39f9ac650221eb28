"""GFORCE: a force and a torque given by their components.

Equation::

    force on I at I's origin = FX x_RM + FY y_RM + FZ z_RM
    torque on I              = TX x_RM + TY y_RM + TZ z_RM

The opposite force and torque act on the part of JFLOAT at the present place of I, so the pair adds
no moment of its own::

      part of I  o ---->  F, T       part of JFLOAT  o <----  -F, -T     (same point in space)

Source: Adams/Solver statement GFORCE.
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
from adamslite.symbolic.scope import Load, along_axes

if TYPE_CHECKING:
    from adamslite.language.expression import Node
    from adamslite.symbolic.scope import Scope
    from adamslite.symbolic.types import Seen


def _component(key: str, unit: str) -> Node:
    help = f"{unit.split()[0]} along {key[1].lower()} of RM"
    return expression(key, unit=unit, default=Num(0.0), help=help)


@statement("GFORCE")
class Gforce(Wrench, Statement):
    """A vector force and a vector torque on marker I.

    The reaction goes to the part of the floating marker JFLOAT, or to the part ``J_PART`` directly;
    a reaction on the ground has no effect.  Omitted components are zero; without RM the components
    are along the ground axes.
    """

    i: int | str = reference("I", to="MARKER", required=True, help="marker the force acts on")
    jfloat: int | str | None = reaction_marker()
    j_part: int | str | None = reaction_part()
    rm: int | str = component_axes()
    fx: Node = _component("FX", "force")
    fy: Node = _component("FY", "force")
    fz: Node = _component("FZ", "force")
    tx: Node = _component("TX", "torque")
    ty: Node = _component("TY", "torque")
    tz: Node = _component("TZ", "torque")
    fxyz: Node | None = component_vector("FXYZ", unit="force")
    txyz: Node | None = component_vector("TXYZ", unit="torque")
    function: Node | None = components_of_routine(
        "fx", "fy", "fz", "tx", "ty", "tz", unit="force, torque"
    )
    routine: str | None = routine_name()

    def loads(self: Seen, scope: Scope) -> list[Load]:
        """Force and torque on I; the reaction follows I."""
        axes = scope.axes(self.rm)
        force = along_axes(axes, (self.fx, self.fy, self.fz))
        torque = along_axes(axes, (self.tx, self.ty, self.tz))
        reaction = self.jfloat if self.jfloat is not None else self.j_part
        return [Load(self.i, force, torque, reaction, follows=True)]
