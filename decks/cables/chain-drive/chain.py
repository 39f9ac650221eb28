"""Kinematics of a roller chain on two sprockets: taut strands between polygons.

Seated pins are the corners of two polygons, with z1 and z2 teeth and the radii p/(2 sin(pi/z)).  A
strand is the common tangent of both: from corner A of the driver to corner B of the driven
sprocket, as long as the k pins between them say,

    |A - B| = k p

When a strand comes in line with the next edge of a polygon the next pin seats (or leaves) and A (or
B) moves on; the length stays continuous.  Both strands together give the turn of the driven
sprocket and the distance of the axles for each turn of the driver.  Their rates follow from

    e . (vB - vA) = 0,    e along the strand.

A strand at the angle a to the motion of its pin moves at w R cos a: between w R cos(pi/z) and w R.
"""

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from scipy.optimize import fsolve


@dataclass(frozen=True)
class Chain:
    """Data of a chain drive [m, kg, N, s]; the driver turns counterclockwise, its top pulls."""

    teeth: tuple[int, int]
    strand: int  # pins between the sprockets, about
    speed: float  # of the driver [rad/s]
    pull: float  # of the tensioner
    load: float  # torque of the driven sprocket
    brake: float = 6.0  # further torque per deviation of its speed from the mean
    ea: float = 1.0e6
    pitch: float = 0.05
    mass: float = 0.02  # of a pin
    seat: float = 2.0e6  # stiffness of a pin on the rim
    tooth: float = 0.012  # height H of the teeth
    root: float = 0.05  # bluntness of their root, e
    damping: float = 500.0  # of a link
    inertia: float = 5.0e-4

    @cached_property
    def radii(self):
        """Of the polygons of seated pins."""
        return tuple(self.pitch / 2 / np.sin(np.pi / z) for z in self.teeth)

    def corner(self, sprocket, index, turn, distance):
        """Places (.., 2) of corners of a polygon turned by `turn`."""
        angle = turn + 2 * np.pi * np.asarray(index) / self.teeth[sprocket]
        place = self.radii[sprocket] * np.stack([np.cos(angle), np.sin(angle)], -1)
        return place + [distance * sprocket, 0]

    def strand_ends(self, side, turns, distance):
        """Corners (a, b) of the common tangent above (side = 1) or below (-1) both polygons."""
        corners = []
        for sprocket, (turn, z) in enumerate(zip(turns, self.teeth, strict=True)):
            near = round((side * np.pi / 2 - turn) * z / 2 / np.pi)
            index = np.arange(near - z // 3, near + z // 3 + 1)
            corners.append((index, self.corner(sprocket, index, turn, distance)))
        (ia, pa), (ib, pb) = corners
        e = pb[None] - pa[:, None]
        across = side * np.stack([-e[..., 1], e[..., 0]], -1)
        beyond = [
            np.einsum("abi,ci->abc", across, p).max(-1)
            - np.einsum("abi,abi->ab", across, own + 0 * across)
            for p, own in ((pa, pa[:, None]), (pb, pb[None]))
        ]
        a, b = np.unravel_index(np.argmin(np.maximum(*beyond)), e.shape[:2])
        return int(ia[a]), int(ib[b])

    def excess(self, side, turns, distance, offset):
        """Length of a strand less that of its links; pin b + offset sits in corner b."""
        a, b = self.strand_ends(side, turns, distance)
        span = self.corner(1, b, turns[1], distance) - self.corner(0, a, turns[0], distance)
        return np.hypot(*span) - side * (a - b - offset) * self.pitch

    @cached_property
    def start(self):
        """Turn of the driven sprocket, distance, offsets of both strands with the driver at 0."""
        guess = [np.pi / self.teeth[1] / 2, self.strand * self.pitch]
        offsets = []
        for side in (1, -1):
            a, b = self.strand_ends(side, (0, guess[0]), guess[1])
            span = self.corner(1, b, guess[0], guess[1]) - self.corner(0, a, 0, 0)
            offsets.append(a - b - side * round(np.hypot(*span) / self.pitch))
        turn, distance = self.settle(0.0, guess, offsets)
        return turn, distance, offsets

    def settle(self, turn, guess, offsets):
        """Turn of the driven sprocket and distance at which both strands are taut."""

        def f(x):
            turns = turn, x[0]
            return [
                self.excess(side, turns, x[1], offset)
                for side, offset in zip((1, -1), offsets, strict=True)
            ]

        x, _, found, message = fsolve(f, guess, xtol=1e-13, full_output=True)
        assert found == 1 or np.abs(f(x)).max() < 1e-10, message
        return x

    def rates(self, turns, distance):
        """Angular velocity of the driven sprocket and speed of its mount."""
        rows, right = [], []
        for side in (1, -1):
            a, b = self.strand_ends(side, turns, distance)
            pa, pb = self.corner(0, a, turns[0], 0), self.corner(1, b, turns[1], distance)
            e = (pb - pa) / np.hypot(*(pb - pa))
            arm = pb - [distance, 0]
            rows.append([e @ [-arm[1], arm[0]], e[0]])
            right.append(self.speed * (e @ [-pa[1], pa[0]]))
        return np.linalg.solve(rows, right)

    def motion(self, times):
        """Driven turn, distance and their rates at `times` (nt, 4)."""
        x, out = self.start[:2], []
        previous = 0.0
        for t in times:
            x = x + self.rates((self.speed * previous, x[0]), x[1]) * (t - previous)
            x = self.settle(self.speed * t, x, self.start[2])
            out.append([*x, *self.rates((self.speed * t, x[0]), x[1])])
            previous = t
        return np.array(out)

    def pins(self):
        """Places and velocities (N, 2) of all pins at the start, in the order of passing."""
        turn, distance, (top, bottom) = self.start
        rate, drift = self.rates((0, turn), distance)
        (a, b), (c, d) = (self.strand_ends(s, (0, turn), distance) for s in (1, -1))
        place = [
            self.corner(0, np.arange(a, c + self.teeth[0] + 1), 0, 0),
            self.corner(1, np.arange(d, b + 1), turn, distance),
        ]
        spin = [p @ [[0, 1], [-1, 0]] for p in (place[0], place[1] - [distance, 0])]
        speed = [self.speed * spin[0], rate * spin[1] + [drift, 0]]
        counts = d + bottom - c, a - b - top
        parts = []
        for i, count in enumerate(counts):
            share = np.arange(1, count)[:, None] / count
            both = [(x[i][-1] * (1 - share) + x[1 - i][0] * share) for x in (place, speed)]
            parts += [(place[i], speed[i]), tuple(both)]
        return tuple(np.vstack(x) for x in zip(*parts, strict=True))
