"""Statements that differ in their numbers only are read by a pattern.

A deck of thousands of bodies is a few statements written again and again.  What grouping, checks
and expressions make of one they make of all of its kind, but for numbers and ids: where the tokens
of each value are is found once.  A statement that would have a message of its own (an id that does
not exist, a number that is too large) does not fit and is read the long way.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from math import isinf
from typing import Any, NamedTuple

from adamslite.deck.names import Names, to_number
from adamslite.functions.arrays import NUMBERED
from adamslite.functions.vectors import VECTORS
from adamslite.language.diagnostics import Source, Spans, packed
from adamslite.language.expression import NEGATE, Call, Node, Num, Op, Ref, names_called
from adamslite.language.function import FUNCTIONS
from adamslite.language.interfaces import ID_DIGITS
from adamslite.language.routines import USER
from adamslite.reading.argument_grouping import Pieces, Read
from adamslite.syntax.forms import Fault, Tree, expression_form
from adamslite.syntax.syntax_errors import Waiting
from adamslite.syntax.tokens import OPERATORS, Lexeme, Tokens

Build = Callable[[Sequence[str]], Any]
"""A value from the texts of the tokens of a statement; raises :class:`Unfit`."""
Key = tuple[str | None, ...]
# Statements of one kind that are read the long way before the next ones have a pattern.
COMMON = 3


class Unfit(Exception):
    """A statement, or its like, that is read the long way."""


class Place(NamedTuple):
    """Where an argument is written: numbers of its first and last token, and how many characters
    the last one counts (0: as it is written).
    """

    first: int
    last: int
    width: int


class Pattern(NamedTuple):
    """How the arguments of a statement are read."""

    fields: tuple[str, ...]
    builds: tuple[Build, ...]
    places: tuple[Place, ...]
    called: frozenset[str] = frozenset()

    def read(self, source: Source, waiting: Waiting) -> Read:
        """What it reads; raises :class:`Unfit`."""
        texts, at = waiting.texts, waiting.offsets
        offsets = [*waiting.range]
        for first, last, width in self.places:
            offsets += at[first], at[last] + (width or len(texts[last]))
        values = {name: build(texts) for name, build in zip(self.fields, self.builds, strict=True)}
        return Read(values, Spans.at(source, self.fields, packed(offsets)), self.called)


class Patterns:
    """The patterns of one text, made as its statements are read.

    Parameters
    ----------
    names : Names
    source : Source
    """

    def __init__(self, names: Names, source: Source) -> None:
        self.ids, self.source = names.ids, source
        # An editor notes every place that refers to a statement: all are read the long way.
        self.useful = type(names).used is Names.used
        self.known: dict[Key, Pattern | int | None] = {}
        """By the words between numbers: the pattern, how often there was none, None: not ever."""
        self._numbered: dict[tuple[str, ...], tuple[int, ...]] = {}
        self._numbers: dict[str, Num] = {}
        self._negatives: dict[str, Num] = {}
        self._refs: dict[tuple[str, str], Ref] = {}

    def key(self, waiting: Waiting, singleton: bool) -> Key:
        """The words of a statement but for its id, and where there are numbers."""
        words: list[str | None] = [*waiting.texts]
        for number in self._numbers_in(waiting.kinds):
            words[number] = None
        if not singleton:
            words[waiting.rest[0][0].start] = None
        return tuple(words)

    def _numbers_in(self, kinds: tuple[str, ...]) -> tuple[int, ...]:
        """Which tokens are numbers."""
        found = self._numbered.get(kinds)
        if found is None:
            numbers = tuple([n for n, kind in enumerate(kinds) if kind == "NUMBER"])
            found = self._numbered[kinds] = numbers
        return found

    def fitted(self, key: Key, waiting: Waiting) -> Read | None:
        """What the pattern of a statement reads; None where it has none or does not fit it."""
        pattern = self.known.get(key)
        if not isinstance(pattern, Pattern):
            return None
        try:
            return pattern.read(self.source, waiting)
        except Unfit:
            return None

    def wanted(self, key: Key) -> bool:
        """Whether a statement is one of many without a pattern."""
        count = self.known.get(key, 0)
        if not self.useful or not isinstance(count, int):
            return False
        self.known[key] = count + 1
        return count + 1 == COMMON

    def learn(
        self,
        key: Key,
        tokens: Sequence[Lexeme],
        found: Mapping[str, Pieces],
        values: Mapping[str, object],
    ) -> None:
        """Make the pattern of a statement from what was found in it and had no message."""
        try:
            self.known[key] = _Learner(self, tokens).pattern(found, values)
        except Unfit:
            self.known[key] = None

    # ---- what patterns are made of ------------------------------------------------------------

    def number(self, text: str) -> Num:
        """The node of a number."""
        found = self._numbers.get(text)
        if found is None:
            found = self._numbers[text] = Num(finite(text))
        return found

    def negative(self, text: str) -> Num:
        """The node of a number behind a minus."""
        found = self._negatives.get(text)
        if found is None:
            found = self._negatives[text] = Num(-finite(text))
        return found

    def ref(self, kind: str, text: str) -> Ref:
        """The node of an id that exists."""
        found = self._refs.get((kind, text))
        if found is None:
            found = self._refs[kind, text] = Ref(kind, self.id(kind, text))
        return found

    def id(self, kind: str, text: str) -> int:
        """An id above zero, of a statement that exists."""
        key = int(text) if text.isdecimal() and len(text) <= ID_DIGITS else 0
        if not key or key not in self.ids.get(kind, ()):
            raise Unfit
        return key


def finite(text: str) -> float:
    """The value of a number token."""
    value = to_number(text)
    if isinf(value):
        raise Unfit
    return value


def plain(text: str) -> float:
    """The same without a unit."""
    if text[-1] in "dD":
        raise Unfit
    return finite(text)


class _Learner:
    """Makes the pattern of one statement."""

    def __init__(self, patterns: Patterns, tokens: Sequence[Lexeme]) -> None:
        self.patterns = patterns
        self.tokens = tokens
        self.number_of = {token[2]: n for n, token in enumerate(tokens)}

    def pattern(self, found: Mapping[str, Pieces], values: Mapping[str, object]) -> Pattern:
        """The pattern; raises :class:`Unfit` where there is none."""
        builds, places = [], []
        for name, pieces in found.items():
            if pieces.argument.fills or pieces.before:
                raise Unfit
            last = pieces.values[-1][-1]
            at = self.number_of[last[2]]
            width = 0 if pieces.end or last is self.tokens[at] else len(last[1])
            places.append(Place(self.number_of[pieces.start], at, width))
            builds.append(self._value(pieces, values[name]))
        called = names_called(each for each in values.values() if isinstance(each, Node))
        return Pattern(tuple(found), tuple(builds), tuple(places), called)

    def _value(self, pieces: Pieces, value: Any) -> Build:
        argument, tokens = pieces.argument, pieces.values
        match argument.kind:
            case "flag" | "choice":
                return _constant(value)
            case "number":
                return self._number(tokens[0])
            case "integer":
                return _whole(self._number(tokens[0]))
            case "vector":
                return _row([self._number(each) for each in tokens])
            case "reference":
                return self._reference(argument.to, tokens[0])
            case "references":
                return _row([self._reference(argument.to, each) for each in tokens])
            case "expression":
                return self._expression(tokens[0], value)
        raise Unfit

    def _number(self, tokens: Tokens) -> Build:
        kinds = [token[0] for token in tokens]
        at = self.number_of[tokens[-1][2]]
        if kinds == ["NUMBER"]:
            return lambda found: plain(found[at])
        if kinds == ["PLUS", "NUMBER"]:
            return lambda found: plain(found[at])
        if kinds == ["MINUS", "NUMBER"]:
            return lambda found: -plain(found[at])
        raise Unfit

    def _reference(self, kind: str, tokens: Tokens) -> Build:
        if len(tokens) != 1 or tokens[0][0] != "NUMBER":
            raise Unfit
        at, id_of = self.number_of[tokens[0][2]], self.patterns.id
        return lambda found: id_of(kind, found[at])

    # ---- expressions --------------------------------------------------------------------------

    def _expression(self, tokens: Tokens, value: Node) -> Build:
        form = expression_form(tuple([token[0] for token in tokens]))
        if isinstance(form, Fault):
            raise Unfit
        return self._node(form, [self.number_of[token[2]] for token in tokens], value)

    def _node(self, tree: Tree, at: Sequence[int], node: Node) -> Build:
        """How a node is built whose form is ``tree``, of the tokens with the numbers ``at``."""
        rule, first = tree[0], at[tree[1]]
        match rule, node:
            case "name", _:
                return _constant(node)
            case "number", Num(name=""):
                number = self.patterns.number
                return lambda found: number(found[first])
            case "negation", Num(name="") if tree[2][0] == "number":
                inside, negative = at[tree[2][1]], self.patterns.negative
                return lambda found: negative(found[inside])
            case "negation", Op(op, (inner,)) if op == NEGATE:
                build = self._node(tree[2], at, inner)
                return lambda found: Op(NEGATE, (build(found),))
            case "operation", Op(op, (left, right)) if op == OPERATORS[self.tokens[first][0]]:
                one, other = self._node(tree[2], at, left), self._node(tree[3], at, right)
                return lambda found: Op(op, (one(found), other(found)))
            case "call", Call(name, args) if name == self.tokens[first][1].upper():
                return self._call(name, tree[3:], at, args)
        raise Unfit

    def _call(
        self, name: str, branches: Sequence[Tree], at: Sequence[int], args: Sequence[Node]
    ) -> Build:
        function = FUNCTIONS[name]
        if function.ruled or name in NUMBERED or name in VECTORS or name == USER:
            raise Unfit
        builds = [self._argument(*each, at) for each in zip(branches, args, strict=False)]
        rest = tuple(args[len(branches) :])
        return lambda found: Call(name, (*[build(found) for build in builds], *rest))

    def _argument(self, tree: Tree, node: Node, at: Sequence[int]) -> Build:
        if type(node) is not Ref:
            return self._node(tree, at, node)
        if tree[0] == "name":
            return _constant(node)
        if tree[0] != "number":  # a name made of several words, of which one may be a number
            raise Unfit
        kind, first, ref = node.kind, at[tree[1]], self.patterns.ref
        return lambda found: ref(kind, found[first])


def _constant(value: object) -> Build:
    return lambda found: value


def _whole(build: Build) -> Build:
    def value(found: Sequence[str]) -> int:
        number = build(found)
        if not number.is_integer():
            raise Unfit
        return int(number)

    return value


def _row(builds: Sequence[Build]) -> Build:
    return lambda found: tuple([build(found) for build in builds])
