"""Redundant constraint rows: found by a rank-revealing factorisation.

Rows of G W^-1/2 are scaled to unit length; QR with column pivoting of the transpose orders them by
independence, and those with |R_kk| <= RANK |R_11| are combinations of the others.
References: Golub, Van Loan, Matrix Computations, 2013, section 5.4; Haug 1989, section 3.4.
"""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np

from adamslite.elements.bases.constraint import Constraint

RANK = 1e-9


def unit_rows(g: np.ndarray) -> np.ndarray:
    """A matrix (m, n) with its rows scaled to unit length; rows of zeros stay."""
    length = np.linalg.norm(g, axis=1)
    return g / np.where(length > 0.0, length, 1.0)[:, None]


def dependent_rows(scaled: np.ndarray) -> list[int]:
    """Numbers of the rows, each of unit length, that are combinations of the others."""
    if np.linalg.matrix_rank(scaled, tol=RANK) == len(scaled):
        return []
    from scipy.linalg import qr

    r, order = qr(scaled.T, mode="r", pivoting=True)
    pivots = np.abs(np.diag(r))
    rank = int((pivots > RANK * pivots[0]).sum())
    return sorted(int(row) for row in order[rank:])


def name_of_row(constraints: Iterable[Constraint], row: int) -> str:
    """``JOINT/3, rotation about y_J (z_I . x_J)``: the constraint and what the row keeps at
    zero.
    """
    for constraint in constraints:
        if row < constraint.n_rows:
            return f"{constraint.label}, {constraint.row_names[row]}"
        row -= constraint.n_rows
    raise IndexError("no constraint has this row")
