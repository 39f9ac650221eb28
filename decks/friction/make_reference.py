"""Write the reference of the rubbing joints: equations in one or two coordinates, by DOP853.

The reaction of the pendulum's pin depends on the acceleration that its friction changes, so each
evaluation there solves for the acceleration.
"""

import sys
from pathlib import Path

import numpy as np
from scipy.optimize import brentq

HERE = Path(__file__).parent
sys.path.insert(0, str(HERE))
from stick_slip import Law, coefficient, solve  # noqa: E402

G, MASS, INERTIA = 9.81, 2.0, 0.01
LAW, PIN, BALL, AXIAL = Law(0.3, 0.2), 0.05, 0.04, 0.03
PRELOAD, ARM, V0 = 0.3, 0.5, 1.5
HEADER = """# Friction in seven joints, DOP853 at rtol 1e-11: see README.md
# written by make_reference.py
# solve: --error 1e-8
# tolerance: abs 1e-5
# tolerance FRICTION/1.fz: abs 1e-3
# tolerance FRICTION/1.creep_z: abs 1e-7
# tolerance FRICTION/4.wy: abs 1e-6
"""


def wheel(radius, load, law=LAW):
    """A wheel of INERTIA on a pin: slip and rates."""
    return (
        lambda y: radius * y,
        lambda t, y, mu, _: -radius * mu * load / INERTIA,
    ), law


def turning(speed, radius, load, law=LAW, held=True):
    (slip, rates), law = wheel(radius, load, law)
    return solve(law, slip, rates, [speed], times, held)


def block(t, y, mu, direction):
    return -(mu * MASS * G + PRELOAD * direction) / MASS


def sleeve(t, y, mu, _):
    return -MASS * G * mu * [1 / MASS, PIN / INERTIA]


def pendulum(t, y, mu, _):
    angle, rate = y

    def surplus(turning):
        along = MASS * (ARM * rate**2 + G * np.cos(angle))
        across = MASS * (ARM * turning + G * np.sin(angle))
        torque = -MASS * G * ARM * np.sin(angle) - mu[0] * PIN * np.hypot(along, across)
        return (INERTIA + MASS * ARM**2) * turning - torque

    return [rate, brentq(surplus, -1e3, 1e3, xtol=1e-13)]


times = np.linspace(0, 1.2, 61)
(v,), (creep,) = solve(LAW, lambda y: y, block, [V0], times)
(wheeling,), _ = turning(15.0, PIN, MASS * G)
(slide, turn), _ = solve(LAW, lambda y: y * [1, PIN], sleeve, [0.4, 8.0], times)
(spin,), _ = turning(-15.0, BALL, MASS * G, Law(0.2, 0.2), held=False)
(swing, rate), _ = solve(LAW, lambda y: PIN * y[1:], pendulum, [2.0, 0.0], times)
(hooke,), _ = turning(12.0, PIN, MASS * G)
(cross,), _ = turning(-9.0, PIN, MASS * G * AXIAL / PIN)

# While the block slides it is slowed down by MU_DYNAMIC g and the preload, from V0 on.
sliding = v > 1.5 * LAW.vs
slowed = V0 - (LAW.moving * G + PRELOAD / MASS) * times
assert sliding.sum() > 20 and abs(v - slowed)[sliding].max() < 1e-10

pulls = zip(v, creep, strict=True)
laws = [coefficient(LAW, np.array([a]), np.array([d]), abs(a) < LAW.vs) for a, d in pulls]
names = {
    "PART/2.vx": v, "PART/3.wz": wheeling, "PART/4.vz": slide, "PART/4.wz": turn,
    "PART/5.wy": spin, "PART/6.wz": rate, "VARIABLE/swing": swing, "PART/7.wx": hooke,
    "PART/8.wy": cross, "FRICTION/1.fz": [-(mu[0] * MASS * G + PRELOAD * d[0]) for mu, d in laws],
    "FRICTION/1.creep_z": creep, "FRICTION/4.wy": BALL * spin,
}  # fmt: skip
table = np.column_stack([times, *names.values()])
rows = [",".join(f"{value:.12g}" for value in row) for row in table]
text = HEADER + ",".join(["time", *names]) + "\n" + "\n".join(rows) + "\n"
(HERE / "reference.csv").write_text(text)
