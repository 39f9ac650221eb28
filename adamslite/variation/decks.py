"""A deck with other numbers: its statements with new values, as reading the edited text gives them.

What a number of the text becomes is known from a reading with traced ones
(:mod:`adamslite.language.traced`).  What decides more than values (a count, a number that a rule of
a function looks at) is read anew, and so is what has become wrong: its message has the place in the
edited text.  Each name is compared with a reading of the edited text when it is first used.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any

from adamslite.checks.rule import apply
from adamslite.checks.rules import VALUE_RULES
from adamslite.deck.deck import Deck
from adamslite.deck.names import Names
from adamslite.errors import UsageError
from adamslite.language.diagnostics import Source
from adamslite.language.expression import Call, Node, Num, calls, rebuild, walk
from adamslite.language.function import find_function
from adamslite.language.statement import Statement
from adamslite.language.traced import Traced, again, places
from adamslite.reading.numbers import Given, Numbers, numbers_of
from adamslite.reading.read import read_by
from adamslite.reading.statement_reader import Reading

#: Kinds of parameters of functions whose numbers decide more than a value.
DECIDING = ("constant", "past")


@dataclass
class Variable:
    """A deck and what its numbers do.

    Attributes
    ----------
    deck : Deck
        As it was read.
    verified, slow : set of str
        Names whose values were compared with a reading, and those that are always read.
    """

    deck: Deck
    numbers: Numbers
    verified: set[str] = field(default_factory=set)
    slow: set[str] = field(default_factory=set)

    @cached_property
    def fields(self) -> dict[int, list[tuple[int, str]]]:
        """Of each number, by its place: the numbers of statements, and fields made of it."""
        found: dict[int, list[tuple[int, str]]] = {}
        for n, statement in enumerate(self.numbers.deck.own):
            for name in statement.arguments:
                for at in places_in(getattr(statement, name)):
                    found.setdefault(at, []).append((n, name))
        return found

    @cached_property
    def written(self) -> dict[int, float]:
        """What each number of the text is."""
        return {each.at: each.digits(each.value) for each in self.numbers.named.values()}

    @cached_property
    def deciding(self) -> set[int]:
        """Numbers that reading looks at."""
        found: set[int] = set()
        for statement in self.numbers.deck.own:
            for name, argument in statement.arguments.items():
                value = getattr(statement, name)
                if argument.kind == "expression" and value is not None:
                    for call in calls(value):
                        found.update(_deciding(call))
        return found

    @cached_property
    def alike(self) -> bool:
        """Whether traced statements are those of the deck."""
        made = self.numbers.deck.own
        return not self.numbers.mistakes and len(made) == len(self.deck.own) and all(
            one.label == other.label for one, other in zip(made, self.deck.own, strict=True)
        )  # fmt: skip

    def is_quick(self, values: Mapping[str, float]) -> bool:
        """Whether these numbers change values of statements and nothing else."""
        at = {self.numbers.named[name.upper()].at for name in values}
        known = self.alike and at <= self.fields.keys() and not at & self.deciding
        return known and self.slow.isdisjoint(values)

    def statements(self, values: Mapping[str, float]) -> dict[int, Statement]:
        """The statements that change, by their numbers.

        Raises
        ------
        ArithmeticError, ValueError
            Where an operation on numbers has no value.
        """
        named = [self.numbers.named[name.upper()] for name in values]
        changed = {number.at: number.digits(values[number.name]) for number in named}
        written = {**self.written, **changed}
        found: dict[int, dict[str, Any]] = {}
        for at in changed:
            for n, name in self.fields[at]:
                traced = getattr(self.numbers.deck.own[n], name)
                found.setdefault(n, {})[name] = remade(traced, written)
        return {n: _with(self.deck.own[n], fields) for n, fields in found.items()}


def variable_of(deck: Deck) -> Variable:
    """A deck as it was read, ready for other numbers."""
    if Variable not in deck.kept:
        if any(each.spans.source is not deck.source for each in deck.own if each.spans):
            raise UsageError("numbers are put into a deck as it was read, not as commands left it")
        deck.kept[Variable] = Variable(deck, numbers_of(deck.source, deck.path, deck.user))
    found: Variable = deck.kept[Variable]
    return found


def with_values(deck: Deck, values: Given) -> Deck:
    """The deck with other numbers, which may have such already.

    Raises
    ------
    DeckError
        With the mistakes that it then has.
    UsageError
        When there is no number of a name, or a value is no finite number.
    """
    base = deck.base or deck
    variable = variable_of(base)
    given = {**deck.values, **variable.numbers.given(values)}
    text = variable.numbers.text(given)
    quick = _quickly(variable, given, text) if variable.is_quick(given) else None
    fresh = variable.numbers.others(given) - variable.verified
    if quick is not None and not fresh:
        return quick
    made = _read(base, text)
    made.base, made.values = base, given
    if quick is not None:
        (variable.verified if _same(quick, made) else variable.slow).update(fresh)
    return made


def _quickly(variable: Variable, given: Mapping[str, float], text: str) -> Deck | None:
    """The deck; None where something is wrong with it."""
    base = variable.deck
    try:
        changed = variable.statements(given)
    except (ArithmeticError, ValueError):
        return None
    own = tuple(changed.get(n, each) for n, each in enumerate(base.own))
    made = base.with_statements(own)
    made.source = Source(text, base.source.file)
    made.base, made.values, made.warnings = base, given, ()
    return None if any(each.is_error for each in apply(VALUE_RULES, made)) else made


def is_quick(deck: Deck) -> bool:
    """Whether the statements of a deck with other numbers are known to be what recipes give."""
    variable = variable_of(deck.base or deck)
    known = variable.numbers.others(deck.values) <= variable.verified
    return known and variable.is_quick(deck.values)


def as_read(deck: Deck) -> Deck:
    """The deck as reading its text gives it, with places and warnings of its own."""
    return deck if deck.base is None else _read(deck.base, deck.source.text)


def _read(base: Deck, text: str) -> Deck:
    source = Source(text, base.source.file)
    return read_by(Reading(source, Names(), "deck"), base.path, base.user)


def _same(one: Deck, other: Deck) -> bool:
    """Whether the statements of decks are equal, field by field."""
    return len(one.own) == len(other.own) and all(map(_equal, one.own, other.own))


def _equal(one: Statement, other: Statement) -> bool:
    """Whether all fields are written alike, minus signs of zeros too."""
    pairs = [(getattr(one, name), getattr(other, name)) for name in one.field_names - {"spans"}]
    return type(one) is type(other) and all(a is b or repr(a) == repr(b) for a, b in pairs)


def _with(statement: Statement, fields: Mapping[str, Any]) -> Statement:
    """A statement with other values."""
    known = {name: each for name, each in vars(statement).items() if name in statement.field_names}
    made = type(statement)(**{**known, **fields})
    if "called" in vars(statement):
        vars(made)["called"] = statement.called
    return made


def places_in(value: Any) -> set[int]:
    """The numbers of the text that a value is made of."""
    if type(value) is Traced:
        return places(value.recipe)
    if isinstance(value, Node):
        traced = (each.value for each in walk(value) if type(each) is Num)
        return set().union(*(places(each.recipe) for each in traced if type(each) is Traced))
    return set().union(*map(places_in, value)) if isinstance(value, tuple) else set()


def remade(value: Any, written: Mapping[int, float]) -> Any:
    """A value made of other numbers."""
    if type(value) is Traced:
        return again(value.recipe, written)
    if isinstance(value, Node):
        return rebuild(value, lambda node: _number(node, written))
    if isinstance(value, tuple):
        return tuple([remade(each, written) for each in value])
    return value


def _number(node: Node, written: Mapping[int, float]) -> Node:
    if type(node) is Num and type(node.value) is Traced:
        return Num(again(node.value.recipe, written), node.name)
    return node


def _deciding(call: Call) -> Iterator[int]:
    """The numbers of a call that rules and the choice of a form look at."""
    function = find_function(call.name)
    for n, each in enumerate(call.args):
        if function.ruled or function.parameter(n).kind in DECIDING:
            yield from places_in(each)
