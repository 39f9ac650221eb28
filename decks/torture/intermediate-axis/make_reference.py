"""Write the reference of the flip about the intermediate axis: Jacobi's elliptic functions."""

import sys
from pathlib import Path

import numpy as np
from scipy.integrate import solve_ivp
from scipy.special import ellipj, ellipk, ellipkinc

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parents[1]))

from minimal import write  # noqa: E402  (it lies beside the folders of the cases)

I1, I2, I3 = INERTIA = np.array([1.0, 2.0, 3.0])
START = np.array([0.01, 5.0, 0.01])
LINES = """
Euler's equations solved by Jacobi's elliptic functions: see README.md
tolerance: abs {band}
tolerance VARIABLE/twice_energy: abs {law}
tolerance VARIABLE/momentum_squared: abs {law}
interpolate: cubic
"""


def elliptic(t):
    """Angular velocities (3, nt) and the period, for L^2 > 2 E I2 (L about axis 3)."""
    twice, square = INERTIA @ START**2, INERTIA**2 @ START**2
    assert square > twice * I2
    high, low = square - twice * I1, twice * I3 - square
    top = np.sqrt([low / (I1 * (I3 - I1)), low / (I2 * (I3 - I2)), high / (I3 * (I3 - I1))])
    m = (I2 - I1) * low / ((I3 - I2) * high)
    pace = np.sqrt((I3 - I2) * high / (I1 * I2 * I3))
    phase = ellipkinc(np.arctan2(START[1] / top[1], START[0] / top[0]), m)
    sn, cn, dn, _ = ellipj(pace * t + phase, m)
    return np.array([top[0] * cn, top[1] * sn, top[2] * dn]), 4 * ellipk(m) / pace


def rhs(_, w):
    return np.cross(INERTIA * w, w) / INERTIA


def main():
    t = np.linspace(0, 20, 401)
    w, period = elliptic(t)
    numbers = solve_ivp(rhs, (0, 20), START, "DOP853", t, rtol=1e-13, atol=1e-14).y
    assert np.abs(w - numbers).max() < 1e-8
    assert abs(period - 10.0518583) < 1e-7
    names = ["VARIABLE/w1", "VARIABLE/w2", "VARIABLE/w3"]
    twice, square = INERTIA @ START**2, INERTIA**2 @ START**2
    names += ["VARIABLE/twice_energy", "VARIABLE/momentum_squared"]
    half = f"measure: value VARIABLE/w2 at {period / 2:.9f} = -5 tol abs 1e-6"
    cases = [
        ("reference", "", "1e-2", "1e-6"),
        ("reference-abam", "solve: --integrator ABAM\n", "1e-3", "1e-7"),
    ]
    for name, flags, band, law in cases:
        lines = f"{LINES.strip().format(band=band, law=law)}\n{flags}{half}"
        write(HERE / f"{name}.csv", lines, names, [t, *w, twice, square])


if __name__ == "__main__":
    main()
