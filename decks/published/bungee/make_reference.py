"""Write a jumper on a folded cord, who falls faster than a stone, and energy's account of the fall.

Cord of mass m and length L, doubled up at the start, jumper of mass M, fallen by y:

    v^2 = g y (4 M L + m (2 L - y))/(2 M L + m (L - y))
    acceleration at y = L: g (1 + r (4 + r)/8), r = m/M
"""

import sys
from pathlib import Path

import numpy as np
from scipy.integrate import quad

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))

import catenary  # noqa: E402  (it lies beside the folders of the cases)

LENGTH, CORD, JUMPER, EA, LINKS, G = 10.0, 40.0, 40.0, 1e6, 201, 9.81
#: Of each link [N s/m].
DAMPER = 20.0
REACHED = (0.5, 0.9)


def speed(y: float) -> float:
    """Of the jumper [m/s]."""
    whole = 4 * JUMPER * LENGTH + CORD * (2 * LENGTH - y)
    return np.sqrt(G * y * whole / (2 * JUMPER * LENGTH + CORD * (LENGTH - y)))


def after(y: float) -> float:
    """Time of the fall to `y` [s]."""
    return quad(lambda u: 2 * u / speed(u * u), 0, np.sqrt(y), epsabs=1e-12)[0]


def deck() -> str:
    """An odd number of links: the middle one lies across; the others hang."""
    h, n = LENGTH / LINKS, LINKS
    cord = catenary.Cable(0.0, CORD / LENGTH, EA, h)
    text = catenary.head("A jumper on a folded cord", f"{n} links.", gravity=G)
    for k in range(1, n + 1):
        down = k if k <= n // 2 else n - k
        place = 0.0 if k <= n // 2 else h, -down * h
        mass = CORD / n if k < n else CORD / n / 2 + JUMPER
        text += catenary.node(k + 1, mass, place)
        pulls = catenary.section(k + 1, k, k + 1, cord, f"{h:.12g}").rstrip()
        text += f"{pulls}-{DAMPER:g}*VR({k + 1},{k})\n"
    return text + (
        f"\nVARIABLE/fallen, FUNCTION=-DY({n + 1},1)\nVARIABLE/speed, FUNCTION=-VY({n + 1},1)\n"
        "\nINTEGRATOR/HHT, ERROR=1.0E-6\n"
        f"SIMULATE/DYNAMIC, END={after(0.97 * LENGTH):.6g}, STEPS=400\nEND\n"
    )


if __name__ == "__main__":
    (HERE / "bungee.adm").write_text(deck())
    lines = ["# Times of the fall, and speeds: see README.md", "# written by make_reference.py"]
    lines += ["# interpolate: cubic"]
    for share in REACHED:
        time = after(share * LENGTH)
        passage = f"arrival VARIABLE/fallen through {share * LENGTH:g} from 0.1"
        swift = f"value VARIABLE/speed at {time:.9f} = {speed(share * LENGTH):.9f}"
        lines.append(f"# measure: {passage} = {time:.9f} tol rel 3e-3")
        lines.append(f"# measure: {swift} tol rel 8e-3")
    (HERE / "bungee.reference.csv").write_text("\n".join(lines) + "\n")
