"""Ropes of pulleys with guided ends: a part that slides through a turret on a link about the axle,
fed by a RACKPIN.

With the rack along z_J and the pinion about z_I, turning about z_I moves the rim at the point of
contact along sign(PD) z_J; so a rope that leaves along d = +z_J or -z_J turns about z_I by the sign
of PD d.z_J.  The reaction on I along d is its tension.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from adamslite.drawing.drawing import Drawing
from adamslite.elements.joint import Joint
from adamslite.language.interfaces import Key

SLIDES = ("TRANSLATIONAL", "CYLINDRICAL")
STEPS = 2
"""Revolute joints from a turret to its pulley, with a link between them."""


@dataclass(frozen=True)
class Side:
    """One side of a pulley: where the rope goes from its wheel, and its tension (nt,)."""

    joint: Joint
    wheel: int
    rope: int
    radius: float
    leaving: int
    """Sense about z of I of a line that leaves the wheel here."""
    tension: np.ndarray | None


@dataclass(frozen=True)
class Rope:
    """A line from end to end: the sides that it goes along, and whether it leaves the wheel."""

    sides: tuple[tuple[Side, bool], ...]


class Pulleys:
    """All ropes of a deck that turrets guide."""

    def __init__(self, drawing: Drawing) -> None:
        self.drawing = drawing
        self.sides = [side for joint in drawing.deck.of(Joint) for side in self._sides(joint)]

    def _sides(self, joint: Joint) -> Iterator[Side]:
        deck, body = self.drawing.deck, self.drawing.frames.body
        if joint.kind != "RACKPIN" or not joint.pd or not deck.is_active(joint):
            return
        wheel, rope = body(joint.i), body(joint.j)
        if not any(self._reaches(guide, wheel) for guide in self._guides(rope)):
            return
        motion = self.drawing.motion
        along = motion.in_ground(joint.j, np.array([0.0, 0.0, 1.0]))
        away = motion.places(self.end(rope, joint.i))[0] - motion.places(joint.i)[0]
        sense = 1 if away @ along[0] >= 0 else -1
        force = motion.columns(joint.label, ("fx", "fy", "fz"))
        yield Side(
            joint, wheel, rope, abs(joint.pd) / 2, sense if joint.pd > 0 else -sense,
            None if force is None else sense * (force * along).sum(axis=1),
        )  # fmt: skip

    def _guides(self, rope: int) -> Iterator[int]:
        """Bodies that a rope slides through, but the ground."""
        body = self.drawing.frames.body
        for joint in self.drawing.deck.of(Joint):
            ends = body(joint.i), body(joint.j)
            if joint.kind in SLIDES and rope in ends:
                yield from (end for end in ends if end not in (rope, 0))

    def _reaches(self, guide: int, wheel: int) -> bool:
        """Whether a guide turns about a wheel."""
        near = {guide}
        for _ in range(STEPS):
            near |= {b for a in near for b in self._revolute.get(a, ())}
        return wheel in near

    @cached_property
    def _revolute(self) -> dict[int, set[int]]:
        """Moving bodies that revolute joints connect."""
        found: dict[int, set[int]] = {}
        body = self.drawing.frames.body
        for joint in self.drawing.deck.of(Joint):
            a, b = body(joint.i), body(joint.j)
            if joint.kind == "REVOLUTE" and a and b:
                found.setdefault(a, set()).add(b)
                found.setdefault(b, set()).add(a)
        return found

    def end(self, rope: int, wheel: Key) -> Key:
        """The marker of a rope that is furthest from a wheel at the first frame."""
        places = self.drawing.motion.places
        centre = places(wheel)[0]
        return max(
            self.drawing.by_body[rope],
            key=lambda marker: float(np.linalg.norm(places(marker)[0] - centre)),
        )

    def ropes(self) -> Iterator[Rope]:
        """From every end of a rope over its wheels to the other end."""
        left = list(self.sides)
        while left:
            first = next((side for side in left if self._is_end(side, left)), left[0])
            yield Rope(tuple(self._followed(first, left)))

    def _is_end(self, side: Side, left: list[Side]) -> bool:
        return sum(each.rope == side.rope for each in left) == 1

    def _followed(self, side: Side, left: list[Side]) -> Iterator[tuple[Side, bool]]:
        """Along a rope to a wheel, from it along the next one, ..."""
        leaves = False
        found: Side | None = side
        while found is not None:
            yield found, leaves
            left.remove(found)
            at = found.rope if leaves else found.wheel
            leaves = not leaves
            found = next((s for s in left if (s.wheel if leaves else s.rope) == at), None)
