"""The smallest weighted step that removes what constraint rows are off by, to first order.

    min sum w_i^2 p_i^2  subject to G p = g

by the pseudo-inverse of a dense matrix, or, of many rows, by sparse factors.  Where these leave a
gap, a model that is not too large is closed once more the dense way.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple, Protocol

import numpy as np

from adamslite.analyses.initial.rows import SPEEDS, gradient, velocity_rows, weights
from adamslite.analyses.initial.sparse_rows import LeastChanges, evaluated, pattern_of
from adamslite.equations.system import System
from adamslite.integrators import contract

# Rows up to which matrices are dense; up to which what stays open is tried once more with them.
MOST_DENSE, MOST_REPEATED = 120, 600
# Singular values below this share of the largest are redundant rows.
RANK = 1e-9
# Defects below this share of the values are round-off.
STILL = 1e-15


class Level(NamedTuple):
    """Rows of positions or of velocities: the phases that evaluate them, and by what they are
    derived.
    """

    phases: int
    kind: int


POSITIONS, VELOCITIES = Level(contract.POSITION_ROWS, 0), Level(SPEEDS, 1)


class Changes(Protocol):
    """Derivatives of some rows at a posture; ``sums`` of each row: not numbers where one is not."""

    sums: np.ndarray

    def step(self, defect: np.ndarray) -> np.ndarray:
        """The smallest weighted step (n,) that removes a defect; redundant rows are shared."""
        ...


Way = Callable[[System, Level, np.ndarray], Changes]


def ways(system: System) -> list[Way]:
    """How to find least changes, one after the other until the constraints hold."""
    many = system.m > MOST_DENSE and not (system.elimination.dead < system.n).any()
    if not many:
        return [Dense]
    return [Sparse] if system.m > MOST_REPEATED else [Sparse, Dense]


class Dense:
    """By singular values."""

    def __init__(self, system: System, level: Level, kept: np.ndarray) -> None:
        velocity = level is VELOCITIES
        rows = velocity_rows(system)[kept] if velocity else system.n + kept
        self.gradient = gradient(system, level.phases, level.kind, rows)
        self.sums = self.gradient.sum(axis=1)
        self.scale = 1.0 / weights(system, velocity)

    def step(self, defect: np.ndarray) -> np.ndarray:
        step, *_ = np.linalg.lstsq(self.gradient * self.scale, defect, rcond=RANK)
        return self.scale * step


class Sparse:
    """By the factors of independent rows."""

    def __init__(self, system: System, level: Level, kept: np.ndarray) -> None:
        self.system, self.kept, self.speeds = system, kept, level is VELOCITIES
        self.pattern = pattern_of(system, self.speeds)
        self.rows = evaluated(system, self.pattern, level.phases, level.kind).only(kept)
        self.sums = np.bincount(self.rows.row, self.rows.values, system.m)[kept]

    def step(self, defect: np.ndarray) -> np.ndarray:
        system, values = self.system, self.system.u if self.speeds else self.system.q
        if np.abs(defect).max() <= STILL * max(1.0, float(np.abs(values).max())):
            return np.zeros(system.n)
        all_defects = np.zeros(system.m)
        all_defects[self.kept] = defect
        scale = weights(system, self.speeds)
        return LeastChanges(system, self.pattern, self.rows, scale).step(all_defects)
