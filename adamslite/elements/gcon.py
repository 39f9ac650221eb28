"""GCON: a constraint given by an expression.

Equation::

    FUNCTION = 0
"""

from __future__ import annotations

from adamslite.expression import Node
from adamslite.statement import Statement, expression, statement


@statement("GCON")
class Gcon(Statement):
    """Makes an expression in displacements (holonomic) or velocities (nonholonomic) vanish."""

    function: Node = expression(
        "FUNCTION", required=True, unit="the user's", help="what is kept at zero"
    )
