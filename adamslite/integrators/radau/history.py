"""Rows of the history of the Radau formula: states of the stages and what belongs to them."""

from __future__ import annotations

# Rows of y: the start of the step, behind it its stages; the start with q as it is; rates of the
# stages (those of the first one are RATES + 1); the step before.
ORIGIN, RATES, BEFORE, Y_ROWS = 4, 4, 8, 12
# What a step is known by: its start and its stages, of y and of z; rates follow.
KEPT_ROWS, KEPT_Z = 5, 3


# Rows of z: the stages, those of the step before.
Z_ROWS = 6
