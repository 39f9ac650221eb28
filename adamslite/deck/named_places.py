"""Places of the statements that messages name: the other markers, the first definition."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from dataclasses import replace
from functools import cache
from typing import TYPE_CHECKING

from adamslite.language.diagnostics import Related
from adamslite.language.interfaces import key_of
from adamslite.language.messages import MESSAGES

if TYPE_CHECKING:
    from adamslite.deck.deck import Deck
    from adamslite.language.diagnostics import Diagnostic, Span
    from adamslite.language.interfaces import Key

LABEL = re.compile(r"\b([A-Z]\w*)/(\w[\w.]*)")
HEADER = re.compile(r"[^,!;\n]*")
MOST = 8
"""Places that are related to one message, at most."""


def with_named(deck: Deck, diagnostics: Iterable[Diagnostic]) -> list[Diagnostic]:
    """The messages with the places of the statements of ``deck`` that they name."""
    return [_with_named(deck, each) for each in diagnostics]


def _with_named(deck: Deck, each: Diagnostic) -> Diagnostic:
    if each.places or not each.span.line:
        return each
    known = {related.span for related in each.related}
    found = [r for r in _named(deck, each) if r.span not in known and not _is_at(each.span, r.span)]
    return replace(each, related=(*each.related, *found[:MOST])) if found else each


def _named(deck: Deck, each: Diagnostic) -> Iterator[Related]:
    """Other statements whose label is in the message, or in its hint but for examples there."""
    examples = _examples(each.code)
    for kind, word in dict.fromkeys(LABEL.findall(f"{each.message} {each.hint}")):
        key: Key = key_of(word.rstrip(".").upper())
        start = deck.names.ids.get(kind, {}).get(key)
        if start is None or (kind, word) in examples or _is_own(deck, kind, key, each.span):
            continue
        header = HEADER.match(deck.source.text, start)
        assert header
        end = start + len(header[0].rstrip())
        yield Related(deck.source.span(start, end), f"{kind}/{word}")


@cache
def _examples(code: str) -> frozenset[tuple[str, str]]:
    """Labels that are always part of a message."""
    entry = MESSAGES.get(code)
    return frozenset(LABEL.findall(f"{entry.sentence} {entry.hint}")) if entry else frozenset()


def _is_own(deck: Deck, kind: str, key: Key, span: Span) -> bool:
    """Whether a span is part of that statement."""
    statement = deck.find(kind, key)
    whole = statement.span if statement else None
    return bool(
        whole
        and whole.file == span.file
        and (whole.line, whole.column) <= (span.line, span.column)
        and (span.end_line, span.end_column) <= (whole.end_line, whole.end_column)
    )


def _is_at(span: Span, other: Span) -> bool:
    return (span.file, span.line, span.column) == (other.file, other.line, other.column)
