"""Constraint rows of a model at a posture: their values, and their derivatives."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from math import isnan
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from adamslite.assembly.reader import NumberReader
from adamslite.assembly.scope import WIDTH, Crowded, Posture, Unmeasured
from adamslite.elements.bases.constraint import Constraint
from adamslite.model.model import Model
from adamslite.symbolic.duals import Dual
from adamslite.symbolic.formulas import with_numbers
from adamslite.symbolic.types import Physics

if TYPE_CHECKING:  # only large models need sparse matrices
    from scipy.sparse import csr_array


def values(model: Model, posture: Posture, constraint: Constraint) -> np.ndarray:
    """What the rows of a constraint are off by, (n_rows,); not a number where that is unknown."""
    return values_by(constraint, NumberReader(model, posture, False))


def values_by(constraint: Constraint, reader: NumberReader) -> np.ndarray:
    """The same by a reader of any model."""
    rows = _computed(constraint, reader)
    return np.array([row.value if isinstance(row, Dual) else row for row in rows], dtype=float)


class Block(NamedTuple):
    """Derivatives of a row by the motion of a body: six, from the first column on."""

    row: int
    first: int
    slope: np.ndarray


def gradient(model: Model, posture: Posture, constraints: Sequence[Constraint]) -> np.ndarray:
    """Derivatives (m, 6 n) of all rows by the motions of n bodies.

    Rows that constrain velocities are derived by velocities.
    """
    rows = np.zeros((sum(each.n_rows for each in constraints), WIDTH * len(model.bodies)))
    for row, first, slope in blocks(model, posture, constraints):
        rows[row, first : first + WIDTH] = slope
    return rows


def sparse_gradient(model: Model, posture: Posture, constraints: Sequence[Constraint]) -> csr_array:
    """The same, for thousands of rows."""
    from scipy.sparse import csr_array

    found = list(blocks(model, posture, constraints))
    shape = (sum(each.n_rows for each in constraints), WIDTH * len(model.bodies))
    at = np.repeat([each.row for each in found], WIDTH)
    columns = np.array([each.first for each in found])[:, None] + np.arange(WIDTH)
    slopes = np.array([each.slope for each in found])
    return csr_array((slopes.ravel(), (at, columns.ravel())), shape=shape)


def blocks(model: Model, posture: Posture, constraints: Sequence[Constraint]) -> Iterator[Block]:
    """The derivatives that are not zero for every posture."""
    number = 0
    for constraint in constraints:
        reader, found = _with_slopes(model, posture, constraint)
        start = reader.width if reader.rates else 0
        for row in found:
            slope = row.slope if isinstance(row, Dual) else 0.0
            for column, body in enumerate(reader.bodies if np.ndim(slope) else ()):
                at = start + WIDTH * column
                yield Block(number, WIDTH * body, slope[at : at + WIDTH])
            if isinstance(row, Dual) and isnan(row.value):
                yield Block(number, 0, np.full(WIDTH, np.nan))
            number += 1


def _with_slopes(
    model: Model, posture: Posture, constraint: Constraint
) -> tuple[NumberReader, list[Dual]]:
    room, rates = 2, constraint.is_rate(model)
    while True:
        reader = NumberReader(model, posture, True, rates, room)
        try:
            return reader, _computed(constraint, reader)
        except Crowded:
            room *= 2


def _computed(constraint: Constraint, reader: NumberReader) -> list[Dual]:
    physics: Physics = type(constraint)
    try:
        with with_numbers():
            return physics.constraints(reader.seen(constraint), reader)
    except Unmeasured:
        return [Dual(float("nan"))] * constraint.n_rows
