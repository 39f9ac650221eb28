"""Values of the deck's own variables and differential equations."""

from __future__ import annotations

from adamslite.language.function import function
from adamslite.symbolic.scope import Scope
from adamslite.symbolic.types import Expr, Tree


@function("VARVAL", "id:variable")
def varval(scope: Scope, id: Tree) -> Expr:
    """Present value of VARIABLE id.

    Unit: that of the variable.  Source: Adams/Solver function VARVAL.
    """
    return scope.statement(id).value


@function("DIF", "id:diff")
def dif(scope: Scope, id: Tree) -> Expr:
    """State of DIFF id.

    Unit: that of the state.  Source: Adams/Solver function DIF.
    """
    return scope.statement(id).state


@function("DIF1", "id:diff")
def dif1(scope: Scope, id: Tree) -> Expr:
    """Time derivative of the state of DIFF id.

    Unit: that of the state, per time.  Source: Adams/Solver function DIF1.
    """
    return scope.statement(id).rate


@function("DDT", "id:variable")
def ddt(scope: Scope, id: Tree) -> Expr:
    """Total time derivative of VARIABLE id, formed from its expression.

    Unit: that of the variable, per time.  Source: an extension; the meaning of VARVAL(d(id)/dt).
    """
    return scope.derivative(scope.statement(id).value)


@function("SENVAL", "id:sensor")
def senval(scope: Scope, id: Tree) -> Expr:
    """EVALUATE of SENSOR id when it last ended an analysis; 0 before.

    Within an analysis it does not change; it also lasts after DEACTIVATE.
    Unit: that of EVALUATE.  Source: Adams/Solver function SENVAL.
    """
    return scope.statement(id).kept
