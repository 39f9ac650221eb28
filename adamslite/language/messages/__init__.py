"""All messages about a deck: one table of sentences, hints and broken decks.

The same table is behaviour (:class:`Log` looks messages up in it), test (every broken deck yields
its code) and manual page.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Protocol

from adamslite.language.diagnostics import (
    CUT,
    ERROR,
    MOST,
    NO_QUOTE,
    QUOTED,
    SEVERITIES,
    Diagnostic,
    Fix,
    LeftOut,
    Quote,
    Related,
    Source,
    Span,
)
from adamslite.language.interfaces import Key
from adamslite.language.likeness import Guesses
from adamslite.language.messages.arguments import ARGUMENTS
from adamslite.language.messages.constraints import CONSTRAINTS
from adamslite.language.messages.entry import Message
from adamslite.language.messages.expressions import EXPRESSIONS
from adamslite.language.messages.fixes import fixes
from adamslite.language.messages.lints import LINTS
from adamslite.language.messages.model import MODEL
from adamslite.language.messages.needless import NEEDLESS
from adamslite.language.messages.routines import ROUTINES
from adamslite.language.messages.runs import RUNS
from adamslite.language.messages.shapes import SHAPES
from adamslite.language.messages.statements import STATEMENTS
from adamslite.language.messages.systems import SYSTEMS
from adamslite.language.messages.tables import TABLES
from adamslite.language.not_supported import INSTEAD
from adamslite.language.text import ignored
from adamslite.notation import shown, visible

MESSAGES: dict[str, Message] = (
    STATEMENTS
    | ARGUMENTS
    | EXPRESSIONS
    | MODEL
    | CONSTRAINTS
    | SHAPES
    | LINTS
    | NEEDLESS
    | TABLES
    | SYSTEMS
    | ROUTINES
    | RUNS
)

ALIKE = {"PART": "POINT_MASS", "POINT_MASS": "PART", "VARIABLE": "DIFF", "DIFF": "VARIABLE"}
"""Which kind of statement is easily written for which."""

LEAST_GUESSED = 100
"""Numbers of one or two digits are all alike: those that there are say more than a guess."""
MOST_LISTED = 6
LISTS = ("known", "listed", "labels", "bound")
"""Words of messages that are lists."""
LONGEST_LIST = 1000

MOST_COUNTED = 100_000
"""Errors beyond those that are kept, after which a text is not read on."""

START = """a deck to add broken statements to
PART/1, GROUND
MARKER/1, PART=1
PART/2, MASS=1, CM=2, IP=1,1,1
MARKER/2, PART=2
POINT_MASS/3, MASS=1
MARKER/3, POINT_MASS=3
"""


def compose(
    code: str, span: Span, quote: Quote = NO_QUOTE, hint: str = "", **words: object
) -> Diagnostic:
    """The message ``code`` with its words filled in; ``hint=`` replaces the hint of the table."""
    message = MESSAGES[code]
    words = {name: shortened(name, word) for name, word in words.items()}
    sentence, hint = message.sentence.format(**words), hint or message.hint.format(**words)
    hint = str(shortened("known", hint))
    sentence, hint = visible(shown(sentence)), visible(shown(hint))
    return Diagnostic(code, message.severity, sentence, span, hint, *quote)


def shortened(name: str, word: object) -> object:
    """A word of a message, without its middle where it is longer than anybody reads."""
    most = LONGEST_LIST if name in LISTS else QUOTED
    if not isinstance(word, str) or len(word) <= most:
        return word
    half = (most - 1) // 2
    return f"{word[:half]}{CUT}{word[-half:]}"


@dataclass
class _Tally:
    places: list[tuple[int, int]]
    hint: str
    words: dict[str, object]


class KnownNames(Protocol):
    """Ids and names of the statements of a deck, :class:`adamslite.deck.names.Names`."""

    @property
    def ids(self) -> Mapping[str, Mapping[Key, object]]: ...

    def find(self, kind: str, word: Key) -> Key | list[Key] | None:
        """The id that a word means; a list when several do."""

    def known(self, kind: str) -> list[str]:
        """Everything that may be written for a statement of this kind."""


class Log:
    """Collects the messages about one source: so many of each severity, and the number of others.

    Warnings and notes that comments of the source ignore are kept besides: what is left to say
    without them is found out in the end.
    """

    def __init__(self, source: Source) -> None:
        self.source = source
        self.diagnostics: list[Diagnostic] = []
        self.guesses = Guesses()
        self.last_line = 0
        """Where reading ended because of too many mistakes; 0 where it did not."""
        self._tallies: dict[tuple[str, str], _Tally] = {}
        self._errors = 0
        self._said = 0
        self._kept = dict.fromkeys(SEVERITIES, 0)
        self._left = dict.fromkeys(SEVERITIES, 0)

    @property
    def errors(self) -> int:
        """How many errors there were so far; those reported once per kind count each time."""
        return self._errors

    @property
    def full(self) -> bool:
        """Whether further errors are only counted."""
        return self._kept[ERROR] >= MOST

    @property
    def overflows(self) -> bool:
        """Whether so many errors are only counted that there is no use in counting further."""
        return self._left[ERROR] >= MOST_COUNTED

    @property
    def count(self) -> int:
        """How many messages there were so far, with those that are not kept."""
        return self._said

    def add(self, code: str, start: int, end: int, hint: str = "", **words: object) -> None:
        """Say ``code`` about the characters from ``start`` to ``end``."""
        self.say(code, (start, end), words, hint)

    def say(
        self,
        code: str,
        place: tuple[int, int],
        words: Mapping[str, object],
        hint: str = "",
        first: tuple[int, int] | None = None,
        fix: Fix | None = None,
    ) -> None:
        """The same with the offsets of what is there already, or a correction of its own."""
        start, end = place
        if not self._has_room(code, MESSAGES[code].severity, lambda: self._lines(start, end)):
            return
        span = self.source.span(start, end)
        found = compose(code, span, self.source.quote(span), hint, **words)
        corrections = fixes(code, self.source, start, end, found.hint)
        if first or fix or corrections:
            related = (Related(self.source.span(*first), "the first one"),) if first else ()
            every = (fix, *corrections) if fix else corrections
            found = replace(found, related=related, fixes=every)
        self.diagnostics.append(found)

    def _has_room(self, code: str, severity: str, lines: Callable[[], Iterable[int]]) -> bool:
        """Count a message about some lines; whether it is kept."""
        self._errors += severity == ERROR
        self._said += 1
        if severity != ERROR and self._ignored:
            if any((code, line) in self._ignored for line in lines()):
                return True
        kept = self._kept[severity] < MOST
        (self._kept if kept else self._left)[severity] += 1
        return kept

    def _lines(self, start: int, end: int) -> range:
        """The lines of the characters from ``start`` to ``end``."""
        return range(self.source.place(start)[0], self.source.place(end)[0] + 1)

    @cached_property
    def _ignored(self) -> set[tuple[str, int]]:
        """Codes that comments ignore, with their lines."""
        return {(each.code, each.line) for each in ignored(self.source)}

    def take(self, diagnostic: Diagnostic) -> None:
        """A message that is made elsewhere."""
        span = diagnostic.span
        lines = range(span.line, span.end_line + 1) if span.file == self.source.file else ()
        if self._has_room(diagnostic.code, diagnostic.severity, lambda: lines):
            self.diagnostics.append(diagnostic)

    def tally(self, code: str, kind: str, start: int, end: int, **words: object) -> None:
        """Say ``code`` once for each ``kind``, at its first place, with the number of places."""
        self._errors += 1
        known = self._tallies.get((code, kind))
        if known:
            known.places.append((start, end))
        else:
            self._tallies[code, kind] = _Tally([(start, end)], INSTEAD.get(kind, ""), words)

    def missing(self, names: KnownNames, kind: str, key: Key, start: int, end: int) -> None:
        """Say that a statement is referred to and does not exist."""
        other = ALIKE.get(kind)
        if other and names.find(other, key) is not None:
            hint = f"there is a {other}/{key}"
        elif isinstance(key, int) and key < LEAST_GUESSED:
            known = names.ids.get(kind, ())
            listed = ", ".join(map(str, known)) if 0 < len(known) <= MOST_LISTED else ""
            hint = f"there is {kind}/{listed}" if listed else ""
        else:
            hint = self.guesses.meant(str(key), kind, lambda: names.known(kind))
        self.add("missing-reference", start, end, kind=kind, key=key, hint=hint)

    def finish(self) -> list[Diagnostic]:
        """Every message that is kept, also those that are reported once per kind; the last one
        says how many there are besides.
        """
        for (code, _), tally in self._tallies.items():
            count = len(tally.places)
            times = "" if count == 1 else f" ({count} times, first here)"
            span, *others = (self.source.span(*place) for place in tally.places)
            words = {"times": times, **tally.words}
            found = compose(code, span, self.source.quote(span), tally.hint, **words)
            self.diagnostics.append(replace(found, places=(span, *others)))
        self._tallies = {}
        left = self._left.values()
        if not any(left):
            return self.diagnostics
        return [*self.diagnostics, LeftOut.of(left, self.last_line)]
