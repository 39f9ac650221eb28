"""Forces of elements as deck functions.

Every element that exerts a force or a reaction is measured by a function of its own name, so one
line below is all that an element needs::

                 force on I  <---  jflag = 0
    NAME(id, jflag, comp, rm)
                 force on J  <---  jflag = 1

comp: 1 FM, 2 FX, 3 FY, 4 FZ, 5 TM, 6 TX, 7 TY, 8 TZ, components along the axes of rm (0: ground).
"""

from __future__ import annotations

from typing import Any

from adamslite.algebra import norm
from adamslite.function import function
from adamslite.symbolic import Scope, dot

MEASURES: dict[str, str] = {}
"""Keyword of a statement -> the function that measures what it does."""
NET: dict[str, int] = {}
"""Function of the net force at a marker -> its component; written out before use."""


def measured(name: str, what: str, keyword: str = "") -> None:
    """Register the function that measures ``what`` of the statements ``keyword`` (or ``name``)."""

    def component(scope: Scope, id: Any, jflag: int, comp: int, rm: Any) -> Any:
        vector = scope.load(name, id, jflag)[(comp - 1) // 4]
        axis = (comp - 1) % 4
        return dot(vector, scope.axes(rm)[axis - 1]) if axis else norm(vector)

    MEASURES[keyword or name] = name
    component.__doc__ = f"""Component comp of {what} {name} id, on marker I (jflag 0) or J (1).

    comp: 1 FM, 2 FX, 3 FY, 4 FZ, 5 TM, 6 TX, 7 TY, 8 TZ, along the axes of marker rm.
    Unit: force, or force times length.  Source: Adams/Solver function {name}.
    """
    function(
        name,
        f"id:{(keyword or name).lower()} jflag:constant{{0,1}} comp:constant{{1..8}} rm:marker=0",
    )(component)


def net(name: str, comp: int) -> None:
    """Register the function of the net force (or torque) at a marker."""
    what = ("force", "torque")[comp > 4]
    sized = comp in (1, 5)

    def component(scope: Scope, i: Any, j: Any, k: Any = None) -> Any:
        raise LookupError(f"{name} is written out before it is evaluated")

    along = "its magnitude" if sized else f"its {name[1].lower()} component along the axes of k"
    component.__doc__ = f"""Net {what} on marker i of all elements between i and j: {along}.

    Without j: of every force and constraint that acts at i.
    Unit: {what if comp < 5 else "force times length"}.  Source: Adams/Solver C++ function {name}.
    """
    NET[name] = comp
    function(name, "i:marker j:marker=0" + ("" if sized else " k:marker=0"))(component)


measured("JOINT", "the reaction of")
measured("JPRIM", "the reaction of")
measured("MOTION", "the reaction of")
measured("COUPLER", "the reaction of")
measured("GEAR", "the reaction of")
measured("PTCV", "the reaction of")
measured("SFORCE", "the force or torque of")
measured("VFORCE", "the force of")
measured("GFORCE", "the force or torque of")
measured("VTORQ", "the torque of", "VTORQUE")
measured("BUSH", "the force or torque of", "BUSHING")
measured("FIELD", "the force or torque of")
measured("BEAM", "the force or torque of")
measured("FRICTION", "the friction of")
measured("SPDP", "the force or torque of", "SPRINGDAMPER")
for _number, _name in enumerate(("FM", "FX", "FY", "FZ", "TM", "TX", "TY", "TZ"), 1):
    net(_name, _number)
