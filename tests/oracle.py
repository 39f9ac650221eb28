"""What elements do, as plain formulas of numpy: loads on bodies, and values of functions.

Three bodies with oblique inertia fly free in random postures at random rates.  An element between
them is written into the deck; its loads follow from the formulas here, accelerations follow from
the loads by Newton and Euler, and the program has to report the same.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from frame_constraints import any_rotation
from newton_euler import Frame
from random_mechanisms import SYSTEMS, Mechanism, _add_body, _place, _start, text
from scenes import compiled

import adamslite as al

Array = np.ndarray
BODIES, MARKERS = 3, 8


@dataclass(frozen=True)
class Marker:
    """Where a marker is and how it moves, in ground: origin r, axes as columns A, v, w; the number
    of its body or -1.
    """

    body: int
    r: Array
    A: Array
    v: Array
    w: Array


class Flight:
    """Bodies and markers 1 ... MARKERS, two or more on every body and on the ground."""

    def __init__(self, seed: int) -> None:
        self.rng = rng = np.random.default_rng([7, seed])
        self.made = made = Mechanism(rng, SYSTEMS[seed % len(SYSTEMS)])
        for _ in range(BODIES):
            _add_body(made)
        for k in range(MARKERS):
            _place(made, k % (BODIES + 1) - 1, rng.uniform(-1, 1, 3) * made.length,
                   any_rotation(rng))  # fmt: skip
        _start(made)
        self.markers = [self._moving(frame) for frame in made.frames]

    def __getitem__(self, number: int) -> Marker:
        return self.markers[number - 1]

    def on(self, body: int) -> list[int]:
        """Numbers of the markers of a body."""
        return [k + 1 for k, frame in enumerate(self.made.frames) if frame.body == body]

    def pick(self, count: int) -> list[int]:
        """Markers on different bodies, or on the ground."""
        bodies = self.rng.permutation(np.arange(-1, BODIES))[:count]
        return [int(self.rng.choice(self.on(int(b)))) for b in bodies]

    def _moving(self, frame: Frame) -> Marker:
        if frame.body < 0:
            return Marker(-1, frame.origin, frame.axes, np.zeros(3), np.zeros(3))
        b, start, body = frame.body, self.made.start, self.made.bodies[frame.body]
        arm = start.rotation[b] @ (frame.origin - body.centre)
        v = start.v[b] + np.cross(start.w[b], arm)
        return Marker(b, start.r[b] + arm, start.rotation[b] @ frame.axes, v, start.w[b])

    def run(self, *statements: str, end: float = 1e-6, steps: int = 1) -> al.Results:
        """The deck with these statements, for so short a time that only the start counts."""
        made = self.made
        kept, made.lines = made.lines, list(statements)
        deck = text(made, end, steps, "RADAU, ERROR=1E-10")
        made.lines = kept
        return al.simulate(compiled(deck))

    def accelerations(self, loads: list[tuple[int, Array, Array, Array]]) -> Array:
        """(BODIES, 6) a and alpha for loads (body, point, force, torque) in ground axes."""
        made, start = self.made, self.made.start
        found = np.zeros((BODIES, 6))
        ucf, gravity = made.assembly.ucf, made.assembly.gravity
        for b, body in enumerate(made.bodies):
            force, torque = np.zeros(3), np.zeros(3)
            for which, point, push, twist in loads:
                if which == b:
                    force = force + push
                    torque = torque + twist + np.cross(point - start.r[b], push)
            inertia = start.rotation[b] @ body.inertia @ start.rotation[b].T
            whirl = np.cross(start.w[b], inertia @ start.w[b])
            found[b, :3] = gravity + ucf * force / body.mass
            found[b, 3:] = np.linalg.solve(inertia, ucf * torque - whirl)
        return found


def reported(results: al.Results) -> Array:
    """(BODIES, 6) a and alpha of the first row, in ground axes."""
    names = ("ax", "ay", "az", "alx", "aly", "alz")
    return np.array([[results[f"PART/{b + 2}.{n}"][0] for n in names] for b in range(BODIES)])


def pair(
    i: Marker, j: Marker, force: Array, torque: Array
) -> list[tuple[int, Array, Array, Array]]:
    """Force and torque on I, the opposite on the body of J at the place of I."""
    return [(i.body, i.r, force, torque), (j.body, i.r, -force, -torque)]


# ------------------------------------------------------------------------- what markers measure


def seen(i: Marker, j: Marker, k: Marker) -> Array:
    """r_i - r_j along the axes of k."""
    return k.A.T @ (i.r - j.r)


def velocity(i: Marker, j: Marker, k: Marker, frame: Marker) -> Array:
    """d/dt(r_i - r_j) taken in a frame, along the axes of k."""
    return k.A.T @ (i.v - j.v - np.cross(frame.w, i.r - j.r))


def projected_angles(i: Marker, j: Marker) -> Array:
    """AX, AY, AZ of I seen from J, in -pi ... pi."""
    x, y, z = i.A.T
    xj, yj, zj = j.A.T
    return np.array([np.arctan2(-z @ yj, z @ zj), np.arctan2(z @ xj, z @ zj),
                     np.arctan2(x @ yj, x @ xj)])  # fmt: skip
