"""A diagnostic about a statement or one of its arguments."""

from __future__ import annotations

from typing import Any

from adamslite.deck.redefinition import Redefinition
from adamslite.language.diagnostics import Diagnostic
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
    span = spans[field] if field in spans else spans.whole
    return compose(code, span, spans.first_line(span), hint, label=statement.label, **words)
