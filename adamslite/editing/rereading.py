"""Reading a deck again after an edit: what is written and means the same is not read again.

A text is cut where a line begins with a letter, for there a statement begins.  Tokens and forms of
a cut depend on its text alone.  What a statement says depends on its text, on the ids and names it
looks up, and on the numbers that other statements give a name; it is kept with what it looked up.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from typing import NamedTuple

from adamslite.deck.names import Names
from adamslite.deck.redefinition import Command
from adamslite.language.diagnostics import Source, Spans
from adamslite.language.expression import Node
from adamslite.language.interfaces import Key
from adamslite.language.statement import Statement
from adamslite.reading.argument_values import ValueReader
from adamslite.reading.entries import Entry, gives_values
from adamslite.reading.statement_reader import Reading
from adamslite.syntax.lines import join, view_name
from adamslite.syntax.syntax_errors import Faults, Syntax, statement_syntax
from adamslite.syntax.tokens import NEW_STATEMENT, Lexeme, scan, shifted
from adamslite.syntax.typeset import is_typeset

Found = Key | list[Key] | None
"""What looking up a name has given."""


class Use(NamedTuple):
    """A place that refers to a statement, by offsets."""

    kind: str
    key: Key
    start: int
    end: int


class Notebook(Names):
    """Names that note what is looked up, and where statements are referred to."""

    def __init__(self) -> None:
        super().__init__()
        self.asked: list[tuple[str, Key, Found]] = []
        self.uses: list[Use] = []

    def find(self, kind: str, word: Key) -> Found:
        found = super().find(kind, word)
        self.asked.append((kind, word, found))
        return found

    def used(self, kind: str, key: Key, start: int, end: int) -> None:
        self.uses.append(Use(kind, key, start, end))


MOST_KEPT, LARGE = 1000, 1 << 16
"""Statements of a stretch that is kept, and characters of one with mistakes in it."""


class Cut(NamedTuple):
    """The statements of a stretch of text and mistakes of form; offsets count from its start.

    ``name_behind`` is the adams_view_name that its last comment gives to the next statement.
    """

    statements: list[tuple[Syntax | None, Faults]]
    name_behind: str | None


class Known(NamedTuple):
    """A statement without mistakes, as read before; offsets count from its start."""

    statement: Statement
    ranges: dict[str, tuple[int, int]]
    asked: list[tuple[str, Key, Found]]
    uses: list[Use]


@dataclass
class Memory:
    """What is kept of a text from one reading to the next."""

    cuts: dict[str, Cut] = field(default_factory=dict)
    statements: dict[tuple[object, ...], Known] = field(default_factory=dict)
    constants: dict[str, float] = field(default_factory=dict)
    numbered: Mapping[tuple[str, Key], Sequence[Node]] = field(default_factory=dict)


class Rereading(Reading):
    """Reads a deck with the memory of its last reading, and leaves there what it found."""

    def __init__(self, source: Source, memory: Memory) -> None:
        self.notebook = Notebook()
        super().__init__(source, self.notebook, "deck")
        self.memory = memory
        self.uses: list[tuple[int, list[Use]]] = []
        """For each statement its offset and its uses, with offsets from there."""
        self._cuts: dict[str, Cut] = {}
        self._statements: dict[tuple[object, ...], Known] = {}
        self._asked: list[tuple[str, Key, Found]] = []
        self._checked = False
        self._name_behind: str | None = None
        self._ground_known: tuple[Key | None] | None = None

    # ---- first pass ---------------------------------------------------------------------------

    def _syntax(self, start: int) -> Iterator[tuple[Syntax | None, Faults]]:
        text, name = self.log.source.text, None
        if is_typeset(text):
            yield from super()._syntax(start)
            return
        while start < len(text):
            cut = NEW_STATEMENT.search(text, start)
            end = cut.end() if cut else len(text)
            stretch = text[start:end]
            known = self._cuts.get(stretch) or self.memory.cuts.get(stretch)
            if known:
                self._cuts[stretch] = known
            found = self._known(known, start) if known else self._read_cut(stretch, start)
            for number, (syntax, faults) in enumerate(found):
                if syntax and number == 0 and name:
                    syntax = syntax._replace(name=name)
                yield syntax, faults
            name = known.name_behind if known else self._name_behind
            start = end

    def _known(self, cut: Cut, start: int) -> Iterator[tuple[Syntax | None, Faults]]:
        for each in cut.statements:
            yield _shifted(each, start)

    def _read_cut(self, stretch: str, start: int) -> Iterator[tuple[Syntax | None, Faults]]:
        """The statements of a stretch as far as they are asked for; kept where all of them are."""
        last: list[Lexeme] = []
        kept: list[tuple[Syntax | None, Faults]] | None = []

        def scanned() -> Iterator[list[Lexeme]]:
            nonlocal last
            for each in scan(stretch):
                last = each
                yield each

        for found in map(statement_syntax, join(scanned())):
            if kept is not None and (len(kept) == MOST_KEPT or found[1] and len(stretch) > LARGE):
                kept = None
            if kept is not None:
                kept.append(found)
            yield _shifted(found, start)
        self._name_behind = _name_behind(last)
        if kept is not None:
            self._cuts[stretch] = Cut(kept, self._name_behind)

    # ---- second pass --------------------------------------------------------------------------

    def _second_pass(self) -> tuple[Command, ...]:
        read = super()._second_pass()
        self.memory.cuts = self._cuts
        self.memory.statements = self._statements
        self.memory.constants = self.resolver.constants
        self.memory.numbered = self.resolver.numbered
        return read

    def _ground(self) -> Key | None:
        if self._ground_known is None:
            self._ground_known = (super()._ground(),)
        self.notebook.asked.append(("", "GROUND", self._ground_known[0]))
        return self._ground_known[0]

    def _statement(self, entry: Entry, reader: ValueReader) -> Command | None:
        if gives_values(entry.cls) or entry.again or not entry.syntax.whole:
            return self._read(entry, reader)
        if not self._checked:
            same = (self.resolver.constants, self.resolver.numbered)
            if same != (self.memory.constants, self.memory.numbered):
                self.memory.statements = {}
            self._checked = True
        start, end = entry.syntax.range
        written = self.log.source.text[start:end]
        key = (written, entry.cls, entry.id, entry.body, entry.syntax.name)
        known = self.memory.statements.get(key)
        if known and all(self._find(*asked[:2]) == asked[2] for asked in known.asked):
            self._statements[key] = known
            self.uses.append((start, known.uses))
            return self._copied(known, start, end)
        said, errors = self.log.count, self.log.errors
        self.resolver.calls_user, before = False, self.resolver.calls_user
        statement = self._read(entry, reader)
        healthy = (said, errors) == (self.log.count, self.log.errors)
        if healthy and isinstance(statement, Statement) and not self.resolver.calls_user:
            ranges = {f: (a - start, b - start) for f, (a, b) in statement.spans.ranges.items()}
            uses = self.uses[-1][1]
            self._statements[key] = Known(statement, ranges, self._asked, uses)
        self.resolver.calls_user |= before
        return statement

    def _read(self, entry: Entry, reader: ValueReader) -> Command | None:
        start = entry.syntax.range[0]
        self.notebook.asked, self.notebook.uses = [], []
        statement = super()._statement(entry, reader)
        self._asked, self.notebook.asked = self.notebook.asked, []
        uses = [Use(k, key, a - start, b - start) for k, key, a, b in self.notebook.uses]
        self.uses.append((start, uses))
        return statement

    def _find(self, kind: str, word: Key) -> Found:
        if not kind:
            return self._ground()
        return Names.find(self.notebook, kind, word)

    def _copied(self, known: Known, start: int, end: int) -> Statement:
        """The same statement at its present place."""
        copy = object.__new__(type(known.statement))
        ranges = {field: (a + start, b + start) for field, (a, b) in known.ranges.items()}
        copy.__dict__.update(known.statement.__dict__)
        copy.__dict__["spans"] = Spans(self.log.source, (start, end), ranges)
        return copy


def _name_behind(tokens: list[Lexeme]) -> str | None:
    kind, text, _ = tokens[-1] if tokens else ("", "", 0)
    return view_name(text) if kind in ("LINE_END", "SEMICOLON") else None


def _shifted(found: tuple[Syntax | None, Faults], offset: int) -> tuple[Syntax | None, Faults]:
    """A statement and the mistakes in it, at another place."""
    syntax, faults = found
    moved = [(mistake, shifted(tokens, offset)) for mistake, tokens in faults]
    return syntax and syntax._replace(tokens=shifted(syntax.tokens, offset)), moved
