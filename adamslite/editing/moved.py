"""Messages of an earlier text at their lines in a later one, until they are found anew."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace

from adamslite.language.diagnostics import Diagnostic, Source, Span


def moved(diagnostics: Iterable[Diagnostic], old: Source, new: Source) -> list[Diagnostic]:
    """The messages about lines that are in both texts; without what they refer to elsewhere."""
    found = [*diagnostics]
    if not found:
        return []
    head, tail = same_lines(old.text.split("\n"), new.text.split("\n"))
    end, shift = len(old.starts) - tail, len(new.starts) - len(old.starts)
    kept = []
    for each in found:
        places = [_moved(span, head, end, shift) for span in each.everywhere]
        if all(places):
            known = tuple(filter(None, places))
            more = known if each.places else ()
            kept.append(replace(each, span=known[0], places=more, related=(), fixes=()))
    return kept


def same_lines(before: list[str], after: list[str]) -> tuple[int, int]:
    """How many lines at the beginning and at the end are the same."""
    least = min(len(before), len(after))
    head = next((n for n in range(least) if before[n] != after[n]), least)
    rest = least - head
    tail = next((n for n in range(rest) if before[-1 - n] != after[-1 - n]), rest)
    return head, tail


def _moved(span: Span, head: int, end: int, shift: int) -> Span | None:
    """The span in the new text; None where it touches lines that have changed."""
    if span.end_line <= head:
        return span
    if span.line > end:
        return replace(span, line=span.line + shift, end_line=span.end_line + shift)
    return None
