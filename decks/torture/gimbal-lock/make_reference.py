"""Write the reference of bodies that turn at a constant angular velocity: R = exp([w] t) R0.

exp([w] t) = 1 + sin(|w| t) [k] + (1 - cos(|w| t)) [k]^2 with k = w/|w| (Rodrigues).
"""

import sys
from pathlib import Path

import numpy as np

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parents[1]))

from minimal import write  # noqa: E402  (it lies beside the folders of the cases)

LYING = np.array([[1, 0, 0], [0, 0, -1], [0, 1, 0]])  # turned by 90 degrees about x
BODIES = (((-1.5, 0.0, 0.0), LYING), ((-1.5, -0.4, 0.4), LYING), ((0.0, 0.0, 3.0), np.eye(3)))
LINES = """
R = exp([w] t) R0, x and y axis of each body: see README.md
tolerance: abs 1e-8
"""


def attitudes(w, start, t):
    """R (nt, 3, 3)."""
    speed = np.linalg.norm(w)
    x, y, z = np.array(w) / speed
    skew = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    turn = (speed * t)[:, None, None]
    return (np.eye(3) + np.sin(turn) * skew + (1 - np.cos(turn)) * skew @ skew) @ start


def main():
    t = np.linspace(0, 12, 121)
    columns = {}
    for body, (w, start) in enumerate(BODIES, 2):
        r = attitudes(w, start, t)
        for c, (row, column) in zip(
            "234678", ((0, 0), (1, 0), (2, 0), (0, 1), (1, 1), (2, 1)), strict=True
        ):
            columns[f"REQUEST/{body}.F{c}"] = r[:, row, column]
    # The z axis of the second body reaches that of the ground: theta = 0 at some time.
    k = np.array(BODIES[1][0])
    assert np.isclose(k @ LYING[:, 2], k @ [0, 0, 1])
    write(HERE / "reference.csv", LINES, list(columns), [t, *columns.values()])


if __name__ == "__main__":
    main()
