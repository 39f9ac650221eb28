"""The references of `bead` and `ropeway`: weights that slide along a rope."""

import sys
from pathlib import Path

import numpy as np
from scipy.integrate import solve_ivp

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))

from formulas import Cable, G  # noqa: E402
from ropeways import Ropeway, coasting, loose  # noqa: E402
from spans import table  # noqa: E402

# A rope with the free length that a tension of 90 kN stretches over the span.
ROPEWAY = Ropeway(Cable(9.0e7, 3.5, 9.0e4), 180.0, 2500.0, 20.0, wheel=0.0)


def bead() -> str:
    """Place of the bead and tension of the rope: a pendulum on an ellipse.

    r = c + P cos u + Q sin u, P and Q its half axes, d = dr/du:  d.d u" = -(g d_y + d.d' u'^2);
    tension from m (r" + g e_y) = T (e_1 + e_2), e_i towards the ends of the rope.
    """
    ends, start, mass = np.array([[0.0, 0.0], [6.0, 1.0]]), np.array([1.0, -2.0]), 20.0
    centre, half = ends.mean(0), (ends[1] - ends[0]) / 2
    c, a = np.hypot(*half), np.hypot(*(start - ends).T).sum() / 2
    e = half / c
    p, q = a * e, np.sqrt(a**2 - c**2) * np.array([-e[1], e[0]])

    def rates(_, y):
        u, w = y
        d, bent = q * np.cos(u) - p * np.sin(u), -p * np.cos(u) - q * np.sin(u)
        return [w, -(G * d[1] + d @ bent * w**2) / (d @ d)]

    begin = np.arctan2((start - centre) @ q / (q @ q), (start - centre) @ p / (p @ p))
    t = np.linspace(0, 4, 101)
    u, w = solve_ivp(rates, (0, 4), [begin, 0], "DOP853", t, rtol=1e-11, atol=1e-11).y
    turn = np.array([rates(0, y)[1] for y in zip(u, w, strict=True)])
    away = np.outer(np.cos(u), p) + np.outer(np.sin(u), q)
    d = np.outer(np.cos(u), q) - np.outer(np.sin(u), p)
    load = mass * (d * turn[:, None] - away * w[:, None] ** 2 + [0, G])
    pull = sum((x - centre - away) / np.hypot(*(x - centre - away).T)[:, None] for x in ends)
    lines = [
        "Place of the bead, tension: README.md",
        "written by describe.py",
        "tolerance POINT_MASS/20.*: abs 4e-6",
        "tolerance GCON/1.f: abs 2e-4",
    ]
    columns = [t, *(centre + away).T, -(load * pull).sum(1) / (pull * pull).sum(1)]
    return table(["time", "POINT_MASS/20.x", "POINT_MASS/20.y", "GCON/1.f"], lines, columns)


def ropeway() -> str:
    """Place of the car and tension beside it: ../ropeways.py, without a wheel."""
    t = np.linspace(0, 40, 201)
    columns = coasting(ROPEWAY, t, loose(ROPEWAY))
    lines = [
        "Place of the car, tension: README.md",
        "written by describe.py",
        "tolerance POINT_MASS/20.x: abs 5.4e-2",
        "tolerance POINT_MASS/20.y: abs 1e-2",
        "tolerance REQUEST/1.F2: peak 1e-3",
    ]
    header = ["time", "POINT_MASS/20.x", "POINT_MASS/20.y", "REQUEST/1.F2"]
    return table(header, lines, [t, *columns])
