"""Write the references of the conical pendulum from its closed form.

The rod turns rigidly about the vertical with W, where It, Ia are its inertias across and along
its axis about the joint, d the way to its centre of mass and b the half angle of the cone:

    W^2 = m g d / ((It - Ia) cos b)
"""

from pathlib import Path

import numpy as np

G, MASS, ARM, ACROSS_CM, ALONG, CONE = 9.81, 1.0, 0.75, 0.1875, 0.01, np.pi / 6
HEADER = """# Conical pendulum, exact: see README.md
# written by make_reference.py
# solve: --error {error:g}
# tolerance: abs {place:g}
# tolerance PART/2.v*: abs {speed:g}
# tolerance PART/2.w*: abs {speed:g}
# tolerance JOINT/*: abs {force:g}
time,PART/2.x,PART/2.y,PART/2.z,PART/2.vx,PART/2.vy,PART/2.wx,PART/2.wy,PART/2.wz\
,VARIABLE/turn,VARIABLE/cone,JOINT/1.fx,JOINT/1.fy,JOINT/1.fz"""


def turn_rate():
    """Rate W about the vertical [rad/s]."""
    across = ACROSS_CM + MASS * ARM**2
    return np.sqrt(MASS * G * ARM / ((across - ALONG) * np.cos(CONE)))


def check(rate):
    """Euler's equation about the joint: the angular momentum turns with the rod."""
    axis = np.array([np.sin(CONE), 0, -np.cos(CONE)])
    across = ACROSS_CM + MASS * ARM**2
    inertia = across * np.eye(3) + (ALONG - across) * np.outer(axis, axis)
    spin = np.array([0, 0, rate])
    change = np.cross(spin, inertia @ spin)
    torque = np.cross(ARM * axis, [0, 0, -MASS * G])
    assert np.allclose(change, torque, rtol=1e-13, atol=1e-13)
    deck = Path(__file__).with_name("conical-pendulum.adm").read_text()
    assert f"WZ={rate:.11f}" in deck and f"VY={rate * ARM * np.sin(CONE):.11f}" in deck


def write(path, **bands):
    rate = turn_rate()
    check(rate)
    t = np.linspace(0, 10, 101)
    c, s = np.cos(rate * t), np.sin(rate * t)
    zero = 0 * t
    radius, depth = ARM * np.sin(CONE), ARM * np.cos(CONE)
    place = [radius * c, radius * s, zero - depth]
    speed = [-radius * rate * s, radius * rate * c, zero, zero, zero + rate]
    pull = -MASS * rate**2 * radius
    columns = [t, *place, *speed, rate * t, zero + CONE, pull * c, pull * s, zero + MASS * G]
    table = np.round(np.column_stack(columns), 12) + 0.0
    header = HEADER.format(**bands)
    np.savetxt(path, table, fmt="%.12g", delimiter=",", header=header, comments="")


if __name__ == "__main__":
    here = Path(__file__).parent
    write(here / "reference.csv", error=1e-6, place=1e-4, speed=5e-4, force=5e-3)
    write(here / "reference-tight.csv", error=1e-8, place=1e-5, speed=5e-5, force=5e-4)
