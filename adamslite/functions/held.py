"""What only the model writes: loads of constraints at any of their markers, and of inertia.

They take the place of the reaction of a joint that holds parts of one body together, see
:mod:`adamslite.model.merging`.
"""

from __future__ import annotations

from adamslite.language.function import function
from adamslite.symbolic.scope import (
    ORIGIN,
    ZERO,
    Scope,
    Vector,
    along_axes,
    cross,
    dot,
    minus,
    plus,
    scale,
)
from adamslite.symbolic.types import Expr, Frame, Tree

AT, HELD = "LOAD AT", "HELD"


@function(AT, "id:gcon at:marker comp:constant{2..8} rm:marker=0", internal=True)
def load_at(scope: Scope, id: Tree, at: Frame, comp: int, rm: Frame) -> Expr:
    """Component comp of all that a constraint exerts at one of the markers that it names.

    comp: 2 FX, 3 FY, 4 FZ, 6 TX, 7 TY, 8 TZ, along the axes of marker rm.
    """
    force, torque = ZERO, ZERO
    for load in scope.statement(id).own_loads(scope):
        sign = (load.frame == at) - (load.reaction == at)
        force = plus(force, scale(sign, load.force))
        torque = plus(torque, scale(sign, load.torque))
    return _along(scope, (force, torque), comp, rm)


@function(
    HELD,
    "part:marker about:marker m:number jxx:number jxy:number jxz:number jyy:number jyz:number"
    " jzz:number gx:number gy:number gz:number comp:constant{2..8} rm:marker=0",
    internal=True,
)
def held(scope: Scope, part: Frame, about: Frame, m: Expr, *rest: Expr) -> Expr:
    """Component comp of what a part needs from others to move as it does in gravity g.

    force  m (a - g),    torque about a marker  J al + w x J w + r x m (a - g)

    J is that about the mass centre, along the axes of the part; r from the marker to the mass
    centre.  comp: 2 FX, 3 FY, 4 FZ, 6 TX, 7 TY, 8 TZ, along the axes of marker rm.
    """
    xx, xy, xz, yy, yz, zz, gx, gy, gz, comp, rm = rest
    axes, omega = scope.axes(part), scope.omega(part)

    def inertia(spin: Vector) -> Vector:
        x, y, z = (dot(spin, axis) for axis in axes)
        rows = ((xx, xy, xz), (xy, yy, yz), (xz, yz, zz))
        return along_axes(axes, (dot(rows[0], (x, y, z)), dot(rows[1], (x, y, z)),
                                 dot(rows[2], (x, y, z))))  # fmt: skip

    force = scale(m, minus(scope.acceleration(part, ORIGIN), (gx, gy, gz)))
    change = plus(inertia(scope.alpha(part)), cross(omega, inertia(omega)))
    arm = cross(scope.position(part, about), force)
    return _along(scope, (force, plus(change, arm)), comp, rm)


def _along(scope: Scope, load: tuple[Vector, Vector], comp: int, rm: Frame) -> Expr:
    return dot(load[(comp - 1) // 4], scope.axes(rm)[(comp - 1) % 4 - 1])
