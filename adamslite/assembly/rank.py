"""Redundant constraint rows: found by a rank-revealing factorisation.

Rows of G W^-1/2 are scaled to unit length; QR with column pivoting of the transpose orders them by
independence, and those with |R_kk| <= RANK |R_11| are combinations of the others.

Of thousands of rows the combinations that vanish are computed instead, y with G^T y = 0, by inverse
iteration of G G^T on several vectors at once.  As many rows can be left out as there are such y:
those in which the y, pivoted, are largest.
References: Golub, Van Loan, Matrix Computations, 2013, sections 5.4, 7.3; Haug 1989, section 3.4.
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING

import numpy as np

from adamslite.elements.bases.constraint import Constraint

if TYPE_CHECKING:  # only large models need sparse matrices
    from scipy.sparse import csr_array

RANK = 1e-9
# Lengths that differ by less than this share are alike.
ALIKE = 1e-6
# Rows up to which they are made orthogonal one by one.
MOST_ORTHOGONALISED = 120
# Rows up to which matrices are dense.
MOST_DENSE = 800
# What is added to the diagonal of G G^T, vectors at first, and iterations: singular values above
# 1e-5 lose nine digits in two.
SHARED, VECTORS, ITERATIONS = 1e-14, 16, 6
# Products of one iteration that makes vectors orthogonal; more take some seconds.
MOST_PRODUCTS = 1e9


class TooManyDependent(Exception):
    """More rows are combinations of others than are looked for."""


def unit_rows(g: np.ndarray) -> np.ndarray:
    """A matrix (m, n) with its rows scaled to unit length; rows of zeros stay."""
    length = np.linalg.norm(g, axis=1)
    return g / np.where(length > 0.0, length, 1.0)[:, None]


def dependent_rows(scaled: np.ndarray) -> list[int]:
    """Numbers of the rows, each of unit length, that are combinations of the others."""
    if np.linalg.matrix_rank(scaled, tol=RANK) == len(scaled):
        return []
    if len(scaled) > MOST_ORTHOGONALISED:
        from scipy.linalg import qr

        r, order = qr(scaled.T, mode="r", pivoting=True)
        pivots = np.abs(np.diag(r))
        rank = int((pivots > RANK * pivots[0]).sum())
        return sorted(int(row) for row in order[rank:])
    return _orthogonalised(scaled)


def _orthogonalised(rows: np.ndarray) -> list[int]:
    """The same by Gram and Schmidt's process: of rows that are longest but for round-off, the
    first comes next, whatever a processor makes of their last digits.
    """
    rest, open_ = rows.copy(), np.ones(len(rows), dtype=bool)
    largest = 0.0
    while open_.any():
        sizes = np.where(open_, np.linalg.norm(rest, axis=1), -1.0)
        longest = float(sizes.max())
        largest = max(largest, longest)
        if longest <= RANK * largest:
            break
        row = int(np.argmax(sizes >= (1.0 - ALIKE) * longest))
        open_[row] = False
        unit = rest[row] / sizes[row]
        for _ in range(2):  # once more for what rounding left
            rest -= np.outer(rest @ unit, unit)
    return np.flatnonzero(open_).tolist()


def dependent_of_many(rows: csr_array) -> list[int]:
    """The same for a sparse matrix, whose rows may have any length.

    Raises
    ------
    TooManyDependent
    """
    length = np.sqrt(rows.multiply(rows).sum(axis=1))
    if not np.isfinite(length).all():
        return []
    unit = rows.multiply(1.0 / np.where(length > 0.0, length, 1.0)[:, None]).tocsr()
    columns = np.unique(unit.indices)
    if len(columns) <= MOST_ORTHOGONALISED:  # few steps, whatever the number of rows
        return _orthogonalised(unit[:, columns].toarray())
    _require_few(len(length), len(length) - len(columns))
    return rows_carried(_vanishing(unit).T)


def rows_carried(y: np.ndarray) -> list[int]:
    """As many rows as there are combinations y (r, m) that vanish: those that carry them."""
    if not len(y):
        return []
    from scipy.linalg import qr

    _, order = qr(y, mode="r", pivoting=True)
    return sorted(int(row) for row in order[: len(y)])


def _vanishing(unit: csr_array) -> np.ndarray:
    """An orthonormal basis (m, r) of the y with G^T y = 0."""
    from scipy.sparse import eye_array
    from scipy.sparse.linalg import splu

    m = unit.shape[0]
    factors = splu((unit @ unit.T + SHARED * eye_array(m)).tocsc())
    count = VECTORS
    while True:
        _require_few(m, count)
        y = np.random.default_rng(0).normal(size=(m, min(count, m)))
        for _ in range(ITERATIONS):
            y, _ = np.linalg.qr(factors.solve(y))
        _, sizes, mix = np.linalg.svd(unit.T @ y, full_matrices=False)
        if sizes[0] > RANK or count >= m:
            return y @ mix[sizes <= RANK].T
        count *= 2


def _require_few(rows: int, count: int) -> None:
    """Raise what is raised where so many of the rows, or nearly, are combinations of others."""
    if count > 0 and rows * min(count, rows) ** 2 > MOST_PRODUCTS:
        raise TooManyDependent


def solved(rows: csr_array, g: np.ndarray) -> np.ndarray:
    """The solution of G G^T x = g; redundant rows share it."""
    from scipy.sparse import eye_array
    from scipy.sparse.linalg import splu

    square = (rows @ rows.T).tocsc()
    added = SHARED * float(square.diagonal().max())
    return splu((square + added * eye_array(len(g))).tocsc()).solve(g)


def names_of_rows(constraints: Iterable[Constraint], rows: Iterable[int]) -> list[str]:
    """``JOINT/3, rotation about y_J (z_I . x_J)``: the constraint of each row, and what the row
    keeps at zero; the rows in rising order.
    """
    names = (f"{c.label}, {name}" for c in constraints for name in c.row_names[: c.n_rows])
    wanted = set(rows)
    return [name for row, name in enumerate(names) if row in wanted]
