"""Whether the statements of a deck are those of the description that it carries.

They are written again by the model that stands beside the description and compared, token by token,
without comments, results and the settings of the run.  Where only numbers differ, a number of the
description is edited, too, such that the statements are those of the edited description: all of
them, or all but the state at the start, in which the cable is as strained as before.  Else the deck
is taken as if it had no description.
"""

import re
from collections.abc import Callable, Iterator, Sequence
from dataclasses import replace
from itertools import chain, islice
from math import isclose
from typing import Any, NamedTuple

from adamslite.cables.deck.deck_writer import Modelled, write
from adamslite.cables.deck.scene import Drawn, chosen, drawn
from adamslite.cables.description.head_comments import Carried, Model, below, carried, comments
from adamslite.cables.description.vocabulary import Spec
from adamslite.cables.layout.brute_force_layout import Overstretched
from adamslite.cables.model.demand import Demand
from adamslite.cables.model.model_choice import CableModel, Reasons, tensions
from adamslite.language.diagnostics import DeckError
from adamslite.syntax.lines import join
from adamslite.syntax.tokens import scan

# Statements that change neither a cable nor what happens to it.
PASSIVE = frozenset(
    "END EQUILIBRIUM GRAPHICS INTEGRATOR MREQUEST OUTPUT REQUEST RESULTS STOP".split()
)
# Numbers that a user has edited, at most, and tokens that are compared to find one.
MOST_EDITS, MOST_TOKENS = 4, 3_000_000
# Of a number: what its text in a deck leaves out.
ROUND_OFF = 1e-9
# Of lengths, masses and places: what tensions at the start make of them; what is none [m, kg].
STATE, NOTHING = 0.01, 1e-6
# Numbers of a description, its comments aside.
NUMBER = re.compile(r"(?<![\w.])(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?(?![\w.])|(#[^\n]*)")

Token = str | float
Tokens = list[list[Any]]
"""Of statements: a :data:`Token` each."""


class Choice(NamedTuple):
    """What `adamslite cable` chooses for an accuracy, why, and the demand that this meets."""

    accuracy: float
    model: CableModel
    reasons: Sequence[str]
    demand: Demand


class Described(NamedTuple):
    """A description, and the model its deck was written by."""

    drawn: Drawn
    model: Model

    def choices(self, accuracies: Sequence[float], end: float, steps: int) -> Iterator[Choice]:
        """Without a word about the model in the description, for its accuracy and others, in a run
        to `end`; in that of the description where `end` is 0, for a deck without a run."""
        given = self.drawn.given
        end, steps = (end, steps) if end > 0 else (given.end, given.steps)
        known: list[tuple[Spec, Demand]] = []
        for p in sorted({given.accuracy, *accuracies}, reverse=True):
            asked = self.drawn.asking(p, end, steps)
            # The linear model takes the time; it is the same unless bending is left out.
            like = [of for spec, of in known if replace(spec, accuracy=p) == asked.spec]
            setting = asked.demanding(like[0] if like else None)
            known.append((asked.spec, setting.demand))
            if self.model.tried and asked.given == given:
                # What runs have shown stands, for the description that they were runs of.
                yield Choice(p, _model(self.model), self.model.tried, setting.demand)
            else:
                model = chosen(setting, setting.faults)
                yield Choice(p, model, model.reasons.sentences, setting.demand)


def described(deck: str, title: str) -> Described | None:
    """What a deck is by its own description; None where it has none, or contradicts it."""
    found = carried(deck)
    if found is None:
        return None
    try:
        of = _fitted(found, deck, title)
    except (ArithmeticError, ValueError, Overstretched):
        return None
    if of is None:
        return None
    return Described(of, found.model if of.text == found.text else found.model._replace(tried=()))


def _model(shown: Model) -> CableModel:
    level, form, elements, method, error, *_ = shown
    return CableModel(level, form, elements, method, error, (), Reasons((), (), (), "", ""))


def tokens(deck: str, title: str) -> Tokens:
    """Of all statements of a deck that are not passive; numbers by their value.

    Without commas, which also mark continued lines: what takes how many values is fixed.
    """
    start = deck.find(title) + len(title)
    found = []
    for statement in join(scan(deck, start)):
        words = [_token(kind, text) for kind, text, _ in statement.tokens if kind != "COMMA"]
        if words[0] not in PASSIVE and (words[0] != "SIMULATE" or "STATICS" in words):
            found.append(words)
    return found


def _token(kind: str, text: str) -> Token:
    if kind == "NUMBER":
        try:
            return float(text)
        except ValueError:  # of degrees
            return text.upper()
    return text if kind == "QUOTED" else text.upper()


def _fitted(found: Carried, deck: str, title: str) -> Drawn | None:
    """The description, edited where the deck was."""
    first, written = _written(found.text, found.model)
    if first is None or deck.endswith(below(written)):  # as most are: nobody has edited it
        return first
    start, wanted = tokens(written, first.spec.title), tokens(deck, title)
    if not _alike(start, wanted):
        return None
    now: _Edited | None = _Edited(_with_gravity(found.text), first, start)
    edits = 0
    while now and (left := _unexplained(start, now.statements, wanted)):
        edits += 1
        if edits > MOST_EDITS:
            return None
        now = _nearer(now, found.model, start, wanted, left)
    if now is None or now.statements == wanted:
        return now and replace(now.of, text=found.text if now.of is first else now.text)
    return _started(now.of, first) if _is_near(now.statements, wanted) else None


class _Edited(NamedTuple):
    """A description, what it says, and its statements."""

    text: str
    of: Drawn
    statements: Tokens


Pairs = dict[tuple[float, float], None]
"""Numbers as written and as they stand in a deck, in their order there."""


def _written(text: str, model: Model) -> tuple[Drawn | None, str]:
    """A description and its deck; None where it has mistakes."""
    try:
        of = drawn(text)
        of = of.pulling() if model.pulls_only else of
        whole = Modelled(of.spec, of.pieces, of.moves, _model(model))
        return of, write([whole], comments=comments(text, model))
    except DeckError:
        return None, ""


def _alike(one: Tokens, other: Tokens) -> bool:
    """Whether two decks differ in numbers alone."""
    return [*map(len, one)] == [*map(len, other)] and all(
        a == b or (isinstance(a, float) and isinstance(b, float)) for a, b in _both(one, other)
    )


def _both(one: Tokens, other: Tokens) -> Iterator[tuple[Token, Token]]:
    return zip(chain.from_iterable(one), chain.from_iterable(other), strict=True)


def _unexplained(start: Tokens, now: Tokens, wanted: Tokens) -> Pairs:
    """Numbers that were edited in the deck otherwise than in the description."""
    three = zip(*map(chain.from_iterable, (start, now, wanted)), strict=True)
    # The mass of a weight has a half section whose length depends on the state at the start.
    return {(b, c): None for a, b, c in three if a != c and abs(c - b) > STATE * abs(c - a)}


def _is_near(now: Tokens, wanted: Tokens) -> bool:
    """Whether what has stayed as it was is a matter of the state in which the cable starts."""
    return all(
        a == b or isclose(float(a), float(b), rel_tol=STATE, abs_tol=NOTHING)
        for a, b in _both(now, wanted)
    )


def _started(of: Drawn, first: Drawn) -> Drawn:
    """A description whose cable starts as strained as that of another one."""
    pulls = tensions(first.spec, first.pieces)
    return of.strained([pull / first.spec.cable.stiffness for pull in pulls])


def _with_gravity(text: str) -> str:
    """A description that says what gravity is."""
    known = re.search(r"(?m)^\s*gravity\s*=", text)
    return text if known else f"gravity = [0.0, -9.81, 0.0]\n{text}"


def _nearer(
    now: _Edited, model: Model, start: Tokens, wanted: Tokens, left: Pairs
) -> _Edited | None:
    """The description with one number edited that explains more of the deck."""
    most = MOST_TOKENS // sum(map(len, wanted))
    for text in islice(_edited(now.text, *next(iter(left))), most):
        of, written = _written(text, model)
        found = tokens(written, of.spec.title) if of else []
        if of and _alike(found, wanted) and len(_unexplained(start, found, wanted)) < len(left):
            return _Edited(text, of, found)
    return None


def _edited(text: str, written: float, wanted: float) -> Iterator[str]:
    """The description with another number, at each place: the one that stands in the deck, or one
    that is as much larger, or by the same factor."""
    changes: list[Callable[[float], float]] = [
        lambda x: wanted if isclose(x, written, rel_tol=ROUND_OFF) else x,
        lambda x: x + wanted - written,
        lambda x: x * wanted / written if written else x,
    ]
    places = [place for place in NUMBER.finditer(text) if place[1] is None]
    for change in changes:
        for place in places:
            before = float(place[0])
            after = float(f"{change(before):.10g}")
            if after != before:
                whole = place[0].isdigit() and after == int(after)
                number = f"{after:.0f}" if whole else repr(after)
                yield text[: place.start()] + number + text[place.end() :]
