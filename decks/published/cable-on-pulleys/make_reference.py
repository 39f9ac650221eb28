"""Write the cable over two point pulleys: three chains that share 220 m, and the exact catenary.

The payout s1 of the first span and s2 of the second are turns of two light pulleys, R = 1 m, on
which the pulls of both sides act; at rest they are equal.
"""

import sys
from pathlib import Path

import numpy as np
from scipy.optimize import fsolve

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))

import catenary  # noqa: E402  (it lies beside the folders of the cases)

WEIGHT, EA, LENGTH, LINK, TAIL = 30.0, 5e7, 220.0, 10.0, 10.0
G = 9.81
SECTIONS = 100
#: A flat polygon under lumps of weight sags by 1/(2 n^2) more than the parabola of its length.
BAND = 1 / SECTIONS**2
CABLE = catenary.Cable(WEIGHT, WEIGHT / G, EA, LENGTH)


def residual(u: np.ndarray) -> list[float]:
    """Ends of both spans meet the pulleys, one tension, the link balances, 220 m in all."""
    one, two, h1, v1, h2, v2, px, py = u
    arrive, leave = CABLE.place(h1, v1, one), CABLE.place(h2, v2, two)
    into, out = np.hypot(h1, v1 - WEIGHT * one), np.hypot(h2, v2)
    last = np.hypot(h2, v2 - WEIGHT * two)
    away = np.array([px - 100, py - 10])
    stretched = np.hypot(*away)
    pull = EA * (stretched / LINK - 1) * away / stretched
    return [
        arrive[0] - px,
        -arrive[1] - py,
        leave[0] - (200 - px),
        py - leave[1],
        (into - out) / 1e3,
        (h2 - h1 - pull[0]) / 1e3,
        (v1 - WEIGHT * one - v2 - pull[1]) / 1e3,
        one + two + TAIL / (1 + last / EA) - LENGTH,
    ]


def exact() -> dict[str, float]:
    """Sag of the first span, tension at its fixed end, place of the first pulley below y = 0."""
    u = fsolve(residual, [105, 105, 2e3, 1500, 2e3, 1500, 100, 0], xtol=1e-13)
    assert np.abs(residual(u)).max() < 1e-10
    one, _, h1, v1, *_ = u
    lowest = CABLE.place(h1, v1, v1 / WEIGHT)[1]
    return {"sag": lowest, "tension": np.hypot(h1, v1), "pulley": u[7]}


END = """
VARIABLE/sag, FUNCTION=-DY({middle})
VARIABLE/pulley, FUNCTION=DY(900)
! The end holds half a lump of its own.
VARIABLE/lump, FUNCTION={weight:g}/2*(105+AZ(911,1))/{n}
VARIABLE/tension, FUNCTION=SQRT(SFORCE(1001,0,2)**2+(SFORCE(1001,0,3)+VARVAL(lump))**2)

EQUILIBRIUM/ERROR=1.0E-10, IMBALANCE=1.0E-5, MAXIT=500
SIMULATE/STATICS
END
"""


def span(first: int, start: int, end: int, left: float, free: str, n: int) -> str:
    """A chain of n sections from MARKER `start` to MARKER `end`, 100 m to the right of `left`.

    Its nodes carry the cable that is in the span: what is more than at the start is a VFORCE.
    """
    text, before = "", start
    for k in range(1, n):
        i = first + k
        place = left + 100 * k / n, catenary.stand_in(12.0, k / n)
        text += catenary.node(i, CABLE.mass * 105 / n, place)
        text += f"MARKER/{i + 200}, PART=1, FLOATING\n"
        text += f"VFORCE/{i}, I={i}, JFLOAT={i + 200}, RM=1, FX=0\\ FY=-{WEIGHT:g}*({free}-105/{n})"
        text += "\\ FZ=0\n" + catenary.section(i, before, i, CABLE, f"({free})")
        before = i
    return text + "\n" + catenary.section(first + n, before, end, CABLE, f"({free})")


def pulley(i: int, title: str, left: str, right: str) -> str:
    """A light wheel of 1 m that the pulls turn: its angle is what passed it to the left [m]."""
    return (
        f"\n! {title}. Its angle is the length that passed it to the left.\n"
        f"PART/{i}, MASS=1, CM={i}, IP=1,1,1\nMARKER/{i}, PART={i}\n"
        f"JOINT/{i}, REVOLUTE, I={i}, J=1\n"
        f"VARIABLE/left{i}, FUNCTION={left}\nVARIABLE/right{i}, FUNCTION={right}\n"
        f"SFORCE/{i}, ROTATIONAL, I={i}, J=1, FUNCTION=VARVAL(left{i})-VARVAL(right{i})\n"
    )


def deck(n: int) -> str:
    """Its text, with n sections a span."""
    one, two = f"(105+AZ(911,1))/{n}", f"(105-AZ(911,1)+AZ(912,1))/{n}"
    text = catenary.head("A cable over two pulleys without friction", f"{n} sections a span.")
    text += "MARKER/2, PART=1, QP=200,0,0\nMARKER/3, PART=1, QP=100,10,0\n"
    text += "\n! The first pulley hangs on a link.\n" + catenary.node(900, 1e-6, (100, 0))
    text += f"SFORCE/900, TRANSLATIONAL, I=900, J=3, FUNCTION=-{EA:g}*(DM(900,3)/{LINK:g}-1)\n"
    half = f"-{WEIGHT / 2:g}*({one}+{two})"
    text += "MARKER/901, PART=1, FLOATING\n"
    text += f"VFORCE/900, I=900, JFLOAT=901, RM=1, FX=0\\ FY={half}\\ FZ=0\n"
    text += span(1000, 1, 900, 0, one, n) + span(2000, 900, 2, 100, two, n)
    last = catenary.pull(f"900,{1000 + n - 1}", CABLE, f"({one})")
    first = catenary.pull("2001,900", CABLE, f"({two})")
    text += pulley(911, "First pulley", last, first)
    last = catenary.pull(f"2,{2000 + n - 1}", CABLE, f"({two})")
    tail = f"{EA:.12g}*({TAIL:g}/({TAIL:g}-AZ(912,1))-1)"
    text += pulley(912, "Second pulley; behind it 10 m lie straight", last, tail)
    return text + END.format(middle=1000 + n // 2, weight=WEIGHT, n=n)


def main() -> None:
    (HERE / "cable-on-pulleys.adm").write_text(deck(SECTIONS))
    lines = ["# Elastic catenary: see README.md", "# written by make_reference.py"]
    for name, value in exact().items():
        band = f"rel {BAND:.3g}"
        lines.append(f"# measure: last VARIABLE/{name} = {value:.9g} tol {band}")
    (HERE / "cable-on-pulleys.reference.csv").write_text("\n".join(lines) + "\n")


main()
