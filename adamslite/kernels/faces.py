"""What a statement contributes to the equations: its faces, each computed by kernels of its own."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from adamslite.elements.bases.constraint import Constraint
from adamslite.kernels.groups import LEVELS
from adamslite.language.expression import calls
from adamslite.language.statement import expressions

if TYPE_CHECKING:
    from adamslite.language.expression import Call
    from adamslite.language.statement import Statement
    from adamslite.model.model import Model

ANGLES = ("AX", "AY", "AZ", "INCANG")
"""Functions that count full turns."""


def faces(statement: Statement, model: Model) -> Iterator[str]:
    """What a statement contributes; switched off, it still counts turns for when it is on again."""
    if not model.acts(statement):
        if counted(statement):
            yield "counted"
        return
    if model.merges(statement):
        return
    if hasattr(statement, "loads"):
        yield "loads"
    if isinstance(statement, Constraint):
        rate = statement.is_rate(model)
        yield from ("reactions", "velocity", "acceleration") if rate else LEVELS
    if hasattr(statement, "relation"):
        yield "sensor"
    if hasattr(statement, "equation"):
        kind = model.variable_kind(statement.key) if statement.keyword == "VARIABLE" else "loop"
        if kind != "inline":
            yield "equation" if kind == "loop" else "signal"


def output_face(statement: Statement) -> Iterator[str]:
    """The values that it writes, if there are any."""
    if statement.result_names:
        yield "output"


def counted(statement: Statement) -> list[Call]:
    """The measures in its expressions that count full turns."""
    return [call for each in expressions(statement) for call in calls(each, *ANGLES)]
