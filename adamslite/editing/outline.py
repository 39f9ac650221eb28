"""What a text says, without its layout: the statements with the items of their arguments.

Two texts with the same outline are read alike.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from functools import cached_property
from typing import NamedTuple

from adamslite.deck.names import Names
from adamslite.language.abbreviations import PREFERRED, Ambiguous, match
from adamslite.language.diagnostics import Source
from adamslite.language.messages import Log
from adamslite.language.spelling import spelled
from adamslite.language.statement import Argument, Statement
from adamslite.reading.argument_grouping import Grouping
from adamslite.reading.resolver import LONGEST
from adamslite.reading.statement_reader import Reading, known_keywords
from adamslite.syntax.forms import Fault, Item, statement_form
from adamslite.syntax.lines import join
from adamslite.syntax.syntax_errors import Syntax, kinds_of
from adamslite.syntax.tokens import Lexeme, Lexemes, Tokens, end_of, scan

TEXTS = ("text", "texts")
"""Kinds of arguments whose values are kept letter by letter."""


class Given(NamedTuple):
    """An argument as it is given.

    Parameters
    ----------
    argument : Argument or None
        None for the id.
    key : token or None
        The keyword as written; None for the id and for a word that is an argument by itself.
    word : str
        The keyword, or that word, written out.
    values : list of lists of tokens
    closed : list
        Not empty where a backslash is behind it.
    """

    argument: Argument | None
    key: Lexeme | None
    word: str
    values: list[Tokens]
    closed: list[bool]

    @property
    def kind(self) -> str:
        return self.argument.kind if self.argument else "id"

    @property
    def is_text(self) -> bool:
        """Whether its values are kept letter by letter."""
        return self.kind in TEXTS


#: Words of which the meaning is remembered.
MOST_WORDS = 1000


@dataclass
class Written:
    """A statement as written; ``cls`` is None where its keyword is not known."""

    tokens: Tokens
    name: str | None
    cls: type[Statement] | None
    log: Log = field(repr=False)
    """That of the whole text, as what it needs is found once for each."""

    @property
    def source(self) -> str:
        """The whole text."""
        return self.log.source.text

    @cached_property
    def given(self) -> list[Given] | None:
        """Its arguments; None where they cannot be told from mistakes, or are not read."""
        if self.cls is None:
            return None
        if len(self.tokens) == 1:
            return [] if self.cls.ends else None
        form = statement_form(kinds_of(self.tokens))
        if isinstance(form, Fault):
            return None
        return _given(self.cls, Syntax(self.tokens, form, self.name, True), self.log)

    @property
    def is_unread(self) -> bool:
        """Whether it is none of the language, or has a mistake."""
        return self.given is None and not (self.cls and self.cls.ignored)

    @property
    def start(self) -> int:
        return self.tokens[0][2]

    @property
    def end(self) -> int:
        return end_of(self.tokens[-1])

    def meaning(self) -> tuple[object, ...]:
        """Everything but the layout, comparable."""
        if self.given is None or self.cls is None:
            return (self.name, *(token[:2] for token in self.tokens))
        return (
            self.name,
            self.cls.keyword,
            *((each.word, bool(each.closed), *self._values(each)) for each in self.given),
        )

    def says(self, other: Written) -> bool:
        """Whether this is read as another statement is, of which perhaps only tokens are known.

        Equal tokens are read alike, but for texts that are kept letter by letter.
        """
        if self.name == other.name and _words(self.tokens) == _words(other.tokens):
            if not any(each.is_text for each in other.given or ()):
                return True
        return other.given is not None and self.meaning() == other.meaning()

    def _values(self, given: Given) -> list[object]:
        if given.argument and not given.key:
            return []
        if given.is_text:
            return [self.source[v[0][2] : end_of(v[-1])] for v in given.values]
        return [
            [(kind, text.upper() if kind == "NAME" else text) for kind, text, _ in value]
            for value in given.values
        ]


def head_end(text: str, place: str) -> int:
    """Where the title of a deck ends, or the names at the top of a command file."""
    reading = Reading(Source(text), Names(), place)
    return reading.names_on_top() if place == "command" else reading.title()[1]


def outline(text: str, place: str) -> Iterator[Written]:
    """The statements of a deck or of a command file, up to the END."""
    yield from statements(text, head_end(text, place), len(text), place)


def statements(text: str, start: int, end: int, place: str) -> Iterator[Written]:
    """The statements in a stretch of a text, up to the END."""
    table, log = _Remembered(known_keywords(place)), Log(Source(text))
    for logical in join(scan(text[:end], start), ampersand=place == "command"):
        found = table.meaning(spelled(logical.tokens[0][1]).upper())
        cls = found if isinstance(found, type) else None
        written = Written(logical.tokens, logical.name, cls, log)
        yield written
        if written.cls and written.cls.ends:
            return


class _Remembered:
    """Keywords that remember what words mean, up to so many of these."""

    def __init__(self, table: Mapping[str, type[Statement] | str]) -> None:
        self._table = table
        self._known: dict[str, type[Statement] | str | Ambiguous | None] = {}

    def meaning(self, word: str) -> type[Statement] | str | Ambiguous | None:
        """What :func:`match` finds."""
        if word not in self._known:
            if len(self._known) >= MOST_WORDS:
                self._known.clear()
            self._known[word] = match(PREFERRED.get(word, word), self._table)
        return self._known[word]


def _words(tokens: Tokens) -> tuple[object, object]:
    """Tokens without their places, comparable."""
    if isinstance(tokens, Lexemes):
        return tokens.kinds, tokens.texts
    return [token[0] for token in tokens], [token[1] for token in tokens]


def _given(cls: type[Statement], syntax: Syntax, log: Log) -> list[Given] | None:
    """The arguments of a statement; None where some are not understood, or not read."""
    if cls.ignored:
        return None
    items, found, tokens = syntax.items, list[Given](), syntax.tokens
    if not cls.singleton:
        if not items or items[0].key >= 0:
            return None
        found = [Given(None, None, "", [tokens[items[0].start : items[0].end]], [])]
        items = items[1:]
    before, grouping = log.errors, Grouping(cls, syntax, log)
    for item in items:
        if value := grouping.listed(item):
            found[-1].values.append(value)
            continue
        flag = grouping.take(item)
        if log.errors > before or not (flag or grouping.current):
            return None
        value = tokens[item.start : item.end]
        if flag or item.key >= 0:
            found.append(_opened(grouping, item, flag))
        if not flag and not _has_room(found[-1], value):
            return None
        found[-1].closed[:] = [True] * item.closed
    return found


def _has_room(given: Given, value: Tokens) -> bool:
    """Give an argument one more value, or more of the one it has; whether reading takes as many."""
    if given.kind in ("expression", "text") and given.values:
        given.values[0].extend(value)
    else:
        given.values.append(value)
    return given.kind != "expression" or len(given.values[0]) <= LONGEST


def _opened(grouping: Grouping, item: Item, flag: bool) -> Given:
    """The argument that an item begins, with its keyword in full, still without values."""
    token = grouping.tokens[item.start if flag else item.key]
    word = spelled(token[1]).upper()
    if flag:
        meaning = grouping.words.flag(token[1])
        assert meaning and not isinstance(meaning, Ambiguous)
        return Given(meaning[0], None, max(word, meaning[1], key=len), [[token]], [])
    assert grouping.current
    argument = grouping.current.argument
    longer = [key for key in argument.keys if key.startswith(word)]
    return Given(argument, token, longer[0] if longer else word, [], [])
