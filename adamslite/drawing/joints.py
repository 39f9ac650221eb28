"""Joints and primitives as symbols at their markers."""

from __future__ import annotations

from typing import Any

from adamslite.drawing.drawing import Drawing
from adamslite.elements.joint import Joint
from adamslite.elements.jprim import Jprim


def joints(drawing: Drawing) -> list[dict[str, Any]]:
    """Those that are switched on, with the frames of both markers."""
    found: list[Joint | Jprim] = [*drawing.deck.of(Joint), *drawing.deck.of(Jprim)]
    return [
        {
            "statement": each.label,
            "kind": each.kind,
            "i": drawing.frames.frame(each.i),
            "j": drawing.frames.frame(each.j),
        }
        for each in found
        if drawing.deck.is_active(each)
    ]
