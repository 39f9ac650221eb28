"""A deck and its results, ready to be drawn."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field, replace
from functools import cached_property

import numpy as np

from adamslite.deck.deck import Deck
from adamslite.drawing.arrays import Block, Reference
from adamslite.drawing.decimation import frames
from adamslite.drawing.frames import Frames
from adamslite.drawing.motion import Motion
from adamslite.elements.marker import Marker
from adamslite.language.interfaces import Key
from adamslite.model.model import PART, Model
from adamslite.results.results import Results
from adamslite.results.selection import limited

# Numbers that a frame of a part and of a point mass takes.
OF_PART, OF_POINT = 7, 3
FURTHER = 4.0
"""By how much the travel of the bodies may enlarge a scene."""


@dataclass(frozen=True)
class Page:
    """What the runs of a page have in common: the block, how many they are, and patterns of the
    columns that are plotted, all where there are none.
    """

    block: Block = field(default_factory=Block)
    runs: int = 1
    plotted: tuple[str, ...] = ()


class Drawing:
    """What all that is drawn has in common.

    Attributes
    ----------
    deck : Deck
    model : Model
    results : Results
    motion : Motion
        Of the bodies, at the frames that are drawn.
    block : Block
        Where arrays go.
    page : Page
        What all runs of the page have in common.
    notes : list of str
        What a reader of the picture must know.
    """

    def __init__(self, deck: Deck, results: Results, page: Page | None = None) -> None:
        given, results = len(results.time), forward(results).by_row()
        self.deck, self.results = deck, results
        self.model = Model(deck)
        self.page = page or Page()
        rows = frames(results.time, numbers_of(self.model), self.page.runs)
        self.motion = Motion(self.model, results, rows)
        self.block = self.page.block
        self.notes = [*([REPEATED] if len(results.time) < given else []), *self.motion.notes]

    @property
    def frames(self) -> Frames:
        """Markers in the axes of their bodies."""
        return self.motion.frames

    @property
    def plotted(self) -> Results:
        """The results with the columns that are plotted."""
        return limited(self.results, self.page.plotted) if self.page.plotted else self.results

    @cached_property
    def markers(self) -> list[Marker]:
        """The markers that have a place."""
        rigid = self.frames.has
        return [each for each in self.deck.of(Marker) if rigid(each.key) and not each.floating]

    @cached_property
    def by_body(self) -> dict[int, list[Key]]:
        """The markers of each body."""
        found: dict[int, list[Key]] = {}
        for each in self.markers:
            found.setdefault(self.frames.body(each.key), []).append(each.key)
        return found

    @cached_property
    def size(self) -> float:
        """The diagonal of the box around all bodies and markers at the first frame, or that around
        the travel of the bodies, up to a few times as much; 1 where all is in one place.
        """
        drawn = _diagonal(np.array([*self._places()]))
        travel = _diagonal(np.concatenate([track.position for track in self.motion.tracks]))
        return min(max(drawn, travel), FURTHER * drawn) if drawn else travel or 1.0

    def _places(self) -> Iterator[np.ndarray]:
        yield from (track.position[0] for track in self.motion.tracks[1:])
        for each in self.markers:
            yield self.motion.places(each.key)[0]

    def moving(self, values: np.ndarray) -> Reference | list[float]:
        """Values (nt, n) of the frames as a reference, or one row where nothing changes."""
        changes = np.ptp(values, axis=0)
        if not (changes > STILL * np.maximum(np.abs(values).max(axis=0), TINY)).any():
            return [float(x) for x in values[0]]
        return self.block.i16(values)

    def history(self, values: np.ndarray | None) -> Reference | None:
        """Values (nt,) or (nt, n) of the frames; none where there is no number."""
        if values is None:
            return None
        return self.block.i16(values) if np.isfinite(values).all() else self.block.f32(values)


def numbers_of(model: Model) -> int:
    """How many numbers a frame has."""
    return sum(OF_PART if body.width == PART else OF_POINT for body in model.bodies)


def _diagonal(places: np.ndarray) -> float:
    return float(np.hypot.reduce(np.ptp(places, axis=0))) if len(places) else 0.0


def forward(results: Results) -> Results:
    """The results without rows that have no time, or whose time a later row precedes."""
    time = np.where(np.isfinite(results.time), results.time, np.inf)
    kept = (time <= np.minimum.accumulate(time[::-1])[::-1]) & (time < np.inf)
    if kept.all():
        return results
    return replace(results, time=results.time[kept], values=results.values[kept])


REPEATED = "rows without a time, or that later rows repeat (the times go back), are left out"
# Changes that are round-off: as a share of the values.
STILL, TINY = 1e-12, 1e-300
