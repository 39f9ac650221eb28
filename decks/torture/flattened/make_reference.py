"""Write the references of mechanisms that pass a posture in which they could move two ways.

Parallelogram (A02 with N = 1), a the angle of the cranks:

    ((N + 1)/3 + N) a" = -g ((N + 1)/2 + N) cos(a),   a(0) = 90 degrees, a'(0) = -1 rad/s

Equal arms l, driven: x = 2 l cos(w t), the rod at -w t.
"""

import sys
from pathlib import Path

import numpy as np

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parents[1]))

from minimal import solve, write  # noqa: E402  (it lies beside the folders of the cases)

G, N, ARM, RATE = 9.81, 1, 0.2, 10.0
PARALLELOGRAM = """
A02, N = 1, one equation, DOP853 at rtol 1e-12: see README.md
tolerance: abs 1e-4
tolerance VARIABLE/skew: abs 1e-6
measure: range VARIABLE/energy = 0 tol abs 1e-4
"""
DRIVEN = """
Equal arms at constant speed, closed form: see README.md
tolerance: abs 1e-6
tolerance PART/4.ax: abs 4e-5
"""


def parallelogram():
    inertia, arm = (N + 1) / 3 + N, (N + 1) / 2 + N

    def rhs(_, y):
        return np.array([y[1], -G * arm / inertia * np.cos(y[0])])

    t = np.linspace(0, 10, 201)
    y = solve(rhs, [np.pi / 2, -1], t)
    energy = inertia * y[:, 1] ** 2 / 2 + G * arm * np.sin(y[:, 0])
    assert np.allclose(energy, energy[0], rtol=1e-10)
    names = ["REQUEST/1.F2", "REQUEST/1.F3", "REQUEST/1.F4", "VARIABLE/skew"]
    columns = [t, np.cos(y[:, 0]), np.sin(y[:, 0]), 0.0, 0.0]
    write(HERE / "parallelogram.reference.csv", PARALLELOGRAM, names, columns)


def driven():
    t = np.linspace(0, 1.5, 151)
    x = 2 * ARM * np.cos(RATE * t)
    names = ["PART/4.x", "PART/4.vx", "PART/4.ax", "PART/3.wz"]
    speed = -2 * ARM * RATE * np.sin(RATE * t)
    columns = [t, x, speed, -(RATE**2) * x, -RATE]
    write(HERE / "driven-equal-arms.reference.csv", DRIVEN, names, columns)


if __name__ == "__main__":
    parallelogram()
    driven()
