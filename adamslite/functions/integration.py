"""Numbers of the integrator, as a record at an output time has them."""

from __future__ import annotations

from adamslite.language.function import function
from adamslite.symbolic.scope import Scope
from adamslite.symbolic.types import Expr

NUMBERS = ("HSIZE", "ORDER", "NJAC", "NRHS")
"""In the order in which the workspace has them, behind time and MODE."""


def _number(scope: Scope, name: str) -> Expr:
    return scope.symbol("run", NUMBERS.index(name))


@function("HSIZE", "")
def hsize(scope: Scope) -> Expr:
    """Size of the step that the output time lies in; 0 at the start. Only in REQUEST.

    It is a number of the integrator of this program, and another one with another method or ERROR.
    Unit: time.  Source: Adams/Solver function HSIZE.
    """
    return _number(scope, "HSIZE")


@function("ORDER", "")
def order(scope: Scope) -> Expr:
    """Order of the formula of the step that the output time lies in. Only in REQUEST.

    It is a number of the integrator of this program, and another one with another method or ERROR.
    Unit: none.  Source: Adams/Solver function ORDER.
    """
    return _number(scope, "ORDER")


@function("NJAC", "")
def njac(scope: Scope) -> Expr:
    """How many Jacobians this analysis has evaluated up to the output time. Only in REQUEST.

    It is a number of the integrator of this program, and another one with another method or ERROR.
    Unit: none.  Source: Adams/Solver function NJAC.
    """
    return _number(scope, "NJAC")


@function("NRHS", "")
def nrhs(scope: Scope) -> Expr:
    """How many residuals this analysis has evaluated up to the output time. Only in REQUEST.

    It is a number of the integrator of this program, and another one with another method or ERROR.
    Unit: none.  Source: Adams/Solver function NRHS.
    """
    return _number(scope, "NRHS")
