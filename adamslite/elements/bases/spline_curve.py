"""A cubic spline through points of space, over the length of its chords, or guided by them.

Equation (c the curve, s from 0 at the first point to 1 at the last)::

    c(s_k) = point k,     s_k = length of the chords up to point k over that of all

Guided by control points P it is their cubic B-spline over equal steps of s, with the first and the
last point at open ends::

    c(s) = sum_k P_k B_k(s)

Open ends take the third derivative from their neighbours ("not a knot"), a closed curve goes
through its seam with slope and bend.
Reference: de Boor, A Practical Guide to Splines, 2001, chapter IV.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

from adamslite.symbolic.interpolant import continued, interpolant

if TYPE_CHECKING:  # reading a deck does without numpy
    import numpy as np

    from adamslite.symbolic.interpolant import Interpolant

# How finely the nearest point is looked for before it is polished, per piece; steps of that.
SAMPLES, POLISHED = 20, 20
DEGREE = 3
# Of parameters from 0 to 1.
TINY = 1e-12


@dataclass(frozen=True, eq=False)
class SplineCurve:
    """``table``: x, y and z over s; ``length`` of all chords; ``closed``: s begins again at 1."""

    table: Interpolant
    length: float
    closed: bool

    def at(self, s: np.ndarray, order: int = 0) -> np.ndarray:
        """Points (n, 3) or derivatives at ``s`` (n,)."""
        import numpy as np

        return self.table.at(s - np.floor(s) if self.closed else s, order)

    def nearest(self, point: np.ndarray) -> float:
        """Parameter of the curve's point nearest to ``point`` (3,): Newton from the nearest sample,
        never to a point that is further away.
        """
        s = self._nearest_sample(point)
        for _ in range(POLISHED):
            gap, slope, bend = self.at(s) - point, self.at(s, 1), self.at(s, 2)
            down = (slope * slope + gap * bend).sum()
            if down <= 0.0:
                break
            step = (gap * slope).sum() / down
            while ((self.at(s - step) - point) ** 2).sum() > (gap * gap).sum():
                step *= 0.5
            if s - step == s:
                break
            s = s - step
        return float(s[0])

    def _nearest_sample(self, point: np.ndarray) -> np.ndarray:
        """Parameter (1,) of the nearest of all samples, on the pieces that may come nearest."""
        import numpy as np

        first, span = self.table.knots[:-1], np.diff(self.table.knots)
        away = np.linalg.norm(self.table.pieces[1:-1, :, 0] - point, axis=1)
        near = np.flatnonzero(away - self._reach <= away.min())
        least, best = np.inf, first[:1]
        for share in np.linspace(0.0, 1.0, SAMPLES + 1):
            s = first[near] + share * span[near]
            away = ((self.table.at(s) - point) ** 2).sum(axis=1)
            nearest = int(np.argmin(away))
            if away[nearest] < least:
                least, best = away[nearest], s[nearest : nearest + 1]
        return best

    @cached_property
    def _reach(self) -> np.ndarray:
        """How far a piece goes from its first point at most, (n - 1,)."""
        import numpy as np

        span, inner = np.diff(self.table.knots), self.table.pieces[1:-1]
        return sum(np.linalg.norm(inner[:, :, k], axis=1) * span**k for k in (1, 2, 3))


def through(points: np.ndarray, closed: bool) -> SplineCurve:
    """The spline through ``points`` (n, 3); a closed one ends where it begins."""
    import numpy as np

    points = np.asarray(points, dtype=float)
    chords = np.linalg.norm(np.diff(points, axis=0), axis=1)
    apart = np.append(True, chords > 0.0)
    points, chords = points[apart], chords[chords > 0.0]
    length = float(chords.sum())
    s = np.append(np.cumsum(np.append(0.0, chords[:-1])) / length, 1.0)
    if not closed:
        return SplineCurve(interpolant(s, points, "not-a-knot", "piece"), length, False)
    ring = points.copy()
    ring[-1] = ring[0]
    return SplineCurve(interpolant(s, ring, "periodic", "piece"), length, True)


def guided(points: np.ndarray, closed: bool) -> SplineCurve:
    """The cubic B-spline of control points (n, 3), n at least 4; a closed one ends where it begins,
    and the last point is the first again.
    """
    import numpy as np
    from scipy.interpolate import BSpline, PPoly

    points = np.asarray(points, dtype=float)
    if closed:
        points = np.concatenate([points[:-1], points[:DEGREE]])
        knots = np.arange(-DEGREE, len(points) + 1.0) / (len(points) - DEGREE)
    else:
        inner = np.linspace(0.0, 1.0, len(points) - DEGREE + 1)
        knots = np.concatenate([np.zeros(DEGREE), inner, np.ones(DEGREE)])
    found = [PPoly.from_spline(BSpline(knots, column, DEGREE)) for column in points.T]
    starts, ends = knots[:-1], knots[1:]
    there = (starts < ends) & (starts > -TINY) & (ends < 1.0 + TINY)
    x = np.append(starts[there], 1.0)
    pieces = np.stack([each.c[::-1, there].T for each in found], axis=1)
    table = continued(x, pieces)
    length = float(np.linalg.norm(np.diff(table.at(x), axis=0), axis=1).sum())
    return SplineCurve(table, length, closed)
