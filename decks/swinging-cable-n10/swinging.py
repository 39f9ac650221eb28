"""The swinging elastic cable: its equations, a tight numerical solution, its deck.

N point masses rho l0, l0 = L / N, joined by springs k = EA / l0 with dampers beta k; the first
spring hangs on the ground at the origin. At t = 0 the cable lies along x, unstretched and at rest.
"""

from pathlib import Path

import numpy as np
from scipy.integrate import solve_ivp

LENGTH, RHO, EA, BETA, G, END = 10.0, 1.0, 1.0e5, 2.0e-5, 9.81, 1.0
HEADER = """# Swinging elastic cable of {n} masses, DOP853 at rtol 1e-12: see README.md
# written by make_reference.py
# tolerance: abs 1e-5
"""

TOP = """Swinging elastic cable of {n} masses, released from the horizontal
! Written by make_reference.py. 10 m, 1 kg/m, EA = 1E5 N, one end at the origin of the ground.

UNITS/SYSTEM=MKS
ACCGRAV/JGRAV=-9.81

PART/1, GROUND
MARKER/1, PART=1

"""

MASS = """POINT_MASS/{i}, MASS={mass:g}, CM={i}, QG={x:g},0,0
MARKER/{i}, POINT_MASS={i}
"""


def acceleration(x, v):
    """Accelerations (n, 2) of the masses at places x and speeds v (n, 2), y upwards."""
    free = LENGTH / len(x)
    k = EA / free
    d = np.diff(x, axis=0, prepend=0)
    length = np.hypot(*d.T)
    rate = np.einsum("ij,ij->i", d, np.diff(v, axis=0, prepend=0)) / length
    pull = (k * (length - free + BETA * rate) / length)[:, None] * d
    a = np.diff(pull, axis=0, append=0) / (RHO * free)
    a[:, 1] -= G
    return a


def solve(n, times, rtol, method="DOP853"):
    """Places (nt, n, 2) and speeds (nt, n, 2) of the masses at the given times."""

    def rhs(_, y):
        x, v = y.reshape(2, n, 2)
        return np.concatenate([v.ravel(), acceleration(x, v).ravel()])

    start = np.zeros((2, n, 2))
    start[0, :, 0] = LENGTH / n * np.arange(1, n + 1)
    run = solve_ivp(rhs, (0, END), start.ravel(), method, times, rtol=rtol, atol=rtol / 10)
    return np.moveaxis(run.y.T.reshape(-1, 2, n, 2), 1, 0)


def energy(x, v):
    """Kinetic, gravity and spring energy (nt,) [J]."""
    n = x.shape[1]
    free = LENGTH / n
    length = np.linalg.norm(np.diff(x, axis=1, prepend=0), axis=2)
    stored = RHO * free * ((v**2).sum((1, 2)) / 2 + G * x[:, :, 1].sum(1))
    return stored + EA / free / 2 * ((length - free) ** 2).sum(1)


def check(n, times, x, v):
    """The solution against another method and tolerance, and against the law of energy."""
    other, _ = solve(n, times, 1e-9, "LSODA")
    assert np.abs(other - x).max() < 1e-6
    e = energy(x, v)
    assert np.all(np.diff(e) < 0), "a damper only takes energy"
    assert e[0] - e[-1] < 1e-3, "and here it takes little"


def write_reference(folder, n):
    """Solve, check, and write <folder>/reference.csv with the places of all masses."""
    times = np.linspace(0, END, 11)
    x, v = solve(n, times, 1e-12)
    check(n, times, x, v)
    names = [f"POINT_MASS/{i}.{axis}" for i in range(2, n + 2) for axis in "xyz"]
    space = np.concatenate([x, 0 * x[:, :, :1]], axis=2)
    table = np.column_stack([times, space.reshape(len(times), -1)]) + 0.0
    header = HEADER.format(n=n) + ",".join(["time", *names])
    path = Path(folder, "reference.csv")
    np.savetxt(path, table, fmt="%.12g", delimiter=",", header=header, comments="")


def write_deck(folder, n, spring, ending=""):
    """Write <folder>/<folder>.adm; `spring` is the statement of one spring with its damper."""
    free = LENGTH / n
    text = TOP.format(n=n)
    for i in range(2, n + 2):
        text += MASS.format(i=i, mass=RHO * free, x=round(free * (i - 1), 12))
    text += "\n"
    words = {"stiffness": EA / free, "damping": BETA * EA / free, "free": free}
    text += "".join(spring.format(i=i, j=i - 1, **words) for i in range(2, n + 2))
    Path(folder, folder.name + ".adm").write_text(text + ending + "END\n")
