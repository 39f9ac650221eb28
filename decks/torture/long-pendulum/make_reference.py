"""Write the reference of a pendulum over a hundred seconds from Jacobi's elliptic functions.

Released from the horizontal, theta counted from the lowest point towards -x, w^2 = g / L:

    theta = 2 asin(sqrt(1/2) sn(K - w t, 1/2)),   tension 3 m g cos(theta)
"""

import sys
from pathlib import Path

import numpy as np
from scipy.special import ellipj, ellipk

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parents[1]))

from minimal import write  # noqa: E402  (it lies beside the folders of the cases)

G, PERIOD = 9.81, 2.3678419476
LINES = """
Pendulum over 42 periods, exact: see README.md
tolerance: abs 1e-3
tolerance VARIABLE/tension: abs 2e-2
measure: range VARIABLE/stretch = 0 tol abs 1e-8
measure: range VARIABLE/stretch to 10 = 0 tol abs 1e-9
measure: range VARIABLE/stretch from 90 = 0 tol abs 1e-9
measure: min VARIABLE/tension = -29.43 tol rel 1e-5
"""


def main():
    w = np.sqrt(G)
    assert np.isclose(4 * ellipk(0.5) / w, PERIOD, rtol=1e-10)
    t = np.linspace(0, 100, 501)
    sn = ellipj(ellipk(0.5) - w * t, 0.5)[0]
    theta = 2 * np.arcsin(np.sqrt(0.5) * sn)
    x, y = -np.sin(theta), -np.cos(theta)
    assert np.allclose([x[50], y[50]], [-0.275087462576, -0.961419205099], rtol=0, atol=1e-11)
    names = ["POINT_MASS/2.x", "POINT_MASS/2.y", "VARIABLE/tension"]
    write(HERE / "reference.csv", LINES, names, [t, x, y, 3 * G * y])


if __name__ == "__main__":
    main()
