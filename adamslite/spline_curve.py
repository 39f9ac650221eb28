"""A cubic spline through points of space, in truncated powers.

Equation (knots t_k inside 0..1, <x> = max(x, 0))::

    c(s) = a0 + a1 s + a2 s^2 + a3 s^3 + sum b_k <s - t_k>^3

Every term is smooth enough for second derivatives, and a kernel evaluates it without searching.
Reference: de Boor, A Practical Guide to Splines, 2001, chapter VIII.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

# How finely the nearest point is looked for before it is polished, per piece.
SAMPLES = 20


@dataclass(frozen=True)
class SplineCurve:
    """``knots`` (k,); ``weights`` (4 + k, 3), a0..a3 and b for x, y, z; ``length`` of chords."""

    knots: tuple[float, ...]
    weights: Any
    length: float

    def basis(self, s: Any, order: int = 0) -> Any:
        """Values (n, 4 + k) of the basis or of a derivative at ``s`` (n,)."""
        return _basis(self.knots, s, order)

    def nearest(self, point: Any) -> float:
        """Parameter of the curve's point nearest to ``point`` (3,)."""
        import numpy as np

        grid = np.linspace(0.0, 1.0, SAMPLES * (len(self.knots) + 3))
        away = self.basis(grid) @ self.weights - point
        s = grid[[int(np.argmin((away**2).sum(axis=1)))]]
        for _ in range(20):
            gap, slope, bend = (self.basis(s, n) @ self.weights for n in range(3))
            gap = gap - point
            down = (slope * slope + gap * bend).sum()
            if down <= 0.0:
                break
            s = s - (gap * slope).sum() / down
        return float(s[0])


def through(points: Any, closed: bool) -> SplineCurve:
    """The spline through ``points`` (n, 3); a closed one ends where it begins."""
    import numpy as np

    points = np.asarray(points, dtype=float)
    chords = np.linalg.norm(np.diff(points, axis=0), axis=1)
    length = float(chords.sum())
    t = np.concatenate([[0.0], np.cumsum(chords) / length])
    knots = t[1:-1] if closed else t[2:-2]
    rows, wanted = [_basis(knots, t, 0)], [points]
    if closed:
        ends = np.array([0.0, 1.0])
        rows += [np.diff(_basis(knots, ends, n), axis=0) for n in (1, 2)]
        wanted.append(np.zeros((2, 3)))
    matrix = np.concatenate(rows)
    # Fewer than four points leave powers over: the smallest weights do.
    weights = np.linalg.lstsq(matrix, np.concatenate(wanted), rcond=None)[0]
    weights[np.abs(weights) < 1e-13 * length] = 0.0
    return SplineCurve(tuple(float(k) for k in knots), weights, length)


def _basis(knots: Any, s: Any, order: int) -> Any:
    import numpy as np

    factor = (1.0, 3.0, 6.0)[order]
    powers = [np.polynomial.Polynomial.basis(n).deriv(order)(s) + 0.0 * s for n in range(4)]
    beyond = [factor * np.maximum(s - k, 0.0) ** (3 - order) for k in knots]
    return np.array(powers + beyond).T
