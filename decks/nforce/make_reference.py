"""Write the reference of two bodies on a beam: modes of four freedoms, damped in proportion."""

from pathlib import Path

import numpy as np

STIFFNESS = 500.0 * np.array([[24, 0, -12, 6], [0, 8, -6, 2], [-12, -6, 12, -6], [6, 2, -6, 4.0]])
MASSES = np.array([3.0, 0.2, 2.0, 0.1])
START = np.array([0.01, 0.0, 0.04, 0.0])
LOAD = np.array([0.0, 0.0, 15.0, 0.0])
RATIO = 2e-3
HEAD = """# Two bodies on a condensed beam, by modes: see README.md
# written by make_reference.py
# tolerance: abs 2e-8
# tolerance VARIABLE/*slope: abs 1e-7
# tolerance VARIABLE/root: abs 5e-4
# tolerance VARIABLE/moment: abs 5e-4
time,VARIABLE/middle,VARIABLE/slope,VARIABLE/tip,VARIABLE/tip_slope,VARIABLE/root,VARIABLE/moment"""


def main():
    times = np.linspace(0, 1, 101)
    root = np.sqrt(MASSES)
    squares, modes = np.linalg.eigh(STIFFNESS / np.outer(root, root))
    rest = np.linalg.solve(STIFFNESS, LOAD)
    amplitudes = modes.T @ (root * (START - rest))
    decay = RATIO * squares / 2
    inner = np.sqrt((squares - decay**2).astype(complex))
    angle = np.outer(times, inner)
    fade = np.exp(-np.outer(times, decay))
    swing = (fade * (np.cos(angle) + decay / inner * np.sin(angle))).real
    rate = (-fade * squares / inner * np.sin(angle)).real
    x = rest + (swing * amplitudes) @ modes.T / root
    v = (rate * amplitudes) @ modes.T / root
    load = LOAD - (x + RATIO * v) @ STIFFNESS
    on_root = -load[:, 0] - load[:, 2]
    # The bodies move in y only: the moment about the root is that of forces at 1 m and 2 m.
    moment = -load[:, 1] - load[:, 3] - load[:, 0] - 2 * load[:, 2]
    table = np.column_stack([times, x, on_root, moment])
    path = Path(__file__).with_name("reference.csv")
    np.savetxt(path, table, fmt="%.12g", delimiter=",", header=HEAD, comments="")


if __name__ == "__main__":
    main()
