"""Bodies of a scene: names and motions."""

from __future__ import annotations

from typing import Any

import numpy as np

from adamslite.deck.deck import Deck
from adamslite.drawing.drawing import Drawing
from adamslite.drawing.motion import Track
from adamslite.elements.part import Part

KINDS = {"PART": "part", "POINT_MASS": "point_mass"}
# Travel that is round-off, as a share of the size of the scene.
ROUND_OFF = 1e-9


def bodies(drawing: Drawing) -> list[dict[str, Any]]:
    """The ground, then all moving bodies."""
    ground = _ground(drawing.deck)
    found = [_still("PART/1" if ground is None else ground.label, ground)]
    for body, track in zip(drawing.model.bodies, drawing.motion.tracks[1:], strict=True):
        statement = body.statement
        found.append({
            "name": statement.label,
            "label": statement.name or "",
            "kind": KINDS[statement.keyword],
            **moved(drawing, track),
            "mass": statement.mass or 0.0,
        })  # fmt: skip
    return found


def moved(drawing: Drawing, track: Track) -> dict[str, Any]:
    """Position and attitude of a body."""
    position = without_round_off(track.position, drawing.size)
    turns = drawing.moving(without_round_off(track.attitude, 1.0)) if track.has_turned else None
    return {"position": drawing.moving(position), "attitude": turns}


def without_round_off(values: np.ndarray, size: float) -> np.ndarray:
    """The same with components at rest that move by round-off alone."""
    rests = np.ptp(values, axis=0) < ROUND_OFF * size
    return np.where(rests, values[0], values)


def _ground(deck: Deck) -> Part | None:
    return next((part for part in deck.of(Part) if part.ground), None)


def _still(name: str, statement: Part | None) -> dict[str, Any]:
    label = statement.name if statement else None
    return {
        "name": name, "label": label or "ground", "kind": "ground",
        "position": [0.0, 0.0, 0.0], "attitude": None, "mass": 0.0,
    }  # fmt: skip
