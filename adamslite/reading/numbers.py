"""The numbers of a deck by name, and its text with other numbers.

=====================  ============================================================================
``SPRINGDAMPER/1.K``   the number of an argument that has one
``PART/2.QG[1]``       the second number of an argument that has several, counted from 0 as written
``VARIABLE/b.FUNCTION[0]``  the first number in an expression; ids are none
``ACCGRAV.JGRAV``      of a statement without id; ``SIMULATE/2.END`` where there are several
``L_0``                a VARIABLE that is one number
=====================  ============================================================================

A sign in front belongs to the number where both stand alone, between commas or brackets:
``FUNCTION=-9.81`` has -9.81, ``FUNCTION=2-9.81*TIME`` has 2 and 9.81.  A number in degrees
(``30D``) stays one.
"""

from __future__ import annotations

from bisect import bisect_left
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from functools import cached_property
from math import copysign, isfinite
from pathlib import Path
from typing import NamedTuple, TypeAlias

from adamslite.deck.deck import Deck
from adamslite.deck.names import Marked, Names, to_number
from adamslite.deck.user_bindings import Bindings
from adamslite.elements.variable import Variable
from adamslite.errors import UsageError
from adamslite.gc_pause import without_collection
from adamslite.language.abbreviations import match
from adamslite.language.diagnostics import DeckError, Diagnostic, Source
from adamslite.language.expression import Node, Num
from adamslite.language.interfaces import key_of
from adamslite.language.likeness import did_you_mean
from adamslite.language.statement import STATEMENTS, Argument, Statement
from adamslite.language.traced import Traced
from adamslite.reading.statement_reader import Reading
from adamslite.reading.unjudged import unjudged
from adamslite.syntax.lines import join
from adamslite.syntax.syntax_errors import Faults, Syntax, statement_syntax
from adamslite.syntax.tokens import CLOSES, Lexeme, end_of, scan

Given: TypeAlias = Mapping[str, float] | Iterable[str]
"""Values by name, or texts ``NAME=VALUE``."""
#: Tokens behind which, and before which, a number is not part of an operation.
BEFORE = {"COMMA", "EQUAL", "COLON", "BACKSLASH", *CLOSES}
BEHIND = {"COMMA", "COLON", "BACKSLASH", *CLOSES.values()}
#: Whole numbers up to here are written without a point.
WHOLE = 1e15


class Named(NamedTuple):
    """A number of the text.

    Attributes
    ----------
    name : str
        In full: ``PART/2.QG[1]``.
    value : float
        As written, with its sign; degrees stay degrees.
    statement : Statement
    argument : Argument
    at : int
        Offset of its digits; ``start``, ``end``: of all that another value replaces.
    unit : str
        ``D`` behind a number in degrees.
    alone : bool
        Whether it is no part of an operation.
    """

    name: str
    value: float
    statement: Statement
    argument: Argument
    at: int
    start: int
    end: int
    unit: str
    alone: bool

    @property
    def sign(self) -> float:
        """-1 where a minus belongs to it."""
        return -1.0 if self.start < self.at and copysign(1.0, self.value) < 0.0 else 1.0

    def written(self, value: float) -> str:
        """Another value in its place."""
        text = str(int(value)) if value.is_integer() and abs(value) < WHOLE else repr(value)
        text += self.unit
        return f"({text})" if text.startswith("-") and not self.alone else text

    def digits(self, value: float) -> float:
        """The value of its digits, without sign, in the unit of expressions."""
        return to_number(repr(self.sign * value) + self.unit)


class MarkedNames(Names):
    """Names whose reading takes no short way: every number stays one of its own."""

    def used(self, kind: str, key: object, start: int, end: int) -> None:
        """Nobody asks."""


class MarkedReading(Reading):
    """Reads a deck whose numbers remember where they are written."""

    def __init__(self, source: Source) -> None:
        super().__init__(source, MarkedNames(), "deck")
        self.lexemes: dict[int, tuple[Lexeme, Lexeme | None, Lexeme | None, Lexeme | None]] = {}
        """Number tokens by offset, with the two before and the one behind."""

    def _syntax(self, start: int) -> Iterator[tuple[Syntax | None, Faults]]:
        for logical in join(scan(self.log.source.text, start)):
            tokens = [_marked(token) for token in logical.tokens]
            around = [None, None, *tokens, None]
            for n, token in enumerate(tokens):
                if token[0] == "NUMBER":
                    self.lexemes[token[2]] = token, around[n], around[n + 1], around[n + 3]
            yield statement_syntax(logical._replace(tokens=tokens))


def _marked(token: Lexeme) -> Lexeme:
    kind, text, at = token
    return (kind, Marked.of(text, at), at) if kind == "NUMBER" else token


@dataclass
class Numbers:
    """The numbers of a text by their names in capitals.

    ``deck``: made of traced numbers; ``mistakes``: what stood in the way of reading it.
    """

    deck: Deck
    named: dict[str, Named]
    mistakes: list[Diagnostic]

    @cached_property
    def parameters(self) -> dict[str, Named]:
        """VARIABLEs that are one number, by their ids in capitals."""
        return {
            str(each.statement.key): each
            for each in self.named.values()
            if isinstance(each.statement, Variable) and _is_number(each.statement.function)
        }

    def find(self, word: str) -> Named:
        """The number of a name.

        Raises
        ------
        UsageError
            When there is none, with those that may have been meant.
        """
        name = word.strip()
        label, dot, rest = name.rpartition(".") if "/" in name or "." in name else (name, "", "")
        for known in (name, f"{self._keyword(label)}{dot}{rest}"):
            found = self.named.get(known.upper()) or self._parameter(known)
            if found:
                return found
        raise UsageError(f"there is no number {name}{self._hint(name)}")

    def _keyword(self, label: str) -> str:
        """A label with its keyword in full."""
        keyword, slash, id = label.partition("/")
        found = match(keyword.upper(), STATEMENTS) if keyword else None
        return f"{found.keyword}{slash}{id}" if isinstance(found, type) else label

    def _parameter(self, name: str) -> Named | None:
        keyword, slash, id = name.partition("/")
        if slash and keyword.upper() != "VARIABLE":
            return None
        key = (id if slash else name).upper()
        return self.parameters.get(key)

    def _hint(self, name: str) -> str:
        """What may have been meant."""
        several = [each for each in self.named if each.startswith(f"{name.upper()}[")]
        variable = self.deck.find("VARIABLE", key_of(name))
        if not several and variable is not None:
            start = f"{variable.label}.FUNCTION".upper()
            several = [each for each in self.named if each.startswith(start)]
        if several:
            return f": it is one of {several[0]} to {several[-1]}" if several[1:] else (
                f": there is {self.named[several[0]].name}"
            )  # fmt: skip
        label = name.upper().rpartition(".")[0]
        beside = [each for each in self.named if label and each.rpartition(".")[0] == label]
        if beside:
            return f"; {label} has {', '.join(each.rpartition('.')[2] for each in beside[:6])}"
        hint = did_you_mean(name, [*self.named, *self.parameters])
        return f"; {hint}" if hint else "; `adamslite names DECK` lists all"

    def given(self, values: Given) -> dict[str, float]:
        """Values by the names in full.

        Raises
        ------
        UsageError
            For a name that there is not, and a value that is no finite number.
        """
        pairs = values.items() if isinstance(values, Mapping) else map(_pair, values)
        found: dict[str, float] = {}
        for name, value in pairs:
            number = self.find(name)
            try:
                found[number.name] = float(value) + 0.0  # no minus before a zero
            except (TypeError, ValueError):
                raise UsageError(f"{name}={value}: it must be a number") from None
            if not isfinite(found[number.name]):
                raise UsageError(f"{name}={value}: it must be a finite number")
        return found

    def others(self, values: Mapping[str, float]) -> set[str]:
        """The names whose values are not those of the text."""
        return {name for name, each in values.items() if self.named[name.upper()].value != each}

    def text(self, values: Mapping[str, float]) -> str:
        """The text of the deck with other values, by names in full."""
        text, edits = self.deck.source.text, []
        for name, value in values.items():
            number = self.named[name.upper()]
            edits.append((number.start, number.end, number.written(value)))
        for start, end, new in sorted(edits, reverse=True):
            text = text[:start] + new + text[end:]
        return text


def _is_number(function: Node) -> bool:
    """Whether a FUNCTION is one number of the text: a routine of the user may be bound to one."""
    return type(function) is Num and type(function.value) is Traced


def _pair(text: str) -> tuple[str, str]:
    name, equal, value = text.partition("=")
    if not equal or not name.strip() or not value.strip():
        raise UsageError(f"{text}: write NAME=VALUE, as SPRINGDAMPER/1.K=90")
    return name, value.strip()


def edited(source: Source, path: Path | None, values: Given, given: Bindings) -> str:
    """The text of a deck with other numbers.

    Raises
    ------
    DeckError
        With the mistakes that reading the deck as it is has found, where a name is not known.
    UsageError
        When there is no number of a name, or a value is no finite number.
    """
    numbers = numbers_of(source, path, given)
    try:
        return numbers.text(numbers.given(values))
    except UsageError:
        if numbers.mistakes:
            raise DeckError(numbers.mistakes, numbers.deck) from None
        raise


def numbers_of(source: Source, path: Path | None, given: Bindings) -> Numbers:
    """The numbers of the text of a deck; ``path``: its file, which others may lie beside."""
    with without_collection():
        reading = MarkedReading(source)
        return _numbers_in(unjudged(reading, path, given), reading)


def _numbers_in(deck: Deck, reading: MarkedReading) -> Numbers:
    taken = sorted(at for at, (token, *_) in reading.lexemes.items() if _is_taken(token[1]))
    named: dict[str, Named] = {}
    labels = _labels(deck.own)
    for statement in deck.own:
        start, end = statement.spans.whole_range
        inside = taken[bisect_left(taken, start) : bisect_left(taken, end)]
        for number in _of_statement(statement, labels[id(statement)], inside, reading):
            named.setdefault(number.name.upper(), number)
    mistakes = [each for each in reading.log.finish() if each.is_error]
    return Numbers(deck, named, mistakes)


def _is_taken(text: str) -> bool:
    return isinstance(text, Marked) and text.taken


def _labels(statements: Iterable[Statement]) -> dict[int, str]:
    """What names begin with; statements without id are counted where there are several."""
    of: dict[str, list[Statement]] = {}
    for each in statements:
        of.setdefault(each.keyword, []).append(each)
    return {
        id(each): f"{each.keyword}/{n}" if each.singleton and len(group) > 1 else each.label
        for group in of.values()
        for n, each in enumerate(group, 1)
    }


def _of_statement(
    statement: Statement, label: str, taken: list[int], reading: MarkedReading
) -> Iterator[Named]:
    """The numbers of one statement."""
    ranges = sorted(statement.spans.ranges.items(), key=lambda each: each[1][1] - each[1][0])
    of: dict[str, list[int]] = {}
    for at in taken:
        field = next((f for f, (start, end) in ranges if start <= at < end), "")
        if field in statement.arguments:
            of.setdefault(field, []).append(at)
    for field, places in of.items():
        argument = statement.arguments[field]
        for n, at in enumerate(places):
            index = f"[{n}]" if len(places) > 1 or _is_list(argument) else ""
            name = f"{label}.{argument.key}{index}"
            yield _named(name, statement, argument, *reading.lexemes[at])


def _is_list(argument: Argument) -> bool:
    return argument.kind in ("vector", "vectors")


def _named(
    name: str,
    statement: Statement,
    argument: Argument,
    token: Lexeme,
    before: Lexeme | None,
    last: Lexeme | None,
    behind: Lexeme | None,
) -> Named:
    """The number of a token, from the two tokens before it and the one behind it."""
    text, at = str(token[1]), token[2]
    unit = text[-1] if text[-1] in "dD" else ""
    value, start = to_number(text.removesuffix(unit)), at
    signed = last is not None and last[0] in ("MINUS", "PLUS")
    outside = before if signed else last
    alone = outside is not None and outside[0] in BEFORE
    alone = alone and (behind is None or behind[0] in BEHIND)
    if last is not None and signed and alone:
        value, start = (-value if last[0] == "MINUS" else value), last[2]
    return Named(name, value, statement, argument, at, start, end_of(token), unit, alone)
