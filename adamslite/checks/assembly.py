"""Rules about the start of a run: whether the bodies are where their joints hold them.

These need the posture of the deck in numbers; they run in :func:`check` only.
"""

from __future__ import annotations

from collections.abc import Iterator
from math import hypot

from adamslite.checks.rule import Rule
from adamslite.deck.deck import Deck
from adamslite.deck.statement_diagnostics import diagnose
from adamslite.elements.bases.constraint import Constraint
from adamslite.elements.marker import Marker
from adamslite.elements.part import Part
from adamslite.elements.sforce import Sforce
from adamslite.elements.springdamper import Springdamper
from adamslite.elements.units import Units
from adamslite.language.diagnostics import Diagnostic
from adamslite.language.interfaces import Key

# Gaps below this share of the size of a model, and angles below this, are digits of numbers.
APART, ASKEW_DEGREES = 1e-5, 1e-2
# Distances below this share of the size of a model are none.
ROUND_OFF = 1e-12


def starts_apart(deck: Deck) -> Iterator[Diagnostic]:
    """Joints whose markers are apart or misaligned as the deck draws them."""
    if not any(deck.of(kind) for kind in ("JOINT", "JPRIM")):
        return
    from adamslite.assembly.drawn import gaps, size_of

    least = APART * size_of(deck)
    for joint, (gap, angle, _) in gaps(deck):
        apart = f"{_length(deck, gap)} apart" if gap > least else ""
        askew = f"{angle:.4g} degrees out of line" if angle > ASKEW_DEGREES else ""
        if apart or askew:
            how = " and ".join(filter(None, (apart, askew)))
            yield diagnose(joint, "starts-apart", "i", how=how, i=joint.i, j=joint.j)


def _length(deck: Deck, value: float) -> str:
    """A length with its unit, where the deck names one."""
    names, text = deck.single(Units).names, f"{value:.4g}"
    if names is None:
        return text
    unit = names[2].lower()
    several = {"foot": "feet", "inch": "inches", "mils": "mils"}.get(unit, f"{unit}s")
    return f"{text} {unit if text == '1' else several}"


def stays_open(deck: Deck) -> Iterator[Diagnostic]:
    """Constraints that no posture near that of the deck satisfies together."""
    if not any(isinstance(each, Constraint) for each in deck.statements):
        return
    from adamslite.assembly.closing import OPEN
    from adamslite.assembly.drawn import is_closed_as_drawn
    from adamslite.assembly.start import closing_of, worst_gap

    if is_closed_as_drawn(deck, OPEN):
        return

    _, closing = closing_of(deck)
    if closing.closed:
        return
    worst = worst_gap(closing)
    if worst is None:
        return
    statement, row, size, others = worst
    also = f": it contradicts {', '.join(others)}" if others else ""
    yield diagnose(statement, "stays-open", row=row, size=f"{size:.4g}", also=also)


def ends_coincide(deck: Deck) -> Iterator[Diagnostic]:
    """Forces along a line whose ends start in the same place."""
    found: list[Sforce | Springdamper] = [*deck.of(Sforce), *deck.of(Springdamper)]
    forces = [
        each
        for each in found
        if each.kind == "TRANSLATIONAL" and deck.is_active(each) and each.i != each.j
        if not (isinstance(each, Sforce) and each.actiononly)
    ]
    if not any(isinstance(each, Constraint) for each in deck.statements):
        at = _Origins(deck)
        forces = [each for each in forces if not _plainly_apart(at[each.i], at[each.j])]
    if not forces:
        return
    import numpy as np

    from adamslite.assembly.closing import OPEN
    from adamslite.assembly.drawn import is_closed_as_drawn, place_of, size_of, spot
    from adamslite.assembly.scope import NumberScope
    from adamslite.assembly.start import closing_of

    as_drawn, least = is_closed_as_drawn(deck, OPEN), ROUND_OFF * size_of(deck)
    for each in forces:
        if as_drawn:
            reach = place_of(spot(deck, each.i)).p - place_of(spot(deck, each.j)).p
        else:
            model, closing = closing_of(deck)
            between = NumberScope(model, closing.posture, False).position(each.i, each.j)
            reach = np.array([component.value for component in between])
        if hypot(*reach) <= least:
            yield diagnose(each, "ends-coincide", "i", i=each.i, j=each.j)


class _Origins(dict[Key, list[float] | None]):
    """Where markers are whose bodies have the axes of ground, as most do; None for others.  Small
    decks do without numpy.
    """

    def __init__(self, deck: Deck) -> None:
        super().__init__()
        self.deck = deck

    def __missing__(self, key: Key) -> list[float] | None:
        marker = self.deck.get(Marker, key)
        body = self.deck.find(*marker.owner) if marker.owner else None
        self[key] = None
        if body is not None and not any(body.given(field) for field in ("reuler", "zg", "xg")):
            self[key] = [a + b for a, b in zip(body.qg, marker.qp, strict=True)]
        return self[key]


def _plainly_apart(start: list[float] | None, end: list[float] | None) -> bool:
    """Whether two origins are known and in different places."""
    if start is None or end is None:
        return False
    apart = max(abs(a - b) for a, b in zip(start, end, strict=True))
    return apart > ROUND_OFF * max(map(abs, start))


def massless_freedoms(deck: Deck) -> Iterator[Diagnostic]:
    """Parts without mass that can move while everything that has mass stays."""
    parts = [each for each in deck.of(Part) if not (each.ground or each.mass)]
    if not parts:
        return
    from adamslite.assembly.start import closing_of, loose_bodies

    model, closing = closing_of(deck)
    loose = loose_bodies(model, closing.posture)
    for part in parts:
        if model.body_index[part.keyword, part.key] in loose:
            yield diagnose(part, "massless")


ASSEMBLY_RULES: list[Rule] = [starts_apart, stays_open, ends_coincide, massless_freedoms]
