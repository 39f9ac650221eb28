"""DIFF: a first-order differential equation.

Equation::

    explicit   dy/dt = FUNCTION
    IMPLICIT   0 = FUNCTION(y, dy/dt)         y = DIF(id), dy/dt = DIF1(id)

A FUNCTION without DIF1(id) is an algebraic equation for y, often written to have the rate of an
expression: FUNCTION=e-DIF(id) gives DIF1(id) = de/dt.  y starts where it holds, and then follows

    d/dt FUNCTION = 0

    statics    0 = FUNCTION with dy/dt = 0, or y as it is with STATIC_HOLD
    elsewhere  dy/dt = 0 with DYNAMIC_HOLD
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from adamslite.elements.bases.arguments import routine_name
from adamslite.language.expression import Call, Ref
from adamslite.language.statement import Statement, expression, flag, statement, vector
from adamslite.symbolic.formulas import piecewise

if TYPE_CHECKING:
    from adamslite.language.expression import Node
    from adamslite.language.interfaces import DrawnModel
    from adamslite.symbolic.scope import Scope
    from adamslite.symbolic.types import Expr, Seen

# MODE of all analyses but statics, which have the next number.
DYNAMICS = 4


@statement("DIFF")
class Diff(Statement):
    """A user-defined state, integrated together with the mechanics."""

    ic: tuple[float, ...] = vector(
        "IC", start=True, size=1, most=2, unit="that of y, that of y per time", default=(0.0,),
        help="value of y at the start and, for IMPLICIT, a guess of dy/dt",
    )  # fmt: skip
    implicit: bool = flag("IMPLICIT", help="FUNCTION is a residual that must vanish")
    static_hold: bool = flag(
        "STATIC_HOLD", help="statics keep y; without it they find the y at which dy/dt = 0"
    )
    dynamic_hold: bool = flag("DYNAMIC_HOLD", help="y changes in statics alone")
    function: Node = expression(
        "FUNCTION", required=True, unit="that of y per time", help="dy/dt, or the residual"
    )
    routine: str | None = routine_name()
    owner: Ref | None = None
    """The statement that brings this state, and gives its rate in place of FUNCTION."""
    number: int = 0
    """Which of the states of its owner it is."""

    @property
    def restarts(self) -> bool:
        """Whether the state counts from an origin that moves, see :meth:`Scope.origin`."""
        return self.owner is not None

    def derived(self, model: DrawnModel) -> dict[str, object]:
        """The owner."""
        return {"owner": self.owner, "number": str(self.number)} if self.owner else {}

    def equation(self: Seen, scope: Scope) -> Expr:
        """dy/dt - FUNCTION, or FUNCTION itself."""
        state, rate = self.unknowns
        if hasattr(self, "owner"):
            return rate - self.owner.cls.state_rate(self.owner, scope, int(self.number), state)
        residual = self.function if self.implicit else rate - self.function
        if not self.dynamic_hold and rate in scope.slope.symbols(residual):
            return residual
        moving = rate if self.dynamic_hold else scope.derivative(residual)
        return piecewise((residual, scope.mode > DYNAMICS), otherwise=moving)

    @property
    def result_names(self) -> tuple[str, ...]:
        """The state itself has no suffix; one with an owner is written by that."""
        return () if self.owner else ("",)

    def outputs(self, model: DrawnModel) -> list[Node]:
        """Values of ``result_names``."""
        return [Call("DIF", (Ref("DIFF", self.key),))]
