"""A diagnostic about a statement or one of its arguments."""

from __future__ import annotations

from typing import Any

from adamslite.deck.redefinition import Redefinition
from adamslite.language.diagnostics import Diagnostic, Span
from adamslite.language.messages import compose
from adamslite.language.statement import Statement


def diagnose(
    statement: Statement | Redefinition[Any],
    code: str,
    field: str = "",
    hint: str = "",
    **words: object,
) -> Diagnostic:
    """A message about a statement, or about one of its arguments."""
    spans = statement.spans.home(field)
    span = place_of(statement, field)
    return compose(code, span, spans.first_line(span), hint, label=statement.label, **words)


def place_of(statement: Statement | Redefinition[Any], field: str = "") -> Span:
    """Where one of the arguments stands, as far as it does; else the whole statement."""
    spans = statement.spans.home(field)
    return spans[field] if field in spans else spans.whole
