"""VARIABLE: an algebraic unknown.

Equation::

    V - FUNCTION = 0
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from adamslite.elements.bases.arguments import routine_name
from adamslite.language.expression import Call, Ref
from adamslite.language.statement import Statement, expression, number, statement

if TYPE_CHECKING:
    from adamslite.language.expression import Node
    from adamslite.language.interfaces import DrawnModel
    from adamslite.symbolic.scope import Scope
    from adamslite.symbolic.types import Expr, Seen


@statement("VARIABLE")
class Variable(Statement):
    """A quantity with a name: ``VARVAL(id)`` in expressions, or just its name.

    It may depend on any quantity, also on itself; loops are solved together with the mechanics.
    """

    ic: float = number(
        "IC",
        start=True,
        unit="that of FUNCTION",
        default=0.0,
        help="first guess where a loop must be solved",
    )
    function: Node = expression(
        "FUNCTION", required=True, unit="the user's", help="what the variable equals"
    )
    routine: str | None = routine_name()

    def equation(self: Seen, scope: Scope) -> Expr:
        """V - FUNCTION, for a variable that has to be solved for."""
        return self.unknowns[0] - self.function

    @property
    def result_names(self) -> tuple[str, ...]:
        """The variable itself has no suffix."""
        return ("",)

    def outputs(self, model: DrawnModel) -> list[Node]:
        """Values of ``result_names``."""
        return [Call("VARVAL", (Ref("VARIABLE", self.key),))]
