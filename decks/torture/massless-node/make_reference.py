"""Write the references of a mass on two springs with (almost) no mass between them.

Springs k1 (upper) and k2 in series are one of k = k1 k2/(k1 + k2); from a stretch off the rest by
A the lower mass moves as A cos(w t), w^2 = k/M, and the node as its share k2/(k1 + k2) of that.
"""

import sys
from pathlib import Path

import numpy as np

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parents[1]))

from minimal import write  # noqa: E402  (it lies beside the folders of the cases)

K1, K2, M, LIGHT, G, A = 300.0, 600.0, 1.0, 1e-9, 9.81, 0.01
LINES = """
Springs in series, closed form: see README.md
tolerance: abs 1e-6
"""


def main():
    k = K1 * K2 / (K1 + K2)
    t = np.linspace(0, 2, 201)
    swing = A * np.cos(np.sqrt(k / M) * t)
    node = -1 - M * G / K1 - swing * k / K1
    mass = -2 - M * G / k - swing
    assert np.allclose(K1 * (-1 - node), K2 * (node - mass - 1), rtol=1e-13)
    lines, names = LINES, ["POINT_MASS/3.y", "POINT_MASS/2.y", "POINT_MASS/2.x"]
    write(HERE / "massless-node.reference.csv", lines, names, [t, mass, node, 0.0])
    write(HERE / "one-spring.reference.csv", lines, names[:1], [t, mass])
    # At the start the node hangs lower by what its own weight and acceleration ask for.
    start = node[0] - LIGHT * (G + A * k / M * k / K1) / (K1 + K2)
    assert f"QG=0,{start:.17g},0" in (HERE / "massless-node.adm").read_text()


if __name__ == "__main__":
    main()
