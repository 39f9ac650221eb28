"""What a deck consists of: statements by kind, degrees of freedom, cables."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Sequence

from adamslite.deck.deck import Deck
from adamslite.deck.redefinition import Command
from adamslite.language.diagnostics import SEVERITIES, Diagnostic, numbers_of

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
