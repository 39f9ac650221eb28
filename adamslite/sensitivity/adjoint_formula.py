"""The backward differences transposed: rows of the tape, coefficients of a step, rows that tie
velocities.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache, lru_cache
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from adamslite.integrators.bdf.history import ROWS

if TYPE_CHECKING:
    from adamslite.equations.system import System


@dataclass
class Row:
    """A row of the tape: what happens there.

    ``h_before``: the step for which differences are there, ``fresh``: the history begins anew;
    ``outputs``: output times within the step; ``memory``: what kernels remember before it.
    """

    is_step: bool
    t: float
    h: float
    order: int
    h_before: float
    fresh: bool
    outputs: range
    memory: tuple[np.ndarray, ...]


class Way(NamedTuple):
    """The way of weights of differences through a step: ybar = ``own`` . Dbar of what the corrector
    finds, and ``past`` Dbar + ``rate`` psibar + ``level`` y_pbar before it.
    """

    own: np.ndarray
    past: np.ndarray
    rate: np.ndarray
    level: np.ndarray


@cache
def gammas(k: int) -> np.ndarray:
    """gamma_0 .. gamma_k."""
    return np.concatenate([[0.0], np.cumsum(1.0 / np.arange(1, k + 1))])


@lru_cache(maxsize=4096)
def way_of(k: int, ratio: float) -> Way:
    g, back = gammas(k), np.eye(ROWS)
    for j in range(k + 1):
        back[j + 1] += back[j]
    own = back[k + 1] + back[k + 2]
    back[k + 1], back[k + 2] = -back[k + 2], 0.0
    change = resized(k, ratio).T
    back[: k + 1] = change @ back[: k + 1]
    return Way(own, back, change @ (g / g[k]), change.sum(axis=1))


def resized(k: int, ratio: float) -> np.ndarray:
    """R (k + 1, k + 1): differences on steps of ``ratio`` times the size are R D."""
    size = k + 1

    def factors(f: float) -> np.ndarray:
        r = np.zeros((size, size))
        r[0] = 1.0
        for i in range(1, size):
            r[i, 1:] = r[i - 1, 1:] * (i - 1 - f * np.arange(1, size)) / i
        return r

    return (factors(ratio) @ factors(1.0)).T


def vector_rates(c: np.ndarray, w: np.ndarray) -> np.ndarray:
    """c' = (I - [c]/2 + c c^T/4) w."""
    return w - 0.5 * np.cross(c, w) + 0.25 * c * np.einsum("bi,bi->b", c, w)[:, None]


class Ties:
    """G of the velocity rows, from the blocks of the matrix of a step."""

    def __init__(self, rows: np.ndarray, columns: np.ndarray, places: np.ndarray, nz: int) -> None:
        self.rows, self.columns, self.places, self.nz = rows, columns, places, nz

    def mu(self, J: np.ndarray, u: np.ndarray) -> np.ndarray:
        """G u at the places of mu (nz,)."""
        return np.bincount(self.rows, J[self.places] * u[self.columns], self.nz)


def ties_of(system: System) -> Ties:
    rows, columns, places = [], [], []
    node_at, nodes = system.node_at, system.nodes
    for (row, column), at in system.blocks.offsets.items():
        if column < len(system.model.bodies) and ("MU", nodes[row]) in node_at:
            mu, wide = node_at["MU", nodes[row]], system.widths[column]
            for i in range(system.widths[row]):
                for j in range(wide):
                    rows.append(system.starts[mu] + i)
                    columns.append(system.starts[column] + j)
                    places.append(at + i * wide + j)
    found = (np.array(each, dtype=int) for each in (rows, columns, places))
    return Ties(next(found), next(found), next(found), system.nz)
