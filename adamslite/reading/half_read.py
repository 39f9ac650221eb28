"""Statements some of whose arguments have mistakes, and what rules say of the others.

No other statement sees such a statement, as long as it is not corrected.  So that its other
mistakes are reported with the first one, the rules are asked once more about the deck with each of
them: a rule that asks for a value which could not be read says no more, and what it has said before
counts where it is about this statement.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator, Sequence
from typing import NoReturn

from adamslite.checks.rule import Rule, apply
from adamslite.deck.deck import Deck
from adamslite.language.diagnostics import Diagnostic, Span
from adamslite.language.statement import Statement

# Statements that rules are asked about, all decks together: a large deck is asked less often.
MOST = 50_000
# Characters of the text that take a rule as long as a statement.
LETTERS = 200


class Unread(Exception):
    """A value that could not be read was asked for."""


def half_read(
    cls: type[Statement], values: dict[str, object], unread: Collection[str]
) -> Statement:
    """A statement without the values of the fields ``unread``."""

    def missing(self: Statement) -> NoReturn:
        raise Unread

    def given(self: Statement, field_name: str) -> bool:
        if field_name in unread and field_name not in self.spans:
            raise Unread
        return field_name in self.spans

    members: dict[str, object] = dict.fromkeys(unread, property(missing))
    return type(cls.__name__, (cls,), {**members, "given": given})(**values)


def further_mistakes(
    statements: Iterable[Statement], rules: Sequence[Rule], deck: Deck
) -> Iterator[Diagnostic]:
    """What rules say of statements that are not in the deck because they are read in part only."""
    cost = max(1, len(deck.own) + len(deck.source.text) // LETTERS)
    for each in list(statements)[: max(1, MOST // cost)]:
        try:
            larger = deck.with_one(each)
        except Unread:  # what it brings with it
            continue
        for rule in rules:
            yield from _before_unread(rule, larger, each.span)


def _before_unread(rule: Rule, deck: Deck, place: Span) -> Iterator[Diagnostic]:
    """What a rule says of the statement at a place until it asks for what could not be read."""
    try:
        for found in apply([rule], deck):
            if _is_inside(found.span, place):
                yield found
    except Unread:
        return


def _is_inside(span: Span, whole: Span) -> bool:
    first, last = (whole.line, whole.column), (whole.end_line, whole.end_column)
    return (
        span.file == whole.file
        and first <= (span.line, span.column)
        and (span.end_line, span.end_column) <= last
    )
