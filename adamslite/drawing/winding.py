"""Wheels of a cable, found in its expressions.

R AZ(i, j)                 a length that a wheel winds up, where i and j are the markers of a
                           revolute joint and the expression measures the distance of two
                           markers as well, itself or through variables
IMPACT(DM(k, j), v, R, ..  a rim that pushes a mass of the cable away from its axle at j
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from adamslite.drawing.drawing import Drawing
from adamslite.elements.gcon import Gcon
from adamslite.elements.joint import Joint
from adamslite.elements.sforce import Sforce
from adamslite.elements.variable import Variable
from adamslite.elements.vforce import Vforce
from adamslite.language.expression import Call, Node, Num, Op, Ref, walk
from adamslite.language.interfaces import Key

ON_RIM, TANGENT = 1e-3, 0.05
"""Within which a point is on a rim and a line touches it, as shares of the radius."""


def wound(drawing: Drawing) -> dict[Key, float]:
    """Markers on the axles of such wheels, and radii."""
    deck = drawing.deck
    axles = {frozenset((j.i, j.j)) for j in deck.of(Joint) if j.kind == "REVOLUTE"}
    found = _rims(drawing, {key for axle in axles for key in axle})
    for function in _lengths(drawing):
        parts = list(_parts(drawing, function))
        if not any(isinstance(each, Call) and each.name == "DM" for each in parts):
            continue
        for marker, other, radius in filter(None, map(_winds, parts)):
            if frozenset((marker, other)) in axles:
                found[marker if drawing.frames.body(marker) else other] = radius
    return found


def _rims(drawing: Drawing, axles: set[Key]) -> dict[Key, float]:
    """Of contacts: the markers on revolute joints that push something away from them."""
    found: dict[Key, float] = {}
    pending = [each.function for each in drawing.deck.of(Variable)]
    for function in (*pending, *_lengths(drawing)):
        for call in walk(function):
            if not (isinstance(call, Call) and call.name == "IMPACT"):
                continue
            depth, radius = call.args[0], call.args[2]
            if isinstance(radius, Op) and radius.op == "+":
                radius = radius.args[0]  # teeth on a rim
            if isinstance(depth, Call) and depth.name == "DM" and isinstance(radius, Num):
                axle = depth.args[1]
                if isinstance(axle, Ref) and axle.id in axles and radius.value > 0:
                    found[axle.id] = radius.value
    return found


def _lengths(drawing: Drawing) -> Iterator[Node]:
    """Expressions that may hold the length of a cable."""
    deck = drawing.deck
    yield from (each.function for each in deck.of(Gcon))
    yield from (each.function for each in deck.of(Sforce) if each.kind == "TRANSLATIONAL")
    for vector in deck.of(Vforce):
        yield from (vector.fx, vector.fy, vector.fz)


def _parts(drawing: Drawing, function: Node) -> Iterator[Node]:
    """All of an expression, with that of the variables it uses."""
    pending, seen = [function], set()
    while pending:
        for each in walk(pending.pop()):
            yield each
            if isinstance(each, Ref) and each.kind == "VARIABLE" and each.id not in seen:
                seen.add(each.id)
                variable = drawing.deck.find(Variable, each.id)
                pending += [variable.function] if variable else []


def _winds(node: Node) -> tuple[Key, Key, float] | None:
    """Markers and radius of a product of a number and AZ."""
    if not (isinstance(node, Op) and node.op == "*" and len(node.args) == 2):
        return None
    number, call = node.args if isinstance(node.args[0], Num) else node.args[::-1]
    if not (isinstance(number, Num) and isinstance(call, Call) and call.name == "AZ"):
        return None
    i, j = call.args[:2]
    if not (isinstance(i, Ref) and isinstance(j, Ref) and number.value):
        return None
    return i.id, j.id, abs(number.value)


def rim(
    drawing: Drawing, wheels: dict[Key, float], end: Key, after: Key
) -> tuple[Key, float] | None:
    """The wheel that a line touches which leaves MARKER/end for MARKER/after, and its radius with
    the sign of the sense in which it leaves.
    """
    places, body = drawing.motion.places, drawing.frames.body
    start = places(end)[0]
    along = places(after)[0] - start
    along = along / max(float(np.linalg.norm(along)), 1e-300)
    for marker, radius in wheels.items():
        out = start - places(marker)[0]
        on_rim = abs(float(np.linalg.norm(out)) - radius) < ON_RIM * radius
        if on_rim and abs(float(out @ along)) < TANGENT * radius and body(after) != body(marker):
            axis = drawing.motion.in_ground(marker, np.array([0.0, 0.0, 1.0]))[0]
            return marker, radius if np.cross(axis, out) @ along > 0 else -radius
    return None
