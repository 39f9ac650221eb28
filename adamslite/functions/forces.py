"""Forces of elements as deck functions.

Every element that exerts a force or a reaction is measured by a function of its own name, so one
line below is all that an element needs::

                 force on I  <---  jflag = 0
    NAME(id, jflag, comp, rm)
                 force on J  <---  jflag = 1

comp: 1 FM, 2 FX, 3 FY, 4 FZ, 5 TM, 6 TX, 7 TY, 8 TZ, components along the axes of rm (0: ground).
"""

from __future__ import annotations

from adamslite.language.function import function
from adamslite.symbolic.formulas import norm, piecewise
from adamslite.symbolic.scope import ZERO, Scope, Vector, cross, dot, plus, scale
from adamslite.symbolic.types import Expr, Frame, Tree

MEASURES: dict[str, str] = {}
"""Keyword of a statement -> the function that measures what it does."""
NET: dict[str, int] = {}
"""Function of the net force at a marker -> its component; written out before use.  That of NFORCE
has it among its arguments."""


def measured(name: str, what: str, keyword: str = "") -> None:
    """Register the function that measures ``what`` of the statements ``keyword`` (or ``name``)."""

    def measuring(scope: Scope, id: Tree, jflag: int, comp: int, rm: Frame) -> Expr:
        return component(scope, id, jflag, comp, rm)

    MEASURES[keyword or name] = name
    measuring.__doc__ = f"""Component comp of {what} {name} id, on marker I (jflag 0) or J (1).

    comp: 1 FM, 2 FX, 3 FY, 4 FZ, 5 TM, 6 TX, 7 TY, 8 TZ, along the axes of marker rm.
    Unit: force, or force times length.  Source: Adams/Solver function {name}.
    """
    function(
        name,
        f"id:{(keyword or name).lower()} jflag:constant{{0,1}} comp:constant{{1..8}} rm:marker=0",
    )(measuring)


def component(scope: Scope, id: Tree, jflag: int, comp: int, rm: Frame) -> Expr:
    """One component of the force or torque of an element."""
    return _part(scope, scope.load(id, jflag), comp, rm)


def _part(scope: Scope, load: tuple[Vector, Vector], comp: int, rm: Frame) -> Expr:
    """One component of a force and a torque."""
    vector = load[(comp - 1) // 4]
    axis = (comp - 1) % 4
    return dot(vector, scope.axes(rm)[axis - 1]) if axis else norm(vector)


def net(name: str, comp: int) -> None:
    """Register the function of the net force (or torque) at a marker."""
    what = ("force", "torque")[comp > 4]
    sized = comp in (1, 5)

    def unwritten(scope: Scope, i: Frame, j: Frame, k: Frame | None = None) -> Expr:
        raise LookupError(f"{name} is written out before it is evaluated")

    along = "its magnitude" if sized else f"its {name[1].lower()} component along the axes of k"
    unwritten.__doc__ = f"""Net {what} on marker i of all elements between i and j: {along}.

    Without j: of every force and constraint that acts at i.
    Unit: {what if comp < 5 else "force times length"}.  Source: Adams/Solver C++ function {name}.
    """
    NET[name] = comp
    function(name, "i:marker j:marker=0" + ("" if sized else " k:marker=0"))(unwritten)


MEASURES["GCON"] = "GCON"


@function("GCON", "id:gcon jflag:constant{0,1}=0 comp:constant{0..8}=0 rm:marker=0")
def gcon(scope: Scope, id: Tree, jflag: int, comp: int, rm: Frame) -> Expr:
    """Component comp of the reaction of GCON id, on marker I (jflag 0) or J (1), or its strength L.

    I is the first marker of FUNCTION, J the one it is measured against; L is meant without comp.

    comp: 1 FM, 2 FX, 3 FY, 4 FZ, 5 TM, 6 TX, 7 TY, 8 TZ, along the axes of marker rm.

    L pushes the coordinates q by L d(FUNCTION)/dq: with FUNCTION=DM(1,2)-1 it is the force that
    drives the markers apart, minus the tension.  For a GCON in velocities u the derivative is
    d(FUNCTION)/du.
    Unit: force, or force times length; of L force length (power for velocities) over that of
    FUNCTION.
    Source: Adams/Solver C++ function GCON; the sign of L is that of this definition.
    """
    return component(scope, id, jflag, comp, rm) if comp else -scope.statement(id).multiplier


MEASURES["FRICTION"] = "FRICTION"


@function("FRICTION", "id:friction jflag:constant{0,1} comp:constant{1..28} rm:marker=0")
def friction(scope: Scope, id: Tree, jflag: int, comp: int, rm: Frame) -> Expr:
    """Component comp of the friction of FRICTION id, on marker I (jflag 0) or J (1).

    comp: 1 FM, 2 FX, 3 FY, 4 FZ, 5 TM, 6 TX, 7 TY, 8 TZ, along the axes of marker rm.  Whatever
    jflag and rm, 9 to 14 are the coefficient MUX ... MURZ, 15 MU1, 16 to 21 the slip VX ... WZ,
    22 to 27 the creep CREEP_X ... CREEP_AZ, 28 BETA: see the page of FRICTION.
    Unit: force, or force times length; 1, length/time, length.
    Source: Adams/Solver function FRICTION; from 9 an extension.
    """
    if comp <= 8:
        return component(scope, id, jflag, comp, rm)
    view = scope.statement(id)
    return view.cls.values(view, scope)[comp - 9]


MEASURES["CONTACT"] = "CONTACT"


@function("CONTACT", "id:contact jflag:constant{0,1} comp:constant{1..10} rm:marker=0")
def contact(scope: Scope, id: Tree, jflag: int, comp: int, rm: Frame) -> Expr:
    """Component comp of the force of CONTACT id on the part of IGEOM (jflag 0) or JGEOM (1).

    It is the sum over all points of contact; the torque is about the marker of the first shape of
    IGEOM, for both parts.

    comp: 1 FM, 2 FX, 3 FY, 4 FZ, 5 TM, 6 TX, 7 TY, 8 TZ, along the axes of marker rm; 9 how many
    points touch, 10 the greatest depth of penetration.
    Unit: force, or force times length; 1, length.  Source: Adams/Solver function CONTACT; the point
    about which ADAMS takes the torque is not documented; from 9 an extension.
    """
    view = scope.statement(id)
    if comp > 8:
        depths = [point.cls.depth(point, scope) for point in view.points]
        return _count(depths) if comp == 9 else _greatest(depths)
    force, torque = ZERO, ZERO
    for point in view.points:
        (load,) = point.own_loads(scope)
        arm = scope.position(load.frame, view.origin)
        sign = -1 if (point.turned == "yes") != (jflag == 1) else 1
        force = plus(force, scale(sign, load.force))
        torque = plus(torque, scale(sign, plus(load.torque, cross(arm, load.force))))
    return _part(scope, (force, torque), comp, rm)


def _count(depths: list[Expr]) -> Expr:
    """How many of the depths are of points that touch."""
    return sum(piecewise((1, depth > 0), otherwise=0) for depth in depths)


def _greatest(depths: list[Expr]) -> Expr:
    """The greatest depth, 0 where nothing touches."""
    found: Expr = 0
    for depth in depths:
        found = piecewise((depth, depth > found), otherwise=found)
    return found


measured("JOINT", "the reaction of")
measured("JPRIM", "the reaction of")
measured("MOTION", "the reaction of")
measured("COUPLER", "the reaction of")
measured("GEAR", "the reaction of")
measured("PTCV", "the reaction of")
measured("CVCV", "the reaction of")
measured("SFORCE", "the force or torque of")
measured("VFORCE", "the force of")
measured("GFORCE", "the force or torque of")
measured("VTORQ", "the torque of", "VTORQUE")
measured("BUSH", "the force or torque of", "BUSHING")
measured("FIELD", "the force or torque of")
measured("BEAM", "the force or torque of")
measured("SPDP", "the force or torque of", "SPRINGDAMPER")


@function("NFORCE", "id:nforce at_marker:marker comp:constant{1..8} rm:marker=0")
def nforce(scope: Scope, id: Tree, at_marker: Frame, comp: int, rm: Frame) -> Expr:
    """Component comp of the load of NFORCE id on at_marker, one of its markers I or J.

    comp: 1 FM, 2 FX, 3 FY, 4 FZ, 5 TM, 6 TX, 7 TY, 8 TZ, along the axes of marker rm.
    Unit: force, or force times length.  Source: Adams/Solver function NFORCE.
    """
    raise LookupError("NFORCE is written out before it is evaluated")


NET["NFORCE"] = 0
for _number, _name in enumerate(("FM", "FX", "FY", "FZ", "TM", "TX", "TY", "TZ"), 1):
    net(_name, _number)
