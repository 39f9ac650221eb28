"""Forces, torques and reactions as arrows at the markers they act on."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np

from adamslite.drawing.drawing import Drawing
from adamslite.elements.graphics import Graphics
from adamslite.language.interfaces import Key
from adamslite.language.statement import Statement

Arrow = dict[str, Any]
FORCES, TORQUES = ("fx", "fy", "fz"), ("tx", "ty", "tz")
ALONG_LINE = ("SFORCE", "SPRINGDAMPER")
WITH_COMPONENTS = (
    "VFORCE", "VTORQUE", "GFORCE", "BUSHING", "BEAM", "FIELD", "CONTACT", "JOINT", "JPRIM", "MOTION"
)  # fmt: skip
REACTIONS = ("JOINT", "JPRIM", "MOTION")
MOST = 120
Z = np.array([0.0, 0.0, 1.0])


def arrows(
    drawing: Drawing, statements: list[Graphics], taken: set[str], inner: set[int]
) -> list[Arrow]:
    """Those of GRAPHICS/FORCE first, then of all elements that are no part of a cable: no section
    (`taken`), and on none of its masses (`inner`).
    """
    found = [each for graphics in statements for each in _requested(drawing, graphics)]
    have = {each["statement"] for each in found} | taken
    for keyword in (*ALONG_LINE, *WITH_COMPONENTS):
        for element in drawing.deck.of(keyword):
            i, _ = _ends(drawing, element)
            if i is not None and element.label not in have and drawing.frames.body(i) not in inner:
                found += _of(drawing, element)
    if len(found) > MOST:
        drawing.notes.append(f"arrows of the first {MOST} of {len(found)} forces are drawn")
    return found[:MOST]


def _requested(drawing: Drawing, graphics: Graphics) -> Iterator[Arrow]:
    if graphics.shape != "FORCE" or graphics.emarker is None:
        return
    for key in graphics.eid:
        element = drawing.deck.find((graphics.etype or "").upper(), key)
        if element is not None:
            yield from _of(drawing, element, graphics.emarker)


def _of(drawing: Drawing, element: Any, marker: Key | None = None) -> Iterator[Arrow]:
    """The arrows of an element, at its marker I or at another one: then it is the force on the body
    of that."""
    i, j = _ends(drawing, element)
    if i is None:
        return
    at = i if marker is None else marker
    on_j = marker is not None and j is not None and _is_on(drawing, marker, j, i)
    for kind, vector in _vectors(drawing, element, i, j):
        if np.isfinite(vector).all() and vector.any():
            shown = -vector if on_j else vector
            yield {
                "statement": element.label, "label": element.name or "",
                "at": drawing.frames.point(at), "vector": drawing.moving(shown), "kind": kind,
            }  # fmt: skip


def _is_on(drawing: Drawing, marker: Key, j: Key, i: Key) -> bool:
    body = drawing.frames.body
    return body(marker) == body(j) != body(i)


def _ends(drawing: Drawing, element: Any) -> tuple[Key | None, Key | None]:
    """Markers I and J; those of its joint for a MOTION, of its shapes for a CONTACT."""
    if element.keyword == "CONTACT":
        shapes = (drawing.deck.find("GRAPHICS", side[0]) for side in (element.igeom, element.jgeom))
        found = [shape.marker if shape else None for shape in shapes]
        return found[0], found[1]
    joint = getattr(element, "joint", None)
    if getattr(element, "i", None) is None and joint is not None:
        element = drawing.deck.find("JOINT", joint)
    return getattr(element, "i", None), getattr(element, "j", None)


def _vectors(
    drawing: Drawing, element: Statement, i: Key, j: Key | None
) -> Iterator[tuple[str, np.ndarray]]:
    """Kind and vectors (nt, 3) in ground axes of what acts on I."""
    motion = drawing.motion
    if element.keyword in ALONG_LINE and j is not None:
        value = motion.column(f"{element.label}.f")
        if value is None:
            return
        about = getattr(element, "kind", "") == "ROTATIONAL"
        fixed = about or getattr(element, "actiononly", False)
        along = motion.in_ground(j, Z) if fixed else _line(drawing, i, j)
        yield "torque" if about else "force", value[:, None] * along
        return
    for kind, suffixes in (("force", FORCES), ("torque", TORQUES)):
        found = motion.columns(element.label, suffixes)
        if found is None:
            continue
        if element.keyword in ("VFORCE", "VTORQUE") and getattr(element, "rm", 0) != 0:
            found = motion.in_ground(element.rm, found)  # type: ignore[attr-defined]
        yield "reaction" if element.keyword in REACTIONS and kind == "force" else kind, found


def _line(drawing: Drawing, i: Key, j: Key) -> np.ndarray:
    """Unit vectors (nt, 3) from J to I."""
    apart = drawing.motion.places(i) - drawing.motion.places(j)
    length = np.linalg.norm(apart, axis=1, keepdims=True)
    return apart / np.where(length > 0, length, 1.0)
