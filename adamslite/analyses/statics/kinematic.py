"""Kinematic analysis: positions, velocities and accelerations that motions fully determine.

At each output time  g(t, q) = 0,  G u = -g_t,  G a = -gamma,  and the multipliers that carry the
forces.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from adamslite.analyses.initial.conditions import (
    initial_conditions,
    largest_turn,
    move,
    without_accelerations,
)
from adamslite.integrators import contract
from adamslite.integrators.contract import ACCELERATIONS, RECORD
from adamslite.results.outcomes import Outcome

if TYPE_CHECKING:
    from adamslite.analyses.initial.conditions import Unclosed
    from adamslite.analyses.setup.run_options import Budget
    from adamslite.equations.system import System

# Angles are counted by the nearest one to the last: no part turns further in a step, and two may
# turn against each other.
MOST_TURNED = 1.5


def reached(
    system: System, times: np.ndarray, row: int, budget: Budget
) -> tuple[Outcome, Unclosed | None]:
    """Go to the time of a row, one of ``times`` (nt,), from that of the row before; how that ended.

    What is recorded on the way, for the angles that it counts, is written over.
    """
    at, end = float(times[max(0, row - 1)]), float(times[row])
    while True:
        at = _next_time(system, at, end)
        unclosed = _solve(system, at)
        if unclosed:
            return unclosed.outcome, unclosed
        if system.run(ACCELERATIONS) != contract.DONE:
            return without_accelerations(system), None
        system.count.steps += 1 if row else 0
        if at == end:
            return Outcome.DONE, None
        system.run(RECORD, row)
        system.count.records = row
        if over := budget.spent(int(system.count.steps)):
            return over, None


def _next_time(system: System, start: float, end: float) -> float:
    """``end``, or a time before it up to which no part turns far; the state is predicted there.

    With second-order Taylor steps: the share s of the way has  s w + s^2 a = MOST_TURNED.
    """
    h, n = end - start, system.n
    by_speed, by_acceleration = h * system.u[:n], 0.5 * h * h * system.a[:n]
    w, a = largest_turn(system, by_speed), largest_turn(system, by_acceleration)
    if w + a > MOST_TURNED:
        share = 2.0 * MOST_TURNED / (w + float(np.sqrt(w * w + 4.0 * a * MOST_TURNED)))
        by_speed, by_acceleration = share * by_speed, share * share * by_acceleration
        end = start + share * h
    if h > 0.0:
        move(system, -(by_speed + by_acceleration))
    return end


def _solve(system: System, time: float) -> Unclosed | None:
    """Positions and velocities at a time; what stayed open, if anything did."""
    system.settings.t = time
    system.report.t = time
    return initial_conditions(system)
