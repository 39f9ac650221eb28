"""Second sets of data for cases that lie outside of this folder: growing masses, snatch, Atwood.

The decks next door with other numbers; every reference is its closed form.
"""

from collections.abc import Iterator

import numpy as np
from formulas import G
from scipy.special import jv, yv
from spans import table

from adamslite.cables.statements.forms import head, number, tail

M0, MU = 4.0, 7.0


def growing(title: str, sign: str, more: str, run: str, gravity: float = G, x0: float = 0.0) -> str:
    """A mass that gains MU per second, with the paper's statement or its opposite."""
    force = "\\\n".join(
        f", F{a}={sign}Dm*(ACC{a}(2)-{i}GRAV){sign}{MU:g}*V{a}(2)"
        for a, i in zip("XYZ", "IJK", strict=True)
    )
    lines = [f"ACCGRAV/JGRAV={number(-gravity)}"] if gravity else []
    return (
        head(title, f"{M0:g} kg gain {MU:g} kg/s.", *lines, "", "PART/1, GROUND")
        + "MARKER/1, PART=1, QP=-1,0,0\n"
        + f"POINT_MASS/2, MASS={M0:g}, CM=2, QG={number(x0)},0,0\nMARKER/2, POINT_MASS=2\n"
        + f"VARIABLE/Dm, FUNCTION={MU:g}*TIME\nVFORCE/1, I=2, J_PART=1\n{force}\n{more}{run}"
    )


def falling(sign: int, t: np.ndarray) -> np.ndarray:
    """M1, M3: v = -g t (m0 + sign mu t/2)/(m0 + sign mu t)."""
    return -G * t * (M0 + sign * MU * t / 2) / (M0 + sign * MU * t)


def bessel(stiffness: float, x0: float, t: np.ndarray) -> np.ndarray:
    """M2: x = A J0(z) + B Y0(z), z = 2 sqrt(q S), S = 1 + mu t/m0, q = k m0/mu^2."""
    q = stiffness * M0 / MU**2
    start, z = 2 * np.sqrt(q), 2 * np.sqrt(q * (1 + MU * t / M0))
    a, b = np.linalg.solve([[jv(0, start), yv(0, start)], [jv(1, start), yv(1, start)]], [x0, 0.0])
    return a * jv(0, z) + b * yv(0, z)


def masses() -> Iterator[tuple[str, str, str]]:
    """M1, M2, M3."""
    fine = "GSTIFF, SI2, ERROR=1.0E-10"
    t = np.linspace(0, 2, 41)
    header, written = ["time", "POINT_MASS/2.vy"], "written by generate.py"
    lines = ["Momentum: README.md", written, "tolerance: rel 1e-6 abs 1e-8"]
    deck = growing("A growing mass falls", "-", "", tail(fine, 2.0, 40))
    yield "growing", deck, table(header, lines, [t, falling(1, t)])
    stop = M0 / MU
    t = np.linspace(0, 0.9 * stop, 10)
    lines = ["Printed sign: README.md", written, "tolerance: rel 1e-5 abs 1e-8"]
    lines.append(f"expect: SINGULAR_ACCELERATION at {number(stop)} within 1e-3")
    run = tail("GSTIFF, SI2, ERROR=1.0E-8", 1.5 * stop, 15)
    yield (
        "printed",
        growing("The printed sign", "+", "", run),
        table(header, lines, [t, falling(-1, t)]),
    )
    stiffness, x0, t = 2500.0, 0.02, np.linspace(0, 2, 81)
    spring = f"SPRINGDAMPER/1, TRANSLATIONAL, I=2, J=1, K={stiffness:g}, LENGTH=1\n"
    deck = growing("A growing mass on a spring", "-", spring, tail(fine, 2.0, 400), 0.0, x0)
    lines = ["Bessel functions: README.md", written, f"tolerance: abs {1e-5 * x0:g}"]
    yield "spring", deck, table(["time", "POINT_MASS/2.x"], lines, [t, bessel(stiffness, x0, t)])


def snatch() -> Iterator[tuple[str, str, str]]:
    """S1: T_max = M g (1 + sqrt(1 + 2 k H/(M g))), contact (pi + 2 phi)/w."""
    mass, stiffness, drop = 250.0, 4.0e5, 0.3
    weight, w = mass * G, np.sqrt(stiffness / mass)
    peak = weight * (1 + np.sqrt(1 + 2 * stiffness * drop / weight))
    fall = np.sqrt(2 * drop / G)
    phase = np.arcsin(weight / (peak - weight))
    end = 10 * (2 * fall + (np.pi + 2 * phase) / w)
    deck = (
        head(
            "A mass falls into a rope ten times",
            f"{mass:g} kg drop {drop:g} m before the rope comes taut; nothing is lost.",
            f"ACCGRAV/JGRAV={number(-G)}",
            "",
            "PART/1, GROUND",
            "MARKER/1, PART=1",
        )
        + f"POINT_MASS/2, MASS={mass:g}, CM=2, QG=0,{number(drop - 1)},0\n"
        + "MARKER/2, POINT_MASS=2\n"
        + f"VARIABLE/tension, FUNCTION=MAX(0,{stiffness:g}*(DM(2,1)-1))\n"
        + "SFORCE/1, I=2, J=1, FUNCTION=-tension\n"
        + f"VARIABLE/energy, FUNCTION={mass / 2:g}*VM(2)**2+{number(weight)}*DY(2)\n"
        + f", +{stiffness / 2:g}*MAX(0,DM(2,1)-1)**2\n"
        + tail("GSTIFF, SI2, ERROR=1.0E-6, HMAX=1", end, 10000)
    )
    reference = (
        "# Snatch: README.md\n# written by generate.py\n"
        f"# measure: max VARIABLE/tension = {number(peak)} tol rel 1e-3\n"
        f"# measure: range VARIABLE/energy = 0 tol abs {number(1e-3 * weight * drop)}\n"
        f"# measure: last POINT_MASS/2.y = {number(drop - 1)} tol abs 0.01\n"
    )
    yield "snatch", deck, reference


def atwood() -> Iterator[tuple[str, str, str]]:
    """L1: a = (m1 - m2) g/(m1 + m2 + I/R^2), T1 = m1 (g - a), T2 = m2 (g + a)."""
    m1, m2, wheel, inertia, radius = 9.0, 4.0, 3.0, 0.27, 0.3
    a = (m1 - m2) * G / (m1 + m2 + inertia / radius**2)
    text = head(
        "Atwood machine",
        "Two weights over a heavy pulley, the rope as two COUPLERs.",
        f"ACCGRAV/JGRAV={number(-G)}",
        "",
        "PART/1, GROUND",
        "MARKER/1, PART=1",
        "PART/2",
        "MARKER/2, PART=2",
        f"PART/10, MASS={wheel:g}, CM=10, IP=1,1,{inertia:g}",
        "MARKER/10, PART=10",
        "JOINT/1, FIXED, I=2, J=1",
        "JOINT/2, REVOLUTE, I=10, J=2",
    )
    for k, (mass, side) in enumerate(((m1, 1), (m2, -1)), start=1):
        i, x = 10 * (k + 1), number(side * radius)
        text += (
            f"MARKER/{k + 2}, PART=2, QP={x},0,0, REULER=0,-90D,0\n"
            f"PART/{i}, MASS={mass:g}, CM={i}, IP=1,1,1, QG={x},-1,0\n"
            f"MARKER/{i}, PART={i}\nMARKER/{i + 1}, PART={i}, REULER=0,-90D,0\n"
            f"JOINT/{k + 2}, TRANSLATIONAL, I={i + 1}, J={k + 2}\n"
            f"COUPLER/{k}, JOINTS={k + 2},2, SCALES=1,{number(-side * radius)}, TYPE=T:R\n"
        )
    t1, t2, t = m1 * (G - a), m2 * (G + a), np.linspace(0, 1, 11)
    header = ["time", "PART/20.ay", "COUPLER/1.fy", "COUPLER/2.fy", "JOINT/1.fy"]
    lines = ["Atwood machine: README.md", "written by generate.py", "tolerance: abs 1e-8"]
    columns = [np.full_like(t, v) for v in (-a, t1, t2, t1 + t2 + wheel * G)]
    deck = text + tail("GSTIFF, SI2, ERROR=1.0E-8", 1.0, 50)
    yield "atwood", deck, table(header, lines, [t, *columns])


def seconds() -> Iterator[tuple[str, str, str]]:
    """All of them."""
    yield from masses()
    yield from snatch()
    yield from atwood()


CASES = {"second-sets": seconds}
