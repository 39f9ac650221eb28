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
from adamslite.analyses.initial.redundancy import badly_chosen, leave_out_redundant
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
# Corrections of a predicted posture that are no other way of assembly; steps are not shortened for
# them below this share of an output step.
CORRECTED, LEAST_SHARE = 0.1, 1e-3
# Lengths whose share is round-off of models that only turn.
SMALL = 1e-6


def reached(
    system: System, times: np.ndarray, row: int, budget: Budget
) -> tuple[Outcome, Unclosed | None]:
    """Go to the time of a row, one of ``times`` (nt,), from that of the row before; how that ended.

    What is recorded on the way, for the angles that it counts, is written over.
    """
    at, end = float(times[max(0, row - 1)]), float(times[row])
    least = LEAST_SHARE * (end - at)
    while True:
        at, unclosed = _followed(system, at, end, least)
        if unclosed:
            return unclosed.outcome, unclosed
        if not _accelerated(system):
            return without_accelerations(system), None
        system.count.steps += 1 if row else 0
        if at == end:
            return Outcome.DONE, None
        system.run(RECORD, row)
        system.count.records = row
        if over := budget.spent(int(system.count.steps)):
            return over, None


def _accelerated(system: System) -> bool:
    """Solve for accelerations and reactions, without rows that are redundant in this posture."""
    if badly_chosen(system):
        leave_out_redundant(system)
    return bool(system.run(ACCELERATIONS) == contract.DONE)


def _followed(
    system: System, start: float, end: float, least: float
) -> tuple[float, Unclosed | None]:
    """Solve at ``end`` or a time before it, so near that the posture is the predicted one but for a
    small correction: a larger one may have led to another way of assembly.
    """
    before = [(x, x.copy()) for x in (system.q, system.u, system.a, system.base)]
    while True:
        at = _next_time(system, start, end)
        predicted = system.q.copy(), system.base.copy()
        unclosed = _solve(system, at)
        opens = unclosed is not None and len(system.elimination.dropped) > 0
        if not at - start > least or not (opens or _is_far(system, *predicted)):
            return at, unclosed
        for array, values in before:
            array[:] = values
        end = start + 0.5 * (at - start)


def _is_far(system: System, q: np.ndarray, base: np.ndarray) -> bool:
    """Whether bodies are farther than CORRECTED from where they were predicted, as a share of the
    model's extent or as a turn: |R - P| of turns by an angle t is sqrt(8) sin(t/2).
    """
    centres = np.add.outer(system.starts[: len(system.mass)], np.arange(3)).ravel().astype(int)
    moved = np.abs(system.q[centres] - q[centres]).max(initial=0.0)
    turns = np.linalg.norm((system.base - base).reshape(-1, 9), axis=1) / np.sqrt(2.0)
    extent = np.abs(q[centres]).max(initial=SMALL)
    return bool(moved > CORRECTED * extent or turns.max(initial=0.0) > CORRECTED)


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
    return initial_conditions(system, redundant=system.elimination.dropped)
