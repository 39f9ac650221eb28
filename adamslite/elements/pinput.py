"""PINPUT: inputs of the linearised model.

Equation (V the VARIABLEs, see LINEAR)::

    u = (V1, V2, ...),     V_n = PINVAL(id, n)
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from adamslite.language.expression import Call, Ref
from adamslite.language.statement import Statement, references, statement

if TYPE_CHECKING:
    from adamslite.language.expression import Node


@statement("PINPUT")
class Pinput(Statement):
    """Variables that are inputs into the model for LINEAR/STATEMAT."""

    variables: tuple[int | str, ...] = references(
        "VARIABLES", to="VARIABLE", required=True, help="the variables, in the order of the inputs"
    )

    def numbered(self) -> tuple[Node, ...]:
        """The values."""
        return tuple(Call("VARVAL", (Ref("VARIABLE", key),)) for key in self.variables)
