"""The scene of a page: what is drawn of a deck and its results, as plain data and one block of
arrays.

Points are ``[body, x, y, z]``, frames ``[body, x, y, z, qx, qy, qz, qw]``, in the axes of the body
(:mod:`adamslite.drawing.frames`); arrays are references (:mod:`adamslite.drawing.arrays`).
"""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from adamslite.deck.deck import Deck
from adamslite.drawing.against import against
from adamslite.drawing.arrows import arrows
from adamslite.drawing.bodies import bodies
from adamslite.drawing.cable_lines import Cables, cables
from adamslite.drawing.channels import channels, unit_symbols
from adamslite.drawing.derived_shapes import derived_shapes
from adamslite.drawing.drawing import Drawing
from adamslite.drawing.joints import joints
from adamslite.drawing.lines import links, springs
from adamslite.drawing.modes import modes
from adamslite.drawing.shapes import graphics, outlines, shapes
from adamslite.drawing.wheels import wheels
from adamslite.elements.graphics import Graphics
from adamslite.results.events import events_of
from adamslite.results.results import Results

VERSION = 1


@dataclass(frozen=True)
class Scene:
    """``plain``: all but the arrays; ``block``: the arrays, compressed, in base 64."""

    plain: dict[str, Any]
    block: str


@dataclass(frozen=True)
class Contents:
    """What is drawn: GRAPHICS statements, cables, solids, and lines that are neither."""

    statements: list[Graphics]
    cables: Cables
    shapes: list[dict[str, Any]]
    springs: list[dict[str, Any]]
    links: list[dict[str, Any]]


def contents(drawing: Drawing) -> Contents:
    """Each statement is drawn once: by a cable or a wheel, else as what it is."""
    statements = graphics(drawing)
    found = cables(drawing, statements)
    solids = wheels(drawing, statements, found)
    own = [each for each in statements if each.label not in found.taken]
    solids += shapes(drawing, own)
    drawn = {each["body"] for each in solids} | found.inner
    solids += derived_shapes(drawing, drawn, found.ropes)
    return Contents(
        own, found, solids,
        springs(drawing, own, found.taken), links(drawing, found.taken, found.inner),
    )  # fmt: skip


def scene(deck: Deck, results: Results, other: Results | None = None, name: str = "") -> Scene:
    """The scene of a deck and its results, and of other results beside them.

    `name` is what the other results are called.
    """
    drawing = Drawing(deck, results)
    return Scene(described(drawing, results, other, name), drawing.block.text())


def described(
    drawing: Drawing, results: Results, other: Results | None = None, name: str = ""
) -> dict[str, Any]:
    """All of a scene but the arrays, which go to the block of the drawing."""
    deck, found = drawing.deck, contents(drawing)
    file = deck.path.name if deck.path else ""
    plain = {
        "version": VERSION,
        "title": deck.title,
        "name": Path(file).stem or "scene",
        "deck": file,
        "outcome": outcome(results),
        "units": unit_symbols(deck),
        "times": drawing.block.f32(drawing.motion.time),
        "gravity": [float(g) for g in deck.gravity],
        "up": up(deck.gravity),
        "bodies": bodies(drawing),
        "shapes": found.shapes,
        "outlines": outlines(drawing, found.statements),
        "springs": found.springs,
        "joints": joints(drawing),
        "links": found.links,
        "cables": found.cables.lines,
        "arrows": arrows(drawing, found.statements, found.cables.taken, found.cables.inner),
        "channels": channels(deck, drawing.plotted, drawing.block, drawing.page.runs),
        "events": [each._asdict() for each in events_of(results)],
        "modes": modes(drawing),
        "against": against(drawing, other, name) if other else None,
    }
    return {**plain, "notes": drawing.notes}


def outcome(results: Results) -> str:
    """How the run ended, in a sentence."""
    return results.message or results.outcome.sentence


def up(gravity: tuple[float, float, float]) -> str:
    """The axis against gravity; y without."""
    largest = int(np.argmax(np.abs(gravity)))
    return "xyz"[largest] if gravity[largest] else "y"
