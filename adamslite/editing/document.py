"""A deck or a command file that is being edited: its messages, and who refers to what."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from dataclasses import replace
from functools import cached_property
from pathlib import Path

from adamslite.checks.rules import check
from adamslite.deck.deck import Deck
from adamslite.deck.element_switch import Switch
from adamslite.deck.names import Names
from adamslite.deck.user_bindings import bindings
from adamslite.editing.outline import Written, head_end, statements
from adamslite.editing.rereading import Memory, Notebook, Rereading, Use
from adamslite.gc_pause import without_collection
from adamslite.language.diagnostics import DeckError, Diagnostic, Source, Span, sort_by_place
from adamslite.language.interfaces import Key, key_of
from adamslite.language.messages.ignoring import without_ignored
from adamslite.language.spelling import spelled
from adamslite.language.statement import Statement
from adamslite.language.text import text_of
from adamslite.reading.read import read_by, read_commands
from adamslite.syntax.tokens import end_of, scan

ID = re.compile(r"[^/\n]*/\s*,?\s*([^\s,=!;\\]+)")
NAME_COMMENT = re.compile(r"![ \t]*adams_view_name[ \t]*=[ \t]*'([^']*)'", re.IGNORECASE)


class Content:
    """A text as read; a new one is made after every edit.

    Parameters
    ----------
    source : Source
    place : str
        ``"deck"`` or ``"command"``.
    deck : Deck or None
        What was read, or the deck that the commands are for; None where there is none.
    names : Names
        Ids and names of the deck.
    uses : list of Use
        Places of this text that refer to statements, in their order.
    diagnostics : tuple of Diagnostic
    """

    def __init__(
        self,
        source: Source,
        place: str,
        deck: Deck | None,
        names: Names,
        uses: list[Use],
        diagnostics: tuple[Diagnostic, ...],
    ) -> None:
        self.source = source
        self.place = place
        self.deck = deck
        self.names = names
        self.uses = uses
        self.diagnostics = diagnostics

    @property
    def text(self) -> str:
        return self.source.text

    def offset(self, line: int, column: int) -> int:
        """The offset of a line and a column, counted from 1; at most that of the line's end."""
        starts = self.source.starts
        if line > len(starts):
            return len(self.text)
        return min(starts[line - 1] + column - 1, starts[line - 1] + len(self.source.line(line)))

    def offsets(self, span: Span) -> tuple[int, int]:
        """Where a span of this text starts and ends."""
        return self.offset(span.line, span.column), self.offset(span.end_line, span.end_column)

    @cached_property
    def uses_of(self) -> dict[tuple[str, Key], list[Use]]:
        """The places that refer to each statement."""
        found: dict[tuple[str, Key], list[Use]] = {}
        for use in self.uses:
            found.setdefault((use.kind, use.key), []).append(use)
        return found

    @cached_property
    def definitions(self) -> dict[tuple[str, Key], Use]:
        """The id of each statement where it is defined; empty for a command file."""
        if self.place == "command":
            return {}
        return {
            (kind, key): Use(kind, key, *found.span(1))
            for kind, ids in self.names.ids.items()
            for key, start in ids.items()
            if (found := ID.match(self.text, start))
        }

    def symbol_at(self, offset: int) -> Use | None:
        """The id under the cursor, where a statement is defined or referred to."""
        places = (*self.uses, *self.definitions.values(), *self.view_names())
        return next((use for use in places if use.start <= offset <= use.end), None)

    def view_names(self) -> Iterator[Use]:
        """The names in comments, which belong to the statement that follows."""
        views = {
            (kind, word): keys
            for kind, table in self.names.views.items()
            for word, keys in table.items()
        }
        starts = (
            sorted(
                (start, kind, key)
                for kind, ids in self.names.ids.items()
                for key, start in ids.items()
            )
            if self.place == "deck"
            else []
        )
        at = 0
        for found in NAME_COMMENT.finditer(self.text):
            while at < len(starts) and starts[at][0] < found.end():
                at += 1
            if at < len(starts):
                _, kind, key = starts[at]
                if key in views.get((kind, spelled(found[1].strip() or " ").upper()), ()):
                    yield Use(kind, key, *found.span(1))

    def statement_at(self, offset: int) -> Written | None:
        """The statement that an offset is in, or right behind."""
        start, end = self.stretch(offset)
        found = None
        for each in statements(self.text, start, end, self.place):
            if each.start <= offset and (found is None or offset >= each.start):
                found = each
        return found

    def stretch(self, offset: int) -> tuple[int, int]:
        """The lines of the statement round an offset, with comments between them."""
        first = last = self.source.place(offset)[0]
        lines = len(self.source.starts)
        top = self.source.place(head_end(self.text, self.place))[0]
        while first > 1 and self._continues(first):
            first -= 1
        while last < lines and self._continues(last + 1):
            last += 1
        start = self.source.starts[first - 1]
        end = self.source.starts[last] if last < lines else len(self.text)
        return max(start, head_end(self.text, self.place) if first <= top else 0), end

    def _continues(self, line: int) -> bool:
        """Whether a line does not begin a statement."""
        text = self.source.line(line).lstrip()
        if self.place == "command" and text[:1] != ",":
            above = self.source.line(line - 1).partition("!")[0]
            return above.rstrip().endswith("&")
        return not text or text[0] in ",!"


class Document:
    """A text in an editor, read again after every edit.

    Parameters
    ----------
    path : Path or str
        The file, or what messages call a text without one.
    place : str
        ``"deck"`` or ``"command"``.
    """

    def __init__(self, path: Path | str, place: str) -> None:
        self.path = path if isinstance(path, Path) else None
        self.file = str(path)
        self.place = place
        self.content = Content(Source("", self.file), place, None, Names(), [], ())
        self._memory = Memory()
        self._advice: tuple[Diagnostic, ...] = ()

    def update(self, text: str, deck: Content | None = None) -> Content:
        """Read the text; ``deck`` is what the commands are for."""
        source = Source(text_of(text), self.file)
        with without_collection():
            self._read(source, deck)
        return self.content

    def _read(self, source: Source, deck: Content | None) -> None:
        if self.place == "command":
            self.content = self._commands(source, deck)
        else:
            self.content = self._deck(source)

    def _deck(self, source: Source) -> Content:
        self._advice = tuple(moved(self._advice, self.content.source, source))
        reading = Rereading(source, self._memory)
        try:
            deck = read_by(reading, self.path, bindings(None))
            known = without_ignored(source, deck.warnings)
            found = tuple(sort_by_place([*known, *self._advice]))
        except DeckError as fault:
            deck, found = fault.deck, fault.diagnostics
        uses = [
            Use(kind, key, start + a, start + b)
            for start, each in reading.uses
            for kind, key, a, b in each
        ]
        return Content(source, self.place, deck, reading.names, uses, found)

    def complete(self, content: Content) -> bool:
        """Take the advice of `check` in, which an edit does not wait for; whether that is new.

        It may run beside edits: what comes late is not taken.
        """
        deck = content.deck
        broken = any(each.is_error for each in content.diagnostics)
        if content.place == "command" or deck is None or broken:
            return False
        found = tuple(check(deck))
        if content is not self.content:
            return False
        known = {*without_ignored(content.source, deck.warnings)}
        self._advice = tuple(each for each in found if each not in known)
        changed = found != content.diagnostics
        content.diagnostics = found
        return changed

    def _commands(self, source: Source, deck: Content | None) -> Content:
        if deck is None or deck.deck is None:
            return Content(source, self.place, None, Names(), [], ())
        notebook = deck.names
        assert isinstance(notebook, Notebook)
        notebook.uses = []
        read: Iterable[object] = ()
        try:
            read = commands = read_commands(source.text + "\n", deck.deck)
            found = commands.warnings
        except DeckError as fault:
            found = fault.diagnostics
            read = fault.deck.own if fault.deck else ()
        uses = [*notebook.uses, *(use for each in read for use in _switched(each, source))]
        notebook.asked, notebook.uses = [], []
        return Content(source, self.place, deck.deck, notebook, uses, found)


def _switched(command: object, source: Source) -> Iterator[Use]:
    """The elements that ACTIVATE or DEACTIVATE names."""
    if not (isinstance(command, Switch) and isinstance(command, Statement)):
        return
    start, end = command.spans.ranges.get("ids", (0, 0))
    for stretch in scan(source.text[:end], start):
        for token in stretch:
            word = token[1].upper()
            key: Key = key_of(word)
            if key in command.ids:
                yield Use(command.kind, key, token[2], end_of(token))


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
