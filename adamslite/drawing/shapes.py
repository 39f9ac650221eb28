"""Shapes, outlines and springs that GRAPHICS statements draw."""

from __future__ import annotations

from collections.abc import Callable
from math import hypot, pi
from typing import Any

import numpy as np

from adamslite.drawing.drawing import Drawing
from adamslite.drawing.motion import FAR
from adamslite.elements.curve import Curve
from adamslite.elements.graphics import Graphics
from adamslite.language.interfaces import Key

Shape = dict[str, Any]
# Points of a CURVE without SEG.
SEGMENTS = 64
COILS = 8
# Diameter of a coil without DA, as a share of the size of the scene.
COIL = 0.03


def graphics(drawing: Drawing) -> list[Graphics]:
    """The statements that can be drawn; notes name the rest."""
    complete = [each for each in drawing.deck.of(Graphics) if each.shape and not each.missing]
    for kind, why in (
        ("EXTERNAL", "its shape is in a Parasolid file, which is not read"),
        ("FUNCTION", "a routine of ADAMS draws it"),
    ):
        labels = [each.label for each in complete if each.shape == kind]
        if labels:
            more = f" and {len(labels) - 1} more" if len(labels) > 1 else ""
            drawing.notes.append(f"{labels[0]}{more}: not drawn, {why}")
    rest = [each for each in complete if each.shape not in ("EXTERNAL", "FUNCTION")]
    flexible = [each for each in rest if not all(map(drawing.frames.has, _markers(each)))]
    if flexible:
        drawing.notes.append(f"{flexible[0].label}: not drawn, it is on a flexible body")
    return [each for each in rest if each not in flexible]


def _markers(each: Graphics) -> list[Key]:
    """All markers of a shape."""
    named = (each.marker, each.rm, each.i, each.j, each.emarker, *each.outline)
    return [key for key in named if key is not None]


def shapes(drawing: Drawing, statements: list[Graphics]) -> list[Shape]:
    """Solids, surfaces and points, each in the frame of its marker."""
    found = []
    for each in statements:
        sizes = SIZES.get(each.shape or "")
        if not sizes or each.marker is None:
            continue
        body, *frame = drawing.frames.frame(each.marker)
        own = sizes(drawing, each)
        if not all(abs(number) < FAR for number in (*frame, *own.values())):
            drawing.notes.append(f"{each.label}: not drawn, it is beyond all pictures")
            continue
        kind = (each.shape or "").lower()
        if kind == "frustum" and not (own["bottom"] or own["top"]):
            drawing.notes.append(f"{each.label}: not drawn, both its radii are zero")
            continue
        found.append({
            "kind": kind, "body": int(body), "frame": frame, "statement": each.label, **own,
        })  # fmt: skip
    return found


def outlines(drawing: Drawing, statements: list[Graphics]) -> list[dict[str, Any]]:
    """Lines through markers, and curves."""
    found = []
    for each in statements:
        if each.shape == "OUTLINE":
            ids = each.outline
            closed = len(ids) > 2 and ids[0] == ids[-1]
            points = [drawing.frames.point(key) for key in (ids[:-1] if closed else ids)]
        elif each.shape == "CURVE":
            closed, points = _curve(drawing, each)
        else:
            continue
        if len(points) > 1:
            found.append({"statement": each.label, "points": points, "closed": closed})
    return found


def _curve(drawing: Drawing, each: Graphics) -> tuple[bool, list[list[float]]]:
    """Points of a CURVE in the frame of CRM."""
    assert each.cid is not None and each.crm is not None  # required by `needs`
    curve = drawing.deck.get(Curve, each.cid).spline(drawing.model)
    count = max(int(each.seg or SEGMENTS), 2)
    along = np.linspace(0.0, 1.0, count + 1)[: count if curve.closed else None]
    place = drawing.frames.place(each.crm)
    points = curve.table.at(along, 0) @ place.axes.T + place.p
    return curve.closed, [[place.body + 1, *row] for row in points.tolist()]


# ---- sizes -----------------------------------------------------------------------------------


def _angle(each: Graphics) -> float:
    return each.rangle if each.rangle is not None else 2 * pi


def _cylinder(drawing: Drawing, each: Graphics) -> Shape:
    return {"length": each.size("length"), "radius": radius(drawing, each), "angle": _angle(each)}


def radius(drawing: Drawing, each: Graphics) -> float:
    """RADIUS of a CYLINDER, or how far RM is from its axis at the first frame."""
    if each.radius is not None or each.rm is None or each.cm is None:
        return each.radius or 0.0
    apart = drawing.motion.places(each.rm)[:1] - drawing.motion.places(each.cm)[:1]
    x, y, _ = (drawing.motion.in_ground(each.cm, axis)[0] for axis in np.eye(3))
    return hypot(float(apart[0] @ x), float(apart[0] @ y))


def _frustum(drawing: Drawing, each: Graphics) -> Shape:
    sizes = {name: each.size(name) for name in ("length", "bottom", "top")}
    return {**sizes, "angle": _angle(each)}


def _box(drawing: Drawing, each: Graphics) -> Shape:
    return {name: each.size(name) for name in "xyz"}


def _ellipsoid(drawing: Drawing, each: Graphics) -> Shape:
    return {name: each.size(f"{name}scale") for name in "xyz"}


def _torus(drawing: Drawing, each: Graphics) -> Shape:
    return {"major": each.size("major_radius"), "minor": each.size("minor_radius")}


def _circle(drawing: Drawing, each: Graphics) -> Shape:
    return {"radius": each.size("radius")}


def _arc(drawing: Drawing, each: Graphics) -> Shape:
    return {"radius": each.size("radius"), "angle": _angle(each)}


def _plane(drawing: Drawing, each: Graphics) -> Shape:
    """A border that is not given lies half the size of the scene away."""
    half = drawing.size / 2
    far = {"xmin": -half, "xmax": half, "ymin": -half, "ymax": half}
    return {name: far[name] if getattr(each, name) is None else each.size(name) for name in far}


def _point(drawing: Drawing, each: Graphics) -> Shape:
    return {}


SIZES: dict[str, Callable[[Drawing, Graphics], Shape]] = {
    "ARC": _arc, "BOX": _box, "CIRCLE": _circle, "CYLINDER": _cylinder, "ELLIPSOID": _ellipsoid,
    "FRUSTUM": _frustum, "PLANE": _plane, "POINT": _point, "TORUS": _torus,
}  # fmt: skip
