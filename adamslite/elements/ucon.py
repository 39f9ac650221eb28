"""UCON: a constraint by a routine of the user.

Equation::

    FUNCTION = 0

It is a GCON with the same FUNCTION, ``GCON/UCON_id``, whose multiplier is in the results.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from adamslite.elements.bases.arguments import routine_name
from adamslite.language.statement import STATEMENTS, Statement, expression, statement

if TYPE_CHECKING:
    from adamslite.language.expression import Node
    from adamslite.language.interfaces import Lookup


@statement("UCON")
class Ucon(Statement):
    """A relation between displacements, or between velocities, that is not in the deck.

    ``--user`` binds a function of Python to it, whose ``reads`` name what it relates.
    """

    function: Node = expression(
        "FUNCTION", required=True, unit="the user's", help="USER(...), a routine that vanishes"
    )
    routine: str | None = routine_name()

    def companions(self, deck: Lookup) -> tuple[Statement, ...]:
        """The constraint."""
        name = f"{self.keyword}_{self.key}"
        return (STATEMENTS["GCON"](id=name, function=self.function, spans=self.spans),)
