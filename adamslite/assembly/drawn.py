"""Where the deck draws its markers, and what joints are apart there.

A marker is at r = r_B + A_B p with the axes A_B A_M, whatever the mass of its body.  What is found
for equal numbers is kept: an editor asks again after every edit, and few numbers have changed.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import lru_cache
from math import asin, atan2, degrees, hypot
from typing import Any, NamedTuple

import numpy as np

from adamslite.assembly.reader import NumberReader
from adamslite.assembly.rows import values_by
from adamslite.deck.deck import Deck
from adamslite.elements.bases.constraint import ON_LINE, PARALLEL, SAME_TURN, TOGETHER
from adamslite.elements.joint import Joint
from adamslite.elements.jprim import Jprim
from adamslite.elements.marker import Marker
from adamslite.elements.part import Part
from adamslite.elements.point_mass import PointMass
from adamslite.language.interfaces import Key
from adamslite.model.geometry import Place, axes_from_points, rotation_313

KEPT = 1 << 15
LENGTHS = {*TOGETHER, *ON_LINE, "offset along z_J"}
#: They start from the posture of the deck, wherever that is.
ANYWHERE = ("SCREW", "RACKPIN")
Point = tuple[float, ...]
Frame = tuple[Point, Point, Point | None, Point | None, bool]
"""Origin, angles, point on z, point on x, whether x is exact."""
Spot = tuple[Frame, Frame]
"""The frame of a body in ground, and that of a marker on it."""


class Gap(NamedTuple):
    """What a joint is apart [length] and out of line [degrees], and its worst row."""

    apart: float
    askew: float
    worst: float


def spot(deck: Deck, marker: Key) -> Spot:
    """The numbers by which the deck places a marker."""
    at = deck.get(Marker, marker)
    assert at.owner is not None  # a rule requires it
    body: Part | PointMass = deck.find(*at.owner)
    return (
        (tuple(body.qg), tuple(body.reuler), body.zg, body.xg, False),
        (tuple(at.qp), tuple(at.reuler), at.zp, at.xp, at.usexp),
    )


@lru_cache(maxsize=KEPT)
def _axes(frame: Frame) -> np.ndarray:
    origin, angles, z, x, exact = frame
    found = axes_from_points(np.asarray(origin, dtype=float), z, x, exact)
    return found if found is not None else rotation_313(angles)


@lru_cache(maxsize=KEPT)
def place_of(at: Spot) -> Place:
    """Origin and axes of a marker in ground."""
    body, marker = at
    base = _axes(body)
    origin = np.asarray(body[0], dtype=float) + base @ np.asarray(marker[0], dtype=float)
    return Place("ground", -1, origin, base @ _axes(marker))


@dataclass(frozen=True)
class _Still:
    """A model in which nothing moves: markers are where they are drawn."""

    places: Mapping[Key, Place]

    def marker(self, marker: Key) -> Place:
        return self.places[marker]


@lru_cache(maxsize=1)
def gaps(deck: Deck) -> list[tuple[Joint | Jprim, Gap]]:
    """What each active joint is apart as drawn."""
    joints: list[Joint | Jprim] = [*deck.of(Joint), *deck.of(Jprim)]
    return [
        (each, _gap(each.keyword, each.kind, spot(deck, each.i), spot(deck, each.j)))
        for each in joints
        if each.kind not in ANYWHERE and deck.is_active(each)
    ]


@lru_cache(maxsize=KEPT)
def _gap(keyword: str, kind: str, i: Spot, j: Spot) -> Gap:
    joint: Joint | Jprim = (Joint if keyword == Joint.keyword else Jprim)(kind=kind, i=1, j=2)
    places: dict[Key, Place] = {1: place_of(i), 2: place_of(j)}
    still: Any = _Still(places)
    nowhere: Any = None
    rows = values_by(joint, NumberReader(still, nowhere, False)).tolist()
    named = list(zip(joint.row_names, rows, strict=True))
    apart = hypot(*(value for name, value in named if name in LENGTHS))
    angles = [value for name, value in named if name in (*PARALLEL, *SAME_TURN)]
    if len(angles) == len(PARALLEL + SAME_TURN):
        askew = _turn(places[2].axes.T @ places[1].axes)
    else:
        angles += [value for name, value in named if name.startswith("right angle")]
        angles += [value / 2 for name, value in named if name == "equal speed"]
        askew = degrees(asin(min(1.0, hypot(*angles))))
    return Gap(apart, askew, max(map(abs, rows)))


def _turn(r: np.ndarray) -> float:
    """The smallest rotation that makes the axes of I parallel to those of J [degrees].

    They may point opposite ways in pairs: of the rotation matrix R = diag(1, 1, 1), (1, -1, -1),
    ... whichever is nearest counts, by its vector (R - R^T)/2 of length sin and trace 1 + 2 cos.
    """
    signs = max(
        ((1, 1, 1), (1, -1, -1), (-1, 1, -1), (-1, -1, 1)),
        key=lambda s: float(r[0, 0] * s[0] + r[1, 1] * s[1] + r[2, 2] * s[2]),
    )
    r = r * signs
    twice = hypot(r[2, 1] - r[1, 2], r[0, 2] - r[2, 0], r[1, 0] - r[0, 1])
    return degrees(atan2(twice, float(r.trace()) - 1.0))


def size_of(deck: Deck) -> float:
    """The largest distance along an axis between bodies, or else between ends of joints; 1 where
    all lie in one place.
    """
    bodies = [each.qg for each in deck.of(Part)] + [each.qg for each in deck.of(PointMass)]
    joints: list[Joint | Jprim] = [*deck.of(Joint), *deck.of(Jprim)]
    ends = (place_of(spot(deck, end)).p for each in joints for end in (each.i, each.j))
    return _extent(bodies) or _extent(list(ends)) or 1.0


def _extent(places: list[Any]) -> float:
    return float(np.ptp(np.array(places, dtype=float), axis=0).max()) if places else 0.0


def is_closed_as_drawn(deck: Deck, share: float) -> bool:
    """Whether a run starts from the posture of the deck: nothing but joints holds it, none is apart
    by more than a share of its size, and none has a start of its own.
    """
    largest = 1.0
    for each in deck.statements:
        if isinstance(each, Part | PointMass):
            largest = max(largest, *map(abs, each.qg))
        if isinstance(each, Joint) and each.initial():
            return False
        if hasattr(each, "constraints") and not isinstance(each, Joint | Jprim):
            return False
    return all(gap.worst <= share * largest for _, gap in gaps(deck))
