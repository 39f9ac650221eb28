"""Write the reference of the capstan: Lagrange's equations in its four coordinates."""

import sys
from pathlib import Path

import numpy as np
import sympy as sp

HERE = Path(__file__).resolve().parent
sys.path[:0] = [str(HERE.parent), str(HERE.parent / "pulley-one-sided")]

from minimal import coordinates, equations, solve, write  # noqa: E402  (beside the cases)
from pulley import Side  # noqa: E402

SPRING, DAMPER, BRAKE, INERTIA, RADIUS = 50.0, 0.5, 2.0, 0.1, 0.1
LINES = """
Four minimal coordinates, DOP853 at rtol 1e-12: see README.md
tolerance: abs 1e-6
tolerance *.wz: abs 2e-5
"""


def main():
    q, v = coordinates("f b p w")
    f, b, p, w = q
    # The slider (0.15 kg) turns with the link and sits with the turret (0.05 kg) at the contact.
    side = Side(
        RADIUS, 1, sp.pi, 0.6, 1.0, 0.01, 0.002,
        turret=0.2, turret_inertia=0.0003, link_inertia=0.0024,
    )  # fmt: skip
    kinetic = side.kinetic(q, v, f, b, p, w) + INERTIA * v[0] ** 2 / 2
    potential = side.potential(9.81, f, b, p, w) + SPRING * w**2 / 2
    start = [0, np.pi, 0, 0, 0, 1.0, 0.5, 0.4]
    t = np.linspace(0, 2, 101)
    rhs = equations(q, v, kinetic, potential, [-BRAKE * v[0], 0, 0, -DAMPER * v[3]])
    y = solve(rhs, start, t).T
    assert np.allclose(solve(rhs, start, t, 1e-10).T, y, rtol=0, atol=1e-7)
    free = solve(equations(q, v, kinetic, potential), start, t).T
    energy = sp.lambdify([*q, *v], kinetic + potential)(*free)
    assert np.allclose(energy, energy[0], rtol=0, atol=1e-9)
    place = sp.lambdify(q, list(side.end(*q)))(*y[:4])
    columns = dict(zip(("PART/40.x", "PART/40.y", "PART/40.z"), place, strict=True))
    columns |= {"VARIABLE/wander": y[3], "PART/10.wz": y[4], "PART/20.wz": y[5]}
    write(HERE / "reference.csv", LINES, list(columns), [t, *columns.values()])


if __name__ == "__main__":
    main()
