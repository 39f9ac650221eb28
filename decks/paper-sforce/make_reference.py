"""Write reference.csv of the paper's SFORCE: a bead on a section whose free length grows.

With the free length L = L0 + U t and the stretch e = x - L:  m e" + (EA / L) e = 0, since L" = 0.
With z = 2 sqrt(q L), q = EA / (m U^2):

    e = z (A J1(z) + B Y1(z)),   de/dL = 2 q (A J0(z) + B Y0(z))
"""

from pathlib import Path

import numpy as np
from scipy.integrate import solve_ivp
from scipy.special import jv, yv

M, EA, L0, U, STRETCH0 = 0.5, 50.0, 1.0, 0.5, 0.01
HEADER = """# The paper's SFORCE with a growing free length, Bessel functions: see README.md
# written by make_reference.py
# tolerance: abs 1e-7
# tolerance POINT_MASS/2.vx: abs 1e-6
# tolerance SFORCE/102.f: abs 5e-6
time,POINT_MASS/2.x,POINT_MASS/2.y,POINT_MASS/2.z,POINT_MASS/2.vx,SFORCE/102.f"""


def closed_form(t):
    """Stretch e and its rate e' (each shaped like t)."""
    q = EA / (M * U * U)

    def basis(length):
        z = 2 * np.sqrt(q * length)
        return np.array([[z * jv(1, z), z * yv(1, z)], [2 * q * jv(0, z), 2 * q * yv(0, z)]])

    ab = np.linalg.solve(basis(L0), [STRETCH0, 0.0])
    e, de_dlength = np.einsum("ijt,j->it", basis(L0 + U * t), ab)
    return e, U * de_dlength


def check(t, e, rate):
    """The closed form against a numerical solution written in x, not in e."""

    def rhs(time, s):
        length = L0 + U * time
        return [s[1], -EA / length * (s[0] - length) / M]

    run = solve_ivp(
        rhs, (0, t[-1]), [L0 + STRETCH0, U], method="DOP853", t_eval=t, rtol=1e-13, atol=1e-14
    )
    assert np.allclose(run.y, [L0 + U * t + e, U + rate], rtol=0, atol=1e-10)


def main():
    t = np.linspace(0, 4, 101)
    e, rate = closed_form(t)
    check(t, e, rate)
    length = L0 + U * t
    table = np.column_stack([t, length + e, 0 * t, 0 * t, U + rate, -EA / length * e])
    np.savetxt(
        Path(__file__).with_name("reference.csv"),
        table + 0.0,
        fmt="%.12g",
        delimiter=",",
        header=HEADER,
        comments="",
    )


if __name__ == "__main__":
    main()
