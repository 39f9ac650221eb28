"""Write decks and references of a hanging chain that rings along itself: the sum of its modes.

N equal masses m on springs k, the first spring at the ground, the last mass free. From rest in the
state u of displacements from the equilibrium they move as

    u_j(t) = sum_k c_k sin((k - 1/2) pi j/(N + 1/2)) cos(w_k t)
    w_k = 2 sqrt(k/m) sin((k - 1/2) pi/(2 N + 1)),   k = 1..N
"""

import sys
from pathlib import Path

import numpy as np

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parents[1]))

from minimal import write  # noqa: E402  (it lies beside the folders of the cases)

N, LENGTH, EA, RHO, STRAIN, G = 20, 10.0, 1e7, 1.0, 1e-3, 9.81
H = LENGTH / N
MASS, STIFFNESS = RHO * H, EA / H
WAVES, SETTLED = 0.05, 1.0
STEADY = "HHT, ERROR=1.0E-3, HMAX=0.01"
TEXT = """{title}
! {what}
! Written by make_reference.py

UNITS/SYSTEM=MKS
ACCGRAV/JGRAV=-9.81

PART/1, GROUND
MARKER/1, PART=1
"""
HEAD = """
{first}: see README.md
"""


def modes():
    """Shapes (N, N), a column each, and circular frequencies (N,)."""
    k, j = np.arange(1, N + 1), np.arange(1, N + 1)
    shapes = np.sin(np.outer(j, (k - 0.5) * np.pi / (N + 0.5)))
    return shapes, 2 * np.sqrt(STIFFNESS / MASS) * np.sin((k - 0.5) * np.pi / (2 * N + 1))


def rest():
    """Stretch of the chain at rest down to each mass [m]."""
    return np.cumsum(MASS * G * np.arange(N, 0, -1)) / STIFFNESS


def motion(t):
    """Distances of the masses from the ground at times t, (nt, N)."""
    shapes, rates = modes()
    j = np.arange(1, N + 1)
    parts = np.linalg.solve(shapes, STRAIN * H * j - rest())
    return H * j + rest() + np.cos(np.outer(t, rates)) * parts @ shapes.T


def deck(title, what, method, end, steps):
    """The text of a deck; every section starts stretched by STRAIN."""
    lines = [TEXT.format(title=title, what=what).rstrip("\n")]
    for j in range(1, N + 1):
        y = -H * j * (1 + STRAIN)
        lines.append(f"POINT_MASS/{j + 1}, MASS={MASS:g}, CM={j + 1}, QG=0,{y:.16g},0")
        lines.append(f"MARKER/{j + 1}, POINT_MASS={j + 1}")
        lines.append(
            f"SFORCE/{j}, TRANSLATIONAL, I={j + 1}, J={j}"
            f", FUNCTION=-{STIFFNESS:.10g}*(DM({j + 1},{j})-{H:g})"
        )
    lines += ["", "VARIABLE/pull, FUNCTION=SFORCE(1,0,3)", "", f"INTEGRATOR/{method}"]
    lines += [f"SIMULATE/DYNAMIC, END={end:g}, STEPS={steps}", "END", ""]
    return "\n".join(lines)


def main():
    t = np.linspace(0, WAVES, 501)
    y = motion(t)
    stretch = STRAIN * LENGTH
    pull = STIFFNESS * (y[:, 0] - H)
    h = 1e-6
    a = (motion(np.array([h])) - 2 * motion(np.array([0.0])) + motion(np.array([-h]))) / h**2
    springs = STIFFNESS * (np.diff(y[0], prepend=0.0) - H)
    expected = (np.append(springs[1:], 0.0) - springs) / MASS + G
    assert np.allclose(a[0], expected, rtol=0, atol=1e-2 * np.abs(expected).max())
    what = f"All modes are awake: the sections start stretched by {STRAIN:g} and are let go."
    (HERE / "waves.adm").write_text(
        deck("Axial waves that are meant", what, "GSTIFF, SI2, ERROR=1.0E-6", WAVES, 500)
    )
    lines = HEAD.format(first="Sum of the modes of the chain")
    lines += f"tolerance: abs {1e-3 * stretch:g}\ntolerance VARIABLE/pull: abs 100\n"
    names = ["POINT_MASS/21.y", "POINT_MASS/11.y", "VARIABLE/pull"]
    write(HERE / "waves.reference.csv", lines, names, [t, -y[:, -1], -y[:, 9], pull])
    what = "The same, but what is looked for is the weight that the ground carries."
    (HERE / "settled.adm").write_text(
        deck("Axial waves that are not meant", what, STEADY, SETTLED, 100)
    )
    weight = N * MASS * G
    lines = "\n".join((
        f"The weight of the chain, {weight:g} N: see README.md",
        f"measure: mean VARIABLE/pull from 0.9 = {weight:g} tol rel 1e-3",
        f"measure: max VARIABLE/pull from 0.9 = {weight:g} tol rel 1e-2",
        f"measure: min VARIABLE/pull from 0.9 = {weight:g} tol rel 1e-2",
    ))  # fmt: skip
    (HERE / "settled.reference.csv").write_text(
        "".join(f"# {line}\n" for line in lines.splitlines()) + "# written by make_reference.py\n"
    )


if __name__ == "__main__":
    main()
