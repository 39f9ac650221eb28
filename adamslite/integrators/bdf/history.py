"""The history of the BDF: its rows of differences, and the room that they take."""

from __future__ import annotations

MAX_ORDER = 5
# Rows of differences, and behind them what positions are too coarse to take.
ROWS = MAX_ORDER + 3
LOST = ROWS


def room(w: int) -> int:
    """Numbers of a history of rows of ``w``, and of the matrices that change its step behind it."""
    size = MAX_ORDER + 1
    return (LOST + 1) * w + 3 * size * size + size
