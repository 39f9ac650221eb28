"""Shapes of bodies that no GRAPHICS statement draws: rods between their markers, a box with their
inertia, or a ball by their mass.

Equation (a box of the sides a, b, c with the mass m and the principal moments I1, I2, I3)::

    I1 = m (b^2 + c^2)/12, ...      so      a^2 = 6 (I2 + I3 - I1)/m, ...
"""

from __future__ import annotations

from math import pi
from typing import Any

import numpy as np

from adamslite.drawing.drawing import Drawing
from adamslite.drawing.frames import from_axes
from adamslite.elements.units import Units
from adamslite.language import units
from adamslite.model.model import Body

Shape = dict[str, Any]
UPRIGHT = [0.0, 0.0, 0.0, 1.0]
STEEL = 7850.0
"""Density of the balls [kg/m^3]."""
BALLS = (0.006, 0.03)
"""Least and largest radius of a ball, as shares of the size of the scene."""
BOXES = (0.01, 0.3)
"""Least and largest side of a box, likewise; larger ones have an inertia of no real body."""
# Points that are nearer than this share of the size of the scene are one.
TOGETHER = 1e-6


def derived_shapes(drawing: Drawing, drawn: set[int], ropes: set[int]) -> list[Shape]:
    """Shapes of the moving bodies that are not among those drawn already; only balls for those that
    are pieces of ropes.
    """
    heaviest = max((body.mass for body in drawing.model.bodies), default=0.0)
    found: list[Shape] = []
    for b, body in enumerate(drawing.model.bodies):
        if b + 1 in ropes and b + 1 not in drawn:
            found.append(_ball(drawing, b, body, heaviest))
        elif b + 1 not in drawn:
            found += _shapes(drawing, b, body, heaviest)
    return found


def _shapes(drawing: Drawing, b: int, body: Body, heaviest: float) -> list[Shape]:
    points = distinct(_points(drawing, b + 1), TOGETHER * drawing.size)
    rods = [_rod(b + 1, points[i], points[j]) for i, j in tree(points)]
    box = _box(drawing, b, body) if not rods and body.inertia.any() and body.mass else None
    if box:
        return [box]
    ball = _ball(drawing, b, body, heaviest)
    return [*rods, ball] if body.mass or not rods else rods


def _points(drawing: Drawing, number: int) -> np.ndarray:
    """The mass centre and all markers of a body, (n, 3)."""
    places = [drawing.frames.place(key).p for key in drawing.by_body.get(number, ())]
    has_mass = drawing.model.bodies[number - 1].mass > 0
    return np.array([*([np.zeros(3)] if has_mass else []), *places]).reshape(-1, 3)


def distinct(points: np.ndarray, apart: float) -> np.ndarray:
    """Points without those that lie together with an earlier one."""
    kept: list[np.ndarray] = []
    for point in points:
        if all(np.linalg.norm(point - other) > apart for other in kept):
            kept.append(point)
    return np.array(kept).reshape(-1, 3)


def tree(points: np.ndarray) -> list[tuple[int, int]]:
    """The shortest tree that joins all points.

    Source: Prim, Bell System Technical Journal 36 (1957).
    """
    if len(points) < 2:
        return []
    near, away = np.zeros(len(points), dtype=int), np.linalg.norm(points - points[0], axis=1)
    inside = np.zeros(len(points), dtype=bool)
    inside[0] = True
    edges = []
    for _ in range(len(points) - 1):
        new = int(np.argmin(np.where(inside, np.inf, away)))
        edges.append((int(near[new]), new))
        inside[new] = True
        closer = np.linalg.norm(points - points[new], axis=1)
        near = np.where(closer < away, new, near)
        away = np.minimum(away, closer)
    return edges


def _rod(body: int, start: np.ndarray, end: np.ndarray) -> Shape:
    frame = [*start.tolist(), *UPRIGHT]
    to = (end - start).tolist()
    return {"kind": "rod", "body": body, "frame": frame, "statement": "", "to": to}


def _ball(drawing: Drawing, b: int, body: Body, heaviest: float) -> Shape:
    """Of steel, where the units are known; else by its share in the heaviest."""
    least, most = (share * drawing.size for share in BALLS)
    names = drawing.deck.single(Units).names
    if names:
        mass = (body.statement.mass or 0.0) * units.MASS[names[1]]
        radius = (3 * mass / (4 * pi * STEEL)) ** (1 / 3) / units.LENGTH[names[2]]
    else:
        radius = most * (body.mass / heaviest) ** (1 / 3) if heaviest else 0.0
    frame = [0.0, 0.0, 0.0, *UPRIGHT]
    radius = min(max(radius, least), most)
    return {"kind": "sphere", "body": b + 1, "frame": frame, "statement": "", "radius": radius}


def _box(drawing: Drawing, b: int, body: Body) -> Shape | None:
    """A box with the same mass and inertia; None where that is too large for the scene."""
    moments, axes = np.linalg.eigh(body.inertia)
    axes = axes * np.sign(np.linalg.det(axes))
    squares = 6 * (moments.sum() - 2 * moments) / body.mass
    least, most = (share * drawing.size for share in BOXES)
    sides = np.maximum(np.sqrt(np.maximum(squares, 0.0)), least)
    if not sides.max() <= most:
        return None
    frame = [0.0, 0.0, 0.0, *from_axes(axes).tolist()]
    sizes = dict(zip("xyz", sides.tolist(), strict=True))
    return {"kind": "inertia_box", "body": b + 1, "frame": frame, "statement": "", **sizes}
