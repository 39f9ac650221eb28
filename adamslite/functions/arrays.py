"""Values that a statement lists, by their number."""

from __future__ import annotations

from adamslite.language.function import function
from adamslite.symbolic.scope import Scope
from adamslite.symbolic.types import Expr, Tree

NUMBERED = ("ARYVAL",)
"""Functions that the reader replaces by a value of their statement, which it lists as numbered."""


@function("ARYVAL", "id:array n:constant")
def aryval(scope: Scope, id: Tree, n: int) -> Expr:
    """Value number n, from 1, of ARRAY id: a constant of IC, a VARIABLE of U.

    Unit: that of the value.  Source: Adams/Solver function ARYVAL.
    """
    raise AssertionError("the reader puts the value in")
