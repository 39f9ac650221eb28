"""Write the reference of the sliding masses from closed forms."""

import sys
from pathlib import Path

import numpy as np

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))

from minimal import solve, write  # noqa: E402  (it lies beside the folders of the cases)

G, TURN, START, BEAD, SLIDER = 9.81, 2.0, 0.2, 0.3, 0.5
DOWNHILL = np.array([0.8, 0.0, -0.6])
ACROSS = np.array([0.6, 0.0, 0.8])
THROWN = DOWNHILL + [0.0, 1.5, 0.0]
LINES = """
A bead on a turning wire and a mass on a slope, closed form: see README.md
tolerance: abs 1e-6
tolerance REQUEST/*: abs 1e-9
tolerance JPRIM/*: abs 1e-5
tolerance JPRIM/[36].*: abs 1e-9
"""


def main():
    t = np.linspace(0, 1.5, 76)
    out, speed = START * np.cosh(TURN * t), START * TURN * np.sinh(TURN * t)
    run = solve(lambda _, y: np.array([y[1], TURN**2 * y[0]]), [START, 0], t)
    assert np.allclose(run.T, [out, speed], rtol=0, atol=1e-10)
    c, s = np.cos(TURN * t), np.sin(TURN * t)
    side = 2 * BEAD * TURN * speed
    wire = [-side * s, side * c, BEAD * G]
    weight = np.array([0.0, 0.0, -G])
    slide = weight - (weight @ ACROSS) * ACROSS
    assert np.allclose(slide, G * 0.6 * DOWNHILL)
    place = np.array([5.0, 0, 0])[:, None] + np.outer(THROWN, t) + np.outer(slide, t**2 / 2)
    normal = SLIDER * G * 0.8 * ACROSS
    columns = {}
    for body, jprim in (("POINT_MASS/2", 1), ("PART/20", 2)):
        columns |= {f"{body}.x": out * c, f"{body}.y": out * s, f"{body}.z": 0}
        columns |= {f"JPRIM/{jprim}.f{x}": f for x, f in zip("xyz", wire, strict=True)}
    for body, jprim in (("POINT_MASS/3", 4), ("PART/30", 5)):
        columns |= {f"{body}.{x}": p for x, p in zip("xyz", place, strict=True)}
        columns |= {f"JPRIM/{jprim}.f{x}": f for x, f in zip("xyz", normal, strict=True)}
    columns |= {f"REQUEST/{n}.F{c}": 0 for n in (1, 2) for c in (2, 3, 4, 6, 7, 8)}
    columns |= {f"JPRIM/{n}.t{x}": 0 for n in (3, 6) for x in "xyz"}
    write(HERE / "reference.csv", LINES, list(columns), [t, *columns.values()])


if __name__ == "__main__":
    main()
