"""The arguments of a statement: groups its items by argument.

Bare values belong to the argument before them; an expression takes everything up to a backslash or
the next ``KEY=``.  Keywords may be shortened to any prefix that fits one argument only.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from typing import NamedTuple

from adamslite.language.abbreviations import Ambiguous, vocabulary
from adamslite.language.diagnostics import Spans
from adamslite.language.messages import Log
from adamslite.language.messages.fixes import fix
from adamslite.language.spelling import spelled
from adamslite.language.statement import STATEMENTS, Argument, Statement
from adamslite.reading.argument_values import Refused, ValueReader
from adamslite.syntax.forms import Item
from adamslite.syntax.syntax_errors import Syntax
from adamslite.syntax.tokens import OPERATORS, Lexeme, Tokens, end_of, lengthened


class Read(NamedTuple):
    """The field values of a statement, where they are written, and the functions that its
    expressions call, where that is known.
    """

    values: dict[str, object]
    spans: Spans
    called: frozenset[str] | None = None


_LISTS = ("vector", "vectors", "references", "ids", "texts")


class Arguments(NamedTuple):
    """What is read of a statement: field values and where they are written, what they were read
    from, and the fields that have no value because of a mistake.
    """

    values: dict[str, object]
    ranges: dict[str, tuple[int, int]]
    found: dict[str, Pieces]
    unread: frozenset[str]


class Pieces:
    """What is written for one argument: the tokens of each value."""

    __slots__ = ("argument", "values", "start", "end", "closed", "before")

    def __init__(self, argument: Argument, start: int) -> None:
        self.argument = argument
        self.values: list[Tokens] = []
        self.start = start
        self.end = 0
        """Where a flag ends, which may be shortened; 0: where its last value does."""
        self.closed = False
        self.before: list[list[Tokens]] = []
        """The values of the same keyword where it was given before."""

    @property
    def range(self) -> tuple[int, int]:
        """Offsets of the argument, from its keyword to its last value."""
        return self.start, self.end or end_of(self.values[-1][-1])


class Grouping:
    """Collects the items of one statement under its arguments."""

    def __init__(self, cls: type[Statement], syntax: Syntax, log: Log) -> None:
        self.cls = cls
        self.tokens = syntax.tokens
        self.log = log
        self.words = vocabulary(cls)
        self.found: dict[str, Pieces] = {}
        self.current: Pieces | None = None
        self.skipping = False
        self.unknown_flag = False
        """A word was not understood: it may be the choice that is missing."""
        self.guessed: set[str] = set()
        """Fields that were meant by words that are none, or whose values were cut out."""
        self.unclear = False
        """Any field may have been meant."""
        for word in filter(None, syntax.cut):
            self._guess(self.words.keyed(word))

    def collect(self, items: Iterable[Item]) -> dict[str, Pieces]:
        """The pieces of each argument that is given, by field name."""
        for item in items:
            if (value := self.listed(item)) and self.current:
                self.current.values.append(value)
            else:
                self.take(item)
        return self.found

    def listed(self, item: Item) -> Tokens | None:
        """The tokens of an item that is no more than a further value of the present list; None of
        others, and of words, which may be more.
        """
        current = self.current
        if item.key >= 0 or not current or current.closed or item.closed:
            return None
        token = self.tokens[item.start]
        if token[0] == "NAME" or current.argument.kind not in _LISTS:
            return None
        return [token] if item.end - item.start == 1 else self._tokens_of(item)

    def take(self, item: Item) -> bool:
        """Put one item under its argument; True for a word that is an argument by itself."""
        flag = False
        if item.key >= 0:
            self._key(item)
        else:
            flag = self._flag(item)
            if not flag:
                self._value(item)
        if self.current and item.closed:
            self.current.closed = True
        return flag

    def _key(self, item: Item) -> None:
        token = self.tokens[item.key]
        meaning = self.words.keyed(token[1])
        self._warn_open(item.key)
        self.current, self.skipping = None, True
        if isinstance(meaning, str):
            self._planned(meaning, token)
            return
        if not isinstance(meaning, Argument):
            meaning = self.words.valued.get(self._unknown(token, meaning, True))
            self._guess(meaning)
        pieces = self._open(meaning, token) if isinstance(meaning, Argument) else None
        if pieces:
            pieces.values.append(self._tokens_of(item))
            self.current, self.skipping = pieces, False

    def _guess(self, meaning: object) -> None:
        """Note the argument that a word is taken for."""
        if isinstance(meaning, Argument):
            self.guessed.add(meaning.name)
        else:
            self.unclear = True

    def _open(self, argument: Argument, token: Lexeme) -> Pieces | None:
        if argument.name in self.found and argument.kind == "vectors":
            pieces = self.found[argument.name]
            pieces.before.append(pieces.values)
            pieces.values, pieces.closed = [], False
            return pieces
        if argument.name in self.found:
            place, first = (token[2], end_of(token)), self.found[argument.name].range
            self.log.say("duplicate-argument", place, {"word": argument.key}, first=first)
            return None
        for other in self.found.values():
            if argument.name in other.argument.fills or other.argument.name in argument.fills:
                hint = f"{other.argument.key} gives it too"
                place, words = (token[2], end_of(token)), {"word": argument.key}
                self.log.say("duplicate-argument", place, words, hint, first=other.range)
                return None
        pieces = self.found[argument.name] = Pieces(argument, token[2])
        return pieces

    def _flag(self, item: Item) -> bool:
        """Take the item as a flag, if it is one."""
        token = self.tokens[item.start]
        if item.end - item.start != 1 or token[0] != "NAME":
            return False
        if self.current and self._inside_expression():
            complete = self.current.values[0][-1][0] not in OPERATORS
            if not complete or spelled(token[1]).upper() not in self.words.bare:
                return False
            self._warn_open(item.start)
        meaning = self.words.flag(token[1])
        if meaning is None or isinstance(meaning, Ambiguous):
            if self._takes_more() or self.skipping:
                return False
            meaning = self.words.bare.get(self._unknown(token, meaning, False))
            self._guess(meaning[0] if meaning else None)
        if meaning:
            argument, option = meaning
            self.current, self.skipping = None, False
            pieces = self._open(argument, token)
            if pieces:
                pieces.values.append([("NAME", option, token[2])])
                pieces.end = end_of(token)
        return True

    def _inside_expression(self) -> bool:
        current = self.current
        return bool(current and current.argument.kind == "expression" and not current.closed)

    def _takes_more(self) -> bool:
        current = self.current
        if current is None:
            return False
        kind = current.argument.kind
        return kind in _LISTS or (current.closed if kind == "text" else kind == "expression")

    def _value(self, item: Item) -> None:
        piece, current = self._tokens_of(item), self.current
        if (
            current
            and self._takes_more()
            and not (current.closed and current.argument.kind != "text")
        ):
            if current.argument.kind in _LISTS:
                current.values.append(piece)
            else:
                current.values[0] = lengthened(current.values[0], piece)
        elif not self.skipping:
            self._stray(piece)

    def _tokens_of(self, item: Item) -> Tokens:
        found: Tokens = self.tokens[item.start : item.end]
        return found

    def _stray(self, piece: Tokens) -> None:
        """A value of no argument: after a whole number it may be the decimals of that."""
        text, place, current = self._text(piece), (piece[0][2], end_of(piece[-1])), self.current
        words, hint, point = {"text": text}, "", None
        if current and current.argument.kind == "number" and text.isdigit():
            whole, after = self._text(current.values[0]), end_of(current.values[0][-1])
            between = self.log.source.text[after : place[0]].strip()
            if whole.lstrip("+-").isdigit() and between == ",":
                hint = f"decimals follow a point: {current.argument.key}={whole}.{text}"
                point = fix(self.log.source, f"write {whole}.{text}", (after, place[0], "."))
        self.log.say("unexpected-value", place, words, hint, fix=point)

    def _text(self, piece: Tokens) -> str:
        text = self.log.source.text[piece[0][2] : end_of(piece[-1])]
        return " ".join(text.split())

    def _warn_open(self, at: int) -> None:
        if self.current and self._inside_expression():
            token, end = self.tokens[at], self.current.range[1]
            close = fix(self.log.source, "write a backslash", (end, end, "\\"))
            words, place = {"word": spelled(token[1])}, (token[2], end_of(token))
            self.log.say("expression-not-closed", place, words, fix=close)

    def _planned(self, key: str, token: Lexeme) -> None:
        keyword = self.cls.keyword
        self.log.tally(
            "planned-argument", f"{keyword} {key}", token[2], end_of(token),
            word=key, keyword=keyword,
        )  # fmt: skip

    def _unknown(self, token: Lexeme, meaning: Ambiguous | None, valued: bool) -> str:
        """A keyword that fits nothing, or too much, or a flag with a value.

        Returns the word it was meant to be, when there is but one guess.
        """
        word = spelled(token[1]).upper()
        place = token[2], end_of(token)
        if isinstance(meaning, Ambiguous):
            choices = " or ".join(meaning.choices)
            self.log.add("ambiguous-argument", *place, word=word, choices=choices)
        elif valued and (flag := self.words.flag(token[1])) and not isinstance(flag, Ambiguous):
            self.log.add("flag-with-value", *place, word=flag[1])
        elif not valued and isinstance(planned := self.words.keyed(token[1]), str):
            self._planned(planned, token)
        elif not valued and isinstance(bare := self.words.keyed(token[1]), Argument):
            choices = " or ".join(bare.options) or bare.help
            self.log.add("argument-without-value", *place, word=bare.key, value=choices)
        else:
            table = self.words.valued if valued else self.words.bare
            others = self.words.bare if valued else self.words.valued
            keyword, meant = self.cls.keyword, self.log.guesses.meant
            hint = meant(word, f"{keyword} {valued}", lambda: table)
            hint = hint or meant(word, f"{keyword} {not valued}", lambda: others)
            self.unknown_flag = self.unknown_flag or not valued
            if not (valued or hint or self.log.full):
                homes = [c.keyword for c in STATEMENTS.values() if word in vocabulary(c).bare]
                hint = f"{word} belongs to {' or '.join(homes[:3])}" * bool(homes)
            self.log.add(
                "unknown-argument", *place, word=token[1], keyword=self.cls.keyword,
                known="" if self.log.full else ", ".join(self.words.known), hint=hint,
            )  # fmt: skip
            return hint.removeprefix("did you mean ").rstrip("?")
        return ""


def read_arguments(
    cls: type[Statement],
    syntax: Syntax,
    items: Sequence[Item],
    reader: ValueReader,
    label: str,
    partial: bool = False,
) -> Arguments:
    """What is read of a statement; ``partial`` statements need no argument."""
    grouping = Grouping(cls, syntax, reader.log)
    found = grouping.collect(items)
    values: dict[str, object] = {}
    ranges: dict[str, tuple[int, int]] = {}
    unread = grouping.guessed
    for name, pieces in found.items():
        ranges[name] = pieces.range
        fields = pieces.argument.fills
        try:
            if fields:
                values |= zip(
                    fields, reader.components(pieces.argument, pieces.values), strict=True
                )
                ranges |= dict.fromkeys(fields, pieces.range)
            elif pieces.argument.kind == "vectors":
                values[name] = reader.vectors(cls, pieces.argument, [*pieces.before, pieces.values])
            else:
                values[name] = reader.value(cls, pieces.argument, pieces.values)
        except Refused:
            unread |= {name, *fields}
    if syntax.whole and not partial:
        unread |= set(_missing(grouping, label, syntax.range))
    if "" in syntax.cut:  # it may belong to any of them
        unread |= cls.arguments.keys()
    elif grouping.unclear:
        unread |= cls.arguments.keys() - values.keys()
    return Arguments(values, ranges, found, frozenset(unread))


def _missing(grouping: Grouping, label: str, place: tuple[int, int]) -> Iterator[str]:
    """Fields that must be given and are not, after saying so."""
    for argument in grouping.words.required:
        unclear = argument.bare and grouping.unknown_flag
        if argument.name not in grouping.found and not unclear:
            hint = f"{argument.key}: {argument.help}"
            if argument.bare:
                hint = f"one of {', '.join(argument.options)}"
            word = argument.help if argument.bare else argument.key
            grouping.log.add("missing-argument", *place, label=label, word=word, hint=hint)
            yield argument.name
