"""The constraint rows of a large model, as sparse entries, and the least changes they ask for.

    [ 1   U^T ] [ W p ]   [   0    ]
    [ U   -s  ] [ -x  ] = [ D^-1 g ],     (U U^T + s) x = D^-1 g,    p = W^-1 U^T x

D makes every row of U = D^-1 G W^-1 as long as 1.  The elimination is the native one, in the order
that is planned for the equations of motion: a chain costs as much as it has bodies.  Rows that
follow from others, or nearly, are left out first: those that carry the vectors y with U^T y = 0
which inverse iteration finds.  What is left of them beside the rows kept is then known to full
accuracy, and by its singular values what they add to a step, and whether defects contradict each
other.
References: Vanderbei, Symmetric quasidefinite matrices, SIAM J. Optim. 5 (1995) 100; Golub, Van
Loan, Matrix Computations, 2013, sections 5.5, 8.2.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from adamslite.assembly.rank import RANK, rows_carried
from adamslite.equations.system import System
from adamslite.integrators.contract import FACTOR, JACOBIAN, SOLVE

if TYPE_CHECKING:  # few models need it
    from scipy.sparse.linalg import SuperLU

# s where some rows follow from others, and where all are independent.
SHARED, ROUND_OFF = 1e-10, 1e-15
# Passes of a step with the same factors; what is left of a defect that holds, and what shrinks no
# more.
PASSES, LEFT, SHRINKING = 8, 1e-14, 0.5
# Contradictions below this share of the defects are round-off.
CONTRADICTED = 1e-9
# The largest residual of a solution whose factors have kept their digits, against it.
DIGITS = 1e-9
# A change of a combination of rows that is round-off.
NOTHING = 1e-11
# Vectors of an inverse iteration at first and at most; iterations; sizes that may vanish.
FIRST, MOST, ITERATIONS, SMALL = 4, 64, 2, 1e-5


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


def pattern_of(system: System, speeds: bool) -> Pattern:
    """The pattern of a system, which does not depend on numbers."""
    return system.layout.once(("pattern", speeds), lambda: Pattern(system, speeds))


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
        below, above = offsets.get((at, column)), offsets.get((column, at))
        if below is None or above is None:  # the row takes the place of a body, not its velocity
            continue
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

    ``unit``: the rows U;  ``weights``: W (n,) of the coordinates;  ``found``: numbers of the rows
    that follow from those kept, or nearly;  ``forces``: what is left of them, F = Y U, where each
    row of ``combinations``, Y, is one of them less what those kept make up of it.
    """

    def __init__(self, system: System, pattern: Pattern, rows: Rows, weights: np.ndarray) -> None:
        self.system, self.pattern, self.weights = system, pattern, weights
        columns = 1.0 / weights
        length = rows.scaled(np.ones(system.m), columns).lengths
        self.shrunk = 1.0 / np.where(length > 0.0, length, 1.0)
        self.unit = rows.scaled(self.shrunk, columns)
        dead = system.elimination.dead - system.n
        self.left_out = np.zeros(system.m, dtype=bool)
        self.left_out[dead[(dead >= 0) & (dead < system.m)]] = True
        self.left_out[length == 0.0] = True
        self.found = self._leave_out()
        self.combinations = np.array([self._combination(row) for row in self.found])
        self.forces = np.array([self.unit.transposed_times(each) for each in self.combinations])

    @property
    def dependent(self) -> list[int]:
        """Numbers of the rows that follow from all others: of those left out, pivoted, the ones of
        which no more than RANK is left.
        """
        if not self.found:
            return []
        from scipy.linalg import qr

        r, order = qr(self.forces.T, mode="r", pivoting=True)
        independent = int((np.abs(np.diag(r)) > RANK).sum())
        return sorted(self.found[k] for k in order[independent:])

    @property
    def least(self) -> float:
        """The smallest singular value of the rows that are kept."""
        return float(self.smallest(FIRST, np.zeros((0, self.system.m)))[0][-1])

    def step(self, defect: np.ndarray) -> np.ndarray:
        """The smallest weighted change (n,) that removes a defect (m,) of the rows, to first order;
        contradictions stay at their least sum of squares.
        """
        if not self.found:
            return self._step(self.shrunk * defect) / self.weights
        left, sizes, right = np.linalg.svd(self.forces, full_matrices=False)
        some = sizes > RANK
        defect = self._met(defect, left.T[~some] @ self.combinations)
        wanted = (left.T @ (self.combinations @ (self.shrunk * defect)))[some]
        step = self._step(self.shrunk * defect) + right[some].T @ (wanted / sizes[some])
        return step / self.weights

    def _met(self, defect: np.ndarray, vanishing: np.ndarray) -> np.ndarray:
        """A defect without what contradicts ``vanishing`` combinations of the rows of U.

        What is left may be round-off, which contradicts them as well.
        """
        for _ in range(PASSES):
            lost = np.abs(vanishing @ (self.shrunk * defect)).max(initial=0.0)
            if not lost > CONTRADICTED * np.abs(self.shrunk * defect).max():
                break
            basis = np.linalg.qr((vanishing * self.shrunk).T)[0]
            defect = defect - basis @ (basis.T @ defect)
        return defect

    def _step(self, defect: np.ndarray) -> np.ndarray:
        """The smallest change that removes a defect of the rows of U that are kept."""
        rest, step = np.where(self.left_out, 0.0, defect), np.zeros(self.system.n)
        enough, size = LEFT * np.abs(rest).max(), np.abs(rest).max()
        for _ in range(PASSES):
            change = self.unit.transposed_times(self._carried(rest[None])[0])
            left = np.where(self.left_out, 0.0, rest - self.unit.times(change))
            before, size = size, np.abs(left).max()
            if not size < before:
                break
            rest, step = left, step + change
            if size <= enough or size > SHRINKING * before:
                break
        return step

    def _combination(self, row: int) -> np.ndarray:
        """A dependent row less what the kept ones make up of it: y, |y| = 1, with U^T y = 0."""
        y = np.zeros(self.system.m)
        y[row] = 1.0
        for _ in range(PASSES):
            force = self.unit.transposed_times(y)
            change = self._carried(self.unit.times(force)[None])[0]
            y = y - change
            if np.linalg.norm(change) <= NOTHING * np.linalg.norm(y):
                break
        return y / np.linalg.norm(y)

    def _leave_out(self) -> list[int]:
        """Leave out the rows that follow from others, or nearly; what is left is factored."""
        found: list[int] = []
        while True:
            self._factor(SHARED)
            more = rows_carried(self._small())
            if not more:
                break
            found += more
            self.left_out[more] = True
        self._factor(ROUND_OFF)
        return sorted(found)

    def _factor(self, shared: float) -> None:
        """Factor the rows kept, U U^T + s: by the native elimination unless its order, which counts
        on inertia that weights of coordinates may undo, makes it lose digits.
        """
        system, kept = self.system, ~self.left_out
        system.J[:] = 0.0
        values = self.unit.values * kept[self.unit.row]
        system.J[self.pattern.below] = system.J[self.pattern.above] = values
        system.F[:] = 1.0
        system.F[system.n : system.n + system.m] = np.where(kept, -shared, -1.0)
        system.run(FACTOR)
        self._stable: SuperLU | None = None
        probe = np.where(kept, np.random.default_rng(0).normal(size=system.m), 0.0)
        x = self._carried(probe[None])[0]
        rest = np.where(kept, self._product(x) + shared * x - probe, 0.0)
        if not np.abs(rest).max() <= DIGITS * np.abs(x).max():
            self._stable = self._by_diagonal(np.where(kept, shared, 1.0))

    def _product(self, x: np.ndarray) -> np.ndarray:
        """U U^T x."""
        return self.unit.times(self.unit.transposed_times(x))

    def _by_diagonal(self, added: np.ndarray) -> SuperLU:
        """The factors of U U^T of the rows kept, with ``added`` on the diagonal, pivot by pivot."""
        from scipy.sparse import csr_array, diags_array
        from scipy.sparse.linalg import splu

        values = self.unit.values * ~self.left_out[self.unit.row]
        rows = csr_array((values, (self.unit.row, self.unit.column)), shape=self.unit.shape)
        square = (rows @ rows.T + diags_array(added)).tocsc()
        return splu(
            square, permc_spec="MMD_AT_PLUS_A", diag_pivot_thresh=0.0,
            options={"SymmetricMode": True},
        )  # fmt: skip

    def _carried(self, defects: np.ndarray) -> np.ndarray:
        """(U U^T + s)^-1 r of the rows kept, for each r of an array (k, m)."""
        if self._stable is not None:
            found = self._stable.solve(np.ascontiguousarray(defects.T)).T
        else:
            found = self._eliminated(defects)
        found[:, self.left_out] = 0.0
        return found

    def _eliminated(self, defects: np.ndarray) -> np.ndarray:
        """The same by the native elimination."""
        system, n, m = self.system, self.system.n, self.system.m
        solve = system.operation(SOLVE)
        found = np.zeros_like(defects)
        for k, defect in enumerate(defects):
            system.F[:] = 0.0
            system.F[n : n + m] = defect
            solve()
            found[k] = -system.F[n : n + m]
        return found

    def _small(self) -> np.ndarray:
        """Orthonormal combinations (r, m) of the rows kept that may vanish: of a few vectors, then
        of more across those found, until some are far from it.
        """
        found, count = np.zeros((0, self.system.m)), FIRST
        left = int((~self.left_out).sum())
        while len(found) < left:
            sizes, y = self.smallest(min(count, left - len(found)), found)
            found = np.concatenate([found, y[sizes <= SMALL]])
            if sizes[0] > SMALL:
                break
            count = min(2 * count, MOST)
        return found

    def smallest(self, count: int, found: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Singular values of the rows kept, the smallest but for those of the rows of ``found``, in
        falling order, and their combinations of rows; by inverse iteration on ``count`` vectors.
        """
        y = np.random.default_rng(len(found)).normal(size=(count, self.system.m))
        y[:, self.left_out] = 0.0
        for _ in range(ITERATIONS):
            y = self._carried(y)
            for _twice in range(2):
                y = np.linalg.qr((y - (y @ found.T) @ found).T)[0].T
        forces = np.array([self.unit.transposed_times(each) for each in y])
        mix, sizes, _ = np.linalg.svd(forces, full_matrices=False)
        return sizes, mix.T @ y
