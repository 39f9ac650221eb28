"""Write a string between a wall and an eye that runs away from it, and how it swings on.

rho y_tt = T y_xx on 0 < x < l(t) = l0 + v t, y = 0 at both ends, b = v/c. Solutions:

    y = F(c t - x) - F(c t + x),  F(s) = (A/2) cos(2 pi n ln(l0 c/v + s)/g),
    g = ln((c + v)/(c - v)):  F(c t + l) = F(c t - l)

The string does not move along itself: the eye slides over it. The nodes lie at x = xi l(t), and

    y_tt at a point of the string = Y_tt - 2 xi l'/l Y_txi + (xi l'/l)^2 Y_xixi + 2 xi (l'/l)^2 Y_xi
"""

import sys
from pathlib import Path

import numpy as np

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))

import catenary  # noqa: E402  (it lies beside the folders of the cases)

START, SPEED, MASS, TENSION, NODES, STROKE = 1.0, 3.0, 1.0, 100.0, 100, 1e-3
C = (TENSION / MASS) ** 0.5
RATE = 2 * np.pi / np.log((C + SPEED) / (C - SPEED))
BEFORE = START * C / SPEED
END = 0.4


def wave(s: np.ndarray) -> np.ndarray:
    """F of the docstring for n = 1."""
    return STROKE * np.cos(RATE * np.log(BEFORE + s)) / 2


def way(x: np.ndarray | float, t: np.ndarray | float) -> np.ndarray:
    """Deflection [m]."""
    return wave(C * t - x) - wave(C * t + x)


def rate(xi: float) -> float:
    """Of the deflection of a node at the start [m/s]."""
    x = xi * START
    up, down = (
        -STROKE / 2 * RATE * np.sin(RATE * np.log(BEFORE + s)) / (BEFORE + s) for s in (x, -x)
    )
    return C * (down - up) - xi * SPEED * (down + up)


def deck() -> str:
    """Nodes of 1 kg move across only and stand where they were at the start."""
    h = 1 / NODES
    title = f"A string that gets longer at {SPEED:g} m/s"
    text = catenary.head(title, f"{NODES} sections.", gravity=0)
    text += f"MARKER/{1000 + NODES}, PART=1, QP={START:g},0,0\nMARKER/1000, PART=1\n"
    text += f"VARIABLE/L, FUNCTION={START:g}+{SPEED:g}*TIME\n"
    text += f"VARIABLE/W, FUNCTION={SPEED:g}/VARVAL(L)\n"
    for k in range(1, NODES):
        i, xi = 1000 + k, k * h
        place = f"{xi * START:.9g},{float(way(xi * START, 0.0)):.12g}"
        bent = f"(DY({i + 1})-2*DY({i})+DY({i - 1}))/{h:g}**2"
        slope, turn = (f"({d}({i + 1})-{d}({i - 1}))/{2 * h:g}" for d in ("DY", "VY"))
        text += (
            f"\nPOINT_MASS/{i}, MASS=1, CM={i}, QG={place},0, VY={rate(xi):.12g}\n"
            f"MARKER/{i}, POINT_MASS={i}\n"
            f"MARKER/{i + 1000}, PART=1, QP={xi * START:.9g},0,0\n"
            f"VFORCE/{i}, I={i}, J_PART=1, RM=1, FX=-1E6*DX({i},{i + 1000})\\\n"
            f", FY=({C:g}**2/VARVAL(L)**2-({xi:g}*VARVAL(W))**2)*{bent}\n"
            f", +2*{xi:g}*VARVAL(W)*({turn}-VARVAL(W)*{slope})\\ FZ=-1E6*DZ({i})\n"
        )
    return text + (
        f"\nVARIABLE/middle, FUNCTION=DY({1000 + NODES // 2})\n"
        f"VARIABLE/quarter, FUNCTION=DY({1000 + NODES // 4})\n"
        "\nINTEGRATOR/RADAU, ERROR=1.0E-8\n"
        f"SIMULATE/DYNAMIC, END={END:g}, STEPS=80\nEND\n"
    )


if __name__ == "__main__":
    (HERE / "growing-string.adm").write_text(deck())
    t = np.linspace(0, END, 81)
    length = START + SPEED * t
    rows = zip(t, way(length / 2, t), way(length / 4, t), strict=True)
    lines = [
        "# Deflection of two nodes: see README.md",
        "# written by make_reference.py",
        f"# tolerance: abs {0.01 * STROKE:g}",
        "time,VARIABLE/middle,VARIABLE/quarter",
        *(f"{a:.4f},{b:.12g},{c:.12g}" for a, b, c in rows),
    ]
    (HERE / "growing-string.reference.csv").write_text("\n".join(lines) + "\n")
