"""Write the decks of this folder from their descriptions, and their references."""

import sys
from dataclasses import dataclass
from pathlib import Path

import numpy as np

HERE = Path(__file__).resolve().parent
sys.path[:0] = [str(HERE.parent), str(HERE)]

from bars import Bars  # noqa: E402
from described_cases import write  # noqa: E402
from formulas import G  # noqa: E402
from spans import table  # noqa: E402

SIGNS = (1, -1)


def touching(a, b, turns, radii):
    """Length and direction of the rope from circle a to circle b; a point has no radius."""
    d = np.subtract(b, a)[:2]
    k = turns[1] * radii[1] - turns[0] * radii[0]
    spacing = np.hypot(*d)
    return np.sqrt(spacing**2 - k**2), np.arctan2(d[1], d[0]) + np.arcsin(-k / spacing)


def bars(first, start, count, pitch, stagger, radius, winch, winch_radius, winch_turn):
    """Lengths of the spans and wraps of the bars: over the first bar, under the second, ..."""
    places = [np.add(start, np.multiply(k, pitch)) + (k % 2) * np.array(stagger)
              for k in range(count)]  # fmt: skip
    centres = [first, *places, winch]
    turns = [0, *[-1 if k % 2 == 0 else 1 for k in range(count)], winch_turn]
    radii = [0, *[radius] * count, winch_radius]
    spans = [touching(centres[i], centres[i + 1], turns[i : i + 2], radii[i : i + 2])
             for i in range(count + 1)]  # fmt: skip
    lengths, angles = np.array(spans).T
    return lengths, np.abs(np.diff(angles))


def step5(t, t0, t1):
    d = np.clip((t - t0) / (t1 - t0), 0, 1)
    return d**3 * (10 - 15 * d + 6 * d * d)


def pulled(rope, start, count, payout, noise):
    """Tensions at both ends of every span, displacement and ratio at every bar."""
    t = np.linspace(0, 100, 101)
    u, pulls = rope.motion(payout(t))
    label = (lambda p: p) if count < 9 else (lambda p: 1000 * p)
    columns = {}
    for p, pull in enumerate(pulls.T, 1):
        columns[f"REQUEST/{label(p)}.F2"] = pull
        if 1 < p:
            columns[f"REQUEST/{label(p)}.F3"] = pull
    for i in range(count):
        columns[f"REQUEST/{10 * (i + 2)}.F2"] = u[:, i]
        columns[f"REQUEST/{10 * (i + 2)}.F8"] = pulls[:, i + 1] / pulls[:, i]
    full = np.exp(rope.mu * rope.wraps)
    lines = [
        "Tensions, displacements and ratios over bars that slip, hold and slip back: README.md",
        "written by make_reference.py",
        f"tolerance REQUEST/*: rel {noise[0]:g}",
        f"tolerance REQUEST/*.F2: rel {noise[0]:g} abs {noise[1]:g}",
        f"tolerance REQUEST/*.F8: abs {noise[2]:g}",
        *(f"measure: value REQUEST/{10 * (i + 2)}.F8 at 50 = {full[i]:.12g} tol rel 1e-6"
          for i in range(count)),
    ]  # fmt: skip
    return table(["time", *columns], lines, [t, *columns.values()], 1e-9)


def pull():
    lengths, wraps = bars((-2, 0), (0, 0.1), 6, (0.8, 0), (0, -0.3), 0.1, (5, 0), 0.2, 1)
    rope = Bars(1e6, 1000, lengths, wraps, 0.25, 2e-5)
    return pulled(rope, 0, 6, lambda t: -0.05 * step5(t, 0, 50) + 0.03 * step5(t, 50, 100),
                  (1e-5, 2e-7, 2e-5))  # fmt: skip


def pull_long():
    lengths, wraps = bars((-30, 1), (0, 1), 9, (6, 0.5), (0, -1.7), 0.4, (60, 4), 0.9, 1)
    rope = Bars(4e7, 20e3, lengths, wraps, 0.12, 1e-4)
    return pulled(rope, 0, 9, lambda t: -0.4 * step5(t, 0, 50) + 0.2 * step5(t, 50, 100),
                  (1e-5, 2e-7, 2e-5))  # fmt: skip


@dataclass(frozen=True)
class Hoist:
    """A weight on three sheaves with bearing friction and a stuck one [kg, N, m, kg m^2, N m]."""

    mass: float
    rho: float
    drop: float
    dip: float
    inertia: float
    friction: float
    mu: float
    travel: float
    radius: float = 0.3
    winch: float = 0.5

    def tensions(self, t):
        """Of every span at its first and its last wheel, along the rope: a column each.

        The rope moves as one, v towards the winch: every piece has the tension behind it, and its
        mass times (a - g.e) more before it; a sheave adds J a/R^2 + M/R; the stuck one what slips.
        """
        lengths, angles = self.route()
        v, a = self.speed(t)
        side, u = np.tanh(v / 1e-9), self.rho * v**2
        pull = (self.mass + self.rho * (lengths[0] - self.hoisted(t))) * (G + a)
        columns = [pull]
        for p in range(1, 5):
            if p < 4:
                pull = pull + self.inertia / self.radius**2 * a + side * self.friction / self.radius
                pull = pull + self.rho * self.radius * abs(angles[p] - angles[p - 1]) * a
            else:
                wrap = abs(angles[4] - angles[3])
                h, arc = np.tanh(self.mu * wrap / 2 * side), self.rho * self.radius * wrap
                pull = (pull * (1 + h) - 2 * u * h + arc * a) / (1 - h)
            columns.append(pull)
            pull = pull + self.rho * lengths[p] * (a + G * np.sin(angles[p]))
            columns.append(pull)
        return columns

    def route(self):
        """Lengths and directions of the spans."""
        places = [(-0.3, -self.drop), (0, 0), (4, -self.dip), (8, 0), (12, -self.dip), (16, 0)]
        turns, radii = [0, -1, 1, -1, 1, 1], [0, *[self.radius] * 4, self.winch]
        spans = [touching(places[i], places[i + 1], turns[i : i + 2], radii[i : i + 2])
                 for i in range(5)]  # fmt: skip
        return np.array(spans).T

    def hoisted(self, t):
        """Way of the rope towards the winch."""
        return self.travel * (step5(t, 0, 8) - step5(t, 8, 16))

    def speed(self, t):
        """And acceleration."""
        h = 1e-4
        before, now, after = (self.hoisted(t + d) for d in (-h, 0, h))
        return (after - before) / (2 * h), (after - 2 * now + before) / h**2


def bearings(hoist, noise):
    t = np.linspace(0, 16, 161)
    pulls = hoist.tensions(t)
    moving = np.abs(hoist.speed(t)[0]) > 0.01
    names = ["REQUEST/1.F2", *(f"REQUEST/{p}.F{k}" for p in range(2, 6) for k in (2, 3))]
    way = hoist.hoisted(t)
    columns = dict(zip(names, (pull[moving] for pull in pulls), strict=True))
    columns["REQUEST/20.F2"] = way[moving]
    lines = [
        "Tensions at the sheaves, way of the rope: README.md",
        "written by make_reference.py",
        f"tolerance REQUEST/*: rel {noise:g}",
        f"tolerance REQUEST/20.F2: abs {noise * 5:g}",
    ]
    return table(["time", *columns], lines, [t[moving], *columns.values()], 1e-6)


LIGHT = Hoist(800, 3, 30, 1.5, 2.5, 90, 0.15, 5)
HEAVY = Hoist(2500, 12, 50, 2.5, 9, 120, 0.08, 8)
CASES = {
    "pull": pull,
    "pull-long": pull_long,
    "bearings": lambda: bearings(LIGHT, 5e-4),
    "bearings-heavy": lambda: bearings(HEAVY, 5e-4),
}


if __name__ == "__main__":
    write(HERE, CASES)
