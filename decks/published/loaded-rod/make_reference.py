"""Write rods with a mass at their end, from which the frequencies along them are computed.

beta tan beta = a,  omega = beta sqrt(EA/rho)/L,  a the mass of the rod by that at its end
"""

import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))

import catenary  # noqa: E402  (it lies beside the folders of the cases)

LENGTH, MASS, EA, SECTIONS = 1.0, 1.0, 1.0, 100
ROD = catenary.Cable(0.0, MASS, EA, LENGTH)


def deck(share: float) -> str:
    """The end carries the mass of the rod by `share`; nodes stay on the x axis."""
    h = LENGTH / SECTIONS
    text = catenary.head(
        f"A rod of {share:g} of the mass at its end", f"{SECTIONS} sections.", gravity=0
    )
    for k in range(1, SECTIONS + 1):
        lump = MASS * h if k < SECTIONS else MASS * h / 2 + MASS * LENGTH / share
        text += catenary.node(k + 1, lump, (k * h, 0))
        held = f"FX=0\\ FY=-1E6*DY({k + 1})\\ FZ=-1E6*DZ({k + 1})"
        text += f"VFORCE/{k + 1}, I={k + 1}, J_PART=1, RM=1, {held}\n"
        text += catenary.section(k + 1, k, k + 1, ROD, f"{h:g}")
    return text + "\nEND\n"


for share in (0.1, 0.5, 1, 2, 5):
    name = f"mass-ratio-{share:g}".replace(".", "-")
    (HERE / f"{name}.adm").write_text(deck(share))
    (HERE / f"{name}.acf").write_text("SIMULATE/INITIAL\nLINEAR/EIGENSOL\nSTOP\n")
