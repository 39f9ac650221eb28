"""Write the references of both decks (metre and millimetre) from the closed form.

A body falls from rest by  d/dt[(m0 + mu t) v] = (m0 + mu t) g.  With S = 1 + r t, r = mu / m0:

    v = g / (2 r) (S - 1 / S),   y = g / (2 r^2) ((S^2 - 1) / 2 - ln S),   a = g / 2 (1 + 1 / S^2)
"""

from pathlib import Path

import numpy as np
from scipy.integrate import solve_ivp

M0, MU, G = 10.0, 10.0, -9.81
HEADER = """# d'Alembert sign: d/dt[(m0 + Dm) v] = (m0 + Dm) g, closed form: see README.md
# written by make_reference.py
# tolerance: rel 1e-6 abs {length:g}
# tolerance REQUEST/1.F3: rel 1e-6 abs 1e-6
time,PART/2.x,PART/2.y,PART/2.z,PART/2.vx,PART/2.vy,PART/2.vz,PART/2.ay,VARIABLE/Dm,REQUEST/1.F3"""


def closed_form(t):
    """Height y, velocity y' and acceleration y" (each shaped like t)."""
    r = MU / M0
    s = 1 + r * t
    y = G / (2 * r * r) * ((s * s - 1) / 2 - np.log(s))
    return y, G / (2 * r) * (s - 1 / s), G / 2 * (1 + 1 / s**2)


def force(t, v, a):
    """The statement of the deck."""
    return -MU * t * (a - G) - MU * v


def check(t, y, v, a):
    """The closed form against the equation of motion, and against the momentum integrated."""
    assert np.allclose(M0 * a, M0 * G + force(t, v, a), rtol=1e-12)
    mass = M0 + MU * t
    run = solve_ivp(
        lambda time, s: [s[1] / (M0 + MU * time), (M0 + MU * time) * G],
        (0, t[-1]),
        [0, 0],
        method="DOP853",
        t_eval=t,
        rtol=1e-13,
        atol=1e-14,
    )
    assert np.allclose(run.y, [y, mass * v], rtol=1e-10, atol=1e-11)
    known = dict(zip([0.25, 0.5, 0.9], [2.20725, 4.0875, 6.73792], strict=True))
    assert np.allclose(np.interp(list(known), t, -v), list(known.values()), rtol=1e-6)


def write(path, scale):
    """One reference; `scale` is the number of the deck's length units in a metre."""
    t = np.append(np.arange(51) / 20, 0.99)
    t.sort()
    y, v, a = closed_form(t)
    check(t, y, v, a)
    zero = 0 * t
    kinematic = scale * np.column_stack([zero, y, zero, zero, v, zero, a])
    table = np.column_stack([t, kinematic, MU * t, force(t, v, a)])
    np.savetxt(
        path,
        table + 0.0,
        fmt="%.12g",
        delimiter=",",
        comments="",
        header=HEADER.format(length=1e-8 * scale),
    )


if __name__ == "__main__":
    folder = Path(__file__).parent
    write(folder / "growing-mass-dalembert.reference.csv", 1)
    write(folder / "growing-mass-dalembert-mm.reference.csv", 1000)
