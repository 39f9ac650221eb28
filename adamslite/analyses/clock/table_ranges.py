"""The least and the largest value of a table over spans of its argument.

Over part of a piece a cubic is largest at an end or where its slope vanishes; over whole pieces
that is known from before, for every run of 2^k neighbours.
"""

from __future__ import annotations

from math import factorial
from typing import TYPE_CHECKING
from weakref import WeakKeyDictionary

import numpy as np

from adamslite.symbolic.interpolant import pieces_at

if TYPE_CHECKING:
    from adamslite.symbolic.interpolant import Interpolant

# A curve or derivative jumps at a knot where its two sides differ by more than this share of its
# largest value.
JUMP = 1e-7


class Ranges:
    """Of one curve of a table, or of its derivative of an ``order``."""

    def __init__(self, table: Interpolant, curve: int, order: int) -> None:
        self.knots = table.knots
        a = table.pieces[:, curve]
        b = [factorial(j + order) / factorial(j) * a[:, j + order] for j in range(4 - order)]
        self.cubics = np.stack([*b, *[0.0 * a[:, 0]] * order], axis=-1)
        width = np.diff(self.knots)
        least, most = extent(self.cubics[1:-1], 0.0 * width, width)
        self.runs = [(least, most)]
        while 2 ** len(self.runs) <= len(width):
            half = 2 ** (len(self.runs) - 1)
            low, high = self.runs[-1]
            self.runs.append(
                (np.minimum(low[:-half], low[half:]), np.maximum(high[:-half], high[half:]))
            )
        self.jumps = self._jumps(np.append(0.0, width))

    def _jumps(self, width: np.ndarray) -> np.ndarray:
        """At how many of the first k knots, k = 0 .. n, there is a jump."""
        before = value(self.cubics[:-1], width)
        behind = self.cubics[1:, 0]
        size = max(np.abs(before).max(), np.abs(behind).max())
        return np.append(0, np.cumsum(np.abs(behind - before) > JUMP * size))

    def within(self, low: np.ndarray, high: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Least and largest value from ``low`` to ``high``."""
        first, last = (pieces_at(self.knots, x) for x in (low, high))
        n = len(self.knots)
        left = np.where(first == last, high, self.knots[np.minimum(first, n - 1)])
        right = np.where(first == last, low, self.knots[np.maximum(last - 1, 0)])
        parts = [self._on_piece(first, low, left), self._on_piece(last, right, high)]
        parts.append(self._whole(first, last - 1))
        least = np.minimum.reduce([part[0] for part in parts])
        most = np.maximum.reduce([part[1] for part in parts])
        return np.where(np.isnan(least), -np.inf, least), np.where(np.isnan(most), np.inf, most)

    def _on_piece(
        self, piece: np.ndarray, low: np.ndarray, high: np.ndarray
    ) -> tuple[np.ndarray, np.ndarray]:
        origin = self.knots[np.maximum(piece - 1, 0)]
        return extent(self.cubics[piece], low - origin, high - origin)

    def _whole(self, first: np.ndarray, end: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Over the pieces between two knots, counted from 0; nothing where there is none."""
        least, most = np.full(np.shape(first), np.inf), np.full(np.shape(first), -np.inf)
        count = end - first
        for k, (low, high) in enumerate(self.runs):
            at = (count >= 2**k) & (count < 2 ** (k + 1))
            one, other = first[at], end[at] - 2**k
            least[at] = np.minimum(low[one], low[other])
            most[at] = np.maximum(high[one], high[other])
        return least, most

    def jumps_within(self, low: np.ndarray, high: np.ndarray) -> np.ndarray:
        """Whether there is a jump behind ``low`` and up to ``high``."""
        first, last = (pieces_at(self.knots, x) for x in (low, high))
        return self.jumps[last] > self.jumps[first]


def value(a: np.ndarray, t: np.ndarray) -> np.ndarray:
    """a_0 + a_1 t + a_2 t^2 + a_3 t^3; ``a`` (n, 4), ``t`` (n,)."""
    return a[:, 0] + t * (a[:, 1] + t * (a[:, 2] + t * a[:, 3]))


def extent(a: np.ndarray, low: np.ndarray, high: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Least and largest value of cubics ``a`` (n, 4) from ``low`` to ``high`` (n,)."""
    with np.errstate(all="ignore"):
        q = a[:, 2] + np.copysign(np.sqrt(a[:, 2] ** 2 - 3.0 * a[:, 3] * a[:, 1]), a[:, 2])
        level = [-q / (3.0 * a[:, 3]), -a[:, 1] / q]
        level = [np.clip(np.where(np.isnan(t), low, t), low, high) for t in level]
        values = [value(a, t) for t in (low, high, *level)]
    return np.minimum.reduce(values), np.maximum.reduce(values)


def ranges(table: Interpolant, curve: int, order: int) -> Ranges:
    """The ranges of a curve, computed once."""
    known = _known.setdefault(table, {})
    if (curve, order) not in known:
        known[curve, order] = Ranges(table, curve, order)
    return known[curve, order]


_known: WeakKeyDictionary[Interpolant, dict[tuple[int, int], Ranges]] = WeakKeyDictionary()
