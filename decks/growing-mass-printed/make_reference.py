"""Write reference.csv of the printed growing-mass force from its closed form.

With S = 1 - r t, r = mu / m0, the body obeys  (m0 - mu t)(a - g) = mu v  and falls from rest:

    v = g / (2 r) (1 / S - S),   y = g / (2 r^2) ((S^2 - 1) / 2 - ln S),   a = g / 2 (1 + 1 / S^2)
"""

from pathlib import Path

import numpy as np
from scipy.integrate import solve_ivp

M0, MU, G = 10.0, 10.0, -9.81
HEADER = """# Printed sign: effective mass m0 - Dm, closed form to Dm / m0 = 0.99: see README.md
# written by make_reference.py
# tolerance: rel 1e-6 abs 1e-8
# tolerance REQUEST/1.F3: rel 1e-6 abs 1e-4
time,PART/2.x,PART/2.y,PART/2.z,PART/2.vx,PART/2.vy,PART/2.vz,PART/2.ay,VARIABLE/Dm,REQUEST/1.F3"""


def closed_form(t):
    """Height y, velocity y' and acceleration y" (each shaped like t)."""
    r = MU / M0
    s = 1 - r * t
    y = G / (2 * r * r) * ((s * s - 1) / 2 - np.log(s))
    return y, G / (2 * r) * (1 / s - s), G / 2 * (1 + 1 / s**2)


def force(t, v, a):
    """The printed statement."""
    return MU * t * (a - G) + MU * v


def check(t, y, v, a):
    """The closed form against the equation of motion, and against its numerical solution."""
    assert np.allclose(M0 * a, M0 * G + force(t, v, a), rtol=1e-12)
    run = solve_ivp(
        lambda time, s: [s[1], G + MU * s[1] / (M0 - MU * time)],
        (0, t[-1]),
        [0, 0],
        method="DOP853",
        t_eval=t,
        rtol=1e-13,
        atol=1e-14,
    )
    assert np.allclose(run.y, [y, v], rtol=1e-10, atol=1e-12)
    assert np.allclose(np.interp([0.25, 0.5, 0.9], t, -v), [2.86125, 7.3575, 48.5595], rtol=1e-9)


def main():
    t = np.arange(100) / 100
    y, v, a = closed_form(t)
    check(t, y, v, a)
    zero = 0 * t
    table = np.column_stack([t, zero, y, zero, zero, v, zero, a, MU * t, force(t, v, a)])
    np.savetxt(
        Path(__file__).with_name("reference.csv"),
        table + 0.0,
        fmt="%.12g",
        delimiter=",",
        header=HEADER,
        comments="",
    )


if __name__ == "__main__":
    main()
