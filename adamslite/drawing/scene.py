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
from adamslite.drawing.arrows import arrows
from adamslite.drawing.bodies import against, bodies
from adamslite.drawing.cable_lines import Cables, cables
from adamslite.drawing.channels import channels, unit_symbols
from adamslite.drawing.derived_shapes import derived_shapes
from adamslite.drawing.drawing import Drawing
from adamslite.drawing.shapes import COIL, COILS, graphics, outlines, shapes
from adamslite.drawing.wheels import wheels
from adamslite.elements.beam import Beam
from adamslite.elements.field import Field
from adamslite.elements.graphics import Graphics
from adamslite.elements.joint import Joint
from adamslite.elements.jprim import Jprim
from adamslite.elements.sforce import Sforce
from adamslite.elements.springdamper import Springdamper
from adamslite.language.interfaces import Key
from adamslite.outputs.modes import mode_rows
from adamslite.results.events import events_of
from adamslite.results.results import Linearized, Results

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


COORDINATES = ("x", "y", "z", "rx", "ry", "rz")
MOST = 60
"""Modes of one LINEAR command."""


def modes(drawing: Drawing) -> list[dict[str, Any]]:
    """The modes that oscillate, slowest first; of a pair of eigenvalues the upper one."""
    return [mode for each in drawing.results.linearizations for mode in _of(drawing, each)]


def _of(drawing: Drawing, each: Linearized) -> list[dict[str, Any]]:
    rows = [row for row in mode_rows(each.model) if row.pair][:MOST]
    time = unit_symbols(drawing.deck)["time"]
    return [
        {
            "frequency": row.frequency,
            "damping": row.damping,
            "unit": "Hz" if time in ("s", "") else f"1/{time}",
            "time": each.time,
            "shape": _shape(drawing, each.model.coordinates, each.model.modes[:, row.place]),
        }
        for row in rows
    ]


def _shape(drawing: Drawing, coordinates: tuple[str, ...], mode: np.ndarray) -> list[list[float]]:
    """Of each body that takes part its number, then the real and the imaginary part of its
    displacement and of its rotation vector.
    """
    numbers = {b.statement.label: k + 1 for k, b in enumerate(drawing.model.bodies)}
    found: dict[int, np.ndarray] = {}
    for name, value in zip(coordinates, mode, strict=True):
        label, _, word = name.rpartition(".")
        if label in numbers:
            amplitudes = found.setdefault(numbers[label], np.zeros(6, dtype=complex))
            amplitudes[COORDINATES.index(word)] = value
    return [[b, *a.real.tolist(), *a.imag.tolist()] for b, a in found.items() if a.any()]
