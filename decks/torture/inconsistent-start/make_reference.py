"""Write the reference of a pendulum whose deck also gives it a velocity along its rod.

The nearest velocity that the rod allows is the one across it: theta" = -g/L sin(theta) from theta =
-90 degrees at 1 rad/s, integrated and compared with the energy.
"""

import sys
from pathlib import Path

import numpy as np

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parents[1]))

from minimal import solve, write  # noqa: E402  (it lies beside the folders of the cases)

G = 9.81
LINES = """
Pendulum from the horizontal at 1 m/s, DOP853 at rtol 1e-12: see README.md
tolerance: abs 1e-5
measure: value POINT_MASS/2.vx at 0 = 0 tol abs 1e-12
measure: value POINT_MASS/2.vy at 0 = -1 tol abs 1e-12
measure: range VARIABLE/stretch = 0 tol abs 1e-8
measure: range VARIABLE/energy = 0 tol abs 1e-4
"""


def main():
    t = np.linspace(0, 5, 101)
    y = solve(lambda _, y: np.array([y[1], -G * np.sin(y[0])]), [-np.pi / 2, 1.0], t)
    angle, rate = y.T
    assert np.allclose(rate**2 / 2 - G * np.cos(angle), 0.5, rtol=0, atol=1e-9)
    names = ["POINT_MASS/2.x", "POINT_MASS/2.y"]
    write(HERE / "reference.csv", LINES, names, [t, np.sin(angle), -np.cos(angle)])


if __name__ == "__main__":
    main()
