"""Write a chain whose upper end is shaken, and the way of its lower end.

Small motions across of the continuous chain, s from the lower end, upper end at d(t):

    y = d + sum_k q_k J0(z_k sqrt(s/L)),  J0(z_k) = 0,  w_k = (z_k/2) sqrt(g/L)
    q_k'' + w_k^2 q_k = -2 d''/(z_k J1(z_k)),  q_k = q_k' = 0 at t = 0
    d = A (1 - cos W t)^2/4,  d'' = A W^2 (cos W t - cos 2 W t)/2
"""

import sys
from pathlib import Path

import numpy as np
from scipy.special import j1, jn_zeros

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))

import catenary  # noqa: E402  (it lies beside the folders of the cases)

LENGTH, MASS, EA, G = 10.0, 1.0, 1e6, 9.81
STROKE, RATE, END, LINKS = 0.01, 0.8, 10.0, 100
#: Modes of the sum: the terms fall with the fourth power of their number.
MODES = 200


def lower_end(t: np.ndarray) -> np.ndarray:
    """Way [m] of the lower end of the continuous chain that does not stretch."""
    z = jn_zeros(0, MODES)[:, None]
    w = z / 2 * np.sqrt(G / LENGTH)
    slow, fast = ((np.cos(r * t) - np.cos(w * t)) / (w**2 - r**2) for r in (RATE, 2 * RATE))
    modes = -STROKE * RATE**2 / (z * j1(z)) * (slow - fast)
    return STROKE / 4 * (1 - np.cos(RATE * t)) ** 2 + modes.sum(axis=0)


def deck(links: int) -> str:
    """A lump at the lower end of each link, half a one at the last; it starts stretched."""
    h = LENGTH / links
    chain = catenary.Cable(MASS * G, MASS, EA, LENGTH)
    text = catenary.head("A chain whose upper end is shaken", f"{links} links.", gravity=G)
    text += (
        "\nMARKER/1002, PART=1, REULER=90D,90D,0\n"
        "PART/1000, MASS=1, CM=1000, IP=1,1,1, QG=0,0,0\nMARKER/1000, PART=1000\n"
        "MARKER/1001, PART=1000, REULER=90D,90D,0\n"
        "JOINT/1, TRANSLATIONAL, I=1001, J=1002\n"
        f"MOTION/1, JOINT=1, TRANSLATION, FUNCTION={STROKE / 4:g}*(1-COS({RATE:g}*TIME))**2\n"
    )
    low = 0.0
    for k in range(1, links + 1):
        hangs = MASS * G * h * (links - k + 0.5)
        low -= h * (1 + hangs / EA)
        text += catenary.node(k + 1, MASS * h * (1 if k < links else 0.5), (0, low))
        text += catenary.section(k + 1, k if k > 1 else 1000, k + 1, chain, f"{h:g}")
    return text + (
        f"\nREQUEST/1, F2=DX({links + 1},1)\n\nINTEGRATOR/RADAU, ERROR=1.0E-5\n"
        f"SIMULATE/DYNAMIC, END={END:g}, STEPS=100\nEND\n"
    )


if __name__ == "__main__":
    (HERE / "shaken-chain.adm").write_text(deck(LINKS))
    t = np.linspace(0, END, 101)
    lines = [
        "# Lower end of the continuous chain: see README.md",
        "# written by make_reference.py",
        f"# tolerance: abs {0.01 * STROKE:g}",
        "time,REQUEST/1.F2",
        *(f"{a:.1f},{b:.9f}" for a, b in zip(t, lower_end(t), strict=True)),
    ]
    (HERE / "shaken-chain.reference.csv").write_text("\n".join(lines) + "\n")
