"""Write the reference of the rubbing joints: scalar equations, integrated by DOP853.

The reaction of the pendulum's pin depends on the acceleration that its friction changes, so each
evaluation there solves for the acceleration.
"""

from pathlib import Path

import numpy as np
from scipy.integrate import solve_ivp
from scipy.optimize import brentq

G, MASS, INERTIA = 9.81, 2.0, 0.01
MU_S, MU_D, EDGE = 0.3, 0.2, 0.1
PIN, BALL = 0.05, 0.04
PRELOAD = 0.3
ARM = 0.5
HEADER = """# Friction in five joints, DOP853 at rtol 1e-11: see README.md
# written by make_reference.py
# solve: --error 1e-8
# tolerance: abs 1e-5
# tolerance FRICTION/1.fx: abs 1e-3
time,PART/2.vx,PART/3.wz,PART/4.vz,PART/4.wz,PART/5.wy,PART/6.wz,VARIABLE/swing,FRICTION/1.fx"""


def mu(speed, rest=MU_S, moving=MU_D):
    """Coefficient at a slip >= 0."""
    u = speed / EDGE
    if u <= 1:
        return rest * u * (3 - u * u) / 2
    d = min((u - 1) / 0.5, 1)
    return rest + (moving - rest) * d * d * (3 - 2 * d)


def block(_, v):
    return [-np.sign(v[0]) * (mu(abs(v[0])) * G + mu(abs(v[0]), PRELOAD, PRELOAD) / MASS)]


def wheel(_, w):
    return [-np.sign(w[0]) * mu(abs(w[0]) * PIN) * MASS * G * PIN / INERTIA]


def screw(_, y):
    slip = np.array([y[0], y[1] * PIN])
    size = np.hypot(*slip)
    pull = mu(size) * MASS * G * slip / max(size, 1e-300)
    return [-pull[0] / MASS, -pull[1] * PIN / INERTIA]


def ball(_, w):
    # EFFECT = SLIDING
    return [-np.sign(w[0]) * mu(abs(w[0]) * BALL, MU_D, MU_D) * MASS * G * BALL / INERTIA]


def pendulum(_, y):
    angle, rate = y
    slip = np.sign(rate) * mu(abs(rate) * PIN)

    def surplus(turning):
        along = MASS * (ARM * rate**2 + G * np.cos(angle))
        across = MASS * (ARM * turning + G * np.sin(angle))
        torque = -MASS * G * ARM * np.sin(angle) - slip * PIN * np.hypot(along, across)
        return (INERTIA + MASS * ARM**2) * turning - torque

    return [rate, brentq(surplus, -1e3, 1e3, xtol=1e-13)]


def solve(f, start, times):
    """Values (n, nt)."""
    steps = {"rtol": 1e-11, "atol": 1e-12, "max_step": 5e-3}
    return solve_ivp(f, (0, times[-1]), start, "DOP853", times, **steps).y


times = np.linspace(0, 1.2, 61)
v, wheeling = solve(block, [1.5], times)[0], solve(wheel, [15.0], times)[0]
slide, turn = solve(screw, [0.4, 8.0], times)
spin = solve(ball, [-15.0], times)[0]
swing, rate = solve(pendulum, [2.0, 0.0], times)
pull = [MASS * block(0, [each])[0] for each in v]
table = np.column_stack([times, v, wheeling, slide, turn, spin, rate, swing, pull])
rows = [",".join(f"{value:.12g}" for value in row) for row in table]
Path(__file__).with_name("reference.csv").write_text("\n".join([HEADER, *rows]) + "\n")
