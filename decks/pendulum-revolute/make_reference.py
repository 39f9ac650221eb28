"""Write the references of the rod pendulum from Jacobi's elliptic functions.

With Ip the inertia about the pin, d the way from the pin to the centre of mass, w^2 = m g d / Ip,
and theta counted from the lowest point towards -x, released from the horizontal:

    theta = 2 asin(sin(pi / 4) sn(K - w t, 1/2)),   theta' = -2 w sin(pi / 4) cn(K - w t, 1/2)

The rod turns by pi / 2 - theta, and the pin carries m (a - g) with a of the centre of mass.
"""

from pathlib import Path

import numpy as np
from scipy.integrate import solve_ivp
from scipy.special import ellipj, ellipk

G, MASS, ARM, INERTIA_CM = 9.81, 1.0, 0.75, 0.1875
RATE2 = MASS * G * ARM / (INERTIA_CM + MASS * ARM**2)
HEADER = """# A01 pendulum as a rod on a revolute joint, exact: see README.md
# written by make_reference.py
# solve: --error {error:g}
# tolerance: abs {place:g}
# tolerance PART/2.wz: abs {speed:g}
# tolerance JOINT/*: abs {force:g}
time,REQUEST/1.F2,REQUEST/1.F3,PART/2.x,PART/2.y,PART/2.z,PART/2.wz,VARIABLE/angle\
,JOINT/1.fx,JOINT/1.fy,JOINT/1.fz,JOINT/1.tz"""


def swing(t):
    """Angle theta and its rate theta' (each shaped like t)."""
    w = np.sqrt(RATE2)
    sn, cn, _, _ = ellipj(ellipk(0.5) - w * t, 0.5)
    return 2 * np.arcsin(np.sqrt(0.5) * sn), -2 * w * np.sqrt(0.5) * cn


def pin_force(theta, rate):
    """Force of the pin on the rod in ground axes (2, nt)."""
    s, c = np.sin(theta), np.cos(theta)
    turn = -RATE2 * s
    a = ARM * (turn * np.array([-c, s]) + rate**2 * np.array([s, c]))
    return MASS * (a + np.array([[0], [G]]))


def check(t, theta, rate, force):
    """The exact solution against a numerical one, published places and the work of the pin."""
    run = solve_ivp(
        lambda _, y: [y[1], -RATE2 * np.sin(y[0])],
        (0, t[-1]),
        [np.pi / 2, 0],
        method="DOP853",
        t_eval=t,
        rtol=1e-12,
        atol=1e-13,
    )
    assert np.allclose(run.y, [theta, rate], rtol=0, atol=1e-8)
    assert np.allclose([-np.sin(theta[-1]), -np.cos(theta[-1])], [-0.275087462576, -0.961419205099])
    # Moment of the pin force about the centre of mass: the pin lies at ARM (sin, cos) from it.
    moment = ARM * (np.sin(theta) * force[1] - np.cos(theta) * force[0])
    assert np.allclose(moment, INERTIA_CM * RATE2 * np.sin(theta), atol=1e-9)


def write(path, **bands):
    t = np.linspace(0, 10, 101)
    theta, rate = swing(t)
    force = pin_force(theta, rate)
    check(t, theta, rate, force)
    point = np.array([-np.sin(theta), -np.cos(theta)])
    zero = 0 * t
    angle = np.pi / 2 - theta
    columns = [t, *point, *(ARM * point), zero, -rate, angle, *force, zero, zero]
    header = HEADER.format(**bands)
    table = np.round(np.column_stack(columns), 12) + 0.0
    np.savetxt(path, table, fmt="%.12g", delimiter=",", header=header, comments="")


if __name__ == "__main__":
    here = Path(__file__).parent
    write(here / "reference.csv", error=1e-6, place=1e-4, speed=5e-4, force=5e-3)
    write(here / "reference-tight.csv", error=1e-8, place=1e-5, speed=5e-5, force=5e-4)
