"""VARIABLE: an algebraic unknown.

Equation::

    V - FUNCTION = 0
"""

from __future__ import annotations

from adamslite.expression import Node
from adamslite.statement import Statement, expression, number, statement


@statement("VARIABLE", planned=("ROUTINE",))
class Variable(Statement):
    """A quantity with a name: ``VARVAL(id)`` in expressions, or just its name.

    It may depend on anything, itself included; loops are solved together with the mechanics.
    """

    ic: float = number(
        "IC", unit="that of FUNCTION", default=0.0, help="first guess where a loop must be solved"
    )
    function: Node = expression(
        "FUNCTION", required=True, unit="the user's", help="what the variable equals"
    )
