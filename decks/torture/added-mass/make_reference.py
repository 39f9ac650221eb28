"""Write the reference of masses that a force proportional to the acceleration makes heavier."""

import sys
from pathlib import Path

import numpy as np

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parents[1]))

from minimal import write  # noqa: E402  (it lies beside the folders of the cases)

MASS, STIFFNESS, SHARES = 10.0, 4000.0, (0.5, 0.9, 1.1, 2.0, 10.0)
LINES = """
x = 0.01 cos(w t), w^2 = k/(m0 + dm): see README.md
tolerance: abs 1e-6
tolerance *.ax: abs 1e-4
"""


def main():
    t, columns = np.linspace(0, 2, 101), {}
    for body, share in enumerate(SHARES, 2):
        w = np.sqrt(STIFFNESS / (MASS * (1 + share)))
        columns[f"POINT_MASS/{body}.x"] = 0.01 * np.cos(w * t)
        columns[f"POINT_MASS/{body}.ax"] = -0.01 * w**2 * np.cos(w * t)
    write(HERE / "reference.csv", LINES, list(columns), [t, *columns.values()])


if __name__ == "__main__":
    main()
