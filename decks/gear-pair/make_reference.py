"""Write the references of the gears from closed forms."""

import sys
from pathlib import Path

import numpy as np

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))

from minimal import solve, write  # noqa: E402  (it lies beside the folders of the cases)

R1, R2, I1, I2, MOTOR, BRAKE = 0.1, 0.25, 0.01, 0.2, 5.0, 1.5
ARM_MASS, ARM_INERTIA, PLANET = 2.0, 0.02, 5.0
PAIR = """
Run-up of a geared pair, an exponential: see README.md
tolerance: abs 1e-5
tolerance PART/*.alz: abs 1e-4
"""
PLANETARY = """
Planet gear, constant acceleration: see README.md
tolerance: abs 1e-6
tolerance PART/*.alz: abs 1e-8
tolerance MOTION/*: abs 1e-8
"""


def pair(t):
    ratio = -R1 / R2
    inertia, brake = I1 + ratio**2 * I2, ratio**2 * BRAKE
    decay = np.exp(-brake / inertia * t)
    speed, rise = MOTOR / brake * (1 - decay), MOTOR / inertia * decay
    run = solve(lambda _, y: (MOTOR - brake * y) / inertia, [0], t)
    assert np.allclose(run[:, 0], speed, rtol=0, atol=1e-9)
    tooth = (MOTOR - I1 * rise) / R1
    assert np.allclose(-R2 * tooth - BRAKE * ratio * speed, I2 * ratio * rise)
    columns = {
        "PART/10.wz": speed, "PART/20.wz": ratio * speed,
        "PART/10.alz": rise, "PART/20.alz": ratio * rise, "GEAR/1.tz": I1 * rise - MOTOR,
    }  # fmt: skip
    write(HERE / "gear-pair.reference.csv", PAIR, list(columns), [t, *columns.values()])


def planetary(t):
    way = R1 + R2
    turns = 1 + R1 / R2
    arm = ARM_INERTIA + ARM_MASS * (way / 2) ** 2 + PLANET * way**2
    a = MOTOR / (arm + I2 * turns**2)
    tooth = I2 * turns * a / R2
    # Moment about the axle: motor, and the tooth of the sun, which is held.
    momentum = (arm + I2 * turns) * a
    assert np.isclose(MOTOR + R1 * -tooth, momentum)
    columns = {
        "PART/5.wz": a * t, "PART/20.wz": turns * a * t,
        "PART/5.alz": a, "PART/20.alz": turns * a, "MOTION/1.tz": -R1 * tooth,
    }  # fmt: skip
    write(HERE / "planetary.reference.csv", PLANETARY, list(columns), [t, *columns.values()])


if __name__ == "__main__":
    pair(np.linspace(0, 1, 101))
    planetary(np.linspace(0, 1, 51))
