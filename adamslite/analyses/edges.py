"""Stops of a run: the times at which a guard of the clock changes its branch.

Guards of the clock (:mod:`adamslite.guards`) are functions of time alone, so their changes are
found before the run, by the native kernels that the run itself uses:

1. values at a grid of times, made finer until the number of changes stays the same; a value that
   turns round just short of zero is looked at more closely;
2. bisection of every change down to round-off.

References: Shampine, Gladwell, Brankin, ACM Trans. Math. Softw. 17 (1991) 11 (events of one
variable).
"""

from __future__ import annotations

import numpy as np

from adamslite.engine import CLOCK
from adamslite.guards import FLOOR, STRICT
from adamslite.system import System

# Points of the first grid for each output interval, and at least in all.
DENSITY, LEAST = 4, 257
# The grid is not made finer than this.
MOST = 2**18
# Points stand in their cells at multiples of this: no regular grid, which a periodic guard could
# always meet at the same phase.
GOLDEN = 0.6180339887498949
# Changes nearer to each other, or to an output time, than this share of the run are one; they are
# located to that of round-off.
SAME, ROUND_OFF = 1e-13, 1e-16


def stops(system: System, times: np.ndarray) -> np.ndarray:
    """Times inside the run over ``times`` (nt,) at which it must stop, and its end; sorted."""
    start, end = float(times[0]), float(times[-1])
    if not system.guarded["clock"] or not end > start:
        return np.array([end])
    same = SAME * (end - start)
    found = _changes(system, _grid(system, times))
    near = times[np.abs(times[:, None] - found).argmin(axis=0)]
    found = np.where(np.abs(near - found) <= same, near, found)
    inside = found[(found > start + same) & (found < end - same)]
    return np.append(inside[np.diff(inside, prepend=-np.inf) > same], end)


def _grid(system: System, times: np.ndarray) -> np.ndarray:
    """Times so dense that no change is missed between two of them."""
    start, end = float(times[0]), float(times[-1])
    count, before = max(LEAST, DENSITY * len(times)), -1
    while True:
        cell = np.arange(count)
        inner = start + (cell + cell * GOLDEN % 1.0) * ((end - start) / count)
        grid = _with_turns(system, np.concatenate([[start], inner, [end]]))
        changes = int((np.diff(_branches(system, grid), axis=0) != 0).sum())
        if changes == before or count >= MOST:
            return grid
        count, before = 3 * count + 1, changes


def _with_turns(system: System, grid: np.ndarray) -> np.ndarray:
    """The grid with more points where a value comes back before it reaches zero."""
    values = sample(system, grid)
    a, b, c = np.abs(values[:-2]), np.abs(values[1:-1]), np.abs(values[2:])
    same = (values[:-2] > 0) == (values[2:] > 0)
    relation = system.kind[: values.shape[1]] != FLOOR
    near = same & relation & (b < a) & (b < c) & (b < np.minimum(a - b, c - b) * 2.0)
    at = np.flatnonzero(near.any(axis=1)) + 1
    more = [np.linspace(grid[k - 1], grid[k + 1], 33) for k in at[: MOST // 33]]
    return np.unique(np.concatenate([grid, *more]))


def _changes(system: System, grid: np.ndarray) -> np.ndarray:
    """Every change between two times of the grid, sorted; a floor may pass several numbers."""
    below, above = grid[:-1], grid[1:]
    found = []
    left, right = _branches(system, below), _branches(system, above)
    while len(below):
        middle = 0.5 * (below + above)
        changed = (left != right).any(axis=1)
        fine = above - below <= ROUND_OFF * (grid[-1] - grid[0])
        fine |= (middle <= below) | (middle >= above)
        found.append(above[changed & fine])
        open_ = changed & ~fine
        below, above, left, right, middle = (x[open_] for x in (below, above, left, right, middle))
        inner = _branches(system, middle)
        below, above = np.concatenate([below, middle]), np.concatenate([middle, above])
        left, right = np.concatenate([left, inner]), np.concatenate([inner, right])
    return np.unique(np.concatenate(found))


def _branches(system: System, times: np.ndarray) -> np.ndarray:
    """Branch of every guard of the clock at ``times``, (nt, guards)."""
    values = sample(system, times)
    kind = system.kind[: values.shape[1]]
    relation = np.where(kind == STRICT, values > 0.0, values >= 0.0).astype(float)
    return np.where(kind == FLOOR, np.floor(values), relation)


def sample(system: System, times: np.ndarray) -> np.ndarray:
    """Values of the guards of the clock at ``times``, (nt, guards)."""
    count = len(system.guarded["clock"])
    kept = system.times, system.record
    system.times = np.ascontiguousarray(times, dtype=float)
    system.record = np.zeros(len(times) * count + 1)
    system.run(CLOCK)
    values = system.record[:-1].reshape(len(times), count)
    system.times, system.record = kept
    return values
