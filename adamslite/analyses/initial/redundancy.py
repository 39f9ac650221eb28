"""Redundant constraint rows: found by a rank-revealing factorisation, named, left out.

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


def redundant_rows(system: System) -> list[int]:
    """Numbers of the redundant rows at the present posture, counted from the first multiplier."""
    if system.m == 0:
        return []
    g = constraint_gradient(system) / weights(system)
    length = np.linalg.norm(g, axis=1)
    scaled = g / np.where(length > 0.0, length, 1.0)[:, None]
    if np.linalg.matrix_rank(scaled, tol=RANK) == system.m:
        return []
    from scipy.linalg import qr

    r, order = qr(scaled.T, mode="r", pivoting=True)
    pivots = np.abs(np.diag(r))
    rank = int((pivots > RANK * pivots[0]).sum())
    return sorted(int(row) for row in order[rank:])


def leave_out_redundant(system: System) -> list[str]:
    """Drop the redundant rows of the present posture; returns their names."""
    system.drop(redundant_rows(system))
    return [row_name(system, row) for row in system.dropped]


def row_name(system: System, row: int) -> str:
    """``JOINT/3, rotation about y_J (z_I . x_J)``: the constraint and what the row keeps at
    zero.
    """
    for constraint in system.model.constraints:
        if row < constraint.n_rows:
            return f"{constraint.label}, {constraint.row_names[row]}"
        row -= constraint.n_rows
    raise IndexError("no constraint has this row")
