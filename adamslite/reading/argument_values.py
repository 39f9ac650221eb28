"""The value of an argument from its tokens, by the kind that its field declares."""

from __future__ import annotations

import math
import re
from collections.abc import Callable
from typing import NoReturn

from adamslite.deck.names import Names, to_number
from adamslite.language.abbreviations import match
from adamslite.language.expression import Node
from adamslite.language.interfaces import ID_DIGITS, Key
from adamslite.language.messages import Log
from adamslite.language.routines import ARGUMENT as ROUTINE_ARGUMENT
from adamslite.language.routines import is_user_call
from adamslite.language.spelling import spelled
from adamslite.language.statement import Argument, Statement
from adamslite.reading.expression_names import Unresolved
from adamslite.reading.resolver import Resolver
from adamslite.syntax.tokens import CLOSES, Tokens, end_of

GROUND = "GROUND"


class Refused(Exception):
    """A value could not be read; the reason has been logged."""


def unwrapped(tokens: Tokens) -> Tokens:
    """The tokens without brackets round the whole of them."""
    while len(tokens) > 1 and tokens[0][0] in CLOSES and _closing(tokens) == len(tokens) - 1:
        tokens = tokens[1:-1]
    return tokens


def _closing(tokens: Tokens) -> int:
    """The number of the bracket that closes the first one."""
    depth = 0
    for number, token in enumerate(tokens):
        depth += (token[0] in CLOSES) - (token[0] in CLOSES.values())
        if depth == 0:
            return number
    return -1


def split(tokens: Tokens, separator: str) -> list[Tokens]:
    """The stretches between separators that stand outside all brackets."""
    parts: list[Tokens] = [[]]
    depth = 0
    for token in tokens:
        depth += (token[0] in CLOSES) - (token[0] in CLOSES.values())
        if token[0] == separator and depth == 0:
            parts.append([])
        else:
            parts[-1].append(token)
    return parts


def to_id(tokens: Tokens) -> Key | None:
    """The id that tokens spell, a number or a name as written; None when they spell none."""
    if len(tokens) != 1:
        tokens = unwrapped(tokens)
    if not tokens:
        return None
    kind, text, _ = tokens[0]
    if kind == "NUMBER":
        short = len(tokens) == 1 and text.isdecimal() and len(text) <= ID_DIGITS
        return int(text) if short else None
    if kind != "NAME":
        return None
    return "".join(spelled(token[1]) for token in tokens)


def _has_no_angle(unit: str) -> bool:
    """Whether a unit is made of lengths, masses, times and forces only."""
    words = set(re.findall("[a-z]+", unit))
    return bool(words) and words <= {"length", "mass", "time", "force"}


class ValueReader:
    """Reads values; knows the names of the deck.

    Parameters
    ----------
    names : Names
    resolver : Resolver
    log : Log
    ground : callable
        Returns the id of the ground part, or None.
    """

    def __init__(
        self, names: Names, resolver: Resolver, log: Log, ground: Callable[[], Key | None]
    ) -> None:
        self.names = names
        self.resolver = resolver
        self.log = log
        self.ground = ground
        self._kinds: dict[str, Callable[[type[Statement], Argument, list[Tokens]], object]] = {
            "number": self._one_number,
            "vector": self._vector,
            "integer": self._integer,
            "flag": lambda cls, argument, values: True,
            "choice": self._choice,
            "reference": self._reference,
            "references": self._references,
            "ids": self._ids,
            "expression": self._expression,
            "text": self._text,
            "texts": self._texts,
            "words": self._words,
        }

    def value(self, cls: type[Statement], argument: Argument, values: list[Tokens]) -> object:
        """The value of ``argument``; raises :class:`Refused` after logging what is wrong."""
        return self._kinds[argument.kind](cls, argument, values)

    def _refuse(self, code: str, tokens: Tokens, hint: str = "", **words: object) -> NoReturn:
        self.log.add(code, tokens[0][2], end_of(tokens[-1]), hint, **words)
        raise Refused

    def _written(self, tokens: Tokens) -> str:
        text = self.log.source.text[tokens[0][2] : end_of(tokens[-1])]
        return " ".join(text.split())

    # ---- numbers ------------------------------------------------------------------------------

    def _number(self, argument: Argument, tokens: Tokens) -> float:
        sign = -1.0 if tokens[0][0] == "MINUS" else 1.0
        plain = tokens[1:] if len(tokens) == 2 and tokens[0][0] in ("MINUS", "PLUS") else tokens
        if len(plain) == 1 and plain[0][0] == "NUMBER":
            value = to_number(plain[0][1]) * (sign if plain is not tokens else 1.0)
            if plain[0][1][-1] in "dD" and _has_no_angle(argument.unit):
                self.log.add(
                    "degrees-of-no-angle", tokens[0][2], end_of(tokens[-1]), value=value,
                    text=self._written(tokens), word=argument.key, unit=argument.unit,
                )  # fmt: skip
        else:
            constant = self.resolver.constant(tokens)
            if constant is None:
                self._refuse("not-a-number", tokens, text=self._written(tokens), word=argument.key)
            value = constant
        if math.isinf(value):
            self._refuse("number-too-large", tokens, word=self._written(tokens))
        return value

    def _one_number(self, cls: type[Statement], argument: Argument, values: list[Tokens]) -> float:
        return self._number(argument, values[0])

    def _integer(self, cls: type[Statement], argument: Argument, values: list[Tokens]) -> int:
        value = self._number(argument, values[0])
        if not value.is_integer():
            self._refuse("not-an-integer", values[0], word=argument.key)
        return int(value)

    def _vector(
        self, cls: type[Statement], argument: Argument, values: list[Tokens]
    ) -> tuple[float, ...]:
        if len(values) == 1 and values[0][0][0] in CLOSES:
            values = split(unwrapped(values[0]), "COMMA")
        low, high = argument.sizes
        if not low <= len(values) <= high or not all(values):
            expected = f"{low} values" if low == high else f"{low} to {high} values"
            flat = [token for value in values for token in value]
            count = len([value for value in values if value])
            self._refuse("value-count", flat, word=argument.key, expected=expected, count=count)
        return tuple([self._number(argument, tokens) for tokens in values])

    def vectors(
        self, cls: type[Statement], argument: Argument, rows: list[list[Tokens]]
    ) -> tuple[tuple[float, ...], ...]:
        """The lists of an argument that may be given several times."""
        return tuple([self._vector(cls, argument, row) for row in rows])

    # ---- words --------------------------------------------------------------------------------

    def _choice(self, cls: type[Statement], argument: Argument, values: list[Tokens]) -> str:
        option = self._option(argument, unwrapped(values[0]) or values[0])
        for given_up, instead in argument.discontinued:
            if option == given_up:
                place = values[0][0][2], end_of(values[0][-1])
                self.log.add("discontinued-choice", *place, word=option, instead=instead)
                option = instead.partition(",")[0]
        if argument.supported and option not in argument.supported:
            token = values[0][0]
            self.log.tally(
                "planned-choice", f"{cls.keyword} {option}", token[2], end_of(token),
                keyword=cls.keyword, word=option, known=", ".join(argument.supported),
            )  # fmt: skip
            raise Refused
        return option

    def _option(self, argument: Argument, tokens: Tokens) -> str:
        word = spelled(tokens[0][1]).upper()
        single = len(tokens) == 1 and tokens[0][0] == "NAME"
        found = match(word, {option: option for option in argument.options}) if single else None
        if not isinstance(found, str):
            self._refuse(
                "unknown-choice", tokens, word=argument.key, text=self._written(tokens),
                known=", ".join(argument.options),
                hint=self.log.guesses.meant(word, argument.key, lambda: argument.options),
            )  # fmt: skip
        return found

    def _words(
        self, cls: type[Statement], argument: Argument, values: list[Tokens]
    ) -> tuple[str, ...]:
        parts = split(unwrapped(values[0]), "COLON")
        return tuple(self._option(argument, part or values[0]) for part in parts)

    def _text(self, cls: type[Statement], argument: Argument, values: list[Tokens]) -> str:
        tokens = values[0]
        text = self.log.source.text[tokens[0][2] : end_of(tokens[-1])]
        return text[1:-1] if len(text) > 1 and text[0] == text[-1] == '"' else text

    def _texts(
        self, cls: type[Statement], argument: Argument, values: list[Tokens]
    ) -> tuple[str, ...]:
        return tuple(self._text(cls, argument, [value]) for value in values)

    # ---- other statements ---------------------------------------------------------------------

    def _reference(self, cls: type[Statement], argument: Argument, values: list[Tokens]) -> Key:
        return self._refer(argument, values[0])

    def _references(
        self, cls: type[Statement], argument: Argument, values: list[Tokens]
    ) -> tuple[Key, ...]:
        return tuple([self._refer(argument, tokens) for tokens in values])

    def _ids(
        self, cls: type[Statement], argument: Argument, values: list[Tokens]
    ) -> tuple[Key, ...]:
        return tuple([self._id(tokens) for tokens in values])

    def _id(self, tokens: Tokens) -> Key:
        key = to_id(tokens)
        if not key:
            self._refuse("bad-id", tokens, text=self._written(tokens))
        return key.upper() if isinstance(key, str) else key

    def _refer(self, argument: Argument, tokens: Tokens) -> Key:
        kind, key = argument.to, to_id(tokens)
        if key is None:
            self._refuse("not-a-reference", tokens, text=self._written(tokens), kind=kind)
        if key == 0 and argument.default == 0:
            return 0
        wanted = key.upper() if isinstance(key, str) else key
        found = self.names.find(kind, wanted)
        if found is None and wanted == GROUND and kind == "PART":
            found = self.ground()
        if isinstance(found, list):
            labels = ", ".join(f"{kind}/{each}" for each in found[:5])
            self._refuse("ambiguous-name", tokens, word=key, labels=labels)
        if found is None:
            self.log.missing(self.names, kind, key, tokens[0][2], end_of(tokens[-1]))
            raise Refused
        inner = unwrapped(tokens)
        self.names.used(kind, found, inner[0][2], end_of(inner[-1]))
        return found

    def components(self, argument: Argument, values: list[Tokens]) -> tuple[Node, ...]:
        """The components of a vector, or the routine that computes all of them."""
        try:
            if argument.key == ROUTINE_ARGUMENT:
                return (self.resolver.routine(values[0]),) * len(argument.fills)
            return self.resolver.components(values[0])
        except Unresolved:
            raise Refused from None

    def _expression(self, cls: type[Statement], argument: Argument, values: list[Tokens]) -> Node:
        try:
            value = self.resolver.expression(values[0])
        except Unresolved:
            raise Refused from None
        if is_user_call(value) and argument.key != ROUTINE_ARGUMENT:
            self._refuse("user-within", values[0])
        return value
