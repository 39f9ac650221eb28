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


def measured(name: str, what: str, keyword: str = "") -> None:
    """Register the function that measures ``what`` of the statements ``keyword`` (or ``name``)."""

    def component(scope: Scope, id: Any, jflag: int, comp: int, rm: Any) -> Any:
        vector = scope.load(name, id, jflag)[(comp - 1) // 4]
        axis = (comp - 1) % 4
        return dot(vector, scope.axes(rm)[axis - 1]) if axis else norm(vector)

    component.__doc__ = f"""Component comp of {what} {name} id, on marker I (jflag 0) or J (1).

    comp: 1 FM, 2 FX, 3 FY, 4 FZ, 5 TM, 6 TX, 7 TY, 8 TZ, along the axes of marker rm.
    Unit: force, or force times length.  Source: Adams/Solver function {name}.
    """
    function(
        name,
        f"id:{(keyword or name).lower()} jflag:constant{{0,1}} comp:constant{{1..8}} rm:marker=0",
    )(component)


measured("JOINT", "the reaction of")
measured("SFORCE", "the force or torque of")
measured("VFORCE", "the force of")
measured("SPDP", "the force or torque of", "SPRINGDAMPER")
