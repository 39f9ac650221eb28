"""Write the references of both decks: the time of the stop, and the motion before it.

Free fall, S = 1 - mu t / m0:          y = g / (2 r^2) ((S^2 - 1) / 2 - ln S),  r = mu / m0
On the spring, m = m0 - mu t:          (m y')' + k y = m g  has  y = g / k (m - mu^2 / k)
"""

from pathlib import Path

import numpy as np
from scipy.integrate import solve_ivp

M0, MU, G, K = 10.0, 10.0, -9.81, 4.0e5
STOP = M0 / MU
HEADER = """# Printed sign: the effective mass m0 - Dm vanishes at t = m0 / mu: see README.md
# written by make_reference.py
# expect: SINGULAR_ACCELERATION at {stop:g} within 1e-3
# tolerance: {tolerance}
time,PART/2.y,PART/2.vy"""
FALLING = "rel 1e-3 abs 1e-5\n# tolerance PART/2.y: rel 1e-3 abs 1e-6"


def free_fall(t):
    """Height y and velocity y' without a spring."""
    r = MU / M0
    s = 1 - r * t
    return G / (2 * r * r) * ((s * s - 1) / 2 - np.log(s)), G / (2 * r) * (1 / s - s)


def on_spring(t):
    """Height y and velocity y' of the smooth solution on the spring."""
    return G / K * (M0 - MU * t - MU**2 / K), 0 * t - G * MU / K


def check(t, solution, k):
    """A closed form against a numerical solution of (m y')' + k y = m g in y and p = m y'."""

    def rhs(time, s):
        m = M0 - MU * time
        return [s[1] / m, m * G - k * s[0]]

    y, v = solution(t)
    run = solve_ivp(
        rhs, (0, t[-1]), [y[0], M0 * v[0]], method="DOP853", t_eval=t, rtol=1e-12, atol=1e-14
    )
    assert np.allclose(run.y, [y, (M0 - MU * t) * v], rtol=1e-8, atol=1e-11)


def write(path, solution, k, tolerance):
    t = np.arange(10) / 10
    check(t, solution, k)
    np.savetxt(
        path,
        np.column_stack([t, *solution(t)]) + 0.0,
        fmt="%.12g",
        delimiter=",",
        comments="",
        header=HEADER.format(stop=STOP, tolerance=tolerance),
    )


if __name__ == "__main__":
    folder = Path(__file__).parent
    write(folder / "growing-mass-singular.reference.csv", free_fall, 0.0, FALLING)
    write(folder / "growing-mass-singular-spring.reference.csv", on_spring, K, "abs 1e-6")
