"""Write a cantilever that a moment at its end rolls up, and where its end comes to.

A moment M bends a beam of length L to an arc of the angle t = M L/EI: its end moves by

    u = L (sin t/t - 1),   v = L (1 - cos t)/t

The law of each of n beams is that of small bending: their end is (t/n)^2/6 off.
"""

import sys
from pathlib import Path

import numpy as np

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))

import catenary  # noqa: E402  (they lie beside the folders of the cases)
import elastica  # noqa: E402

LENGTH, EI, EA, BEAMS = 1.0, 2.0, 2e6, 40
LINE = catenary.Cable(0.0, 1.0, EA, LENGTH)
END = """
VARIABLE/u, FUNCTION=DX({last},1)-{length:g}
VARIABLE/v, FUNCTION=DY({last},1)

EQUILIBRIUM/ERROR=1.0E-12, IMBALANCE=1.0E-9, MAXIT=200
SIMULATE/STATICS
END
"""


def deck(turn: float) -> str:
    """Bodies lie on the arc at the start, from which statics finds the moments."""
    h = LENGTH / BEAMS
    text = catenary.head(f"A cantilever rolled up by {turn:.4g} rad", f"{BEAMS} beams.", gravity=0)
    text += "MARKER/1000, PART=1\n"
    for k in range(1, BEAMS + 1):
        slope = turn * k / BEAMS
        place = LENGTH / turn * np.array([np.sin(slope), 1 - np.cos(slope)])
        text += elastica.part(1000 + k, h, place, slope)
        text += elastica.beam(1000 + k, LINE, EI, h)
    last = 1000 + BEAMS
    moment = EI * turn / LENGTH
    text += f"\nSFORCE/1, ROTATIONAL, I={last}, J=1000, ACTIONONLY, FUNCTION={moment:.12g}\n"
    return text + END.format(last=last, length=LENGTH)


def write(name: str, turn: float) -> None:
    (HERE / f"{name}.adm").write_text(deck(turn))
    u, v = LENGTH * (np.sin(turn) / turn - 1), LENGTH * (1 - np.cos(turn)) / turn
    lines = ["# End of the beam on an arc: see README.md", "# written by make_reference.py"]
    near = (turn / BEAMS) ** 2 / 5
    lines += [f"# measure: last VARIABLE/u = {u:.9f} tol abs {near:.2g}"]
    lines += [f"# measure: last VARIABLE/v = {v:.9f} tol abs {near:.2g}"]
    (HERE / f"{name}.reference.csv").write_text("\n".join(lines) + "\n")


write("quarter", np.pi / 2)
write("half", np.pi)
write("whole", 2 * np.pi)
