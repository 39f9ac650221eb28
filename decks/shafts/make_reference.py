"""Write the references of shafts at an angle from closed forms."""

import sys
from pathlib import Path

import numpy as np

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))

from minimal import write  # noqa: E402  (it lies beside the folders of the cases)

BEND, RATE, INPUT, OUTPUT = np.pi / 6, 5.0, 0.01, 0.05
LINES = """
{what}: see README.md
tolerance: abs 1e-7
tolerance VARIABLE/speed: abs 1e-6
tolerance MOTION/*: abs 1e-4
"""


def cross(t):
    """Input and output angle, output speed and acceleration of a Hooke joint."""
    a = RATE * t
    below = 1 - (np.sin(BEND) * np.cos(a)) ** 2
    b = a + np.arctan2(np.sin(a) * np.cos(a) * (1 - np.cos(BEND)),
                       np.cos(BEND) * np.cos(a) ** 2 + np.sin(a) ** 2)  # fmt: skip
    speed = RATE * np.cos(BEND) / below
    rise = -(RATE**2) * np.cos(BEND) * np.sin(BEND) ** 2 * np.sin(2 * a) / below**2
    arms = cross_arms(a, b)
    assert np.allclose(arms, 0, atol=1e-14)
    assert np.allclose(np.gradient(b, t)[1:-1], speed[1:-1], atol=2e-3)
    assert np.allclose(np.gradient(speed, t)[1:-1], rise[1:-1], atol=5e-2)
    return a, b, speed, rise


def cross_arms(a, b):
    """Cosine of the angle between the arms, which has to vanish."""
    y_input = np.array([-np.sin(a), np.cos(a), 0 * a])
    x_output = np.array([np.cos(b), np.cos(BEND) * np.sin(b), -np.sin(BEND) * np.sin(b)])
    return (y_input * x_output).sum(0)


def main():
    t = np.linspace(0, 2, 201)
    a, b, speed, rise = cross(t)
    columns = {
        "VARIABLE/input": a, "VARIABLE/output": b, "VARIABLE/speed": speed,
        "MOTION/1.tz": OUTPUT * rise * speed / RATE,
    }  # fmt: skip
    for name in ("hooke", "universal"):
        lines = LINES.format(what="Joint with a cross between shafts at 30 degrees")
        write(HERE / f"{name}.reference.csv", lines, list(columns), [t, *columns.values()])
    columns = {
        "VARIABLE/input": RATE * t**2, "VARIABLE/output": RATE * t**2,
        "VARIABLE/speed": 2 * RATE * t, "MOTION/1.tz": (INPUT + OUTPUT) * 2 * RATE,
    }  # fmt: skip
    lines = LINES.format(what="Constant-velocity joint between shafts at 30 degrees")
    write(HERE / "convel.reference.csv", lines, list(columns), [t, *columns.values()])


if __name__ == "__main__":
    main()
