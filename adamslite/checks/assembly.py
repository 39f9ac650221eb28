"""Rules about the start of a run: whether the bodies are where their joints hold them.

These need the posture of the deck in numbers; they run in :func:`check` only.
"""

from __future__ import annotations

from collections.abc import Iterator
from math import asin, atan2, degrees, hypot
from typing import TYPE_CHECKING

from adamslite.checks.rule import Rule
from adamslite.deck.deck import Deck
from adamslite.deck.statement_diagnostics import diagnose
from adamslite.elements.bases.constraint import ON_LINE, PARALLEL, SAME_TURN, TOGETHER, Constraint
from adamslite.elements.joint import Joint
from adamslite.elements.jprim import Jprim
from adamslite.elements.part import Part
from adamslite.elements.sforce import Sforce
from adamslite.elements.springdamper import Springdamper
from adamslite.elements.units import Units
from adamslite.language.diagnostics import Diagnostic

if TYPE_CHECKING:  # decks without constraints do without numpy
    import numpy as np

    from adamslite.model.model import Model

# Gaps below this share of the size of a model, and angles below this, are digits of numbers.
APART, ASKEW_DEGREES = 1e-5, 1e-2
# Distances below this share of the size of a model are none.
ROUND_OFF = 1e-12
LENGTHS = {*TOGETHER, *ON_LINE, "offset along z_J"}


def starts_apart(deck: Deck) -> Iterator[Diagnostic]:
    """Joints whose markers are apart or misaligned as the deck draws them."""
    joints: list[Joint | Jprim] = [*deck.of(Joint), *deck.of(Jprim)]
    joints = [each for each in joints if deck.is_active(each)]
    if not joints:
        return
    from adamslite.assembly.start import closing_of, size_of

    model, closing = closing_of(deck)
    least = APART * size_of(model)
    drawn = zip(closing.kept, closing.drawn, strict=True)
    rows = {(each.keyword, each.key): gap for each, gap in drawn}
    for joint in joints:
        gap, angle = _gap(model, joint, rows[joint.keyword, joint.key])
        apart = f"{gap:.4g}{_unit(deck)} apart" if gap > least else ""
        askew = f"{angle:.4g} degrees out of line" if angle > ASKEW_DEGREES else ""
        if apart or askew:
            how = " and ".join(filter(None, (apart, askew)))
            yield diagnose(joint, "starts-apart", "i", how=how, i=joint.i, j=joint.j)


def _unit(deck: Deck) -> str:
    """The unit of length with a blank before it, where the deck names one."""
    names = deck.single(Units).names
    if names is None:
        return ""
    unit = names[2].lower()
    return " " + {"foot": "feet", "inch": "inches", "mils": "mils"}.get(unit, f"{unit}s")


def _gap(model: Model, joint: Joint | Jprim, rows: np.ndarray) -> tuple[float, float]:
    """What a joint is apart [length] and out of line [degrees]."""
    named = list(zip(joint.row_names, rows.tolist(), strict=True))
    gap = hypot(*(value for name, value in named if name in LENGTHS))
    angles = [value for name, value in named if name in (*PARALLEL, *SAME_TURN)]
    if len(angles) == len(PARALLEL + SAME_TURN):
        return gap, _turn(model, joint)
    angles += [value for name, value in named if name.startswith("right angle")]
    angles += [value / 2 for name, value in named if name == "equal speed"]
    return gap, degrees(asin(min(1.0, hypot(*angles))))


def _turn(model: Model, joint: Joint | Jprim) -> float:
    """The smallest rotation that makes the axes of I parallel to those of J [degrees].

    They may point opposite ways in pairs: of the rotation matrix R = diag(1, 1, 1), (1, -1, -1),
    ... whichever is nearest counts, by its vector (R - R^T)/2 of length sin and trace 1 + 2 cos.
    """
    from adamslite.elements.bases.joint_coordinates import pose

    r = pose(model, joint.j)[1].T @ pose(model, joint.i)[1]
    signs = max(
        ((1, 1, 1), (1, -1, -1), (-1, 1, -1), (-1, -1, 1)),
        key=lambda s: float(r[0, 0] * s[0] + r[1, 1] * s[1] + r[2, 2] * s[2]),
    )
    r = r * signs
    twice = hypot(r[2, 1] - r[1, 2], r[0, 2] - r[2, 0], r[1, 0] - r[0, 1])
    return degrees(atan2(twice, float(r.trace()) - 1.0))


def stays_open(deck: Deck) -> Iterator[Diagnostic]:
    """Constraints that no posture near that of the deck satisfies together."""
    if not any(isinstance(each, Constraint) for each in deck.statements):
        return
    from adamslite.assembly.start import closing_of, worst_gap

    model, closing = closing_of(deck)
    if closing.closed:
        return
    worst = worst_gap(model, closing)
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
    if not forces:
        return
    from adamslite.assembly.scope import NumberScope
    from adamslite.assembly.start import closing_of, size_of

    model, closing = closing_of(deck)
    least = ROUND_OFF * size_of(model)
    for each in forces:
        reach = NumberScope(model, closing.posture, False).position(each.i, each.j)
        if hypot(*(component.value for component in reach)) <= least:
            yield diagnose(each, "ends-coincide", "i", i=each.i, j=each.j)


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
