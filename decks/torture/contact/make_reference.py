"""Write the references of a ball on an elastic floor: free flight, contacts by quadrature.

Falling from h it arrives with v0 = sqrt(2 g h). In contact, x the depth, energy gives

    x'^2 = v0^2 + 2 g x - 4/5 (k/m) x^(5/2)

and the time from touching to the deepest point is the integral of dx/x' from 0 to the root.
"""

import sys
from pathlib import Path

import numpy as np
from scipy.integrate import quad
from scipy.optimize import brentq

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parents[1]))

from minimal import write  # noqa: E402  (it lies beside the folders of the cases)

G, HEIGHT, STIFFNESS = 9.81, 0.1, 1e7
LINES = """
Free flight between elastic contacts: see README.md
tolerance POINT_MASS/2.y: abs 1e-5
tolerance VARIABLE/energy: abs 1e-5
"""


def contact():
    """Depth and duration of a contact."""
    arrival = 2 * G * HEIGHT
    square = lambda x: arrival + 2 * G * x - 0.8 * STIFFNESS * x**2.5  # noqa: E731
    depth = brentq(square, 1e-6, 1.0, xtol=1e-16)
    # x = depth (1 - z^2) takes the root out of the integrand.
    slope = lambda z: 2 * depth * z / np.sqrt(square(depth * (1 - z * z)))  # noqa: E731
    return depth, 2 * quad(slope, 0, 1, epsabs=1e-13, limit=200)[0]


def height(t, duration):
    """Height at the times (nt,), none of them in contact; periodic."""
    fall = np.sqrt(2 * HEIGHT / G)
    phase = np.mod(t + fall, 2 * fall + duration)
    flight = HEIGHT - G * (phase - fall) ** 2 / 2

    assert phase.max() < 2 * fall, "an output time in contact"
    return flight


def main():
    t = np.linspace(0, 2, 101)
    depth, duration = contact()
    y = height(t, duration)
    top = y[95:].max()
    runs = {
        "": "",
        "-abam": "solve: --integrator ABAM --error 1e-9",
        "-radau": "solve: --integrator RADAU",
    }
    for tag, flags in runs.items():
        lines = f"{LINES.strip()}\nmeasure: max POINT_MASS/2.y from 1.9 = {top:.12g} tol abs 1e-5"
        names = ["POINT_MASS/2.y", "VARIABLE/energy"]
        write(HERE / f"reference{tag}.csv", f"{lines}\n{flags}", names, [t, y, G * HEIGHT])
    assert np.isclose(depth, 2.28969e-3, rtol=1e-5)
    assert np.isclose(duration, 4.788034e-3, rtol=1e-6)


if __name__ == "__main__":
    main()
