"""Modes of small motions about a state, for animation."""

from __future__ import annotations

from typing import Any

import numpy as np

from adamslite.drawing.channels import unit_symbols
from adamslite.drawing.drawing import Drawing
from adamslite.outputs.modes import mode_rows
from adamslite.results.results import Linearized

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
