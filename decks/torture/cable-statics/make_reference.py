"""Write decks and references of cables at rest: closed forms, and the polygon of a catenary.

Section k pulls with T_k, its length is h (1 + T_k/EA). Hanging straight down with a weight M:

    T_k = g (M + rho h/2 + rho h (N - k)),   stretch = g L (M + rho L/2)/EA   for every N

Between two points at the same height, pulled with H level and V_k upright, k = 1 .. N:

    V_k = rho g h (k - (N + 1)/2),   T_k = sqrt(H^2 + V_k^2)
    sum h (1 + T_k/EA) H/T_k = span                             decides H
"""

import sys
from pathlib import Path

import numpy as np
from scipy.optimize import brentq

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parents[1]))

from minimal import write  # noqa: E402  (it lies beside the folders of the cases)

G, EA, RHO = 9.81, 6e7, 5.536
TOP = """{title}
! Written by make_reference.py.

UNITS/SYSTEM=MKS
ACCGRAV/JGRAV=-9.81

PART/1, GROUND
MARKER/1, PART=1
"""
NODE = """
POINT_MASS/{k}, MASS={mass:.16g}, CM={k}, QG={x:.16g},{y:.16g},0
MARKER/{k}, POINT_MASS={k}
SFORCE/{k}, TRANSLATION, I={k}, J={before}, FUNCTION=-6E7*(DM({k},{before})/{h:.16g}-1)
"""
BOTTOM = """
EQUILIBRIUM/ERROR=1.0E-10, IMBALANCE=1.0E-6, MAXIT=200
SIMULATE/STATICS
END
"""


def hanging(n=20, length=1000.0, weight=500.0):
    """A cable of `length` hanging down, started unstretched."""
    h = length / n
    text = TOP.format(title=f"A cable of 1000 m hanging down: {n} sections and 500 kg")
    for k in range(1, n + 1):
        mass = RHO * h if k < n else RHO * h / 2 + weight
        text += NODE.format(k=k + 1, before=k, mass=mass, x=0, y=-k * h, h=h)
    (HERE / "hanging.adm").write_text(text + BOTTOM)
    pull = G * (weight + RHO * h / 2 + RHO * h * (n - np.arange(1, n + 1)))
    stretch = (pull * h / EA).sum()
    assert np.isclose(stretch, G * length * (weight + RHO * length / 2) / EA, rtol=1e-14)
    assert np.isclose(stretch, 0.534318)
    lines = "Closed form: see README.md\ntolerance: rel 1e-6\n"
    lines += "tolerance POINT_MASS/*: abs 5e-7"
    names = [f"POINT_MASS/{n + 1}.y", "SFORCE/2.f", f"SFORCE/{n + 1}.f"]
    write(HERE / "hanging.reference.csv", lines, names, [0, -length - stretch, -pull[0], -pull[-1]])


def polygon(n, ea=EA, span=10.0, length=11.0):
    """H, pulls T_k, and the nodes (x, y), the first at the origin."""
    h = length / n
    upright = RHO * G * h * (np.arange(1, n + 1) - (n + 1) / 2)

    def steps(level):
        pull = np.hypot(level, upright)
        return h * (1 + pull / ea) * np.array([level / pull, upright / pull]), pull

    level = brentq(lambda level: steps(level)[0][0].sum() - span, 1.0, 1e5, xtol=1e-12, rtol=1e-15)
    away, pull = steps(level)
    return level, pull, np.cumsum(away, axis=1)


def catenary(n, span=10.0, length=11.0):
    """A slack cable between two points, started as two straight halves."""
    h = length / n
    depth = np.sqrt(length**2 - span**2) / 2
    text = TOP.format(title=f"A catenary of {n} sections, 11 m between points 10 m apart")
    text += f"MARKER/{n + 1}, PART=1, QP={span:g},0,0\n"
    for k in range(1, n):
        x, y = span * k / n, -2 * depth * min(k, n - k) / n
        text += NODE.format(k=k + 1, before=k, mass=RHO * h, x=x, y=y, h=h)
    text += f"\nSFORCE/{n + 1}, TRANSLATION, I={n}, J={n + 1}"
    text += f", FUNCTION=-6E7*(DM({n},{n + 1})/{h:.16g}-1)\n"
    text += f"VARIABLE/level, FUNCTION=-SFORCE({n // 2 + 1},0,2)\n"
    (HERE / f"catenary-n{n}.adm").write_text(text + BOTTOM)
    level, pull, places = polygon(n)
    middle = n // 2
    lines = "Polygon of stretched sections: see README.md\ntolerance: rel 1e-6\n"
    lines += "tolerance POINT_MASS/*: abs 1e-6"
    names = [f"POINT_MASS/{middle + 1}.{c}" for c in "xy"]
    names += [f"POINT_MASS/{n // 4 + 1}.{c}" for c in "xy"] + ["SFORCE/2.f"]
    values = [*places[:, middle - 1], *places[:, n // 4 - 1], -pull[0]]
    write(HERE / f"catenary-n{n}.reference.csv", lines, names, [0, *values])


def main():
    hanging()
    a = brentq(lambda a: 2 * a * np.sinh(5 / a) - 11, 1, 100)
    ideal = np.array([RHO * G * a, a * (np.cosh(5 / a) - 1)])
    assert np.allclose(ideal, [355.6989, 2.0030079], rtol=1e-7)

    off = []
    for n in (20, 40):
        catenary(n)
        level, _, places = polygon(n, ea=1e15)
        off.append(np.array([level, -places[1].min()]) - ideal)
    assert np.allclose(off[0] / off[1], 4, atol=0.05)


if __name__ == "__main__":
    main()
