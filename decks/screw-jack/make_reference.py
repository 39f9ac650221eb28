"""Write the references of the screw jack from closed forms."""

import sys
from pathlib import Path

import numpy as np

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))

from minimal import write  # noqa: E402  (it lies beside the folders of the cases)

G, PITCH, SPINDLE, LOAD, SPINDLE_MASS, MOTOR = 9.81, 0.006, 0.002, 500.0, 5.0, -8.0
TORQUE = """
A constant torque lifts the load with a constant acceleration: see README.md
tolerance: abs 3e-6
tolerance VARIABLE/turns: abs 5e-4
tolerance PART/3.az: abs 1e-8
tolerance PART/2.alz: abs 1e-6
tolerance JOINT/*: abs 1e-6
"""
DRIVEN = """
Ten turns, ten pitches: see README.md
tolerance: abs 1e-8
tolerance VARIABLE/turns: abs 1e-6
tolerance PART/3.az: abs 1e-7
tolerance JOINT/*: abs 1e-4
tolerance MOTION/*: abs 1e-5
"""


def columns_of(turns, lift, a):
    """Columns common to both decks; a is the acceleration of the load."""
    axial = LOAD * (G + a)
    columns = {"VARIABLE/turns": turns, "VARIABLE/lift": lift, "PART/3.az": a}
    columns |= {"PART/2.alz": -a * 2 * np.pi / PITCH} if np.isscalar(a) else {}
    return columns | {"JOINT/3.fz": -axial, "JOINT/1.fz": axial + SPINDLE_MASS * G}


def main():
    gain = 2 * np.pi / PITCH
    a = (-MOTOR * gain - LOAD * G) / (LOAD + SPINDLE * gain**2)
    t = np.linspace(0, 1, 51)
    lift, speed = a * t**2 / 2, a * t
    kinetic = LOAD * speed**2 / 2 + SPINDLE * (gain * speed) ** 2 / 2
    assert np.allclose(kinetic, (-MOTOR * gain - LOAD * G) * lift)
    columns = columns_of(-lift / PITCH, lift, a)
    write(HERE / "screw-jack.reference.csv", TORQUE, list(columns), [t, *columns.values()])

    t = np.linspace(0, 2, 101)
    u = t / 2
    turns = 10 * u**3 * (10 - 15 * u + 6 * u**2)
    a = PITCH * 10 * (60 * u - 180 * u**2 + 120 * u**3) / 4
    assert np.isclose(turns[-1], 10) and np.allclose(
        np.gradient(np.gradient(PITCH * turns, t), t)[3:-3], a[3:-3], atol=1e-3
    )
    columns = columns_of(-turns, PITCH * turns, a)
    columns["MOTION/1.tz"] = -SPINDLE * gain * a - LOAD * (G + a) / gain
    write(HERE / "driven.reference.csv", DRIVEN, list(columns), [t, *columns.values()])


if __name__ == "__main__":
    main()
