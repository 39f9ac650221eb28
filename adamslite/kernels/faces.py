"""What a statement contributes to the equations: its faces, each computed by kernels of its own."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from adamslite.deck.counted_turns import counted
from adamslite.elements.bases.constraint import Constraint
from adamslite.kernels.groups import LEVELS

if TYPE_CHECKING:
    from adamslite.language.statement import Statement
    from adamslite.model.model import Model


def faces(statement: Statement, model: Model) -> Iterator[str]:
    """What a statement contributes; switched off, it still counts turns for when it is on again."""
    if not model.acts(statement):
        if counted(statement):
            yield "counted"
        if isinstance(statement, Constraint) and statement.counts_from_start:
            yield "since start"
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
