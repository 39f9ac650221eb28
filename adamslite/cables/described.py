"""Whether the statements of a deck are those of the description that it carries.

They are written again by the model that stands beside the description and compared, token by token,
without comments, results and the settings of the run.  Where only numbers differ that also stand in
the description, these are edited there too: the statements then are those of the edited one, or
the deck is taken as if it had none.
"""

import re
from collections.abc import Iterator, Sequence
from dataclasses import replace
from typing import NamedTuple

from adamslite.cables.brute_force_layout import Overstretched
from adamslite.cables.deck_writer import write
from adamslite.cables.demand import Demand
from adamslite.cables.description import Carried, Model, below, carried, comments
from adamslite.cables.model_choice import CableModel, Reasons
from adamslite.cables.scene import Drawn, chosen, drawn
from adamslite.cables.vocabulary import Spec
from adamslite.language.diagnostics import DeckError
from adamslite.syntax.lines import join
from adamslite.syntax.tokens import scan

# Statements that change neither a cable nor what happens to it.
PASSIVE = frozenset(
    "END EQUILIBRIUM GRAPHICS INTEGRATOR MREQUEST OUTPUT REQUEST RESULTS STOP".split()
)
# Numbers that a user has edited, at most, and tokens of a deck in which they are looked for.
MOST_EDITS, MOST_TOKENS = 4, 30_000
# Of a number: what its text in a deck leaves out.
ROUND_OFF = 1e-9
# Numbers of a description, its comments aside.
NUMBER = re.compile(r"(?<![\w.])(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?(?![\w.])|(#[^\n]*)")

Token = str | float
Tokens = list[list[Token]]
"""Of statements."""


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
        to `end`."""
        given = self.drawn.given
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
                yield Choice(p, model, model.reasons.told, setting.demand)


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
    of, written = _written(found.text, found.model)
    if written and deck.endswith(below(written)):  # as most are: nobody has edited it
        return of
    text, edits, wanted = found.text, 0, tokens(deck, title)
    differing = _differing(of, written, wanted) if of else None
    while differing and edits < MOST_EDITS:
        text, of, differing = _nearer(text, found.model, wanted, differing)
        edits += 1
    return of if differing == set() else None


Pairs = set[tuple[float, float]]
"""Numbers as written, and as they stand in a deck."""


def _written(text: str, model: Model) -> tuple[Drawn | None, str]:
    """A description and its deck; None where it has mistakes."""
    try:
        of = drawn(text)
        of = of.pulling() if model.pulls_only else of
        return of, write(of.spec, of.pieces, of.moves, _model(model), comments(text, model))
    except DeckError:
        return None, ""


def _differing(of: Drawn, written: str, wanted: Tokens) -> Pairs | None:
    """The numbers that differ; None where more does."""
    own = tokens(written, of.spec.title)
    if [*map(len, own)] != [*map(len, wanted)]:
        return None
    pairs = set()
    for mine, theirs in zip(own, wanted, strict=True):
        for a, b in zip(mine, theirs, strict=True):
            if a != b:
                if not isinstance(a, float) or not isinstance(b, float):
                    return None
                pairs.add((a, b))
    return pairs


def _nearer(
    text: str, model: Model, wanted: Tokens, differing: Pairs
) -> tuple[str, Drawn | None, Pairs | None]:
    """The description with one number edited that leaves fewer to differ."""
    if sum(map(len, wanted)) <= MOST_TOKENS:
        for edited in _edited(text, differing):
            of, written = _written(edited, model)
            left = _differing(of, written, wanted) if of else None
            if left is not None and len(left) < len(differing):
                return edited, of, left
    return text, None, None


def _edited(text: str, differing: Pairs) -> Iterator[str]:
    """The description with a number that differs replaced, at each place where it stands."""
    for place in NUMBER.finditer(text):
        if place[1] is None:
            for a, b in differing:
                if abs(float(place[0]) - a) <= ROUND_OFF * abs(a):
                    number = f"{b:.0f}" if place[0].isdigit() and b == int(b) else repr(b)
                    yield text[: place.start()] + number + text[place.end() :]
