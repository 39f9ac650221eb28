"""How far from fixed places a marker can ever be, by the joints that its part hangs on.

Between two joints of a part the distance stays, so a marker is never farther from the place A of a
joint on ground than the shortest chain of such distances:

    |r - A| <= R,    R = min over chains of  sum |h_k - h_{k+1}|
"""

from __future__ import annotations

from collections.abc import Iterator
from heapq import heappop, heappush
from typing import TYPE_CHECKING

import numpy as np

from adamslite.elements.joint import Joint
from adamslite.elements.jprim import Jprim

if TYPE_CHECKING:
    from adamslite.language.interfaces import Key
    from adamslite.model.model import Model

#: Joints and primitives that keep their two markers in one place.
TOGETHER = frozenset({"ATPOINT", "CONVEL", "FIXED", "HOOKE", "REVOLUTE", "SPHERICAL", "UNIVERSAL"})


#: Markers that are passed on all ways together; of what is longer nothing is reported.
MOST = 20_000


class Reach:
    """The places at which a model hangs on ground, for any of its markers.

    The ways of long chains are long: after ``MOST`` markers no more is looked at.
    """

    def __init__(self, model: Model) -> None:
        self.model = model
        self.left = MOST
        self.partner: dict[Key, list[Key]] = {}
        self.of_body: dict[int, list[Key]] = {}
        joints: list[Joint | Jprim] = [*model.deck.of(Joint), *model.deck.of(Jprim)]
        for joint in joints:
            if joint.kind in TOGETHER and model.acts(joint):
                for own, other in ((joint.i, joint.j), (joint.j, joint.i)):
                    self.partner.setdefault(own, []).append(other)
                    place = model.marker(own)
                    if place.kind == "part":
                        self.of_body.setdefault(place.body, []).append(own)

    def anchors(self, marker: Key) -> Iterator[tuple[np.ndarray, float]]:
        """Places in ground, and how far from each the marker is at most; itself, where it is fixed.

        Dijkstra's shortest chains over the markers of joints.
        """
        done: set[Key] = set()
        pending: list[tuple[float, int, Key]] = [(0.0, 0, marker)]
        count = 0
        while pending and self.left > 0:
            self.left -= 1
            far, _, at = heappop(pending)
            if at in done:
                continue
            done.add(at)
            place = self.model.marker(at)
            if place.kind == "ground":
                yield place.p, far
                continue
            steps = [(0.0, other) for other in self.partner.get(at, ())]
            for other in self.of_body.get(place.body, ()) if place.kind == "part" else ():
                steps.append((float(np.linalg.norm(self.model.marker(other).p - place.p)), other))
            for step, other in steps:
                count += 1
                heappush(pending, (far + step, count, other))
