"""MoorPy: the elastic catenary with a bed, solved by Newton's method."""

from __future__ import annotations

import numpy as np

from benchmarks import rope_cases as cases
from benchmarks.peers.program import Laps
from benchmarks.rope_cases import MOORED, Answer, RopeRun


def moored() -> Answer:
    """Tension at the fairlead [kN]; the bed has no friction."""
    from moorpy.Catenary import catenary

    weight = (cases.CHAIN - cases.WATER * np.pi / 4 * cases.DIAMETER**2) * cases.CHAIN_G
    laps = Laps()
    found = catenary(
        cases.AWAY, cases.DEPTH, cases.CHAIN_LENGTH, cases.CHAIN_EA, weight, CB=0, Tol=1e-10
    )
    return Answer(float(np.hypot(*found[2:4])) / 1e3, 0.0, laps.lap())


def runs() -> list[RopeRun]:
    """One, for equilibria are all that it does."""
    return [RopeRun(MOORED, "moorpy", "catenary", moored)]
