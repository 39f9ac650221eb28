"""Choice between expressions."""

from __future__ import annotations

from adamslite.language.function import function
from adamslite.symbolic.formulas import piecewise
from adamslite.symbolic.scope import Scope
from adamslite.symbolic.types import Expr


@function("IF", "e:number: a:number b:number c:number", edges=lambda e, a, b, c: (e,), order=-1)
def if_(scope: Scope, e: Expr, a: Expr, b: Expr, c: Expr) -> Expr:
    """a where e < 0, b where e = 0, c where e > 0.

    Unit: that of a, b and c.  Source: Adams/Solver function IF.
    """
    return piecewise((a, e < 0), (c, e > 0), otherwise=b, order=-1)
