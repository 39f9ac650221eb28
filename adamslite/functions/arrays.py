"""Values that a statement lists, by their number."""

from __future__ import annotations

from adamslite.language.function import function
from adamslite.symbolic.scope import Scope
from adamslite.symbolic.types import Expr, Tree

NUMBERED = ("ARYVAL", "PINVAL", "POUVAL")
"""Functions that the reader replaces by a value of their statement, which it lists as numbered."""


@function("ARYVAL", "id:array n:constant")
def aryval(scope: Scope, id: Tree, n: int) -> Expr:
    """Value number n, from 1, of ARRAY id: a constant of IC, a VARIABLE of U, a state or output.

    Unit: that of the value.  Source: Adams/Solver function ARYVAL.
    """
    raise AssertionError("the reader puts the value in")


@function("PINVAL", "id:pinput n:constant")
def pinval(scope: Scope, id: Tree, n: int) -> Expr:
    """Value number n, from 1, of PINPUT id: that of its n-th VARIABLE.

    Unit: that of the variable.  Source: Adams/Solver function PINVAL.
    """
    raise AssertionError("the reader puts the value in")


@function("POUVAL", "id:poutput n:constant")
def pouval(scope: Scope, id: Tree, n: int) -> Expr:
    """Value number n, from 1, of POUTPUT id: that of its n-th VARIABLE.

    Unit: that of the variable.  Source: Adams/Solver function POUVAL.
    """
    raise AssertionError("the reader puts the value in")
