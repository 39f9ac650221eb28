"""Write the references of a top in a cup with friction: Euler's equations about the cup, DOP853.

Unknowns: a quaternion and the angular velocity along the axes of the body, which are those of I.
The reaction contains the angular acceleration, which contains the friction: each evaluation solves
for the acceleration by Newton's method.
"""

import sys
from pathlib import Path

import numpy as np
from scipy.spatial.transform import Rotation

HERE = Path(__file__).parent
sys.path.insert(0, str(HERE.parent / "friction"))
from stick_slip import Law, coefficient, solve  # noqa: E402

MASS, GRAVITY, ARM = 2.0, np.array([0, 0, -9.81]), np.array([0, 0, 0.3])
INERTIA = np.diag([0.05, 0.06, 0.02]) + MASS * (ARM @ ARM * np.eye(3) - np.outer(ARM, ARM))
LEVER = np.cross(np.eye(3), ARM).T  # LEVER @ x = x cross ARM
CUP = Rotation.from_euler("ZXZ", [0.3, 0.5, -0.4])
UPRIGHT = Rotation.from_euler("ZXZ", [0.4, 1.0, 0.2])
# Law, radius, preload, angular velocity at the start along the axes of the body.
CASES = {
    "top": (Law(0.5, 0.3), 0.1, 0.0, [2.0, -1.0, 3.0]),
    "top-stops": (Law(0.9, 0.5, 0.05, 0.002), 0.15, 0.1, [-0.5, 0.3, 1.0]),
}
HEADER = """# A top in a cup with friction, DOP853 at rtol 1e-11: see README.md
# written by make_reference.py
# solve: --error 1e-8
# tolerance: abs 1e-5
# tolerance FRICTION/1.creep_a*: abs 1e-8
# tolerance FRICTION/1.t*: abs 1e-4
# tolerance FRICTION/1.mur*: abs 1e-5
"""


def pushed(q, w, alpha):
    """Reaction of the cup, along the axes of the body."""
    weight = Rotation.from_quat(q).inv().apply(GRAVITY)
    return MASS * (np.cross(alpha, ARM) + np.cross(w, np.cross(w, ARM)) - weight)


def acceleration(q, w, ball, mu, own):
    """I alpha = ARM x m g - w x I w - ball mu |F(alpha)| - own."""
    weight = Rotation.from_quat(q).inv().apply(GRAVITY)
    known = np.cross(ARM, MASS * weight) - np.cross(w, INERTIA @ w) - own
    alpha = np.linalg.solve(INERTIA, known)
    for _ in range(50):
        force = pushed(q, w, alpha)
        load = np.linalg.norm(force)
        slope = INERTIA + ball * np.outer(mu, force / load @ (MASS * LEVER))
        change = np.linalg.solve(slope, known - ball * mu * load - INERTIA @ alpha)
        alpha = alpha + change
        if abs(change).max() < 1e-13:
            break
    return alpha


def turned(q, w):
    x, y, z, s = q
    along = [s * w[0] + y * w[2] - z * w[1], s * w[1] + z * w[0] - x * w[2]]
    return 0.5 * np.array([*along, s * w[2] + x * w[1] - y * w[0], -(q[:3] @ w)])


def motion(law, ball, own, spin):
    def rates(t, y, mu, direction):
        q, w = y[:4] / np.linalg.norm(y[:4]), y[4:]
        return [*turned(q, w), *acceleration(q, w, ball, mu, own * direction)]

    start = [*UPRIGHT.as_quat(), *spin]
    return solve(law, lambda y: ball * y[4:], rates, start, times, longest=5e-3)


def write(name, law, ball, own, spin):
    y, creep = motion(law, ball, own, spin)
    table = []
    for k in range(len(times)):
        q, w = y[:4, k] / np.linalg.norm(y[:4, k]), y[4:, k]
        body, slip = Rotation.from_quat(q), ball * y[4:, k]
        mu, direction = coefficient(law, slip, creep[:, k], np.linalg.norm(slip) < law.vs)
        load = np.linalg.norm(pushed(q, w, acceleration(q, w, ball, mu, own * direction)))
        torque = CUP.inv().apply(body.apply(-ball * mu * load - own * direction))
        row = [times[k], *body.apply(ARM), *body.apply(w), *creep[:, k], *torque, *-mu]
        table.append(",".join(f"{value:.12g}" for value in row))
    axes = "xyz"
    names = [f"PART/2.{stem}{a}" for stem in ("", "w") for a in axes]
    names += [f"FRICTION/1.{stem}{a}" for stem in ("creep_a", "t", "mur") for a in axes]
    text = HEADER + ",".join(["time", *names]) + "\n" + "\n".join(table) + "\n"
    (HERE / f"{name}.reference.csv").write_text(text)


times = np.linspace(0, 2, 41)
for name, case in CASES.items():
    write(name, *case)
