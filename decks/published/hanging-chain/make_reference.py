"""Write a chain that hangs from its upper end, from which its frequencies are computed.

Small motions across of the continuous chain: omega_k = (j_k/2) sqrt(g/L), J0(j_k) = 0.
"""

import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))

import catenary  # noqa: E402  (it lies beside the folders of the cases)

LENGTH, MASS, EA, LINKS = 1.0, 1.0, 1e7, 100
CHAIN = catenary.Cable(MASS * 9.81, MASS, EA, LENGTH)


def deck() -> str:
    """A lump at the lower end of each link, half a one at the last."""
    h = LENGTH / LINKS
    text = catenary.head("A hanging chain", f"{LINKS} links.")
    for k in range(1, LINKS + 1):
        text += catenary.node(k + 1, MASS * h * (1 if k < LINKS else 0.5), (0, -k * h))
        text += catenary.section(k + 1, k, k + 1, CHAIN, f"{h:g}")
    return text + "\nEND\n"


(HERE / "hanging-chain.adm").write_text(deck())
(HERE / "hanging-chain.acf").write_text("SIMULATE/STATICS\nLINEAR/EIGENSOL\nSTOP\n")
