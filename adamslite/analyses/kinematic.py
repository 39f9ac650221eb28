"""Kinematic analysis: positions, velocities and accelerations that motions fully determine.

At each output time  g(t, q) = 0,  G u = -g_t,  G a = -gamma,  and the multipliers that carry the
forces.
"""

from __future__ import annotations

import numpy as np

from adamslite.analyses.initial.conditions import Unclosed, initial_conditions, move
from adamslite.equations.system import System
from adamslite.integrators import contract
from adamslite.integrators.contract import ACCELERATIONS, RECORD
from adamslite.results.outcomes import Outcome


def run_kinematic(system: System, times: np.ndarray) -> tuple[Outcome, Unclosed | None]:
    """Solve at each of ``times`` (nt,) and fill ``system.record``."""
    system.start_record(times)
    for row, time in enumerate(times):
        if row:
            _predict(system, float(time) - float(times[row - 1]))
        system.settings.t = time
        system.report.t = time
        unclosed = initial_conditions(system)
        if unclosed:
            return unclosed.outcome, unclosed
        if system.run(ACCELERATIONS) != contract.DONE:
            return Outcome.UNDETERMINED, None
        system.run(RECORD, row)
        system.count.steps += 1 if row else 0
    return Outcome.DONE, None


def _predict(system: System, h: float) -> None:
    """Second-order Taylor step of positions and attitudes."""
    n = system.n
    move(system, -(h * system.u[:n] + 0.5 * h * h * system.a[:n]))
