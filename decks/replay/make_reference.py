"""Write the recorded torques of two driven pendulums, and their motions as references."""

import sys
from pathlib import Path

import numpy as np

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))

from minimal import solve, write  # noqa: E402  (it lies beside the folders of the cases)

HEAD = "A pendulum under a recorded torque: see README.md\ntolerance: abs {tolerance}"
CASES = (
    # name, inertia about the pivot, weight times arm, swing, frequency, sampling rate, tolerance
    ("pendulum", 2.0 + 3.0 * 0.4**2, 3.0 * 9.81 * 0.4, 0.9, 2.5, 100, 2e-6),
    ("pendulum-mm", 5.0 + 0.8 * 22.5, 0.8 * 9806.65 * 0.15, -0.5, 4.0, 150, 5e-6),
)


def driven(t, swing, w):
    """Angle, speed and acceleration: it starts at rest, with a torque that starts from zero."""
    angle = swing * np.sin(w * t) ** 3
    speed = 3 * swing * w * np.sin(w * t) ** 2 * np.cos(w * t)
    bend = 3 * swing * w**2 * (2 * np.sin(w * t) * np.cos(w * t) ** 2 - np.sin(w * t) ** 3)
    return angle, speed, bend


def main():
    for name, inertia, weight, swing, w, samples, tolerance in CASES:
        t = np.arange(int(4.1 * samples) + 1) / samples
        angle, _, bend = driven(t, swing, w)
        torque = inertia * bend + weight * np.sin(angle)
        with open(HERE / f"{name}.torque.csv", "w", encoding="utf-8") as stream:
            stream.write("# torque of the motor, written by make_reference.py\n")
            stream.write("time,angle,torque\n")
            np.savetxt(stream, np.column_stack([t, angle, torque]), fmt="%.15g", delimiter=",")
        t = np.linspace(0, 4, 101)
        angle, speed, _ = driven(t, swing, w)
        states = solve(
            lambda time, y, case=(inertia, weight, swing, w): rate(time, y, *case), [0.0, 0.0], t
        )
        assert np.allclose(states, np.column_stack([angle, speed]), atol=1e-9)
        columns = {"VARIABLE/angle": angle, "PART/2.wz": speed}
        head = HEAD.format(tolerance=tolerance)
        write(HERE / f"{name}.reference.csv", head, list(columns), [t, *columns.values()])


def rate(time, y, inertia, weight, swing, w):
    """Equation of motion of the pendulum under the torque that drives it."""
    angle, _, bend = driven(time, swing, w)
    torque = inertia * bend + weight * np.sin(angle)
    return np.array([y[1], (torque - weight * np.sin(y[0])) / inertia])


if __name__ == "__main__":
    main()
