"""USER: a number that a program outside the deck computes."""

from __future__ import annotations

from adamslite.language.function import function
from adamslite.symbolic.routines import routine_value
from adamslite.symbolic.scope import Scope
from adamslite.symbolic.types import Expr


@function("USER", "*parameters:number[0..30]")
def user(scope: Scope, routine: int, component: int, *inputs: Expr) -> Expr:
    """What a routine returns that is no part of the deck; only as the whole of FUNCTION.

    The parameters, 30 numbers at most, go to the routine. ``--user`` binds numbers or a function
    of Python to it, for a statement or for all that call it; see
    docs/how-to/user-routines.md. Without them every routine that is missing is reported, with its
    calls; a REQUEST is left out.
    Unit: that of FUNCTION.  Source: Adams/Solver function USER.
    """
    return routine_value(scope, routine, component, inputs)
