"""Write the references of a mass that its past speed brakes from the closed form."""

import sys
from math import factorial
from pathlib import Path

import numpy as np

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))

from minimal import write  # noqa: E402  (it lies beside the folders of the cases)

HEAD = "A brake that acts late, closed form: see README.md\ntolerance: peak 1e-8"


def braked(t, v0, k, delay):
    """Place and speed of v' = -k v(t - delay)."""
    x, v = v0 * t, np.full(len(t), v0)
    for n in range(1, int(t[-1] / delay) + 3):
        later = np.maximum(t - (n - 1) * delay, 0.0)
        v = v + v0 * (-k) ** n * later**n / factorial(n)
        x = x + v0 * (-k) ** n * later ** (n + 1) / factorial(n + 1)
    assert np.allclose(np.gradient(x, t)[1:-1], v[1:-1], atol=2e-2 * np.abs(v).max())
    return x, v


def main():
    for name, end, steps, *numbers in (
        ("delayed-brake", 3.5, 70, 3.0, 3.0 / 2.0, 0.7),
        ("delayed-brake-mm", 0.5, 50, -400.0, 0.011 * 1000.0 / 5.0, 0.1),
    ):
        times = np.linspace(0.0, end, steps + 1)
        place, speed = braked(times, *numbers)
        names = ["POINT_MASS/2.x", "POINT_MASS/2.vx"]
        write(HERE / f"{name}.reference.csv", HEAD, names, [times, place, speed])


if __name__ == "__main__":
    main()
