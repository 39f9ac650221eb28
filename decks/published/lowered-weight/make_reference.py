"""Write the deck of the weight from its description, and the load by the momentum of both.

T = (M + rho l)(g - S") at the top, l = 20 + S; S" = 0 from 4 s on.
"""

from pathlib import Path

import numpy as np

from adamslite.cables.deck.scene import deck

HERE = Path(__file__).resolve().parent
G, WEIGHT, RHO = 9.81, 1000.0, 5.536

text, _ = deck((HERE / "lowered-weight.toml").read_text(encoding="utf-8"))
(HERE / "lowered-weight.adm").write_text(text)
t = np.linspace(4.2, 5.0, 81)
load = (WEIGHT + RHO * (60 + 20 * (t - 4))) * G
LINES = [
    "# Load at the top: see README.md",
    "# written by make_reference.py",
    f"# measure: mean REQUEST/1.F2 from 4.2 = {load.mean():.4f} tol rel 1e-4",
    "# tolerance: abs 60",
    "time,REQUEST/1.F2",
    *(f"{a:.2f},{b:.4f}" for a, b in zip(t, load, strict=True)),
]
(HERE / "lowered-weight.reference.csv").write_text("\n".join(LINES) + "\n")
