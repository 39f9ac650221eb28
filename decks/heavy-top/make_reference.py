"""Write the references of the heavy top: a tight numerical solution with unit quaternions.

With w in body axes, p the unit quaternion (scalar first) of the attitude, R its matrix, d the way
to the centre of mass in body axes and I the inertia about the joint:

    I w' = I w x w + d x R^T m g,   p' = 1/2 p o (0, w)
"""

from pathlib import Path

import numpy as np
from scipy.integrate import solve_ivp

MASS, ARM = 15.0, np.array([0.0, 1.0, 0.0])
WEIGHT = MASS * np.array([0.0, 0.0, -9.81])
INERTIA = np.array([0.234375, 0.46875, 0.234375]) + MASS * np.array([1.0, 0.0, 1.0])
SPIN0 = np.array([0.0, 150.0, -4.61538])
HEADER = """# Heavy top, DOP853 at rtol 1e-13: see README.md
# written by make_reference.py
# solve: --error {error:g}
# tolerance: abs {band:g}
# tolerance VARIABLE/spin: abs {spin:g}
time,PART/2.x,PART/2.y,PART/2.z,VARIABLE/spin"""


def matrix(p):
    """Rotation matrix of the unit quaternion p = (p0, p1, p2, p3)."""
    a, v = p[0], p[1:]
    cross = np.array([[0, -v[2], v[1]], [v[2], 0, -v[0]], [-v[1], v[0], 0]])
    return (a * a - v @ v) * np.eye(3) + 2 * np.outer(v, v) + 2 * a * cross


def rhs(_, y):
    p, w = y[:4], y[4:]
    turn = np.concatenate([[-p[1:] @ w], p[0] * w + np.cross(p[1:], w)]) / 2
    torque = np.cross(ARM, matrix(p).T @ WEIGHT)
    return np.concatenate([turn, (np.cross(INERTIA * w, w) + torque) / INERTIA])


def solve(times, rtol):
    """Quaternions and body angular velocities: (nt, 7)."""
    start = np.concatenate([[1, 0, 0, 0], SPIN0])
    return solve_ivp(rhs, (0, times[-1]), start, "DOP853", times, rtol=rtol, atol=rtol).y.T


def check(times, states, place):
    """Against another tolerance, the published place at t = 1, and the laws of the top."""
    assert np.abs(solve(times, 1e-11) - states).max() < 1e-6
    published = [0.173343964098, 0.640088592070, -0.748490791134]
    assert np.allclose(place[times == 1.0], [published], rtol=0, atol=1e-8)
    p, w = states[:, :4], states[:, 4:]
    assert np.allclose((p * p).sum(1), 1, atol=1e-10)
    energy = (INERTIA * w * w).sum(1) / 2 - place @ WEIGHT
    assert np.allclose(energy, energy[0], rtol=1e-10)
    vertical = [(matrix(q) @ (INERTIA * v))[2] for q, v in zip(p, w, strict=True)]
    assert np.allclose(vertical, vertical[0], rtol=0, atol=1e-8)
    assert np.allclose(w[:, 1], 150, rtol=1e-12)


def write(path, times, place, **bands):
    table = np.column_stack([times, place, np.full_like(times, 150.0)]) + 0.0
    header = HEADER.format(**bands)
    np.savetxt(path, table, fmt="%.12g", delimiter=",", header=header, comments="")


if __name__ == "__main__":
    here = Path(__file__).parent
    times = np.linspace(0, 1, 101)
    states = solve(times, 1e-13)
    place = np.array([matrix(p) @ ARM for p in states[:, :4]])
    check(times, states, place)
    write(here / "reference.csv", times, place, error=1e-6, band=3e-3, spin=1.5e-2)
    write(here / "reference-tight.csv", times, place, error=1e-8, band=3e-4, spin=1.5e-3)
