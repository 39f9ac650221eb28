"""Write deck and references of the folded falling chain: 51 rods of equal length, hinged.

Rod k hangs at the angle a_k from the downward vertical; m is its mass, l its length, n the number
of rods below it:

    sum_k m_jk l^2 (cos(a_j - a_k) a_k" + sin(a_j - a_k) a_k'^2) = -(n_j + 1/2) m g l sin(a_j)
    m_jj = (n_j + 1/3) m,     m_jk = (min(n_j, n_k) + 1/2) m
"""

import sys
from pathlib import Path

import numpy as np
from scipy.integrate import cumulative_trapezoid, solve_ivp

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parents[1]))

from minimal import write  # noqa: E402  (it lies beside the folders of the cases)

ARM = 25  # rods down, one across, as many up
N, G, LENGTH, TOTAL = 2 * ARM + 1, 9.81, 1.0, 1.0
ROD, MASS = LENGTH / N, TOTAL / N
BELOW = np.arange(N)[::-1]
SHARED = MASS * (np.minimum.outer(BELOW, BELOW) + 0.5 - np.eye(N) / 6)
START = np.concatenate([np.zeros(ARM), [np.pi / 2], np.full(ARM, np.pi)])
END, STEPS = 0.38, 190
HEAD = """Folded chain: both ends at the same height, one is let go
! Written by make_reference.py. {n} rods, 1 m and 1 kg in all; rods 1 to {arm} hang, the next lies
! across, the others stand beside the first ones.

UNITS/SYSTEM=MKS
ACCGRAV/JGRAV=-9.81

PART/1, GROUND
MARKER/1, PART=1
"""
LINK = """
PART/{k}, MASS={mass:.16g}, CM={k}00, IP=0,{inertia:.16g},{inertia:.16g}
, QG={x:.16g},{y:.16g},0, REULER={turn:g}D,0,0
MARKER/{k}00, PART={k}, QP={half:.16g},0,0
MARKER/{k}01, PART={k}
MARKER/{k}02, PART={k}, QP={rod:.16g},0,0
JOINT/{k}, REVOLUTE, I={k}01, J={above}
"""
TAIL = """
! How far the free end has fallen, and how fast it is.
VARIABLE/fallen, FUNCTION=-DY({last}02)
VARIABLE/speed, FUNCTION=-VY({last}02)

INTEGRATOR/HHT, ERROR=1.0E-6
SIMULATE/DYNAMIC, END={end}, STEPS={steps}
END
"""
CLOSED = """
Chain of infinitely many links, from its energy: see README.md
tolerance: rel 2.4e-2
interpolate: cubic
"""
TIGHT = """
Chain of 51 rods, DOP853 at rtol 1e-10: see README.md
tolerance VARIABLE/fallen: abs 5e-5
tolerance VARIABLE/speed: peak 2e-3
tolerance JOINT/2.fy: peak 2e-2
"""


def deck():
    place, parts = np.zeros(2), [HEAD.format(n=N, arm=ARM)]
    for i, angle in enumerate(START):
        parts.append(
            LINK.format(
                k=i + 2, above=f"{i + 1}02" if i else 1, mass=MASS, inertia=MASS * ROD**2 / 12,
                x=place[0] + 0.0, y=place[1] + 0.0, turn=np.degrees(angle) - 90,
                half=ROD / 2, rod=ROD,
            )
        )  # fmt: skip
        place += ROD * np.round([np.sin(angle), -np.cos(angle)], 12)
    return "".join([*parts, TAIL.format(last=N + 1, end=END, steps=STEPS)])


def rates(_, y):
    a, w = y[:N], y[N:]
    matrix = SHARED * np.cos(a[:, None] - a) * ROD
    load = -(BELOW + 0.5) * MASS * G * np.sin(a) - (SHARED * np.sin(a[:, None] - a)) @ w**2 * ROD
    return np.concatenate([w, np.linalg.solve(matrix, load)])


def rods(t, rtol):
    """Fall and speed of the free end, vertical force on the support, energy: (4, nt)."""
    start = np.concatenate([START, np.zeros(N)])
    run = solve_ivp(rates, (0, t[-1]), start, "DOP853", t, rtol=rtol, atol=rtol)
    a, w = run.y[:N].T, run.y[N:].T
    down = ROD * np.cos(a)
    height = ((BELOW + 0.5) * MASS * down).sum(1)
    turn = np.array([rates(0, y)[N:] for y in run.y.T])
    falling = -ROD * (np.sin(a) * turn + np.cos(a) * w**2)
    pull = TOTAL * G - ((BELOW + 0.5) * MASS * falling).sum(1)
    cosines = np.cos(a[:, :, None] - a[:, None, :])
    kinetic = ROD**2 / 2 * np.einsum("jk,tjk,tj,tk->t", SHARED, cosines, w, w)
    return np.array([down.sum(1), -(ROD * np.sin(a) * w).sum(1), pull, kinetic - G * height])


def ideal():
    """Times and falls of the ideal chain to 0.9 L, x = z^2 L: the start has no singularity."""
    z = np.linspace(0, np.sqrt(0.9), 200001)
    slope = 2 * np.sqrt(LENGTH * (1 - z**2) / (G * (2 - z**2)))
    t = cumulative_trapezoid(slope, z, initial=0)
    return t, LENGTH * z**2


def main():
    (HERE / "falling-chain.adm").write_text(deck())
    t, x = ideal()
    path = np.linspace(0.05, 0.9, 18) * LENGTH
    when = np.interp(path, x, t)
    speed = np.sqrt(G * path * (2 * LENGTH - path) / (LENGTH - path))
    assert np.isclose(speed[-1] ** 2, 97.119)
    lines = CLOSED + f"measure: value VARIABLE/fallen at {when[-1]:.9f} = 0.9 tol rel 2.4e-2"
    write(HERE / "reference.csv", lines, ["VARIABLE/fallen"], [when, path])
    early = path < 0.75
    columns = ["VARIABLE/fallen", "VARIABLE/speed"]
    write(HERE / "reference-speed.csv", CLOSED, columns, [when[early], path[early], speed[early]])
    t = np.linspace(0, END, STEPS + 1)
    tight, loose = rods(t, 1e-10), rods(t, 1e-8)
    assert np.abs(tight - loose)[0].max() < 1e-7
    assert np.abs(tight - loose)[1].max() < 1e-4
    assert np.ptp(tight[3]) < 1e-8
    names = ["VARIABLE/fallen", "VARIABLE/speed", "JOINT/2.fy"]
    of_links = rods(np.array([0.0, *when]), 1e-10)
    assert np.abs(of_links[0, 1:] / path - 1).max() < 0.8 * 0.024
    assert np.abs(of_links[1, 1:] / speed - 1)[early].max() < 0.8 * 0.024
    write(HERE / "reference-rods.csv", TIGHT, names, [t, *tight[:3]])


if __name__ == "__main__":
    main()
