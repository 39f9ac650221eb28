"""Write chains moored on a sea bed, and the elastic catenary that lies on a rigid bed.

A chain lies on the bed with its underside: its axis is half a diameter above it.
"""

import sys
from pathlib import Path

import numpy as np
from scipy.optimize import fsolve

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))

import catenary  # noqa: E402  (it lies beside the folders of the cases)

MASS, DIAMETER, EA, WATER, G = 390.0, 0.252, 1.674e9, 1025.0, 9.8
BED = 1e7
#: The chain sinks into the bed: what this changes, relative.
SUNK = 6e-5
LIFT = WATER * np.pi / 4 * DIAMETER**2
END = """
! The fairlead holds half a lump of its own.
VARIABLE/fairlead, FUNCTION=SQRT(SFORCE(2,0,2)**2+(SFORCE(2,0,3)+{half:.9g})**2)
VARIABLE/anchor, FUNCTION=-SFORCE({last},0,2)

EQUILIBRIUM/ERROR=1.0E-10, IMBALANCE=1.0E-3, MAXIT=1000
SIMULATE/STATICS
END
"""


def exact(c: catenary.Cable, away: float, depth: float) -> tuple[float, float]:
    """Tension at the fairlead and at the anchor [N]; what lies on the bed has no friction."""

    def residual(u: np.ndarray) -> list[float]:
        level, upright = np.exp(u[0]), u[1]
        lifted = upright / c.weight
        lying = (c.length - lifted) * (1 + level / c.stiffness)
        x, z = c.place(level, upright, lifted)
        return [(x + lying) / away - 1, z / depth - 1]

    weight = c.weight * c.length
    u = fsolve(residual, [np.log(2 * weight), 0.5 * weight], xtol=1e-13)
    assert np.abs(residual(u)).max() < 1e-10 and u[1] < weight
    return np.hypot(np.exp(u[0]), u[1]), np.exp(u[0])


def write(name: str, length: float, away: float, depth: float, n: int) -> None:
    c = catenary.Cable((MASS - LIFT) * G, MASS, EA, length)
    h = length / n
    text = catenary.head(
        f"A chain of {length:g} m, moored in water {depth:g} m deep",
        f"{n} sections, each with its buoyancy; nodes on the bed are carried by {BED:g} N/m3.",
        gravity=G,
    )
    text += f"MARKER/{n + 1}, PART=1, QP={away:g},{-depth:g},0\n"
    for k in range(1, n):
        i, share = k + 1, k / n
        text += catenary.node(i, MASS * h, (away * share, -depth * share * (2 - share)))
        bed = f"{BED * DIAMETER * h:.9g}*MAX(0,{DIAMETER / 2 - depth:g}-DY({i}))"
        text += f"MARKER/{i + 200}, PART=1, FLOATING\n"
        text += f"VFORCE/{i}, I={i}, JFLOAT={i + 200}, RM=1, FX=0\\ FY={LIFT * h * G:.9g}+{bed}"
        text += "\\ FZ=0\n" + catenary.section(i, k, i, c, f"{h:g}")
    text += "\n" + catenary.section(n + 1, n, n + 1, c, f"{h:g}")
    half = c.weight * h / 2
    (HERE / f"{name}.adm").write_text(text + END.format(half=half, last=n + 1))
    near = max(1 / n**2, SUNK)
    fairlead, anchor = exact(c, away, depth - DIAMETER / 2)
    lines = [
        "# Elastic catenary on a rigid bed: see README.md",
        "# written by make_reference.py",
        f"# measure: last VARIABLE/fairlead = {fairlead:.2f} tol rel {near:.3g}",
        f"# measure: last VARIABLE/anchor = {anchor:.2f} tol rel {near:.3g}",
    ]
    (HERE / f"{name}.reference.csv").write_text("\n".join(lines) + "\n")


if __name__ == "__main__":
    write("fifty", 410, 400, 50, 82)
    write("two-hundred", 760, 700, 200, 76)
    write("six-hundred", 1700, 1500, 600, 170)
