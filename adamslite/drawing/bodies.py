"""Bodies of a scene: names and motions, also those of other results drawn beside them."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np

from adamslite.deck.deck import Deck
from adamslite.drawing.channels import channels
from adamslite.drawing.drawing import Drawing, forward
from adamslite.drawing.motion import ANGLES, PLACE, Motion, Track
from adamslite.elements.part import Part
from adamslite.errors import FormatError
from adamslite.results.common_terms import of_deck
from adamslite.results.results import Results

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


def against(drawing: Drawing, other: Results, name: str) -> dict[str, Any]:
    """Bodies in the order of the scene, null where the other results have none, and channels.

    Coordinates that the other results lack are those of the first.

    Raises
    ------
    FormatError
        When both have no channel in common.
    """
    other, _ = of_deck(other, drawing.deck)
    if not any(each in drawing.results for each in other.names) or not len(other.time):
        what = "no channel of these results" if len(other.time) else "no output time"
        raise FormatError(f"{name or 'the other result'} has {what}: nothing can be compared")
    other = forward(other).by_row()
    labels = [body.statement.label for body in drawing.model.bodies]
    known = [_has(other, label) for label in labels]
    full = _completed(drawing.results, other, labels)
    rows = _frames(other.time, len(drawing.motion.time))
    motion = Motion(drawing.model, full, rows)
    bodies = [
        {"name": label, **moved(drawing, track)} if there else None
        for label, there, track in zip(labels, known, motion.tracks[1:], strict=True)
    ]
    return {
        "name": name,
        "bodies": [None, *bodies],
        "times": drawing.block.f32(motion.time),
        "channels": channels(drawing.deck, other, drawing.block),
    }


def _has(results: Results, label: str) -> bool:
    return any(f"{label}.{word}" in results for word in (*PLACE, *ANGLES))


def _frames(time: np.ndarray, most: int) -> np.ndarray:
    """About as many rows as the scene has frames."""
    return np.unique(np.linspace(0, len(time) - 1, min(len(time), most)).astype(int))


def _completed(results: Results, other: Results, labels: list[str]) -> Results:
    """The other results with the coordinates they lack, between output times along lines."""
    lacking = [
        f"{label}.{word}"
        for label in labels
        if _has(other, label)
        for word in (*PLACE, *ANGLES)
        if f"{label}.{word}" in results and f"{label}.{word}" not in other
    ]
    if not lacking or not len(results.time):
        return other
    more = [np.interp(other.time, results.time, results[name]) for name in lacking]
    values = np.column_stack([other.values, *more])
    return replace(other, names=(*other.names, *lacking), values=values)
