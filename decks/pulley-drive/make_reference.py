"""Write the reference of the pulley drive: an exponential run-up."""

import sys
from pathlib import Path

import numpy as np

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))

from minimal import solve, write  # noqa: E402  (it lies beside the folders of the cases)

G, STALL, IDLE = 9.81, 60.0, 40.0
R1, R2, I1, I2 = 0.1, 0.16, 0.02, 0.08
MOTOR, SHEAVE, RUN, LOAD = 4.0, 6.0, 0.5, 30.0
ALONG, UP = np.array([[0.6], [0.8]]), np.array([[0.0], [1.0]])
LINES = """
Run-up of a pulley drive, an exponential: see README.md
tolerance: abs 1e-6
tolerance PART/*.w*: abs 1e-4
tolerance JOINT/*: abs 1e-3
"""


def main():
    t = np.linspace(0, 1, 101)
    mass = LOAD + RUN + I1 / R1**2 + I2 / R2**2
    drag = STALL / IDLE / R1**2
    force = STALL / R1 - LOAD * G + 0.8 * RUN * G
    final, rate = force / drag, drag / mass
    speed = final * (1 - np.exp(-rate * t))
    way = final * (t - (1 - np.exp(-rate * t)) / rate)
    a = force / mass * np.exp(-rate * t)
    run = solve(lambda _, y: np.array([y[1], (force - drag * y[1]) / mass]), [0, 0], t)
    assert np.allclose(run.T, [way, speed], rtol=0, atol=1e-9)
    load = LOAD * (G + a)
    at_sheave = load + I2 * a / R2**2
    at_motor = at_sheave + RUN * (a - 0.8 * G)
    torque = STALL * (1 - speed / R1 / IDLE)
    assert np.allclose(torque - R1 * at_motor, I1 * a / R1)
    mount1 = -at_motor * ALONG + MOTOR * G * UP
    mount2 = at_sheave * ALONG + (load + SHEAVE * G) * UP
    columns = {
        "PART/40.y": -0.5 + way, "PART/40.vy": speed, "PART/10.wz": speed / R1,
        "PART/20.wz": speed / R2, "SFORCE/1.f": torque,
        "JOINT/1.fx": mount1[0], "JOINT/1.fy": mount1[1],
        "JOINT/2.fx": mount2[0], "JOINT/2.fy": mount2[1],
        "JOINT/3.fx": -0.8 * 0.6 * RUN * G, "JOINT/3.fy": 0.6 * 0.6 * RUN * G,
    }  # fmt: skip
    lines = LINES + "tolerance SFORCE/1.f: abs 1e-4"
    write(HERE / "reference.csv", lines, list(columns), [t, *columns.values()])


if __name__ == "__main__":
    main()
