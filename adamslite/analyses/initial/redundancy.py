"""Redundant constraint rows: found by a rank-revealing factorisation, named and left out.

Rows of G W^-1/2 scaled to unit length; QR with column pivoting of the transpose orders them by
independence, and those with |R_kk| <= RANK |R_11| are combinations of the others.  Their
multipliers are zero, so reactions of the joints concerned are one choice among many.
References: Golub, Van Loan, Matrix Computations, 2013, section 5.4; Haug 1989, section 3.4.
"""

from __future__ import annotations

import numpy as np

from adamslite.analyses.initial.conditions import constraint_gradient, weights
from adamslite.equations.system import System

RANK = 1e-9
# Rows kept that are nearer to dependence than all rows by this factor were the wrong choice.
WORSE = 1e-3


def redundant_rows(system: System) -> list[int]:
    """Numbers of the redundant rows at the present posture, counted from the first multiplier."""
    if system.m == 0:
        return []
    scaled = _scaled_rows(system)
    if np.linalg.matrix_rank(scaled, tol=RANK) == system.m:
        return []
    from scipy.linalg import qr

    r, order = qr(scaled.T, mode="r", pivoting=True)
    pivots = np.abs(np.diag(r))
    rank = int((pivots > RANK * pivots[0]).sum())
    return sorted(int(row) for row in order[rank:])


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
    """G W^-1/2 (m, n), its rows of unit length."""
    g = constraint_gradient(system) / weights(system)
    length = np.linalg.norm(g, axis=1)
    return g / np.where(length > 0.0, length, 1.0)[:, None]


def leave_out_redundant(system: System) -> list[str]:
    """Drop the redundant rows of the present posture; returns their names."""
    system.drop(redundant_rows(system))
    return [row_name(system, row) for row in system.elimination.dropped]


def row_name(system: System, row: int) -> str:
    """``JOINT/3, rotation about y_J (z_I . x_J)``: the constraint and what the row keeps at
    zero.
    """
    for constraint in system.model.constraints:
        if row < constraint.n_rows:
            return f"{constraint.label}, {constraint.row_names[row]}"
        row -= constraint.n_rows
    raise IndexError("no constraint has this row")
