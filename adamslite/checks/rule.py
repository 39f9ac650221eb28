"""What rules are made of: a rule takes a deck and yields diagnostics."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from typing import TYPE_CHECKING, Any

from adamslite.language.diagnostics import Diagnostic
from adamslite.language.messages import compose
from adamslite.language.statement import Statement

if TYPE_CHECKING:
    from adamslite.deck.deck import Deck

Rule = Callable[["Deck"], Iterator[Diagnostic]]


def apply(rules: Sequence[Rule], deck: Deck) -> Iterator[Diagnostic]:
    """What the rules say; those that need statements which could not be read are left out."""
    for rule in rules:
        if not deck.incomplete.intersection(getattr(rule, "needs", ())):
            yield from rule(deck)


def needs(*keywords: str) -> Callable[[Rule], Rule]:
    """Mark a rule that draws conclusions from what is absent."""

    def mark(rule: Rule) -> Rule:
        rule.needs = keywords
        return rule

    return mark


def say(statement: Statement, code: str, field: str = "", **words: Any) -> Diagnostic:
    """A message about a statement, or about one of its arguments."""
    spans = statement.spans.home(field)
    span = spans[field] if field in spans else spans.whole
    source_line = spans.source.line(span.line) if spans.source else ""
    return compose(code, span, source_line, label=statement.label, **words)


def positive(statement: Statement, *fields: str) -> Iterator[Diagnostic]:
    """Complain of fields that are given and not above zero."""
    for field in fields:
        value = getattr(statement, field)
        if value is not None and value <= 0:
            yield say(statement, "not-positive", field, word=field.upper())
