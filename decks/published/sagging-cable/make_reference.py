"""Write sagging cables, from which the frequencies of their motions in the plane are computed.

Irvine and Caughey: with Omega = omega L/sqrt(H/m), Le/L = 1 + (w L/H)^2/8 and
lambda^2 = (w L/H)^2 L EA/(H Le),

    antisymmetric  Omega = 2 n pi
    symmetric      tan(Omega/2) = Omega/2 - (4/lambda^2) (Omega/2)^3
"""

import sys
from pathlib import Path

from scipy.optimize import brentq

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))

import catenary  # noqa: E402  (it lies beside the folders of the cases)

SPAN, MASS, G, LEVEL, SECTIONS = 100.0, 1.0, 9.81, 12262.5, 100
#: w L/H: a sag of a hundredth of the span.
SLOPE = MASS * G * SPAN / LEVEL


def cable(square: float) -> catenary.Cable:
    """The cable of lambda^2 = `square`; its unstretched length hangs with H = LEVEL."""
    stiffness = square * LEVEL * (1 + SLOPE**2 / 8) / SLOPE**2

    def miss(length: float) -> float:
        c = catenary.Cable(MASS * G, MASS, stiffness, length)
        return c.place(LEVEL, c.weight * length / 2, length)[0] - SPAN

    length = brentq(miss, 0.5 * SPAN, 1.1 * SPAN, xtol=1e-13)
    return catenary.Cable(MASS * G, MASS, stiffness, length)


def deck(c: catenary.Cable, square: float) -> str:
    h = c.length / SECTIONS
    text = catenary.head(f"A sagging cable of lambda^2 = {square:.6g}", f"{SECTIONS} sections.")
    text += f"MARKER/{SECTIONS + 1}, PART=1, QP={SPAN:g},0,0\n"
    for k in range(1, SECTIONS):
        share = k / SECTIONS
        text += catenary.node(k + 1, MASS * h, (SPAN * share, catenary.stand_in(1.0, share)))
        text += catenary.section(k + 1, k, k + 1, c, f"{h:.14g}")
    text += "\n" + catenary.section(SECTIONS + 1, SECTIONS, SECTIONS + 1, c, f"{h:.14g}")
    return text + "\nEND\n"


for name, square in (("stiff", 4 * 3.141592653589793**2), ("soft", 1.0), ("inextensible", 4000.0)):
    (HERE / f"{name}.adm").write_text(deck(cable(square), square))
    (HERE / f"{name}.acf").write_text("SIMULATE/STATICS\nLINEAR/EIGENSOL\nSTOP\n")
