"""The deck of tests on what is kept between runs: each is one that nothing has been kept of."""

from __future__ import annotations

import time
from pathlib import Path

from adamslite.cli.main import main
from adamslite.results.results import Results

FALL = """a mass that falls {now}
UNITS/SYSTEM=MKS
PART/1, GROUND
MARKER/1, PART=1
POINT_MASS/2, MASS=2
MARKER/2, POINT_MASS=2
VFORCE/1, I=2, J_PART=1, FX=0\\, FY=-10.0\\, FZ=0
INTEGRATOR/GSTIFF, ERROR=1E-6
SIMULATE/DYNAMIC, END=2, STEPS=4
END
"""


def falling_mass() -> Path:
    """Its file in the current folder."""
    path = Path("fall.adm")
    path.write_text(FALL.format(now=time.time_ns()))
    return path


def solve(path: Path, *words: str) -> float:
    """y at the end of a run: F t^2 / 2 m."""
    assert main(["solve", str(path), "-o", "out.csv", *words]) == 0
    return float(Results.load("out.csv")["POINT_MASS/2.y"][-1])
