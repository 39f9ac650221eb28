"""Write strings that run through two eyes, from which their frequencies are computed.

rho (y_tt + 2 v y_xt + v^2 y_xx) = T y_xx,  omega_n = (n pi c/L) |1 - (v/c)^2|,  c^2 = T/rho
"""

import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))

import catenary  # noqa: E402  (it lies beside the folders of the cases)

LENGTH, MASS, TENSION, NODES = 1.0, 1.0, 100.0, 100


def deck(speed: float) -> str:
    """Nodes that stay at their places along x; the string runs through at `speed` [m/s]."""
    h = LENGTH / NODES
    text = catenary.head(f"A string that runs at {speed:g} m/s", f"{NODES} sections.", gravity=0)
    text += f"MARKER/{1000 + NODES}, PART=1, QP=1,0,0\nMARKER/1000, PART=1\n"
    for k in range(1, NODES):
        i = 1000 + k
        bent = f"DY({i + 1})-2*DY({i})+DY({i - 1})"
        turns = f"VY({i + 1})-VY({i - 1})"
        text += catenary.node(i, MASS * h, (k * h, 0))
        text += (
            f"MARKER/{i + 1000}, PART=1, QP={k * h:.9g},0,0\n"
            f"VFORCE/{i}, I={i}, J_PART=1, RM=1, FX=-1E6*DX({i},{i + 1000})\\\n"
            f", FY={TENSION - MASS * speed**2:.9g}/{h:g}*({bent})-{MASS * speed:.9g}*({turns})\\\n"
            f", FZ=-1E6*DZ({i})\n"
        )
    return text + "\nEND\n"


for name, speed in (("resting", 0.0), ("half", 5.0), ("nearly-critical", 9.0), ("beyond", 15.0)):
    (HERE / f"{name}.adm").write_text(deck(speed))
    (HERE / f"{name}.acf").write_text("SIMULATE/STATICS\nLINEAR/EIGENSOL\nSTOP\n")
