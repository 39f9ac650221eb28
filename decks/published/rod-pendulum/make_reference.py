"""Write the quarters of the periods of the pendulums, for 90 degrees to both sides.

T = 4 sqrt(l/g) K(sin^2(45 deg)), l = 2 L/3 for the rod and L/2 for the mass in its middle; passages
of the bottom at T/4 and 3 T/4.
"""

from pathlib import Path

import numpy as np
from scipy.special import ellipk

HERE = Path(__file__).resolve().parent

for name, length in (("rod-pendulum", 2 / 3), ("mass-pendulum", 1 / 2)):
    period = 4 * np.sqrt(length / 9.81) * ellipk(0.5)
    lines = ["# Passages of the bottom, T/4 and 3 T/4: see README.md"]
    lines += ["# written by make_reference.py"]
    for quarters, start in ((1, 0), (3, 1)):
        passage = f"arrival VARIABLE/angle through 0 from {start} = {period * quarters / 4:.9f}"
        lines.append(f"# measure: {passage} tol abs 1e-7")
    (HERE / f"{name}.reference.csv").write_text("\n".join(lines) + "\n")
