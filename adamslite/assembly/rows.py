"""Constraint rows of a model at a posture: their values, and their derivatives."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from adamslite.assembly.reader import NumberReader
from adamslite.assembly.scope import WIDTH, Crowded, Posture, Unmeasured
from adamslite.elements.bases.constraint import Constraint
from adamslite.model.model import Model
from adamslite.symbolic.duals import Dual
from adamslite.symbolic.sympy_nodes import with_numbers
from adamslite.symbolic.types import Physics


def values(model: Model, posture: Posture, constraint: Constraint) -> np.ndarray:
    """What the rows of a constraint are off by, (n_rows,); not a number where that is unknown."""
    rows = _computed(constraint, NumberReader(model, posture, False))
    return np.array([row.value if isinstance(row, Dual) else row for row in rows], dtype=float)


def gradient(
    model: Model, posture: Posture, constraints: Sequence[Constraint]
) -> tuple[np.ndarray, np.ndarray]:
    """Values (m,) of all rows, and their derivatives (m, 6 n) by the motions of n bodies.

    Rows that constrain velocities are derived by velocities.
    """
    value: list[float] = []
    rows = np.zeros((sum(each.n_rows for each in constraints), WIDTH * len(model.bodies)))
    for constraint in constraints:
        reader, found = _with_slopes(model, posture, constraint)
        first = reader.width if reader.rates else 0
        for row in found:
            number = row if isinstance(row, Dual) else Dual(row)
            for column, body in enumerate(reader.bodies):
                at = first + WIDTH * column
                slope = number.slope[at : at + WIDTH] if np.ndim(number.slope) else 0.0
                rows[len(value), WIDTH * body : WIDTH * (body + 1)] = slope
            value.append(number.value)
    return np.array(value), rows


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
