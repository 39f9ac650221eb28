"""Write a beam that sags under its weight, one end sliding or both held, and its deflection."""

import sys
from pathlib import Path

import numpy as np

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))

import catenary  # noqa: E402  (they lie beside the folders of the cases)
import elastica  # noqa: E402

LENGTH, MASS, EA, EI, G = 10.0, 100.0, 1.5e9, 1e7, 9.80665
LINE = catenary.Cable(MASS * G, MASS, EA, LENGTH)
BEAMS = 40
#: Weights on n nodes instead of a uniform load: 5 - 4/n^2 for 5 in the formula below.
LUMPED = 1 - 0.8 / BEAMS**2
SLIDING = 5 * LINE.weight * LENGTH**4 / (384 * EI)
END = """
VARIABLE/sag, FUNCTION=-DY({middle})

EQUILIBRIUM/ERROR=1.0E-12, IMBALANCE=1.0E-3, MAXIT=100
SIMULATE/STATICS
END
"""


def held() -> float:
    """Sag in the middle [m] of the beam that is stretched when it bends."""
    s = np.linspace(0, 1, 2001)
    y = -SLIDING * np.sin(np.pi * s)
    slope = -SLIDING * np.pi / LENGTH * np.cos(np.pi * s)
    ends = np.array([[0, 0], [LENGTH, 0]])
    guess = np.vstack([LENGTH * s, y, slope])
    _, _, down = elastica.between_hinges(LINE, EI, ends, guess, (6e3, -LINE.weight * LENGTH / 2))
    return -down[1000]


def write(name: str, title: str, holds: str, sag: float, turned: str = "") -> None:
    n = BEAMS
    h = LENGTH / n
    text = catenary.head(title, f"{n} beams.", gravity=G)
    text += f"MARKER/2, PART=1, QP={LENGTH:g},0,0{turned}\n"
    for k in range(n + 1):
        share = h * (0.5 if k in (0, n) else 1)
        text += elastica.part(1000 + k, MASS * share, np.array([k * h, 0]), 0)
        text += elastica.beam(1000 + k, LINE, EI, h) if k else ""
    text += f"\nJOINT/1, REVOLUTE, I=1000, J=1\n{holds.format(last=1000 + n)}\n"
    (HERE / f"{name}.adm").write_text(text + END.format(middle=1000 + n // 2))
    lines = [f"# {title}: see README.md", "# written by make_reference.py"]
    lines += [f"# measure: last VARIABLE/sag = {sag * LUMPED:.9f} tol rel 1e-4"]
    (HERE / f"{name}.reference.csv").write_text("\n".join(lines) + "\n")


write(
    "sliding",
    "A beam under its weight, one end slides",
    "JPRIM/2, INPLANE, I={last}, J=2",
    SLIDING,
    ", REULER=0,90D,0",
)
write("held", "A beam under its weight, both ends held", "JOINT/2, REVOLUTE, I={last}, J=2", held())
