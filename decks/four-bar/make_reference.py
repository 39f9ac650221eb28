"""Write the reference of the four-bar: one coordinate, the loop closed by two circles."""

import sys
from pathlib import Path

import numpy as np
import sympy as sp

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))

from minimal import coordinates, equations, solve, write  # noqa: E402  (beside the cases)

CRANK, COUPLER, ROCKER, BASE = 0.1, 0.35, 0.3, 0.4
MASSES, G, START, SPEED = (1.0, 2.0, 1.5), 9.81, np.pi / 2, -8.0
LINES = """
One coordinate, DOP853 at rtol 1e-12: see README.md
tolerance: abs 1e-6
tolerance VARIABLE/*: abs 1e-5
tolerance PART/*.w*: abs 5e-4
"""


def linkage(a):
    """Pins at the end of crank and rocker for the crank angle a (coupler above the base)."""
    pin = sp.Matrix([CRANK * sp.cos(a), CRANK * sp.sin(a)])
    base = sp.Matrix([BASE, 0])
    way = base - pin
    square = way.dot(way)
    share = (square + COUPLER**2 - ROCKER**2) / (2 * square)
    height = sp.sqrt(COUPLER**2 / square - share**2)
    return pin, pin + share * way + height * sp.Matrix([-way[1], way[0]])


def energies(a, w):
    """Kinetic and potential energy; a uniform rod has m/6 (u.u + u.v + v.v) with its ends' u, v."""
    pin, top = linkage(a)
    base = sp.Matrix([BASE, 0])
    kinetic = potential = 0
    for mass, p, q in zip(MASSES, (sp.zeros(2, 1), pin, top), (pin, top, base), strict=True):
        u, v = sp.diff(p, a) * w, sp.diff(q, a) * w
        kinetic += mass / 6 * (u.dot(u) + u.dot(v) + v.dot(v))
        potential += mass * G * (p + q)[1] / 2
    return kinetic, potential


def main():
    t = np.linspace(0, 1.5, 151)
    (a,), (w,) = coordinates("a")
    kinetic, potential = energies(a, w)
    rhs = equations([a], [w], kinetic, potential)
    y = solve(rhs, [START, SPEED], t).T
    assert np.allclose(solve(rhs, [START, SPEED], t, 1e-11).T, y, rtol=0, atol=1e-6)
    energy = sp.lambdify([a, w], kinetic + potential)(*y)
    assert np.allclose(energy, energy[0], rtol=1e-10)
    pin, top = (np.array(sp.lambdify(a, list(p))(y[0])) for p in linkage(a))
    assert np.allclose(np.hypot(*(top - pin)), COUPLER)
    rocker = np.arctan2(top[1], top[0] - BASE)
    middle = (pin + top) / 2
    columns = {
        "VARIABLE/crank": y[0], "VARIABLE/rocker": rocker, "PART/2.wz": y[1],
        "PART/3.x": middle[0], "PART/3.y": middle[1], "PART/3.z": 0 * t,
    }  # fmt: skip
    write(HERE / "reference.csv", LINES, list(columns), [t, *columns.values()])


if __name__ == "__main__":
    main()
