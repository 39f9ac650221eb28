"""Write the references of the pendulum on a massless rod from Jacobi's elliptic functions.

Released from the horizontal, theta counted from the lowest point towards -x, w^2 = g / L:

    theta = 2 asin(sin(pi / 4) sn(K - w t, 1/2)),   theta' = -2 w sin(pi / 4) cn(K - w t, 1/2)
"""

from pathlib import Path

import numpy as np
from scipy.integrate import solve_ivp
from scipy.special import ellipj, ellipk

G, LENGTH = 9.81, 1.0
HEADER = """# A01 pendulum, exact: see README.md
# written by make_reference.py
# solve: --error {error:g}
# tolerance: abs {place:g}
# tolerance POINT_MASS/2.v*: abs {speed:g}
# tolerance POINT_MASS/2.a*: abs {acceleration:g}
time,POINT_MASS/2.x,POINT_MASS/2.y,POINT_MASS/2.z,POINT_MASS/2.vx,POINT_MASS/2.vy\
,POINT_MASS/2.ax,POINT_MASS/2.ay"""


def swing(t):
    """Angle theta and its rate theta' (each shaped like t)."""
    w = np.sqrt(G / LENGTH)
    sn, cn, _, _ = ellipj(ellipk(0.5) - w * t, 0.5)
    return 2 * np.arcsin(np.sqrt(0.5) * sn), -2 * w * np.sqrt(0.5) * cn


def motion(t):
    """Place, velocity and acceleration of the mass in the plane: three of (2, nt)."""
    theta, rate = swing(t)
    s, c = np.sin(theta), np.cos(theta)
    turn = -G / LENGTH * s
    x = LENGTH * np.array([-s, -c])
    v = LENGTH * rate * np.array([-c, s])
    a = LENGTH * (turn * np.array([-c, s]) + rate**2 * np.array([s, c]))
    return x, v, a


def check(t, x, v):
    """The exact solution against a numerical one, and against the published values."""
    run = solve_ivp(
        lambda _, y: [y[1], -G / LENGTH * np.sin(y[0])],
        (0, t[-1]),
        [np.pi / 2, 0],
        method="DOP853",
        t_eval=t,
        rtol=1e-12,
        atol=1e-13,
    )
    theta, rate = run.y
    assert np.allclose(x, [-np.sin(theta), -np.cos(theta)], rtol=0, atol=1e-9)
    assert np.allclose(v, [-rate * np.cos(theta), rate * np.sin(theta)], rtol=0, atol=1e-8)
    assert np.allclose(x[:, t == 5].T, [-0.942305435044, -0.334754338414], rtol=0, atol=1e-11)
    assert np.allclose(x[:, -1], [-0.275087462576, -0.961419205099], rtol=0, atol=1e-11)


def write(path, **bands):
    t = np.linspace(0, 10, 101)
    x, v, a = motion(t)
    check(t, x, v)
    table = np.round(np.column_stack([t, *x, 0 * t, *v, *a]), 12) + 0.0
    header = HEADER.format(**bands)
    np.savetxt(path, table, fmt="%.12g", delimiter=",", header=header, comments="")


if __name__ == "__main__":
    here = Path(__file__).parent
    write(here / "reference.csv", error=1e-6, place=1e-4, speed=5e-4, acceleration=5e-3)
    write(here / "reference-tight.csv", error=1e-8, place=1e-5, speed=5e-5, acceleration=5e-4)
