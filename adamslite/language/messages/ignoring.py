"""Comments ``! adamslite: ignore CODE, CODE``: messages that the author of a deck has judged.

A comment works on the statement or argument that is on its own line.  It never hides an error.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Collection, Iterable, Iterator
from dataclasses import replace
from functools import cache

from adamslite.language.diagnostics import (
    ERROR,
    MOST,
    SEVERITIES,
    Diagnostic,
    LeftOut,
    Source,
    Span,
)
from adamslite.language.likeness import did_you_mean
from adamslite.language.messages import MESSAGES, compose
from adamslite.language.messages.fixes import fixes
from adamslite.language.messages.needless import NEEDLESS
from adamslite.language.text import Ignored, ignored

# What is known only when deck and commands have been read, or is reported by `check` alone.
WHOLE = ("no-run", *NEEDLESS)


def without_ignored(source: Source, diagnostics: Iterable[Diagnostic]) -> list[Diagnostic]:
    """What is left to say once the comments of a source have been heeded."""
    wanted = {(each.code, each.line) for each in ignored(source)}
    return _heeded(source, diagnostics, wanted, set()) if wanted else list(diagnostics)


def judged(source: Source, diagnostics: Iterable[Diagnostic], complete: bool) -> list[Diagnostic]:
    """As :func:`without_ignored`, with what there is to say about the comments themselves.

    Parameters
    ----------
    source : Source
    diagnostics : iterable of Diagnostic
        Those about other files stay as they are.
    complete : bool
        Whether these are all there can be: then a comment that ignores none of them is reported.
    """
    comments = list(ignored(source))
    used: set[tuple[str, int]] = set()
    wanted = {(each.code, each.line) for each in comments}
    left = _heeded(source, diagnostics, wanted, used) if wanted else list(diagnostics)
    about = [(each, code) for each in comments if (code := _mistake(each, complete, used))]
    left += [_about(source, each, code) for each, code in about[:MOST]]
    others = Counter(MESSAGES[code].severity for _, code in about[MOST:])
    return [*left, LeftOut.of(others[each] for each in SEVERITIES)] if others else left


def _mistake(each: Ignored, complete: bool, used: Collection[tuple[str, int]]) -> str:
    """The code of what there is to say about a comment."""
    entry = MESSAGES.get(each.code)
    if entry and entry.severity == ERROR:
        return "ignored-error"
    needless = complete and each.code not in WHOLE and (each.code, each.line) not in used
    return "ignores-nothing" if needless else ""


def _heeded(
    source: Source,
    diagnostics: Iterable[Diagnostic],
    wanted: set[tuple[str, int]],
    used: set[tuple[str, int]],
) -> list[Diagnostic]:
    """What is not wanted to be ignored; ``used`` gets what was found to ignore."""
    return [kept for each in diagnostics if (kept := _kept(source, each, wanted, used))]


def _kept(
    source: Source,
    diagnostic: Diagnostic,
    wanted: set[tuple[str, int]],
    used: set[tuple[str, int]],
) -> Diagnostic | None:
    """The message at the places that are not ignored; None where there are none."""
    if diagnostic.is_error:
        return diagnostic
    kept = []
    for place in diagnostic.everywhere:
        heeded = wanted.intersection(_lines(source, diagnostic.code, place))
        used |= heeded
        if not heeded:
            kept.append(place)
    if not kept:
        return None
    if kept[0] == diagnostic.span:
        return replace(diagnostic, places=tuple(kept)) if diagnostic.places else diagnostic
    line, column = source.quote(kept[0])
    return replace(
        diagnostic, span=kept[0], places=tuple(kept), source_line=line, source_column=column
    )


def _lines(source: Source, code: str, place: Span) -> Iterator[tuple[str, int]]:
    """The code on each line of a place; none where the place is in another file."""
    if place.file == source.file:
        for line in range(place.line, place.end_line + 1):
            yield code, line


@cache
def _meant(code: str) -> str:
    """What to write in place of something that is no code."""
    if not code:
        return "name the codes after it: ! adamslite: ignore CODE, CODE"
    return did_you_mean(code, MESSAGES).lower() or "no message has this code"


def _about(source: Source, each: Ignored, code: str) -> Diagnostic:
    hint = "" if each.code in MESSAGES else _meant(each.code)
    span = source.span(each.start, each.end)
    found = compose(code, span, source.quote(span), hint, word=each.code or "code")
    return replace(found, fixes=fixes(code, source, each.start, each.end, hint))
