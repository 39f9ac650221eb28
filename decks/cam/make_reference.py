"""Write the reference of the cam: the lift of a flat follower on an eccentric circle."""

from pathlib import Path

import numpy as np

RADIUS, E, MASS, GRAVITY = 0.05, 0.02, 0.8, 9.80665
CAM_INERTIA = 2.0e-3
HEAD = """# An eccentric cam under a flat follower: see README.md
# written by make_reference.py
# tolerance: abs 2e-8
# tolerance VARIABLE/speed: abs 5e-7
# tolerance VARIABLE/force: abs 1e-3
# tolerance REQUEST/1.F3: abs 1e-3
# tolerance VARIABLE/across: abs 1e-6
# tolerance VARIABLE/drive: abs 2e-5
time,VARIABLE/lift,VARIABLE/speed,VARIABLE/force,REQUEST/1.F3,VARIABLE/across,VARIABLE/drive"""


def main():
    t = np.linspace(0, 3, 151)
    angle, rate, second = 2 * t**2 + 3 * t, 4 * t + 3, 4 + 0 * t
    lift = RADIUS + E * np.sin(angle)
    speed = E * rate * np.cos(angle)
    force = MASS * (GRAVITY + E * (second * np.cos(angle) - rate**2 * np.sin(angle)))
    # Power: what the drive does is what the follower and the cam take up.
    drive = CAM_INERTIA * second + force * E * np.cos(angle)
    table = np.column_stack([t, lift, speed, force, force, 0 * t, drive])
    path = Path(__file__).with_name("reference.csv")
    np.savetxt(path, table, fmt="%.12g", delimiter=",", header=HEAD, comments="")


if __name__ == "__main__":
    main()
