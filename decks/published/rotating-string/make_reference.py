"""Write a string that turns about one end, from which its motions out of its plane are computed.

rho y_tt = (T y_x)_x,  T = rho W^2 (L^2 - x^2)/2:  omega_k = W sqrt(k (2 k - 1)), y = P_{2k-1}(x/L)

Seen from the turning frame the string is at rest and its lumps are pulled outwards by m W^2 x; the
other acceleration that the frame adds stays in its plane.
"""

import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))

import catenary  # noqa: E402  (it lies beside the folders of the cases)

LENGTH, MASS, EA, RATE, LINKS = 1.0, 1.0, 1e7, 10.0, 100
STRING = catenary.Cable(0.0, MASS, EA, LENGTH)


def deck() -> str:
    """A lump at the outer end of each link, half a one at the last; they stay in the plane xz."""
    h = LENGTH / LINKS
    text = catenary.head("A string that turns about its end", f"{LINKS} links.", gravity=0)
    for k in range(1, LINKS + 1):
        i, mass = k + 1, MASS * h * (1 if k < LINKS else 0.5)
        text += catenary.node(i, mass, (k * h, 0))
        text += f"VFORCE/{i}, I={i}, J_PART=1, RM=1, FX={mass * RATE**2:.12g}*DX({i})\\"
        text += f" FY=-1E6*DY({i})\\ FZ=0\n"
        text += catenary.section(i, k, i, STRING, f"{h:g}")
    return text + "\nEND\n"


(HERE / "rotating-string.adm").write_text(deck())
(HERE / "rotating-string.acf").write_text("SIMULATE/STATICS\nLINEAR/EIGENSOL\nSTOP\n")
