"""`check` as users of Python call it: every message about a deck, and what the deck contains."""

from __future__ import annotations

import os
from collections import Counter
from collections.abc import Iterable, Sequence

import adamslite
from adamslite.api.inputs import (
    CommandSource,
    User,
    Values,
    need_subject,
    read_inputs,
    with_commands,
)
from adamslite.checks import rules
from adamslite.checks.runs import without_run
from adamslite.deck.deck import Deck
from adamslite.deck.redefinition import Command
from adamslite.language.diagnostics import (
    SEVERITIES,
    DeckError,
    Diagnostic,
    limited,
    numbers_of,
    render,
)
from adamslite.language.messages.ignoring import without_ignored
from adamslite.language.text import NamedText
from adamslite.variation.decks import as_read


class Check(list[Diagnostic]):
    """The messages about a deck, in the order of the deck; as text what `adamslite check` prints.

    Parameters
    ----------
    messages : iterable of Diagnostic
    deck : Deck or None
        None where it could not be read.
    commands : sequence of Command
        The commands of its run.
    title : str
        The files, or the title of a text.
    """

    def __init__(
        self,
        messages: Iterable[Diagnostic],
        deck: Deck | None = None,
        commands: Sequence[Command] = (),
        title: str = "",
    ) -> None:
        super().__init__(limited(messages))
        self.deck, self.commands, self.title = deck, commands, title

    @property
    def errors(self) -> list[Diagnostic]:
        """Those because of which the deck does not run."""
        return [each for each in self if each.is_error]

    @property
    def counts(self) -> str:
        """How many messages of each kind there are."""
        return counted(self, ("error", "warning") if self.errors else ()) or "no mistakes found"

    @property
    def contents(self) -> list[str]:
        """What a deck without errors consists of: statements, degrees of freedom, cables."""
        if self.deck is None or self.errors:
            return []
        return contents(self.deck, self.commands)

    def __str__(self) -> str:
        messages = f"{render(self)}\n\n" if self else ""
        if self.errors or self.deck is None:
            return f"{messages}{self.counts}\n"
        lines = [f"{self.title}: {self.counts}", *(f"  {line}" for line in self.contents)]
        return messages + "".join(f"{line}\n" for line in lines)

    def __repr__(self) -> str:
        return str(self).rstrip()

    def _repr_html_(self) -> str:
        return adamslite.html(self)


def check(
    scene: Deck | str | os.PathLike[str],
    commands: CommandSource = None,
    user: User = None,
    values: Values = (),
) -> Check:
    """Everything to say about a deck: of a file or text errors too, and what it can do without;
    of a Deck warnings and notes.

    Parameters
    ----------
    scene : str, Path or Deck
        A file, the text of a deck (more than one line), or a deck that has been read.
    commands : str, Path, or iterable of str or of statements
        As for :func:`adamslite.simulate`; of a Deck nothing unless given.
    user, values
        As for :func:`adamslite.read`, of a file or text.
    """
    if isinstance(scene, str | os.PathLike):
        return _of_files(scene, commands, user, values)
    need_subject(scene)
    scene = as_read(scene)
    found = rules.check(scene)
    if commands is None:
        return Check(found, scene, (), _title(scene))
    given = with_commands(scene, commands)
    return Check([*found, *given.messages], scene, given.commands, _title(scene))


def _of_files(
    scene: str | os.PathLike[str], commands: CommandSource, user: User, values: Values
) -> Check:
    """Deck and command file as the command line checks them."""
    title = scene.name if isinstance(scene, NamedText) else f"{scene}".partition("\n")[0]
    try:
        read = read_inputs(scene, commands, user, values)
    except DeckError as fault:
        return Check(fault.diagnostics, fault.deck, (), title)
    deck = read.deck
    missing = without_ignored(deck.source, without_run(deck, read.commands))
    title = f"{title} with {read.beside} beside it" if read.beside else title
    messages = [*read.messages, *missing, *rules.needless(deck)]
    return Check(messages, deck, read.commands, title)


def _title(deck: Deck) -> str:
    return str(deck.path or deck.title)


MOST_NAMED = 200
"""Redundant rows that are named."""
MOST_SURPLUS = 2000
"""Constraint rows beyond the number of coordinates with which degrees of freedom are counted."""


def contents(deck: Deck, commands: Sequence[Command]) -> list[str]:
    """Lines about a deck; of its cables also how they would be modelled."""
    from adamslite.cables.recognition.report import about_cables

    kinds = Counter(statement.keyword for statement in deck.statements)
    listed = ", ".join(f"{number} {keyword}" for keyword, number in kinds.items())
    cables = [line.removeprefix("  ") for line in about_cables(deck, commands)]
    return [f"{many(kinds.total(), 'statement')}: {listed}", *_freedom(deck), *cables]


def counted(diagnostics: Iterable[Diagnostic], always: Sequence[str] = ()) -> str:
    """How many there are of each severity; those of `always` also where there are none."""
    found = dict(zip(SEVERITIES, numbers_of(diagnostics), strict=True))
    kinds = [each for each in SEVERITIES if found[each] or each in always]
    return ", ".join(many(found[each], each) for each in kinds)


def many(number: int, one: str, several: str = "") -> str:
    """``1 part``, ``2 parts``"""
    return f"{number} {one if number == 1 else several or one + 's'}"


def _freedom(deck: Deck) -> list[str]:
    """Six coordinates for a part and three for a point mass, less one for each independent row."""
    from adamslite.elements.bases.constraint import Constraint
    from adamslite.elements.part import Part
    from adamslite.elements.point_mass import PointMass

    parts = sum(not each.ground for each in deck.of(Part))
    points = len(deck.of(PointMass))
    constraints = [each for each in deck.statements if isinstance(each, Constraint)]
    held = sum(each.n_rows for each in constraints if deck.is_active(each))
    consisting = (
        f"{many(parts, 'moving part')}, {many(points, 'point mass', 'point masses')}, "
        f"{many(held, 'constraint row')}"
    )
    found = _redundant(deck, held - 6 * parts - 3 * points) if held else []
    if found is None:
        return [f"{consisting}: too many of them are redundant to count degrees of freedom"]
    free = 6 * parts + 3 * points - held + len(found)
    freedom = f"{many(free, 'degree')} of freedom: {consisting}"
    if not found:
        return [freedom]
    named = "; ".join(found[:MOST_NAMED])
    further = f"; and {len(found) - MOST_NAMED} more" if len(found) > MOST_NAMED else ""
    return [freedom, f"redundant, left out: {named}{further}"]


def _redundant(deck: Deck, surplus: int) -> list[str] | None:
    """Names of redundant rows; None where there are more than are looked for, as where ``surplus``,
    rows beyond the number of coordinates, is large.
    """
    if surplus > MOST_SURPLUS:
        return None
    from adamslite.assembly.rank import TooManyDependent
    from adamslite.assembly.start import redundant_rows

    try:
        return redundant_rows(deck)
    except TooManyDependent:
        return None
