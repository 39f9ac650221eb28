"""The constraint rows of a large model, as sparse entries, and the least changes they ask for.

    [ 1   U^T ] [ W p ]   [   0    ]
    [ U   -s  ] [ -x  ] = [ D^-1 g ],     (U U^T + s) x = D^-1 g,    p = W^-1 U^T x

D makes every row of U = D^-1 G W^-1 as long as 1, s lets redundant rows share what they carry. The
elimination is the native one, in the order that is planned for the equations of motion: a chain
costs as much as it has bodies.  What s leaves of the defects is removed by further passes with the
same factors.  Reference: Vanderbei, Symmetric quasidefinite matrices, SIAM J. Optim. 5 (1995) 100.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from adamslite.assembly.rank import RANK
from adamslite.equations.system import System
from adamslite.integrators.contract import DONE, FACTOR, JACOBIAN, SOLVE

# s: what round-off of rows of unit length, times a thousand, stays below.
SHARED = 1e-12
# Defects that no longer shrink by this factor are contradictions.
PASSES, SHRINKING = 8, 0.5
# Vectors of an inverse iteration at first and at most; iterations; sizes that are clearly not zero.
FIRST, MOST, ITERATIONS, CLEAR = 4, 64, 8, 1e-6


@dataclass(frozen=True)
class Rows:
    """Entries of a matrix (m, n): ``values`` at ``row``, ``column``."""

    shape: tuple[int, int]
    row: np.ndarray
    column: np.ndarray
    values: np.ndarray

    def times(self, x: np.ndarray) -> np.ndarray:
        """G x."""
        return np.bincount(self.row, self.values * x[self.column], self.shape[0])

    def transposed_times(self, y: np.ndarray) -> np.ndarray:
        """G^T y."""
        return np.bincount(self.column, self.values * y[self.row], self.shape[1])

    def scaled(self, rows: np.ndarray, columns: np.ndarray) -> Rows:
        """Rows and columns multiplied by numbers of their own."""
        values = rows[self.row] * self.values * columns[self.column]
        return Rows(self.shape, self.row, self.column, values)

    def largest(self, columns: np.ndarray) -> np.ndarray:
        """(m,) the largest |entry| of each row in some columns (n,) bool."""
        found, chosen = np.zeros(self.shape[0]), columns[self.column]
        np.maximum.at(found, self.row[chosen], np.abs(self.values[chosen]))
        return found

    def only(self, kept: np.ndarray) -> Rows:
        """The same with zeros in the rows that are not ``kept``."""
        chosen = np.zeros(self.shape[0])
        chosen[kept] = 1.0
        return self.scaled(chosen, np.ones(self.shape[1]))

    @property
    def lengths(self) -> np.ndarray:
        """(m,) of the rows."""
        return np.sqrt(np.bincount(self.row, self.values**2, self.shape[0]))


class Pattern:
    """Where the entries of constraint rows stand among the blocks of the Jacobian.

    ``source``: of the rows as they are evaluated, those of velocities at mu where there is one;
    ``below``, ``above``: of G and G^T in the matrix of the equations of motion.
    """

    def __init__(self, system: System, speeds: bool) -> None:
        self.shape = system.m, system.n
        blocks = np.array(list(_blocks(system, speeds)), dtype=np.int64).reshape(-1, 7)
        found = [np.zeros((5, 0), dtype=np.int64)]
        for height, width in np.unique(blocks[:, 5:], axis=0).tolist():
            like = blocks[(blocks[:, 5] == height) & (blocks[:, 6] == width)]
            r, c = (each.ravel() for each in np.divmod(np.arange(height * width), width))
            inside = np.stack([r * width + c, r * width + c, c * height + r, r, c])
            found.append((like[:, :5].T[:, :, None] + inside[:, None, :]).reshape(5, -1))
        self.source, self.below, self.above, self.row, self.column = np.hstack(found)


def _blocks(system: System, speeds: bool) -> Iterator[tuple[int, ...]]:
    """Places of rows, of G and of G^T, first row and column, height and width of each block."""
    offsets, nodes, starts = system.blocks.offsets, system.nodes, system.starts
    velocity = {key[1] for key in nodes if key[0] == "MU"} if speeds else set()
    bodies, held = len(system.model.bodies), system.model.held
    for (row, column), source in offsets.items():
        if column >= bodies or row < bodies:
            continue
        key = nodes[row]
        if key[0] == "MU" and speeds:
            key = key[1]
        elif key not in held or key in velocity:
            continue
        at = system.node_at[key]
        below, above = offsets[at, column], offsets[column, at]
        size = system.widths[row], system.widths[column]
        yield source, below, above, starts[at] - system.n, starts[column], *size


def evaluated(system: System, pattern: Pattern, phases: int, kind: int) -> Rows:
    """The derivatives of the constraint rows by positions (kind 0) or velocities (1)."""
    system.coef[:5] = 0.0
    system.coef[kind] = 1.0
    system.run(JACOBIAN, phases)
    return Rows(pattern.shape, pattern.row, pattern.column, system.J[pattern.source])


class LeastChanges:
    """The factors at one posture.

    ``unit``: the rows U;  ``weights``: W (n,) of the coordinates.
    """

    def __init__(self, system: System, pattern: Pattern, rows: Rows, weights: np.ndarray) -> None:
        self.system, self.weights = system, weights
        dead = system.elimination.dead - system.n
        self.left_out = dead[(dead >= 0) & (dead < system.m)]
        columns = 1.0 / weights
        length = rows.scaled(np.ones(system.m), columns).lengths
        self.shrunk = 1.0 / np.where(length > 0.0, length, 1.0)
        self.unit = rows.scaled(self.shrunk, columns)
        system.J[:] = 0.0
        system.J[pattern.below] = system.J[pattern.above] = self.unit.values
        system.F[:] = 1.0
        system.F[system.n : system.n + system.m] = -SHARED
        self.regular = system.run(FACTOR) == DONE

    def carried(self, defects: np.ndarray) -> np.ndarray:
        """(U U^T + s)^-1 r for each row r of an array (k, m)."""
        system, n, m = self.system, self.system.n, self.system.m
        solve = system.operation(SOLVE)
        found = np.empty_like(defects)
        for k, defect in enumerate(defects):
            system.F[:] = 0.0
            system.F[n : n + m] = defect
            solve()
            found[k] = -system.F[n : n + m]
        found[:, self.left_out] = 0.0
        return found

    def step(self, defect: np.ndarray) -> np.ndarray:
        """The smallest weighted change (n,) that removes a defect (m,) of the rows, to first order;
        contradictions stay at their least sum of squares.
        """
        rest, step = self.shrunk * defect, np.zeros(self.system.n)
        size = np.linalg.norm(rest)
        for _ in range(PASSES):
            change = self.unit.transposed_times(self.carried(rest[None])[0])
            step += change
            rest = rest - self.unit.times(change)
            before, size = size, np.linalg.norm(rest)
            if not size < SHRINKING * before:
                break
        return step / self.weights

    def vanishing(self) -> np.ndarray:
        """An orthonormal basis (r, m) of the y with U^T y = 0: of a few vectors, then of more
        across those found, until some do not vanish.
        """
        found, count = np.zeros((0, self.system.m)), FIRST
        while len(found) < self.system.m:
            sizes, y = self.smallest(count, found)
            found = np.concatenate([found, y[sizes <= RANK]])
            if sizes[0] > RANK:
                break
            count = min(2 * count, MOST)
        return found

    def smallest(self, count: int, found: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Singular values of U, the smallest but for those of the rows of ``found``, in falling
        order, and their combinations of rows; by inverse iteration on ``count`` vectors.
        """
        m = self.system.m
        y = np.random.default_rng(len(found)).normal(size=(min(count, m - len(found)), m))
        for _ in range(ITERATIONS):
            y = self.carried(y)
            y = np.linalg.qr((y - (y @ found.T) @ found).T)[0].T
            forces = np.array([self.unit.transposed_times(each) for each in y])
            mix, sizes, _ = np.linalg.svd(forces, full_matrices=False)
            if not ((sizes > RANK) & (sizes < CLEAR)).any():
                break
        return sizes, mix.T @ y
