"""Markers in the axes of their bodies: the points and frames of everything that is drawn.

Body 0 is the ground, body k + 1 the k-th moving body of the model.  The frame of a moving body is
at its mass centre, with the axes of the PART statement; a point mass has those of ground.
"""

from __future__ import annotations

from typing import TypeAlias

import numpy as np

from adamslite.drawing.attitudes import from_axes
from adamslite.elements.marker import Marker
from adamslite.language.interfaces import Key
from adamslite.model.geometry import IDENTITY, Place
from adamslite.model.model import Model

Numbers: TypeAlias = list[float]
"""``[body, x, y, z]``, or with ``qx, qy, qz, qw`` after it."""
RIGID = ("PART", "POINT_MASS")
ORIGIN = Place("ground", -1, np.zeros(3), IDENTITY)


class Frames:
    """Places of the markers of a model."""

    def __init__(self, model: Model) -> None:
        self.model = model

    def has(self, marker: Key) -> bool:
        """Whether a marker is on a body that can be drawn, which flexible ones cannot."""
        if marker == 0:
            return True
        owner = self.model.deck.get(Marker, marker).owner
        return owner is not None and owner[0] in RIGID

    def place(self, marker: Key) -> Place:
        """Body, origin and axes; marker 0 is the origin of ground."""
        return self.model.marker(marker) if marker != 0 else ORIGIN

    def body(self, marker: Key) -> int:
        """Number of the body a marker is on."""
        return self.place(marker).body + 1

    def point(self, marker: Key) -> Numbers:
        """The origin of a marker."""
        place = self.place(marker)
        return [place.body + 1, *place.p.tolist()]

    def frame(self, marker: Key) -> Numbers:
        """Origin and axes of a marker."""
        return [*self.point(marker), *from_axes(self.place(marker).axes).tolist()]
