"""Wheels: discs with a spoke, so that one sees them turn.

A CYLINDER is drawn as one where its axis is that of a cable's wheel or of a revolute joint and it
is wider than long.  Wheels of a cable, pinions, gears and drums without GRAPHICS get one of their
radius: PD/2 of a RACKPIN, the distance of the pitch point from the axle of a GEAR, travel per angle
of a COUPLER of a rotation and a translation.
"""

from __future__ import annotations

from collections.abc import Iterator
from math import pi

import numpy as np

from adamslite.drawing.cable_lines import Cables
from adamslite.drawing.drawing import Drawing
from adamslite.drawing.shapes import Shape, radius
from adamslite.elements.coupler import Coupler
from adamslite.elements.gear import Gear
from adamslite.elements.graphics import Graphics
from adamslite.elements.joint import Joint
from adamslite.language.interfaces import Key

WIDTH = 0.2
"""Of a wheel without GRAPHICS, over its radius."""
# Angles this close to a full turn are one.
WHOLE = 1e-6


def wheels(drawing: Drawing, statements: list[Graphics], cables: Cables) -> list[Shape]:
    """All wheels; the labels of the statements that they are drawn for join those taken."""
    axles = {key for joint in drawing.deck.of(Joint) if joint.kind == "REVOLUTE"
             for key in (joint.i, joint.j)} | set(cables.wheels)  # fmt: skip
    discs: dict[tuple[Key, float], list[Graphics]] = {}
    for each in statements:
        if each.shape == "CYLINDER" and each.cm in axles and _is_whole(each):
            discs.setdefault((each.cm, radius(drawing, each)), []).append(each)
    found = []
    for (marker, size), group in discs.items():
        low = min(0.0, *(each.size("length") for each in group))
        high = max(0.0, *(each.size("length") for each in group))
        if high - low < size:
            found.append(_wheel(drawing, marker, size, (low, high), group[0].label))
            cables.taken |= {each.label for each in group}
    drawn = {key for key, _ in discs}
    for marker, size in {**_geared(drawing), **cables.wheels}.items():
        if marker not in drawn:
            found.append(_wheel(drawing, marker, size, (-WIDTH * size / 2, WIDTH * size / 2)))
    return found


def _is_whole(each: Graphics) -> bool:
    return each.rangle is None or each.rangle > 2 * pi - WHOLE


def _geared(drawing: Drawing) -> dict[Key, float]:
    """Markers on the axles of pinions, gears and drums, and their radii."""
    racks = (joint for joint in drawing.deck.of(Joint) if joint.kind == "RACKPIN")
    found = {joint.i: abs(joint.pd) / 2 for joint in racks if joint.pd}
    for gear in drawing.deck.of(Gear):
        for joint in _turning(drawing, gear.joints):
            arm = drawing.motion.places(gear.cv)[0] - drawing.motion.places(joint.j)[0]
            axis = drawing.motion.in_ground(joint.j, np.array([0.0, 0.0, 1.0]))[0]
            found[joint.i] = float(np.linalg.norm(np.cross(axis, arm)))
    for coupler in drawing.deck.of(Coupler):
        turning = list(_turning(drawing, coupler.joints))
        if coupler.function is None and len(coupler.joints) == 2 and len(turning) == 1:
            at = coupler.joints.index(turning[0].key)
            if coupler.uses(1 - at, ("TRANSLATION",)) and coupler.factors[1 - at]:
                found[turning[0].i] = abs(coupler.factors[at] / coupler.factors[1 - at])
    return {key: radius for key, radius in found.items() if radius > 0}


def _turning(drawing: Drawing, joints: tuple[Key, ...]) -> Iterator[Joint]:
    """The revolute ones among some joints."""
    found = (drawing.deck.find(Joint, key) for key in joints)
    yield from (joint for joint in found if joint and joint.kind == "REVOLUTE")


def _wheel(
    drawing: Drawing, marker: Key, size: float, ends: tuple[float, float], label: str = ""
) -> Shape:
    """A disc about z of a marker, from one height to another."""
    place = drawing.frames.place(marker)
    body, _, _, _, *turn = drawing.frames.frame(marker)
    centre = place.p + place.axes[:, 2] * (ends[0] + ends[1]) / 2
    return {
        "kind": "wheel", "body": int(body), "frame": [*centre.tolist(), *turn],
        "statement": label, "radius": size, "width": ends[1] - ends[0],
    }  # fmt: skip
