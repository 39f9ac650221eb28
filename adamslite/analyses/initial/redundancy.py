"""Redundant constraint rows are left out: their multipliers are zero.

Reactions of the joints concerned are one choice among many, see :mod:`adamslite.assembly.rank`.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from adamslite.analyses.initial.least_change import MOST_DENSE, VELOCITIES
from adamslite.analyses.initial.rows import constraint_gradient, weights
from adamslite.analyses.initial.sparse_rows import LeastChanges, evaluated, pattern_of
from adamslite.assembly.rank import dependent_rows, names_of_rows, unit_rows

if TYPE_CHECKING:
    from adamslite.equations.system import System

# Rows kept that are nearer to dependence than all rows by this factor were the wrong choice.
WORSE = 1e-3


def redundant_rows(system: System) -> list[int]:
    """Numbers of the redundant rows at the present posture, counted from the first multiplier."""
    if not system.m:
        return []
    if system.m <= MOST_DENSE:
        return dependent_rows(_scaled_rows(system))
    system.drop([])
    return _factored(system, np.arange(system.m)).dependent


def badly_chosen(system: System) -> bool:
    """Whether the rows kept have become dependent at the present posture while others of those
    left out have not.

    The smallest singular value of the rows kept, against that of as many independent combinations
    of all rows: where constraints lose rank (a flattened parallelogram) both vanish, and leaving
    out another row there would let the mechanism come apart.
    """
    dropped = system.elimination.dropped
    if len(dropped) in (0, system.m):
        return False
    kept = np.delete(np.arange(system.m), dropped)
    if system.m <= MOST_DENSE:
        scaled = _scaled_rows(system)
        some, all_ = (np.linalg.svd(each, compute_uv=False) for each in (scaled[kept], scaled))
        return bool(some[len(kept) - 1] < WORSE * all_[len(kept) - 1])
    system.drop([])
    few, whole = _factored(system, kept), _factored(system, np.arange(system.m))
    if len(whole.dependent) > len(dropped):
        worse = False  # all rows have lost rank
    else:
        worse = len(few.dependent) > 0 or few.least < WORSE * whole.least
    system.drop(dropped)
    return worse


def _factored(system: System, kept: np.ndarray) -> LeastChanges:
    pattern = pattern_of(system, True)
    rows = evaluated(system, pattern, *VELOCITIES).only(kept)
    return LeastChanges(system, pattern, rows, weights(system))


def _scaled_rows(system: System) -> np.ndarray:
    return unit_rows(constraint_gradient(system) / weights(system))


def leave_out_redundant(system: System) -> list[str]:
    """Drop the redundant rows of the present posture; returns their names."""
    system.drop(redundant_rows(system))
    return [row_name(system, row) for row in system.elimination.dropped]


def row_name(system: System, row: int) -> str:
    """The constraint and what the row keeps at zero."""
    return names_of_rows(system.model.constraints, [row])[0]
