"""Write the references of the Atwood machine from its closed form, asserted by its energy."""

import sys
from pathlib import Path

import numpy as np

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))

from minimal import write  # noqa: E402  (it lies beside the folders of the cases)

G, M1, M2, PULLEY, INERTIA, RADIUS = 9.81, 5.0, 3.0, 2.0, 0.04, 0.2
LINES = """
Atwood machine, closed form: see README.md
tolerance: abs 1e-8
tolerance PART/*.y: abs 1e-6
tolerance PART/10.wz: abs 1e-6
"""


def main():
    a = (M1 - M2) * G / (M1 + M2 + INERTIA / RADIUS**2)
    t1, t2 = M1 * (G - a), M2 * (G + a)
    mount = t1 + t2 + PULLEY * G
    assert np.allclose([a, t1, t2, mount], [2.18, 38.15, 35.97, 93.74], rtol=1e-14)
    assert np.isclose(INERTIA * a / RADIUS, RADIUS * (t1 - t2))
    t = np.linspace(0, 1, 51)
    fallen, speed, turn = a * t**2 / 2, a * t, -a * t / RADIUS
    kinetic = (M1 + M2) * speed**2 / 2 + INERTIA * turn**2 / 2
    assert np.allclose(kinetic, (M1 - M2) * G * fallen)
    motion = {
        "PART/20.y": -1 - fallen, "PART/30.y": -1 + fallen, "PART/10.wz": turn,
        "PART/20.ay": -a, "PART/30.ay": a, "PART/10.alz": -a / RADIUS, "JOINT/1.fy": mount,
    }  # fmt: skip
    ropes = {
        "rackpin": {"JOINT/4.fy": -t1, "JOINT/5.fy": -t2, "JOINT/4.tz": -RADIUS * t1},
        "coupler": {"COUPLER/1.fy": t1, "COUPLER/2.fy": t2},
    }
    for kind, rope in ropes.items():
        columns = motion | rope
        path = HERE / f"atwood-{kind}.reference.csv"
        write(path, LINES, list(columns), [t, *columns.values()])


if __name__ == "__main__":
    main()
