"""Write the references of both decks (d'Alembert and printed sign) from Bessel functions.

The equation is ((m0 + sg mu t) x')' + k x = 0, sg = +1 or -1.
With S = 1 + sg mu t / m0, q = k m0 / mu^2 and z = 2 sqrt(q S):

    x = A J0(z) + B Y0(z),   dx/dz = -A J1(z) - B Y1(z),   dz/dt = sg mu / m0 sqrt(q / S)
"""

from pathlib import Path

import numpy as np
from scipy.integrate import solve_ivp
from scipy.special import jv, yv

M0, MU, K, X0 = 10.0, 10.0, 4000.0, 0.01
HEADER = """# m x" + m' x' + k x = 0, m = m0 {sign} mu t, Bessel functions: see README.md
# written by make_reference.py
# tolerance: {tolerance}
# tolerance PART/2.x: abs 1e-7
time,PART/2.x,PART/2.y,PART/2.vx"""


def closed_form(t, sg):
    """Position x and velocity x' (each shaped like t)."""
    q = K * M0 / MU**2

    def basis(time):
        s = 1 + sg * MU * time / M0
        z = 2 * np.sqrt(q * s)
        rate = sg * MU / M0 * np.sqrt(q / s)
        return np.array([[jv(0, z), yv(0, z)], [-jv(1, z) * rate, -yv(1, z) * rate]])

    ab = np.linalg.solve(basis(0.0), [X0, 0.0])
    return np.einsum("ijt,j->it", basis(t), ab)


def check(t, x, v, sg):
    """The closed form against a numerical solution in x and the momentum p = m x'."""

    def rhs(time, s):
        return [s[1] / (M0 + sg * MU * time), -K * s[0]]

    run = solve_ivp(rhs, (0, t[-1]), [X0, 0], method="DOP853", t_eval=t, rtol=1e-13, atol=1e-15)
    assert np.allclose(run.y, [x, (M0 + sg * MU * t) * v], rtol=1e-9, atol=1e-12)


def write(path, t, sg, tolerance):
    x, v = closed_form(t, sg)
    check(t, x, v, sg)
    np.savetxt(
        path,
        np.column_stack([t, x, 0 * t, v]) + 0.0,
        fmt="%.12g",
        delimiter=",",
        comments="",
        header=HEADER.format(sign="+" if sg > 0 else "-", tolerance=tolerance),
    )


if __name__ == "__main__":
    folder = Path(__file__).parent
    write(folder / "growing-mass-spring.reference.csv", np.linspace(0, 2.5, 101), 1, "abs 2e-6")
    write(
        folder / "growing-mass-spring-printed.reference.csv",
        np.linspace(0, 0.99, 100),
        -1,
        "abs 2e-6 rel 1e-5",
    )
