"""Write a rope that whirls between two points of its axis, and its elliptic sine.

With y from the axis, rho W^2 = w, pull H along the axis, b the largest y, q = w/(2 H):

    H y'' = -w y sqrt(1 + y'^2),   sqrt(1 + y'^2) = 1 + q (b^2 - y^2),   y = b sn(...)
    half the distance   K(m)/r,   half the length   ((2 + q b^2) E(m) - K(m))/r
    m = q b^2/(2 + q b^2),   r = sqrt(q (2 + q b^2)),   tension H (1 + q (b^2 - y^2))

Seen from the turning frame the rope is at rest and its lumps are pulled outwards by m W^2 y.
"""

import sys
from pathlib import Path

import numpy as np
from scipy.optimize import fsolve
from scipy.special import ellipe, ellipk

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))

import catenary  # noqa: E402  (it lies beside the folders of the cases)

HALF, MASS, RATE, EA, SECTIONS = 1.0, 0.1, 10.0, 1e6, 100
PULL = MASS * RATE**2
END = """
VARIABLE/width, FUNCTION=DY({middle},1)
VARIABLE/along, FUNCTION=-SFORCE({first},0,2)
VARIABLE/tension, FUNCTION=SFORCE({first},0,1)

EQUILIBRIUM/ERROR=1.0E-12, IMBALANCE=1.0E-8, MAXIT=1000
SIMULATE/STATICS
END
"""


def exact(length: float) -> tuple[float, float]:
    """Width b [m] and pull along the axis H [N] for half a rope of `length` [m]."""

    def miss(u: np.ndarray) -> list[float]:
        b, q = np.exp(u)
        m, r = q * b**2 / (2 + q * b**2), np.sqrt(q * (2 + q * b**2))
        around = (2 + q * b**2) * ellipe(m) - ellipk(m)
        return [ellipk(m) / r / HALF - 1, around / r / length - 1]

    found = fsolve(miss, np.log([0.6 * np.sqrt(length**2 - HALF**2), 1.0]), xtol=1e-13)
    assert np.abs(miss(found)).max() < 1e-11
    b, q = np.exp(found)
    return b, PULL / (2 * q)


def write(name: str, length: float) -> None:
    n, h = SECTIONS, 2 * length / SECTIONS
    rope = catenary.Cable(0.0, MASS, EA, h)
    width, along = exact(length)
    text = catenary.head("A rope that whirls about its axis", f"{n} sections.", gravity=0)
    text += f"MARKER/1000, PART=1, QP={-HALF:g},0,0\nMARKER/{1000 + n}, PART=1, QP={HALF:g},0,0\n"
    for k in range(1, n):
        i, share = 1000 + k, k / n
        place = HALF * (2 * share - 1), -catenary.stand_in(width, share)
        text += catenary.node(i, MASS * h, place)
        text += f"VFORCE/{i}, I={i}, J_PART=1, RM=1, FX=0\\ FY={PULL * h:.12g}*DY({i})"
        text += f"\\ FZ=-1E6*DZ({i})\n" + catenary.section(i, i - 1, i, rope, f"{h:.12g}")
    text += catenary.section(1000 + n, 999 + n, 1000 + n, rope, f"{h:.12g}")
    text += END.format(middle=1000 + n // 2, first=1001)
    (HERE / f"{name}.adm").write_text(text)
    lines = ["# Width and pull along the axis: see README.md", "# written by make_reference.py"]
    lines += [f"# measure: last VARIABLE/width = {width:.9f} tol rel 1e-3"]
    lines += [f"# measure: last VARIABLE/along = {along:.9f} tol rel 1e-3"]
    (HERE / f"{name}.reference.csv").write_text("\n".join(lines) + "\n")


if __name__ == "__main__":
    write("tight", 1.1)
    write("wide", 1.5)
