"""GCON: a constraint given by an expression.

Equation::

    FUNCTION = 0
"""

from __future__ import annotations

from typing import Any

from adamslite.expression import Call, Node, Ref, walk
from adamslite.statement import Statement, expression, statement
from adamslite.symbolic import Scope

# Measures of velocity: a GCON that uses one constrains velocities only.
RATES = frozenset(("VM", "VR", "VX", "VY", "VZ", "WM", "WX", "WY", "WZ"))


@statement("GCON")
class Gcon(Statement):
    """Makes an expression in displacements (holonomic) or velocities (nonholonomic) vanish."""

    function: Node = expression(
        "FUNCTION", required=True, unit="the user's", help="what is kept at zero"
    )

    @property
    def n_rows(self) -> int:
        """Constraint equations."""
        return 1

    @property
    def row_names(self) -> tuple[str, ...]:
        """What the row keeps at zero."""
        return ("FUNCTION",)

    def is_rate(self, model: Any) -> bool:
        """Whether FUNCTION measures velocities, itself or through variables."""
        pending, seen = [self.function], set()
        while pending:
            for node in walk(pending.pop()):
                if isinstance(node, Call) and node.name in RATES:
                    return True
                if isinstance(node, Ref) and node.kind == "VARIABLE" and node.id not in seen:
                    seen.add(node.id)
                    pending.append(model.variable(node.id).function)
        return False

    def constraints(self, scope: Scope) -> list[Any]:
        """The row that vanishes."""
        return [self.function]

    @property
    def result_names(self) -> tuple[str, ...]:
        """``f``: the strength of the constraint, see the function GCON."""
        return ("f",)

    def outputs(self, model: Any) -> list[Node]:
        """Values of ``result_names``."""
        return [Call("GCON", (Ref("GCON", self.key),))]
