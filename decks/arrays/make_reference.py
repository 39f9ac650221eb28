"""Write the references of a damped oscillator under a constant load, closed form."""

import sys
from pathlib import Path

import numpy as np

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))

from minimal import write  # noqa: E402  (it lies beside the folders of the cases)

HEAD = "A damped oscillator under a constant load, closed form: see README.md\ntolerance: peak 3e-6"


def motion(t, mass, k, c, load, x0, v0):
    """Place and speed."""
    decay, rest = c / (2 * mass), load / k
    w = np.sqrt(k / mass - decay**2)
    a, b = x0 - rest, (v0 + decay * (x0 - rest)) / w
    swing = a * np.cos(w * t) + b * np.sin(w * t)
    rate = w * (b * np.cos(w * t) - a * np.sin(w * t))
    return rest + np.exp(-decay * t) * swing, np.exp(-decay * t) * (rate - decay * swing)


def main():
    for name, mass, k, c, load, x0, v0, end in (
        ("arrays", 2.0, 50.0, 3.0, 20.0, 0.1, -0.5, 2.0),
        ("arrays-mm", 0.7e-3, 0.4, 0.004, -8.0, -30.0, 400.0, 1.5),
    ):
        t = np.linspace(0, end, 101)
        x, v = motion(t, mass, k, c, load, x0, v0)
        assert np.allclose(np.gradient(x, t)[2:-2], v[2:-2], atol=0.02 * np.abs(v).max())
        columns = {"POINT_MASS/2.x": x, "POINT_MASS/2.vx": v}
        columns |= {"VARIABLE/spring": -k * x, "VARIABLE/damper": -c * v}
        write(HERE / f"{name}.reference.csv", HEAD, list(columns), [t, *columns.values()])


if __name__ == "__main__":
    main()
