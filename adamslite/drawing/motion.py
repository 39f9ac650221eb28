"""How the bodies of a model move by its results.

A result names the mass centre of ``PART/2`` by x, y, z and the attitude of its CM marker by the
angles psi, theta, phi of the sequence 3-1-3, all in ground.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from adamslite.drawing.frames import (
    UPRIGHT,
    Frames,
    continuous,
    from_313,
    from_axes,
    inverse,
    product,
    rotated,
)
from adamslite.language.interfaces import Key
from adamslite.model.model import Body, Model
from adamslite.results.results import Results

PLACE = ("x", "y", "z")
ANGLES = ("psi", "theta", "phi")
MOST_NAMED = 3
FAR = 1e30
"""Places beyond it are none: their squares are beyond all numbers of 32 bits."""


@dataclass(frozen=True)
class Track:
    """Position (nt, 3) and attitude (nt, 4) of a body's frame in ground; `has_turned` when the
    attitude is more than that of ground."""

    position: np.ndarray
    attitude: np.ndarray
    has_turned: bool


class Motion:
    """Tracks of all bodies at some rows of the results.

    Attributes
    ----------
    time : (nt,) array
    tracks : list of Track
        That of ground first.
    notes : list of str
        What the results lack.
    """

    def __init__(self, model: Model, results: Results, rows: np.ndarray) -> None:
        self.frames = Frames(model)
        self.results = results
        self.rows = rows
        self.time = results.time[rows] if len(rows) else np.zeros(1)
        self.notes: list[str] = []
        still = np.zeros((len(self.time), 3))
        self.tracks = [Track(still, np.tile(UPRIGHT, (len(still), 1)), False)]
        self._missing: list[str] = []
        self._incomplete: list[str] = []
        self._without_value: list[str] = []
        self.tracks += [self._track(model, body) for body in model.bodies]
        self._note("not in the results, drawn where the deck has it", self._missing)
        self._note(
            "not all coordinates are in the results, drawn with the deck's", self._incomplete
        )
        self._note("no position at some times, drawn at the last one", self._without_value)

    def column(self, name: str) -> np.ndarray | None:
        """A column at the frames, (nt,); None when there is none."""
        if name not in self.results or not len(self.rows):
            return None
        return self.results[name][self.rows]

    def columns(self, label: str, suffixes: tuple[str, ...]) -> np.ndarray | None:
        """Columns of a statement at the frames, (nt, n); None unless there are all of them."""
        found = [self.column(f"{label}.{suffix}") for suffix in suffixes]
        if any(each is None for each in found):
            return None
        return np.stack(found, axis=1)  # type: ignore[arg-type]

    def places(self, marker: Key) -> np.ndarray:
        """Origin of a marker in ground, (nt, 3)."""
        place = self.frames.place(marker)
        return self.of_point(place.body + 1, place.p)

    def in_ground(self, marker: Key, vectors: np.ndarray) -> np.ndarray:
        """Vectors (3,) or (nt, 3) along the axes of a marker as (nt, 3) along those of ground."""
        place = self.frames.place(marker)
        return self.of_vector(place.body + 1, vectors @ place.axes.T)

    def of_point(self, body: int, point: np.ndarray) -> np.ndarray:
        """A point of a body (3,) in ground, (nt, 3)."""
        return self.tracks[body].position + self.of_vector(body, point)

    def of_vector(self, body: int, vectors: np.ndarray) -> np.ndarray:
        """Vectors (3,) or (nt, 3) in the axes of a body, in those of ground, (nt, 3)."""
        track = self.tracks[body]
        if track.has_turned:
            return rotated(track.attitude, vectors)
        return np.broadcast_to(vectors, track.position.shape)

    def _track(self, model: Model, body: Body) -> Track:
        label = body.statement.label
        start = from_axes(body.attitude)
        position = self._held(label, self._position(label, body), lambda: body.x)
        if body.statement.keyword != "PART":
            return Track(position, np.tile(UPRIGHT, (len(position), 1)), False)
        cm = body.statement.cm
        own = from_axes(model.marker(cm).axes) if cm is not None else UPRIGHT
        angles = self._held(label, self.columns(label, ANGLES), lambda: np.full(3, np.nan))
        turned = product(from_313(angles), inverse(own))
        attitude = np.where(np.isfinite(turned), turned, start)
        moves = bool((np.abs(np.abs(attitude @ UPRIGHT) - 1) > 0).any())
        return Track(position, continuous(attitude), moves)

    def _position(self, label: str, body: Body) -> np.ndarray | None:
        """Coordinates (nt, 3), those that are lacking as at the start; None where all are."""
        found = [self.column(f"{label}.{word}") for word in PLACE]
        if all(each is None for each in found):
            return None
        if any(each is None for each in found):
            self._incomplete.append(label)
        start = np.tile(body.x, (len(self.time), 1)).T
        given = zip(found, start, strict=True)
        return np.stack([x if each is None else each for each, x in given], axis=1)

    def _held(
        self, label: str, values: np.ndarray | None, start: Callable[[], np.ndarray]
    ) -> np.ndarray:
        """Values without gaps: before the first number that of the start, later the last one."""
        if values is None:
            self._missing.append(label)
            return np.tile(start(), (len(self.time), 1))
        good = (np.abs(values) < FAR).all(axis=1)  # nor is a number what is none
        if good.all():
            return values
        self._without_value.append(label)
        last = np.maximum.accumulate(np.where(good, np.arange(len(good)), -1))
        return np.where(last[:, None] < 0, start(), values[np.maximum(last, 0)])

    def _note(self, what: str, labels: list[str]) -> None:
        labels = list(dict.fromkeys(labels))
        if labels:
            more = f" and {len(labels) - MOST_NAMED} more" if len(labels) > MOST_NAMED else ""
            self.notes.append(f"{what}: {', '.join(labels[:MOST_NAMED])}{more}")
