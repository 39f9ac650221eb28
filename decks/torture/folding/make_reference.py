"""Write the deck of a paid-out cable that is pushed along itself, and its reference.

Scene S5 of the benchmarks with 50 masses: the classical Runge-Kutta method with 64 bits, steps in
which the fastest oscillation turns 0.02 rad; steps of 0.01 rad change 4e-9 m.
"""

import sys
from pathlib import Path

import numpy as np

HERE = Path(__file__).resolve().parent
sys.path[:0] = [str(HERE.parents[1]), str(HERE.parents[2])]

from minimal import write  # noqa: E402  (it lies beside the folders of the cases)

from benchmarks.decks import deck  # noqa: E402
from benchmarks.reference import chain_at  # noqa: E402

COUNT, PARTS, SHOWN = 50, 10, (10, 30, 50)

if __name__ == "__main__":
    text = deck("S5", COUNT).replace(
        "SIMULATE/", "INTEGRATOR/RADAU, ERROR=1.0E-6\nSIMULATE/"
    )  # fmt: skip
    (HERE / "folding.adm").write_text(text)
    places = chain_at("S5", COUNT, 2.0, PARTS).astype(float)
    times = np.linspace(0.0, 1.0, PARTS + 1)
    names = [f"POINT_MASS/{k + 1}.{axis}" for k in SHOWN for axis in "xy"]
    columns = [places[:, k - 1, axis] for k in SHOWN for axis in (0, 1)]
    lines = "A paid-out cable that is pushed along itself: see README.md\ntolerance: abs 1e-3"
    write(HERE / "folding.reference.csv", lines, names, [times, *columns])
