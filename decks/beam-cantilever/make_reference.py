"""Write the references of the cantilevers: modes of one beam, deflection of several."""

from pathlib import Path

import numpy as np

E, G, A, L, ASY, ASZ, C = 2.0e7, 8.0e6, 4.0e-3, 0.8, 1.2, 1.1, 1.0e-3
IXX, IYY, IZZ = 1.1e-6, 0.8e-6, 1.5e-6
MASS, INERTIA = 0.5, 0.004
TIP = 20.0
HERE = Path(__file__)
VIBRATION = """# One beam and a rigid body, by modes: see README.md
# written by make_reference.py
# solve: --error 1e-8
# tolerance VARIABLE/tip_*: abs 2e-6
# tolerance VARIABLE/slope_*: abs 1e-5
# tolerance VARIABLE/root_*: abs 5e-3
time,VARIABLE/tip_y,VARIABLE/slope_y,VARIABLE/root_y,VARIABLE/tip_z,VARIABLE/slope_z,VARIABLE/root_z,\
VARIABLE/tip_x,VARIABLE/slope_x"""
DEFLECTION = """# Tip of the loaded cantilever, by beam theory: see README.md
# written by make_reference.py"""


def bending(inertia, ratio, sign):
    """Stiffness (2, 2) at the tip: deflection and slope, `sign` that of their coupling."""
    shear = 12 * E * inertia * ratio / (G * A * L**2)
    soft = E * inertia / (1 + shear)
    off = sign * 6 * soft / L**2
    return np.array([[12 * soft / L**3, off], [off, (4 + shear) * soft / L]])


def response(times, stiffness, masses, load):
    """Displacement and force (nt, n) from rest, damping C times the stiffness: mode by mode."""
    root = np.sqrt(masses)
    squares, modes = np.linalg.eigh(stiffness / np.outer(root, root))
    decay = C * squares / 2
    w = np.sqrt(squares - decay**2)
    swing = np.exp(-np.outer(times, decay))
    value = 1 - swing * (np.cos(np.outer(times, w)) + decay / w * np.sin(np.outer(times, w)))
    rate = swing * squares / w * np.sin(np.outer(times, w))
    to_modes = modes.T @ (load / root) / squares
    x, v = ((part * to_modes) @ modes.T / root for part in (value, rate))
    return x, -(x + C * v) @ stiffness


def vibration():
    """Three bodies, each on a beam: bending in xy, in xz, stretch and twist."""
    times = np.linspace(0, 1, 101)
    masses = np.array([MASS, INERTIA])
    y, on_y = response(times, bending(IZZ, ASY, -1), masses, [TIP, 0])
    z, on_z = response(times, bending(IYY, ASZ, 1), masses, [TIP, 0])
    straight = np.diag([E * A / L, G * IXX / L])
    x, _ = response(times, straight, masses, [TIP, 1.5])
    # Moment on J: that on I and that of the force, about y it is z_tip Fx - x_tip Fz, here -L Fz.
    root_y = -on_y[:, 1] - L * on_y[:, 0]
    root_z = -on_z[:, 1] + L * on_z[:, 0]
    columns = [times, y[:, 0], y[:, 1], root_y, z[:, 0], z[:, 1], root_z, x[:, 0], x[:, 1]]
    rows = [",".join(f"{value:.12g}" for value in row) for row in np.column_stack(columns)]
    HERE.with_name("vibration.reference.csv").write_text("\n".join([VIBRATION, *rows]) + "\n")


def deflection(force=(1.0e-3, -2.0e-3), length=1.0):
    """Tip of a chain of beams under a force along y and one along z."""
    tips = {}
    for name, load, inertia, ratio, sign in (
        ("y", force[0], IZZ, ASY, 1),
        ("z", force[1], IYY, ASZ, -1),
    ):
        bent = load * length**3 / (3 * E * inertia)
        tips[f"tip_{name}"] = bent + load * length * ratio / (G * A)
        tips[f"slope_{name}"] = sign * load * length**2 / (2 * E * inertia)
    lines = [f"# measure: last VARIABLE/{n} = {v:.12g} tol rel 1e-5" for n, v in tips.items()]
    HERE.with_name("deflection.reference.csv").write_text("\n".join([DEFLECTION, *lines]) + "\n")


vibration()
deflection()
