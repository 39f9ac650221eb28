"""Redundant constraint rows are left out: their multipliers are zero.

Reactions of the joints concerned are one choice among many, see :mod:`adamslite.assembly.rank`.
"""

from __future__ import annotations

import numpy as np

from adamslite.analyses.initial.conditions import constraint_gradient, weights
from adamslite.assembly.rank import dependent_rows, name_of_row, unit_rows
from adamslite.equations.system import System

# Rows kept that are nearer to dependence than all rows by this factor were the wrong choice.
WORSE = 1e-3


def redundant_rows(system: System) -> list[int]:
    """Numbers of the redundant rows at the present posture, counted from the first multiplier."""
    return dependent_rows(_scaled_rows(system)) if system.m else []


def badly_chosen(system: System) -> bool:
    """Whether the rows kept have become dependent at the present posture while others of those
    left out have not.

    The smallest singular value of the rows kept, against that of as many independent combinations
    of all rows: where constraints lose rank (a flattened parallelogram) both vanish, and leaving
    out another row there would let the mechanism come apart.
    """
    kept = system.m - len(system.elimination.dropped)
    if kept in (0, system.m):
        return False
    scaled = _scaled_rows(system)
    independent = np.delete(scaled, system.elimination.dropped, axis=0)
    least = np.linalg.svd(independent, compute_uv=False)[kept - 1]
    return bool(least < WORSE * np.linalg.svd(scaled, compute_uv=False)[kept - 1])


def _scaled_rows(system: System) -> np.ndarray:
    return unit_rows(constraint_gradient(system) / weights(system))


def leave_out_redundant(system: System) -> list[str]:
    """Drop the redundant rows of the present posture; returns their names."""
    system.drop(redundant_rows(system))
    return [row_name(system, row) for row in system.elimination.dropped]


def row_name(system: System, row: int) -> str:
    """The constraint and what the row keeps at zero."""
    return name_of_row(system.model.constraints, row)
