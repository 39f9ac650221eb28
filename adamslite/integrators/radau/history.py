"""Rows of the history of the Radau formula: states of the stages and what belongs to them."""

from __future__ import annotations

# Rows of y: the start of the step, behind it its stages and their rates; the step before; the start
# with q as it is.
RATES, BEFORE, ORIGIN, Y_ROWS = 3, 7, 11, 12


# Rows of z: the stages, those of the step before.
Z_ROWS = 6
