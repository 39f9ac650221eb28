"""Write the references of the one-sided pulley: involute in closed form, free by Lagrange."""

import sys
from pathlib import Path

import numpy as np
import sympy as sp

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))

from minimal import coordinates, equations, solve, write  # noqa: E402  (beside the cases)
from pulley import Side  # noqa: E402

RADIUS, LENGTH, SPEED, MASS = 0.1, 1.0, 2.0, 1.0
WINDUP = """
The end of a cable that winds up runs along an involute: see README.md
tolerance: abs 1e-6
tolerance PART/10.psi: abs 1e-10
tolerance PART/*.v*: abs 2e-6
tolerance PART/*.w*: abs 1e-5
tolerance JOINT/*: abs 1e-4
tolerance MOTION/*: abs 1e-5
"""
FREE = """
Three minimal coordinates, DOP853 at rtol 1e-12: see README.md
tolerance: abs 2e-6
tolerance *.v*: abs 2e-5
tolerance *.wz: abs 5e-5
"""


def windup(t):
    """Length, wrap angle, end (2, nt), its velocity and the pull of the involute, closed form."""
    length = np.sqrt(LENGTH**2 - 2 * RADIUS * SPEED * t)
    b = (LENGTH - length) / RADIUS
    r, k = np.array([np.cos(b), np.sin(b)]), np.array([-np.sin(b), np.cos(b)])
    return length, b, RADIUS * r + length * k, -SPEED * r, MASS * SPEED**2 / length * k


def check_windup(t, length, b, place):
    """Closed form against Lagrange's equations, and the values of the standard test."""
    assert np.allclose([length[-1], MASS * SPEED**2 / length[-1]], [0.4472136, 8.944272], rtol=1e-7)
    q, v = coordinates("b p")
    side = Side(RADIUS, 1, 0.0, LENGTH, MASS)
    rhs = equations(q, v, side.kinetic(q, v, 0, *q))
    states = solve(rhs, [0, 0, SPEED / LENGTH, 0], t)
    assert np.allclose(states[:, 0], b, rtol=0, atol=1e-9)
    assert np.allclose(states[:, 1], 0, rtol=0, atol=1e-12)
    end = sp.lambdify(q, side.end(0, *q)[:2])
    assert np.allclose(end(*states[:, :2].T), place, rtol=0, atol=1e-9)


def write_windup(t):
    length, b, place, speed, pull = windup(t)
    check_windup(t, length, b, place)
    torque = RADIUS * MASS * SPEED**2 / length
    columns = {
        "PART/40.x": place[0], "PART/40.y": place[1], "PART/40.z": 0,
        "PART/40.vx": speed[0], "PART/40.vy": speed[1], "PART/40.wz": SPEED / length,
        "PART/20.wz": SPEED / length, "PART/10.psi": 0,
        "MOTION/1.tz": -torque,
    }  # fmt: skip
    mount = {"JOINT/1.fx": -pull[0], "JOINT/1.fy": -pull[1]}
    rack = {"JOINT/5.fx": pull[0], "JOINT/5.fy": pull[1], "JOINT/5.tz": torque}
    for kind, more in (("rackpin", mount | rack), ("coupler", mount)):
        path = HERE / f"windup-{kind}.reference.csv"
        write(path, WINDUP, [*columns, *more], [t, *columns.values(), *more.values()])


def write_free(t):
    q, v = coordinates("f b p")
    f, b, p = q
    side = Side(RADIUS, 1, np.pi, 0.6, 2.0, 0.01, 0.002, 0.2, 0.0003, 0.002)
    kinetic = side.kinetic(q, v, f, b, p) + 0.1 * v[0] ** 2 / 2
    potential = side.potential(9.81, f, b, p)
    rhs = equations(q, v, kinetic, potential, [-2 * v[0], 0, 0])
    start = [0, np.pi, 0, 0, 1.5, 1.0]
    states = solve(rhs, start, t)
    assert np.allclose(solve(rhs, start, t, 1e-10), states, rtol=0, atol=1e-7)
    y = states.T
    free = equations(q, v, kinetic, potential)
    energy = sp.lambdify([*q, *v], kinetic + potential)(*solve(free, start, t).T)
    assert np.allclose(energy, energy[0], rtol=1e-10)
    end = side.end(f, b, p)
    place = sp.lambdify([*q, *v], list(end))(*y)
    speed = sp.lambdify([*q, *v], list(end.jacobian(list(q)) * sp.Matrix(v)))(*y)
    feed = 0.6 + RADIUS * (y[0] - y[1] + np.pi)
    columns = dict(zip(("PART/40.x", "PART/40.y", "PART/40.z"), place, strict=True))
    columns |= dict(zip(("PART/40.vx", "PART/40.vy", "PART/40.vz"), speed, strict=True))
    columns |= {"PART/10.wz": y[3], "PART/20.wz": y[4], "VARIABLE/feed": feed}
    write(HERE / "free.reference.csv", FREE, list(columns), [t, *columns.values()])


if __name__ == "__main__":
    times = np.linspace(0, 2, 101)
    write_windup(times)
    write_free(times)
