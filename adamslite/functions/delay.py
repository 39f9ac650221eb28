"""Values of the past."""

from __future__ import annotations

from adamslite.language.function import Mistake, function
from adamslite.symbolic.formulas import lookup
from adamslite.symbolic.scope import Scope
from adamslite.symbolic.types import Expr

DELAY = "DELAY"


def _known(*values: float | None) -> Mistake | None:
    """The delay and the value before the start must be numbers."""
    for index, name in ((1, "delay"), (2, "initial")):
        if values[index] is None:
            return index, f"{name} of {DELAY} must be a number: a delay that varies is not computed"
    assert values[1] is not None
    return None if values[1] > 0.0 else (1, f"delay of {DELAY} must be greater than 0")


@function(DELAY, "e:past delay:number initial:number=0", rule=_known)
def delay(scope: Scope, e: Expr, delay: Expr, initial: Expr) -> Expr:
    """The value that e had at TIME - delay; initial before e has been known for so long.

    A run proceeds in spans no longer than the shortest delay, so that what is delayed is known
    when a span begins: a cubic spline through 129 values of each earlier span, whose error is
    reported where it exceeds ERROR.  Spans end where a jump of the past arrives.
    It takes no part in constraints, and LINEAR rejects it: x(t - delay) has no state matrix.  An
    equilibrium has the past that led to it.
    Unit: that of e.  Source: Adams/Solver function DELAY; method of steps: Bellen, Zennaro,
    Numerical Methods for Delay Differential Equations, 2003, section 3.1.
    """
    return lookup(e, scope.now - delay)
