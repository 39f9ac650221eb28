"""The nearest posture in which the holonomic constraints hold.

    min sum w_i^2 (q_i - q_i0)^2  subject to g(0, q) = 0

by Gauss-Newton: each step is W^-2 G^T lam with (G W^-2 G^T) lam = g, redundant rows being shared by
a small multiple of the unit matrix.  A step that does not reduce |g| is halved.  It is the method
of :mod:`adamslite.analyses.initial.conditions`, without native code.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from adamslite.assembly.rank import MOST_DENSE, SHARED, solved
from adamslite.assembly.rows import gradient, sparse_gradient, values
from adamslite.assembly.scope import WIDTH, Posture
from adamslite.elements.bases.constraint import Constraint
from adamslite.model.model import Model
from adamslite.model.scaling import coordinate_weights, turned

MAX_ITERATIONS, HALVINGS = 60, 12
# |g| below this share of the size of the model counts as closed; beyond that one it is open.
CLOSED, OPEN = 1e-13, 1e-9
# Largest turn of a part in one step [rad].
MOST_TURN = 0.5


@dataclass
class Closing:
    """Where the constraints hold, or nearly.

    ``kept``: the holonomic ones; ``drawn``, ``gaps``: what the rows of each are off by at the start
    and in the end; ``closed``: whether the posture is one that a run can start from.
    """

    posture: Posture
    kept: list[Constraint]
    drawn: list[np.ndarray]
    gaps: list[np.ndarray]
    closed: bool


def close(
    model: Model, constraints: Sequence[Constraint], start: Posture, closed: float = CLOSED
) -> Closing:
    """The posture nearest to ``start`` in which the holonomic ones of some constraints hold.

    ``closed``: the share of the size of the model that is small enough.
    """
    kept = [each for each in constraints if not each.is_rate(model)]
    with np.errstate(all="ignore"):  # what has no value stays so
        return _closed(model, kept, start, closed)


def _closed(model: Model, kept: list[Constraint], start: Posture, closed: float) -> Closing:
    scale = 1.0 / coordinate_weights(model).ravel()
    size = max(1.0, float(np.abs(start.x).max(initial=0.0)))
    at, first = start, rows_of(model, start, kept)
    g = first
    for _ in range(MAX_ITERATIONS):
        if not np.isfinite(g).all() or np.abs(g).max(initial=0.0) <= closed * size:
            break
        step = _least_change(model, at, kept, scale, g)
        if not np.isfinite(step).all():
            break
        found = _damped(model, kept, at, step * scale, g)
        if found is None:
            break
        at, g = found
    edges = np.cumsum([each.n_rows for each in kept])[:-1]
    drawn, gaps = (np.split(each, edges) if kept else [] for each in (first, g))
    off = float(np.abs(g).max(initial=0.0))
    return Closing(at, kept, drawn, gaps, bool(off <= OPEN * size))


def rows_of(model: Model, at: Posture, constraints: Sequence[Constraint]) -> np.ndarray:
    """The rows of some constraints, one after the other."""
    return np.concatenate([np.zeros(0), *(values(model, at, each) for each in constraints)])


def _least_change(
    model: Model, at: Posture, kept: Sequence[Constraint], scale: np.ndarray, g: np.ndarray
) -> np.ndarray:
    """The smallest scaled step that removes ``g`` to first order; not a number where there is
    none.
    """
    if len(g) > MOST_DENSE:
        rows = sparse_gradient(model, at, kept).multiply(scale[None, :]).tocsr()
        return rows.T @ solved(rows, g)
    dense = gradient(model, at, kept) * scale
    square = dense @ dense.T
    square[np.diag_indices_from(square)] += SHARED * float(np.diag(square).max())
    try:
        return dense.T @ np.linalg.solve(square, g)
    except np.linalg.LinAlgError:
        return np.full(len(scale), np.nan)


def _damped(
    model: Model, kept: Sequence[Constraint], at: Posture, step: np.ndarray, g: np.ndarray
) -> tuple[Posture, np.ndarray] | None:
    """The posture after the step, or the longest half, quarter ... of it that reduces |g|."""
    turns = np.linalg.norm(step.reshape(-1, WIDTH)[:, 3:], axis=1)
    share = min(1.0, MOST_TURN / max(1e-300, float(turns.max(initial=0.0))))
    for _ in range(HALVINGS):
        new = moved(at, share * step)
        value = rows_of(model, new, kept)
        if np.linalg.norm(value) < np.linalg.norm(g):
            return new, value
        share *= 0.5
    return None


def moved(at: Posture, step: np.ndarray) -> Posture:
    """The posture less a step (6 n,) of places and rotations in ground axes."""
    change = step.reshape(-1, WIDTH)
    attitude = [turned(a, -c[3:]) for a, c in zip(at.attitude, change, strict=True)]
    return Posture(at.x - change[:, :3], np.array(attitude).reshape(-1, 3, 3), at.speed)
