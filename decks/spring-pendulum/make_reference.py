"""Write the references of both spring pendulums from tight numerical solutions.

A mass m at r from the support of a spring k of free length L:  m r" = m g - k (|r| - L) r / |r|
"""

from pathlib import Path

import numpy as np
from scipy.integrate import solve_ivp

SOFT = {"k": 40.0, "gravity": np.array([0, 0, -9.81]), "start": [0.8, 0, -0.9, 0, 0.7, 0]}
STIFF = {"k": 1.0e6, "gravity": np.array([0, -1.0, 0]), "start": [1.0, 0, 0, 0, 0, 0]}
HEADER = """# Spring pendulum, DOP853 at rtol 1e-12: see README.md
# written by make_reference.py
# tolerance: abs 1e-4
# tolerance POINT_MASS/2.v*: abs 1e-3
# tolerance VARIABLE/energy: abs 1e-3
time,POINT_MASS/2.x,POINT_MASS/2.y,POINT_MASS/2.z,POINT_MASS/2.vx,POINT_MASS/2.vy\
,POINT_MASS/2.vz,VARIABLE/energy"""


def solve(times, method, rtol, k, gravity, start):
    """Places and velocities (nt, 6); mass and free length are 1."""

    def rhs(_, y):
        r = y[:3]
        length = np.linalg.norm(r)
        return np.concatenate([y[3:], gravity - k * (length - 1) / length * r])

    return solve_ivp(rhs, (0, times[-1]), start, method, times, rtol=rtol, atol=rtol / 10).y.T


def energy(y, k, gravity):
    """Kinetic, gravity and spring energy (nt,)."""
    stretch = np.linalg.norm(y[:, :3], axis=1) - 1
    return (y[:, 3:] ** 2).sum(1) / 2 - y[:, :3] @ gravity + k / 2 * stretch**2


def check(y, other, k, gravity):
    """Two methods agree; energy and the angular momentum about the vertical are kept."""
    assert np.abs(y - other).max() < 1e-6
    e = energy(y, k, gravity)
    assert np.abs(e - e[0]).max() < 1e-7
    moment = np.cross(y[:, :3], y[:, 3:]) @ gravity
    assert np.abs(moment - moment[0]).max() < 1e-7


def write(path, method, rtol, k, gravity, start):
    """Solve, check with another method, write one reference."""
    times = np.linspace(0, 10, 101)
    case = {"k": k, "gravity": gravity, "start": start}
    y = solve(times, "DOP853", 1e-12, **case)
    check(y, solve(times, method, rtol, **case), k, gravity)
    table = np.round(np.column_stack([times, y, 0 * times + energy(y, k, gravity)[0]]), 12) + 0.0
    np.savetxt(path, table, fmt="%.12g", delimiter=",", header=HEADER, comments="")
    return y[-1]


if __name__ == "__main__":
    here = Path(__file__).parent
    write(here / "spring-pendulum.reference.csv", "Radau", 1e-9, **SOFT)
    last = write(here / "spring-pendulum-stiff.reference.csv", "Radau", 1e-11, **STIFF)
    assert np.allclose(last[:2], [-0.81157637, -0.58424934], atol=1e-7)
