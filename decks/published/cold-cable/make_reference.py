"""Write the cable between level supports, cold and warmed, and the elastic catenary of both."""

import sys
from pathlib import Path

import numpy as np
from scipy.optimize import brentq

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))

import catenary  # noqa: E402  (it lies beside the folders of the cases)

AREA, E, DENSITY, SPAN, G = 2.2783e-4, 5.7e10, 2844.23, 325.0, 9.81
SECTIONS = 100
END = """
VARIABLE/sag, FUNCTION=-DY({middle})
VARIABLE/level, FUNCTION=-SFORCE({middle},0,2)

EQUILIBRIUM/ERROR=1.0E-10, IMBALANCE=1.0E-5, MAXIT=500
SIMULATE/STATICS
END
"""


def cable(rise: float) -> catenary.Cable:
    """The cable when it is `rise` [K] warmer: longer, the weight of a metre stays."""
    mass = DENSITY * AREA
    return catenary.Cable(mass * G, mass, E * AREA, SPAN * (1 + 2.3e-5 * rise))


def exact(c: catenary.Cable) -> tuple[float, float]:
    """Sag [m] and level pull [N] of the continuous cable."""
    upright = c.weight * c.length / 2
    level = brentq(lambda h: c.place(h, upright, c.length)[0] - SPAN, 1e2, 1e6, xtol=1e-9)
    return c.place(level, upright, c.length / 2)[1], level


def polygon(c: catenary.Cable, n: int) -> tuple[float, float]:
    """The same for n sections with a lump of mass between two of them."""
    h = c.length / n
    upright = c.weight * h * (np.arange(1, n + 1) - (n + 1) / 2)

    def steps(level: float) -> np.ndarray:
        pull = np.hypot(level, upright)
        return h * (1 + pull / c.stiffness) * np.array([level / pull, upright / pull])

    level = brentq(lambda level: steps(level)[0].sum() - SPAN, 1e2, 1e6, xtol=1e-10)
    return -np.cumsum(steps(level)[1])[n // 2 - 1], level


def write(name: str, title: str, rise: float) -> None:
    c, n = cable(rise), SECTIONS
    h, middle = c.length / n, n // 2 + 1
    text = catenary.head(title, f"{n} sections; they start on a parabola.")
    text += f"MARKER/{n + 1}, PART=1, QP={SPAN:g},0,0\n"
    for k in range(1, n):
        place = SPAN * k / n, catenary.stand_in(5.0, k / n)
        text += catenary.node(k + 1, c.mass * h, place)
        text += catenary.section(k + 1, k, k + 1, c, f"{h:.16g}")
    text += "\n" + catenary.section(n + 1, n, n + 1, c, f"{h:.16g}")
    (HERE / f"{name}.adm").write_text(text + END.format(middle=middle))

    sag, level = exact(c)
    lumped = polygon(c, n)
    assert abs(lumped[0] - sag) < 1e-4 * sag and abs(lumped[1] - level) < 1e-4 * level
    lines = [
        f"# {title}: see README.md",
        "# written by make_reference.py",
        f"# measure: last VARIABLE/sag = {lumped[0]:.9f} tol rel 1e-7",
        f"# measure: last VARIABLE/level = {lumped[1]:.6f} tol rel 1e-7",
        f"# measure: last VARIABLE/sag = {sag:.6f} tol rel 1e-4",
        f"# measure: last VARIABLE/level = {level:.4f} tol rel 1e-4",
    ]
    (HERE / f"{name}.reference.csv").write_text("\n".join(lines) + "\n")


write("cold", "A cable between level supports", 0.0)
write("warm", "A cable between level supports, 39.26 K warmer", 39.26)
