"""Rows of the constraints: their numbers, their derivatives, the weights of what they move."""

from __future__ import annotations

import numpy as np

from adamslite.equations.system import System
from adamslite.integrators import contract
from adamslite.integrators.contract import JACOBIAN
from adamslite.model.scaling import coordinate_weights

SPEEDS = contract.VELOCITY_ROWS | contract.RATE_ROWS


def gradient(system: System, phases: int, kind: int, rows: np.ndarray) -> np.ndarray:
    """Derivative of constraint rows with respect to positions (kind 0) or velocities (1), dense."""
    system.coef[:5] = 0.0
    system.coef[kind] = 1.0
    system.run(JACOBIAN, phases)
    return system.dense_jacobian()[rows, : system.n]


def constraint_gradient(system: System) -> np.ndarray:
    """G: derivative of every constraint row with respect to velocities, (m, n)."""
    return gradient(system, SPEEDS, 1, velocity_rows(system))


def velocity_rows(system: System) -> np.ndarray:
    """Rows of the velocity conditions: holonomic ones (at mu when there is one), then rates."""
    first = system.nz - system.holonomic if system.numbering.stabilised else system.n
    rates = np.arange(system.n + system.holonomic, system.n + system.m)
    return np.concatenate([np.arange(first, first + system.holonomic), rates])


def weights(system: System, speeds: bool = False) -> np.ndarray:
    """(n,) weights of the coordinates, or of their velocities."""
    model = system.model
    table = model.once_of_bodies(("weights", speeds), lambda: coordinate_weights(model, speeds))
    widths = np.array(system.widths[: len(model.bodies)], dtype=int)
    return table[np.arange(table.shape[1]) < widths[:, None]]
