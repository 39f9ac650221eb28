"""Write the references of force pulses on a mass on a spring: piecewise closed forms.

Between two edges the force F is constant, and about x = F/k the mass swings freely:

    x = F/k + (x0 - F/k) cos w t + v0/w sin w t,     w^2 = k/m
"""

import sys
from pathlib import Path

import numpy as np

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parents[1]))

from minimal import write  # noqa: E402  (it lies beside the folders of the cases)

MASS, STIFFNESS, FORCE = 1.0, 100.0, 100.0
PULSE = [(0.5, FORCE), (0.51, 0.0)]
SQUARE = [(0.05 * k, FORCE if k % 2 == 0 else -FORCE) for k in range(40)]
LINES = """
Piecewise closed form: see README.md
tolerance: abs 2e-5
tolerance *.vx: abs 2e-4
"""


def swing(t, x, v, force):
    """Place and speed after t under a constant force."""
    w, rest = np.sqrt(STIFFNESS / MASS), force / STIFFNESS
    c, s = np.cos(w * t), np.sin(w * t)
    return rest + (x - rest) * c + v / w * s, v * c - (x - rest) * w * s


def driven(times, edges):
    """Place and speed at the times, (2, nt), under a force that changes at the edges."""
    x, v, now, force, todo, found = 0.0, 0.0, 0.0, 0.0, list(edges), []
    for t in times:
        while todo and todo[0][0] <= t:
            edge, following = todo.pop(0)
            x, v = swing(edge - now, x, v, force)
            now, force = edge, following
        found.append(swing(t - now, x, v, force))
    return np.array(found).T


def main():
    t = np.linspace(0, 2, 21)
    for name, edges in (("pulse", PULSE), ("square-wave", SQUARE)):
        columns = ["POINT_MASS/2.x", "POINT_MASS/2.vx"]
        path = HERE / f"{name}.reference.csv"
        write(path, LINES, columns, [t, *driven(t + 1e-12, edges)])


if __name__ == "__main__":
    main()
