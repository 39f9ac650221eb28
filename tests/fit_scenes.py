"""Decks whose motion is known in closed form, and measurements of them.

A mass is thrown: y = y0 + v0 t + g t^2/2, linear in all three numbers. A mass on a spring and a
damper swings: its motion depends on k/m and c/m alone.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np

THROWN = """a mass that is thrown
UNITS/SYSTEM=MKS
ACCGRAV/JGRAV=-8
PART/1, GROUND
POINT_MASS/2, MASS=2, CM=2, QG=0,5,0, VY=3
MARKER/2, POINT_MASS=2
INTEGRATOR/GSTIFF, SI2, ERROR=1E-10
SIMULATE/DYNAMIC, END=1, STEPS=40
END
"""
SWINGS = """a mass on a spring and a damper
UNITS/SYSTEM=MKS
PART/1, GROUND
MARKER/1, PART=1
POINT_MASS/2, MASS=2, CM=2, QG=1.2,0,0
MARKER/2, POINT_MASS=2
SPRINGDAMPER/1, TRANSLATIONAL, I=2, J=1, K=200, C=2, LENGTH=1
INTEGRATOR/GSTIFF, SI2, ERROR=1E-9
SIMULATE/DYNAMIC, END=2, STEPS=100
END
"""
K, C, MASS = "SPRINGDAMPER/1.K", "SPRINGDAMPER/1.C", "POINT_MASS/2.MASS"
LINEAR = ("ACCGRAV.JGRAV", "POINT_MASS/2.VY", "POINT_MASS/2.QG[1]")
Y, VY, X = "POINT_MASS/2.y", "POINT_MASS/2.vy", "POINT_MASS/2.x"


def table(time: np.ndarray, *lines: str, **columns: np.ndarray) -> Path:
    """Write a measurement; names of columns in the order of Y, VY, X by ``y``, ``vy``, ``x``."""
    named = {"y": Y, "vy": VY, "x": X}
    rows = np.column_stack([time, *columns.values()])
    header = ",".join(["time", *(named.get(each, each) for each in columns)])
    text = [*lines, header, *(",".join(map(repr, row)) for row in rows.tolist())]
    Path("measured.csv").write_text("\n".join(text) + "\n")
    return Path("measured.csv")


def swinging(time: np.ndarray, k: float = 200.0, c: float = 2.0, m: float = 2.0) -> np.ndarray:
    """x = 1 + 0.2 exp(-d t) (cos w t + d/w sin w t),  d = c/2m,  w^2 = k/m - d^2."""
    d = c / (2.0 * m)
    w = np.sqrt(k / m - d * d)
    return 1.0 + 0.2 * np.exp(-d * time) * (np.cos(w * time) + d / w * np.sin(w * time))


TIMES = np.linspace(0.0, 1.0, 41)
LONG = np.linspace(0.0, 2.0, 101)


def noisy(size: int, sigma: float, seed: int = 3) -> np.ndarray:
    return sigma * np.random.default_rng(seed).normal(size=size)
