"""The type of a rule: it takes a deck and yields diagnostics."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence

from adamslite.deck.deck import Deck
from adamslite.deck.statement_diagnostics import diagnose
from adamslite.language.diagnostics import Diagnostic
from adamslite.language.statement import Statement

Rule = Callable[[Deck], Iterator[Diagnostic]]
NEEDS: dict[Rule, tuple[str, ...]] = {}
"""Keywords of the statements from whose absence a rule draws conclusions."""


def apply(rules: Sequence[Rule], deck: Deck) -> Iterator[Diagnostic]:
    """What the rules say; those that need statements which could not be read are left out."""
    for rule in rules:
        if not deck.incomplete.intersection(NEEDS.get(rule, ())):
            yield from rule(deck)


def needs(*keywords: str) -> Callable[[Rule], Rule]:
    """Mark a rule that draws conclusions from what is absent."""

    def mark(rule: Rule) -> Rule:
        NEEDS[rule] = keywords
        return rule

    return mark


def positive(statement: Statement, *fields: str) -> Iterator[Diagnostic]:
    """Complain of fields that are given and not above zero."""
    for field in fields:
        value = getattr(statement, field)
        if value is not None and value <= 0:
            yield diagnose(statement, "not-positive", field, word=field.upper())
