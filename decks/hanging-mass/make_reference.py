"""Write reference.csv of the hanging mass from the closed form of the damped oscillator.

With d the way below the free end of the spring,  m d" + c d' + k d = m g,  d(0) = d'(0) = 0:

    d = m g / k * (1 - exp(-a t) (cos w t + a / w sin w t)),   a = c / 2m,  w^2 = k / m - a^2
"""

from pathlib import Path

import numpy as np
from scipy.integrate import solve_ivp

M, K, C, G, LENGTH = 2.0, 200.0, 2.0, 9.81, 1.0
HEADER = """# A mass released on a spring and a damper, closed form: see README.md
# written by make_reference.py
# tolerance: abs 1e-5
# tolerance POINT_MASS/2.v*: abs 1e-4
# tolerance REQUEST/1.F3: abs 2e-3
# tolerance POINT_MASS/2.x: abs 1e-12
time,POINT_MASS/2.x,POINT_MASS/2.y,POINT_MASS/2.vy,REQUEST/1.F3"""


def closed_form(t):
    """Way down d and speed down d' (each shaped like t)."""
    a = C / (2 * M)
    w = np.sqrt(K / M - a * a)
    decay = np.exp(-a * t)
    d = M * G / K * (1 - decay * (np.cos(w * t) + a / w * np.sin(w * t)))
    rate = M * G / K * decay * (w + a * a / w) * np.sin(w * t)
    return d, rate


def check(t, d, rate):
    """The closed form against a numerical solution of the same equation."""
    run = solve_ivp(
        lambda _, s: [s[1], G - (K * s[0] + C * s[1]) / M],
        (0, t[-1]),
        [0, 0],
        method="DOP853",
        t_eval=t,
        rtol=1e-12,
        atol=1e-13,
    )
    assert np.allclose(run.y, [d, rate], rtol=0, atol=1e-10)


def main():
    t = np.linspace(0, 2, 101)
    d, rate = closed_form(t)
    check(t, d, rate)
    table = np.column_stack([t, 0 * t, -LENGTH - d, -rate, K * d + C * rate])
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
