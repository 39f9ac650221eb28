"""Eigenvalues of a state matrix, with free motions found exactly.

A free motion drifts: its eigenvalue zero belongs to a chain A v2 = v1, A v1 = 0, and a general
eigenvalue routine splits it into two of size sqrt(round-off).  So the null space is taken out
first, over and over (the staircase of Kublanovskaya)

    Q^T A Q = [0, A12; 0, A22],    Q = [null space, rest]

until A22 is regular.  An eigenvector y of A22 is one of A with A12 y / s on the null space.
Reference: G. H. Golub, J. H. Wilkinson, SIAM Review 18 (1976) 578.
"""

from __future__ import annotations

import numpy as np

# Singular values below this share of the largest are round-off of the entries.
ROUND_OFF = 32.0 * np.finfo(float).eps


def eigen(a: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Eigenvalues (nx,) and vectors (nx, nx) of ``a``.

    Of a chain every vector is the free motion that it ends in.
    """
    values, vectors = _eigen(a, balance(a))
    size = np.linalg.norm(vectors, axis=0)
    return values, vectors / np.where(size > 0.0, size, 1.0)


def balance(a: np.ndarray) -> np.ndarray:
    """Powers of two d (nx,) for which diag(1/d) A diag(d) has rows and columns of one size."""
    from scipy.linalg import matrix_balance

    if not len(a):
        return np.ones(0)
    # scipy also makes integers of the scales, for a permutation that is not asked for.
    with np.errstate(invalid="ignore"):
        return matrix_balance(a, permute=False, separate=True)[1][0]


def _eigen(a: np.ndarray, scale: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    values, vectors = _staircase(a * scale / scale[:, None])
    return values, scale[:, None] * vectors


def _staircase(a: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    if _is_regular(a):
        return np.linalg.eig(a)
    _, size, vt = np.linalg.svd(a)
    free = int((size <= ROUND_OFF * size[0]).sum())
    if free == 0:
        return np.linalg.eig(a)
    if free == len(a):
        return np.zeros(free, complex), np.eye(free, dtype=complex)
    kernel, rest = vt[len(a) - free :].T, vt[: len(a) - free].T
    values, within = _staircase(rest.T @ a @ rest)
    down = kernel.T @ a @ rest @ within
    chained = values == 0.0
    on_kernel = np.where(chained, down, down / np.where(chained, 1.0, values))
    vectors = kernel @ on_kernel + np.where(chained, 0.0, rest @ within)
    return (
        np.concatenate([np.zeros(free, complex), values]),
        np.hstack([kernel.astype(complex), vectors]),
    )


def _is_regular(a: np.ndarray) -> bool:
    """Whether an estimate of the condition shows, for little, that no singular value vanishes."""
    from scipy.linalg import get_lapack_funcs

    if not len(a):
        return True
    getrf, gecon = get_lapack_funcs(("getrf", "gecon"), (a,))
    factors, _, singular = getrf(a)
    if singular:
        return False
    share, _ = gecon(factors, np.abs(a).sum(axis=0).max())
    return bool(share > len(a) * ROUND_OFF)
