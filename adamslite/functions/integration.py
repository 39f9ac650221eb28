"""Numbers of the integrator, as a record at an output time has them."""

from __future__ import annotations

from adamslite.language.function import function
from adamslite.language.method import NUMBERS
from adamslite.symbolic.scope import Scope
from adamslite.symbolic.types import Expr


def _number(name: str, place: int) -> None:
    """Register the function of the number at a place."""
    what, unit = NUMBERS[name]

    def number(scope: Scope) -> Expr:
        return scope.symbol("run", place)

    number.__doc__ = f"""{what} Only in REQUEST.

    It is a number of the integrator of this program, and another one with another method or ERROR.
    Unit: {unit}.  Source: Adams/Solver function {name}.
    """
    function(name, "")(number)


for _place, _name in enumerate(NUMBERS):
    _number(_name, _place)
