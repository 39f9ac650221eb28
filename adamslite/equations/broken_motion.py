"""A motion that no mechanism can follow: what drives a constraint jumps, or has no value."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

if TYPE_CHECKING:
    from adamslite.language.statement import Statement


class Break(NamedTuple):
    """Where a run cannot continue: statement, time, and what becomes of which quantity."""

    statement: Statement
    time: float
    quantity: str
    how: str
