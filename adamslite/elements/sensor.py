"""SENSOR: ends a simulation, or the run, when an expression reaches a value.

Equation (e the FUNCTION; the first time at which it is true)::

    EQ    |e - VALUE| <= ERROR
    GE    e >= VALUE - ERROR
    LE    e <= VALUE + ERROR
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from adamslite.elements.bases.arguments import routine_name
from adamslite.language.statement import Statement, choice, expression, flag, number, statement
from adamslite.symbolic.formulas import piecewise

if TYPE_CHECKING:
    from adamslite.language.expression import Node
    from adamslite.language.interfaces import DrawnModel
    from adamslite.symbolic.scope import Scope
    from adamslite.symbolic.types import Expr, Seen


@statement("SENSOR")
class Sensor(Statement):
    """Watches an expression during dynamic analyses.

    The time at which the relation becomes true is located like the branch of an IF.  RETURN hands
    over to the next command, HALT ends the run, each with a last output there.  A relation that is
    true at the start of a SIMULATE ends it there: DEACTIVATE the sensor before.  EQ is also true
    where FUNCTION passes the whole window within a step, or jumps over it.

    Without RETURN and HALT the analysis continues from there, the integrator with its first step.
    Such a sensor acts once each time the relation becomes true, and not again within 1e-7 of the
    longest step.  Sensors that act a thousand times in a row within next to no time end the run.
    """

    function: Node = expression(
        "FUNCTION", required=True, unit="the user's", help="what is watched"
    )
    routine: str | None = routine_name()
    value: float = number(
        "VALUE", unit="that of FUNCTION", default=0.0, help="what it is compared with"
    )
    error: float = number(
        "ERROR", unit="that of FUNCTION", default=1e-3, help="how near to VALUE it has to come"
    )
    comparison: str = choice(options=("EQ", "GE", "LE"), default="EQ", help="the relation")
    evaluate: Node | None = expression(
        "EVALUATE", unit="the user's", help="SENVAL(id) from the time at which it triggers"
    )
    halt: bool = flag("HALT", help="end the run")
    returns: bool = flag("RETURN", help="end this SIMULATE; the next command follows")
    prints: bool = flag("PRINT", help="write an output at that time, as HALT and RETURN do")
    bisection: bool = flag("BISECTION", help="read, without effect: the time is located anyway")
    yydump: bool = flag("YYDUMP", inert=True, help="write the states to the message file of ADAMS")
    codgen: bool = flag("CODGEN", help="read, without effect: every start does so")
    restart: bool = flag("RESTART", help="read, without effect: the integrator restarts anyway")
    stepsize: float | None = number(
        "STEPSIZE", unit="time", help="the first step after it, where the analysis continues"
    )
    dt: float | None = number(
        "DT", unit="time", help="the output step after it, where the analysis continues"
    )

    @property
    def result_names(self) -> tuple[str, ...]:
        """evaluate: the present value of EVALUATE, of which SENVAL keeps the last."""
        return () if self.evaluate is None else ("evaluate",)

    @property
    def ends_analysis(self) -> bool:
        """Whether the analysis ends with it."""
        return self.halt or self.returns

    def outputs(self, model: DrawnModel) -> list[Node]:
        """Values of ``result_names``."""
        return [] if self.evaluate is None else [self.evaluate]

    @property
    def relation_count(self) -> int:
        """Relations of the sensor."""
        return 2 if self.comparison == "EQ" else 1

    def holds(self, value: float) -> bool:
        """Whether the sensor is true where FUNCTION has this value."""
        above, below = value >= self.value - self.error, value <= self.value + self.error
        return {"EQ": above and below, "GE": above, "LE": below}[self.comparison]

    def relation(self: Seen, scope: Scope) -> Expr:
        """A choice whose conditions are the relations, all of them true when the sensor is."""
        above = self.function >= self.value - self.error
        below = self.function <= self.value + self.error
        if self.comparison == "EQ":
            return piecewise((1, above), (2, below), otherwise=0, order=0)
        return piecewise((1, above if self.comparison == "GE" else below), otherwise=0, order=0)
