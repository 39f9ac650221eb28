"""Write the reference of a pendulum released at 179 degrees from Jacobi's elliptic functions.

Angle from the lowest point, k = sin(89.5 degrees), w^2 = g / L:

    theta = 2 asin(k sn(K - w t, k^2)),   period 4 K/w
"""

import sys
from pathlib import Path

import numpy as np
from scipy.special import ellipj, ellipkm1

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parents[1]))

from minimal import solve, write  # noqa: E402  (it lies beside the folders of the cases)

G, PERIOD = 9.81, 7.82579683754
LINES = """
Pendulum from 179 degrees, exact: see README.md
tolerance: abs {band:.3g}
tolerance PART/2.wz: abs {rate:.3g}
"""


def main():
    w, m = np.sqrt(G), np.sin(np.radians(89.5)) ** 2
    quarter = ellipkm1(np.cos(np.radians(89.5)) ** 2)
    assert np.isclose(4 * quarter / w, PERIOD, rtol=1e-11)
    t = np.linspace(0, PERIOD, 401)
    sn, cn, _, _ = ellipj(quarter - w * t, m)
    theta, rate = 2 * np.arcsin(np.sqrt(m) * sn), -2 * w * np.sqrt(m) * cn
    numeric = solve(lambda _, y: np.array([y[1], -G * np.sin(y[0])]), [np.radians(179), 0], t)
    assert np.allclose(numeric[:, 0], theta, rtol=0, atol=1e-6)
    late = 1e-5 * PERIOD
    lines = LINES.format(band=late * 2 * w, rate=late * G)
    write(HERE / "reference.csv", lines, ["VARIABLE/angle", "PART/2.wz"], [t, theta, rate])


if __name__ == "__main__":
    main()
