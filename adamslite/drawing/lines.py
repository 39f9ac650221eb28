"""Springs as coils, and other forces along a line between two markers."""

from __future__ import annotations

from typing import Any

from adamslite.drawing.drawing import Drawing
from adamslite.drawing.shapes import COIL, COILS
from adamslite.elements.beam import Beam
from adamslite.elements.field import Field
from adamslite.elements.graphics import Graphics
from adamslite.elements.sforce import Sforce
from adamslite.elements.springdamper import Springdamper
from adamslite.language.interfaces import Key

Line = dict[str, Any]


def springs(drawing: Drawing, statements: list[Graphics], taken: set[str]) -> list[Line]:
    """Coils of GRAPHICS and of SPRINGDAMPERs that no GRAPHICS and no cable draws."""
    elements = {
        frozenset((each.i, each.j)): each
        for each in drawing.deck.of(Springdamper)
        if each.kind == "TRANSLATIONAL"
    }
    found = []
    for each in statements:
        if each.shape == "SPRINGDAMPER" and each.i is not None and each.j is not None:
            element = elements.pop(frozenset((each.i, each.j)), None)
            label = element.label if element else ""
            found.append(_spring(drawing, each.label, (each.i, each.j), label, each))
    for element in elements.values():
        if element.label not in taken:
            found.append(_spring(drawing, element.label, (element.i, element.j), element.label))
    return found


def _spring(
    drawing: Drawing, label: str, ends: tuple[Key, Key], element: str, drawn: Graphics | None = None
) -> Line:
    coils = drawn.coils if drawn and drawn.coils is not None else COILS
    diameter = drawn.da if drawn and drawn.da is not None else COIL * drawing.size
    i, j = (drawing.frames.point(end) for end in ends)
    force = drawing.history(drawing.motion.column(f"{element}.f")) if element else None
    return {
        "statement": label, "i": i, "j": j, "coils": coils, "diameter": diameter, "force": force,
    }  # fmt: skip


def links(drawing: Drawing, taken: set[str], inner: set[int]) -> list[Line]:
    """Forces along a line, and beams, that are no part of a cable (`taken`) and push none of its
    masses (`inner`).
    """
    lines = (s for s in drawing.deck.of(Sforce) if s.kind != "ROTATIONAL" and not s.actiononly)
    elements: list[Sforce | Beam | Field] = [
        *lines, *drawing.deck.of(Beam), *drawing.deck.of(Field)
    ]  # fmt: skip
    point, body = drawing.frames.point, drawing.frames.body
    return [
        {"statement": each.label, "i": point(each.i), "j": point(each.j)}
        for each in elements
        if each.label not in taken and not {body(each.i), body(each.j)} & inner
    ]
