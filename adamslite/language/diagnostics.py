"""Diagnostics: a message about a deck, with file, line and column.

A mistake of the user is data: a :class:`Diagnostic` with a code, one sentence, a place and a hint.
All of them are collected and raised once, as :class:`DeckError`.
"""

from __future__ import annotations

from bisect import bisect_right
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import chain
from struct import Struct, pack
from typing import Any, ClassVar, NamedTuple

from adamslite.notation import visible

ERROR = "error"
WARNING = "warning"
NOTE = "note"
SEVERITIES = (ERROR, WARNING, NOTE)

MOST = 200
"""Messages that are kept of a text; one more says how many there are besides."""
QUOTED = 200
"""Characters of a line that a message quotes, at most."""
BEFORE = 80
"""And how many of them stand before the place of the message."""
CUT = "\N{HORIZONTAL ELLIPSIS}"
"""What stands for the rest of a line."""

PAIR = Struct("<II")
"""First and last offset of something written."""
NO_RANGES: Mapping[str, tuple[int, int]] = {}


@dataclass(frozen=True, slots=True)
class Span:
    """A stretch of a file; lines and columns count from 1, ``end_column`` is one past the end."""

    file: str
    line: int
    column: int
    end_line: int
    end_column: int

    def __str__(self) -> str:
        return f"{self.file}:{self.line}:{self.column}"


NOWHERE = Span("", 0, 0, 0, 0)


class Quote(NamedTuple):
    """What a message quotes of a line, and the column that its first character has there."""

    text: str = ""
    column: int = 1


NO_QUOTE = Quote()


class Source:
    """A text with its file name; turns character offsets into lines and columns."""

    __slots__ = ("file", "text", "_starts")

    def __init__(self, text: str, file: str = "<text>") -> None:
        self.file = file
        self.text = text
        self._starts: list[int] | None = None

    @property
    def starts(self) -> list[int]:
        """Offset of the first character of each line."""
        if self._starts is None:
            starts = [0]
            find = self.text.find
            while (at := find("\n", starts[-1])) >= 0:
                starts.append(at + 1)
            self._starts = starts
        return self._starts

    def place(self, offset: int) -> tuple[int, int]:
        """Line and column (from 1) of a character offset."""
        line = bisect_right(self.starts, offset)
        return line, offset - self.starts[line - 1] + 1

    def span(self, start: int, end: int) -> Span:
        """The span of the characters ``start`` up to, not including, ``end``."""
        return Span(self.file, *self.place(start), *self.place(max(start, end)))

    def line(self, number: int) -> str:
        """The text of line ``number`` (from 1), without its end."""
        if not 1 <= number <= len(self.starts):
            return ""
        return self.text[self.starts[number - 1] : self._end(number)].rstrip("\r")

    def _end(self, number: int) -> int:
        """Offset of the end of line ``number`` (from 1)."""
        return self.starts[number] - 1 if number < len(self.starts) else len(self.text)

    def quote(self, span: Span) -> Quote:
        """What there is to quote of the line that a span begins on: all of it, or what is round
        the beginning of the span.
        """
        if not 1 <= span.line <= len(self.starts):
            return NO_QUOTE
        first, last = self.starts[span.line - 1], self._end(span.line)
        start = max(first, min(first + span.column - 1 - BEFORE, last - QUOTED))
        end = min(last, start + QUOTED)
        text = self.text[start:end]
        text = CUT + text[1:] if start > first else text
        text = text[:-1] + CUT if end < last else text
        return Quote(text, start - first + 1)


class Spans(Mapping[str, Span]):
    """The places of a statement's arguments as written, by field name; computed when needed.

    ``fields`` are their names; ``places`` holds first and last offsets of the whole statement and
    of each field as bytes, because a large deck has many.
    """

    __slots__ = ("source", "fields", "places")
    kept: ClassVar[tuple[str, ...]] = __slots__

    def __init__(
        self,
        source: Source | None = None,
        whole_range: tuple[int, int] = (0, 0),
        ranges: Mapping[str, tuple[int, int]] = NO_RANGES,
    ) -> None:
        self.source = source
        self.fields = (*ranges,)
        self.places = packed([*whole_range, *chain(*ranges.values())])

    @classmethod
    def at(cls, source: Source | None, fields: tuple[str, ...], places: bytes) -> Spans:
        """Places that are packed already."""
        made = cls.__new__(cls)
        made.source, made.fields, made.places = source, fields, places
        return made

    def __reduce__(self) -> tuple[Any, ...]:  # a third of the time that slots take by themselves
        return _restored, (type(self), *[getattr(self, name) for name in self.kept])

    @property
    def whole_range(self) -> tuple[int, int]:
        """First and last offset of the whole statement."""
        return PAIR.unpack_from(self.places)

    @property
    def ranges(self) -> dict[str, tuple[int, int]]:
        """First and last offset of each field."""
        return {field: self._range(number) for number, field in enumerate(self.fields)}

    def _range(self, number: int) -> tuple[int, int]:
        return PAIR.unpack_from(self.places, PAIR.size * (number + 1))

    @property
    def whole(self) -> Span:
        """The span of the whole statement."""
        return self.source.span(*self.whole_range) if self.source else NOWHERE

    def home(self, field: str) -> Spans:
        """The places, all in one source, that ``field`` is among."""
        return self

    def quote(self, span: Span) -> Quote:
        """What there is to quote of a span; nothing where there is no source."""
        return self.source.quote(span) if self.source else NO_QUOTE

    def text(self, field: str) -> str:
        """An argument as written, with its keyword; empty where there is no source."""
        start, end = self.ranges.get(field, (0, 0))
        return self.source.text[start:end] if self.source else ""

    def __getitem__(self, field: str) -> Span:
        if field not in self.fields:
            raise KeyError(field)
        start, end = self._range(self.fields.index(field))
        return self.source.span(start, end) if self.source else NOWHERE

    def __contains__(self, field: object) -> bool:
        return field in self.fields

    def __iter__(self) -> Iterator[str]:
        return iter(self.fields)

    def __len__(self) -> int:
        return len(self.fields)


def packed(offsets: Sequence[int]) -> bytes:
    """Offsets as :class:`Spans` holds them."""
    return pack(f"<{len(offsets)}I", *offsets)


def _restored(kind: type[Spans], *values: object) -> Spans:
    """Places as they were kept."""
    made = kind.__new__(kind)
    for name, value in zip(kind.kept, values, strict=True):
        setattr(made, name, value)
    return made


class Related(NamedTuple):
    """Another place that has to do with a message, and what is there."""

    span: Span
    message: str


class Edit(NamedTuple):
    """A text in place of what a span covers."""

    span: Span
    text: str


class Fix(NamedTuple):
    """A correction that the author may accept: all of its edits at once."""

    title: str
    edits: tuple[Edit, ...]


@dataclass(frozen=True, slots=True)
class Diagnostic:
    """One message about a deck.

    Parameters
    ----------
    code : str
        Short name of the kind of message, the key into
        :data:`adamslite.language.messages.MESSAGES`.
    severity : str
        ``"error"``, ``"warning"`` (looks wrong), or ``"note"`` (has no consequence).
    message : str
        One sentence.
    span : Span
        Where.
    hint : str
        What to do about it; may be empty.
    source_line : str
        The line of the deck the span begins on; may be empty.  Of a line of more than 200
        characters those round the place, with an ellipsis for the others.
    source_column : int
        The column of its first character.
    places : tuple of Span
        Everywhere it applies, ``span`` first; empty unless the text tells several places once.
    related : tuple of Related
        Other places: where something was defined first, the statements that the message names.
    fixes : tuple of Fix
        Corrections, one of which may be chosen.
    """

    code: str
    severity: str
    message: str
    span: Span = NOWHERE
    hint: str = ""
    source_line: str = ""
    source_column: int = 1
    places: tuple[Span, ...] = ()
    related: tuple[Related, ...] = ()
    fixes: tuple[Fix, ...] = ()

    @property
    def everywhere(self) -> tuple[Span, ...]:
        """All places, also those that the text does not list."""
        return self.places or (self.span,)

    @property
    def is_error(self) -> bool:
        return self.severity == ERROR

    def render(self) -> str:
        """The message with its place, the source line, carets below it and the hint.

        Names of files, and what a description or a table of others says, may hold anything.
        """
        place = f"{self.span}: " if self.span.line else ""
        lines = [f"{place}{self.severity}: {self.message} [{self.code}]"]
        if self.source_line.strip():
            lines += self._marked_line()
        if self.hint:
            lines.append(f"    = {self.hint}")
        return visible("\n".join(lines))

    def _marked_line(self) -> list[str]:
        text = self.source_line.expandtabs(1)
        start = self.span.column - self.source_column + 1
        width = self.span.end_column - self.span.column
        end = start + width if self.span.end_line == self.span.line else len(text) + 1
        number = str(self.span.line)
        carets = "^" * max(1, min(end, len(text) + 1) - start)
        return [f"  {number} | {text}", f"  {' ' * len(number)} | {' ' * (start - 1)}{carets}"]


@dataclass(frozen=True, slots=True)
class LeftOut(Diagnostic):
    """The last of many messages: how many there are besides.

    Parameters
    ----------
    numbers : tuple of int
        For each of :data:`SEVERITIES`.
    last_line : int
        Where reading ended because of them; 0 where it did not.
    """

    numbers: tuple[int, ...] = (0,) * len(SEVERITIES)
    last_line: int = 0

    @classmethod
    def of(cls, numbers: Iterable[int], last_line: int = 0) -> LeftOut:
        """The message about so many errors, warnings and notes."""
        found = tuple(numbers)
        named = [(n, kind) for n, kind in zip(found, SEVERITIES, strict=True) if n]
        listed = ", ".join(f"{n} {kind}{'s' * (n != 1)}" for n, kind in named)
        sentence = f"there is more to say than the {MOST} messages that are kept: {listed}"
        hint = "correct what comes first, and check again"
        if last_line:
            hint = f"reading ended in line {last_line} because of them: {hint}"
        severity = named[0][1]
        return cls(
            "more-messages", severity, sentence, hint=hint, numbers=found, last_line=last_line
        )


def numbers_of(diagnostics: Iterable[Diagnostic]) -> tuple[int, ...]:
    """How many errors, warnings and notes there are, with those that are left out."""
    found = [0] * len(SEVERITIES)
    for each in diagnostics:
        if isinstance(each, LeftOut):
            found = [a + b for a, b in zip(found, each.numbers, strict=True)]
        else:
            found[SEVERITIES.index(each.severity)] += 1
    return tuple(found)


def limited(diagnostics: Iterable[Diagnostic]) -> list[Diagnostic]:
    """At most :data:`MOST` of the messages, in their order, errors rather than warnings and these
    rather than notes; and one more that says how many there are besides.
    """
    every = list(diagnostics)
    own = [each for each in every if not isinstance(each, LeftOut)]
    if len(own) <= MOST and len(own) == len(every):
        return own
    by_weight = sorted(range(len(own)), key=lambda n: SEVERITIES.index(own[n].severity))
    kept = [own[n] for n in sorted(by_weight[:MOST])]
    left = [a - b for a, b in zip(numbers_of(every), numbers_of(kept), strict=True)]
    ends = [each.last_line for each in every if isinstance(each, LeftOut)]
    return [*kept, LeftOut.of(left, max(ends, default=0))]


def sort_by_place(diagnostics: Iterable[Diagnostic]) -> list[Diagnostic]:
    """In the order of the deck, the same message at the same place once; at most so many."""
    unique = dict.fromkeys(diagnostics)
    return limited(sorted(unique, key=lambda d: (d.span.file, d.span.line, d.span.column)))


def render(diagnostics: Iterable[Diagnostic]) -> str:
    """All messages as text, one blank line between two."""
    return "\n\n".join(diagnostic.render() for diagnostic in diagnostics)


class DeckError(Exception):
    """A deck (or command file) with mistakes; carries every one of them.

    ``deck`` is what could be read of it, so that the command file can be checked as well.
    """

    def __init__(self, diagnostics: Iterable[Diagnostic], deck: Any = None) -> None:
        self.diagnostics = tuple(sort_by_place(diagnostics))
        self.deck = deck
        super().__init__(self.diagnostics)

    @property
    def errors(self) -> tuple[Diagnostic, ...]:
        return tuple(d for d in self.diagnostics if d.is_error)

    def __str__(self) -> str:
        return render(self.diagnostics)

    def _render_traceback_(self) -> list[str]:
        """What a notebook prints: the messages, without the way through this package."""
        count = numbers_of(self.diagnostics)[0]
        return [f"{type(self).__name__}: {count} mistake{'s' * (count > 1)}", "", str(self)]
