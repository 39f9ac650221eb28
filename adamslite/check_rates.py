"""A rule about equations that cannot be formed: rates of what has none, forces of themselves."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from adamslite.diagnostics import Diagnostic
from adamslite.expression import calls, expressions
from adamslite.functions.forces import MEASURES, NET
from adamslite.statement import Statement

if TYPE_CHECKING:
    from adamslite.deck import Deck

# Functions without a rate, or with one that depends on what they measure.
RATELESS = (
    "VARVAL", "DIF", "DIF1", "ACCM", "ACCX", "ACCY", "ACCZ", "WDTM", "WDTX", "WDTY", "WDTZ",
)  # fmt: skip


def unformed_equations(deck: Deck) -> Iterator[Diagnostic]:
    """Forces that depend on themselves, rates of what has none."""
    suspects = [each for each in deck.statements if _is_suspect(each)]
    if suspects:
        from adamslite.compiled import unformed
        from adamslite.model import Model

        yield from unformed(Model(deck), suspects)


def _is_suspect(statement: Statement) -> bool:
    """Whether it takes rates of more than places and TIME, or measures forces with forces."""
    asked = ("DDT",)
    if hasattr(statement, "constraints"):
        asked += RATELESS
    if hasattr(statement, "loads") or statement.keyword == "GCON":
        asked += (*MEASURES.values(), *NET)
    return any(next(calls(node, *asked), None) for node in expressions(statement))
