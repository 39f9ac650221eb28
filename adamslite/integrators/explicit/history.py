"""Rows of the history of the explicit formula: stages, states and what belongs to the bodies."""

from __future__ import annotations

# Rows of the history, of 2 n + ns numbers each: stages from 0 (those behind K_NEW are for dense
# output), the accepted state, the new one, one in between, the factors of ERROR (SCALE), the slope
# of the interpolation. Behind them are the inverse inertias, 9 of every body, or what is known of
# masses, 6 of each.
K_NEW, LATE_STAGES = 12, 3
OLD = K_NEW + LATE_STAGES + 1
NEXT_STATE, BETWEEN, SCALES, SLOPE = OLD + 1, OLD + 2, OLD + 3, OLD + 4
INVERSE = HISTORY_ROWS = SLOPE + 1

# By component: numbers that processors take at once, and rows of the tables: 1/m, accelerations of
# gravity and forces by component, masses, and the effective masses.
LINE = 4
TABLES = 3 + 3 + 3 + 1 + 9
