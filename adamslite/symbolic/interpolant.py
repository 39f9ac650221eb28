"""Tables of interpolated curves, as data for :mod:`adamslite.kernels.code.lookup`.

==============  ==================================================================================
linear          straight lines from point to point
akima           slopes from the four chords next to a point; bends break at the points
natural         cubic spline, bends are zero at both ends
not-a-knot      cubic spline, third derivatives continuous next to both ends
periodic        cubic spline whose slopes and bends are the same at both ends, as the values are
==============  ==================================================================================

Beyond its ends a table goes on as one of

==============  ==================================================================================
parabola        through the outermost three points
tangent         the straight line with the slope at the end
constant        the value at the end
piece           the cubic of the outermost piece
==============  ==================================================================================

References: Akima, J. ACM 17 (1970) 589-602; de Boor, A Practical Guide to Splines, 2001, ch. IV.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import factorial
from typing import TYPE_CHECKING

if TYPE_CHECKING:  # reading a deck does without numpy
    import numpy as np

KINDS = ("linear", "akima", "natural", "not-a-knot", "periodic")
BEYOND = ("parabola", "tangent", "constant", "piece")


@dataclass(frozen=True, eq=False)
class Interpolant:
    """Curves over common knots.

    ``data``: all that follows in one array, laid out as :mod:`adamslite.kernels.code.lookup` says;
    ``knots`` (n,), ascending; ``places`` (m,) of the curves along z, ascending; ``pieces`` (n + 1,
    m, 4) coefficients.
    """

    data: np.ndarray
    knots: np.ndarray
    places: np.ndarray
    pieces: np.ndarray

    def at(self, x: np.ndarray, order: int = 0) -> np.ndarray:
        """Values (k, m) of all curves, or of a derivative, at ``x`` (k,)."""
        import numpy as np

        piece = np.searchsorted(self.knots, x, side="right")
        t = (x - self.knots[np.maximum(piece - 1, 0)])[:, None]
        return _polynomial(self.pieces[piece], t, order)


def interpolant(
    x: np.ndarray,
    y: np.ndarray,
    kind: str,
    beyond: str = "parabola",
    places: np.ndarray | None = None,
) -> Interpolant:
    """Curves of a kind through the columns of ``y`` (n, m) at ``x`` (n,), which ascends.

    ``places`` (m,): where along z each curve lies.
    """
    import numpy as np

    x, y = np.asarray(x, dtype=float), np.asarray(y, dtype=float)
    inner = _inner(x, y, kind)
    ends = [_end(x, y, inner, beyond, last) for last in (False, True)]
    return joined(x, np.concatenate([ends[0][None], inner, ends[1][None]]), places)


def joined(knots: np.ndarray, pieces: np.ndarray, places: np.ndarray | None = None) -> Interpolant:
    """The table of given ``pieces`` (n + 1, m, 4) over ``knots`` (n,)."""
    import numpy as np

    n, (_, m, _) = len(knots), pieces.shape
    places = np.arange(float(m)) if places is None else np.asarray(places, dtype=float)
    data = np.concatenate([[n, m], knots, places, pieces.ravel()])
    views = np.split(data, [2, 2 + n, 2 + n + m])[1:]
    return Interpolant(data, views[0], views[1], views[2].reshape(pieces.shape))


def _inner(x: np.ndarray, y: np.ndarray, kind: str) -> np.ndarray:
    """Coefficients (n - 1, m, 4) between the knots."""
    import numpy as np
    from scipy.interpolate import Akima1DInterpolator, CubicSpline

    if kind == "linear":
        flat = np.zeros_like(y[1:])
        slope = np.diff(y, axis=0) / np.diff(x)[:, None]
        return np.stack([y[:-1], slope, flat, flat], axis=-1)
    found = Akima1DInterpolator(x, y) if kind == "akima" else CubicSpline(x, y, bc_type=kind)
    return np.moveaxis(found.c[::-1], 0, -1)


def _end(x: np.ndarray, y: np.ndarray, inner: np.ndarray, beyond: str, last: bool) -> np.ndarray:
    """Coefficients (m, 4) before the first knot or behind the last one, counted from it."""
    import numpy as np

    at, outer = (-1, inner[-1]) if last else (0, inner[0])
    t = x[-1] - x[-2] if last else 0.0
    found = np.stack([_polynomial(outer, t, k) / factorial(k) for k in range(4)], axis=-1)
    found[:, 0] = y[at]
    if beyond == "piece":
        return found
    if beyond == "parabola":
        found[:, 1:3] = _parabola(x[-3:][::-1], y[-3:][::-1]) if last else _parabola(x[:3], y[:3])
    found[:, {"parabola": 3, "tangent": 2, "constant": 1}[beyond] :] = 0.0
    return found


def _parabola(x: np.ndarray, y: np.ndarray) -> np.ndarray:
    """Slope at the first point and half the bend of the parabola through three, (m, 2)."""
    import numpy as np

    slopes = np.diff(y, axis=0) / np.diff(x)[:, None]
    half_bend = (slopes[-1] - slopes[0]) / (x[-1] - x[0]) if len(x) > 2 else 0.0 * y[0]
    return np.stack([slopes[0] + (x[0] - x[1]) * half_bend, half_bend], axis=-1)


def _polynomial(a: np.ndarray, t: np.ndarray | float, order: int) -> np.ndarray:
    """Derivative of a_0 + a_1 t + a_2 t^2 + a_3 t^3; ``a`` (..., 4)."""
    total = 0.0 * a[..., 0]
    for k in range(3, order - 1, -1):
        total = total * t + factorial(k) // factorial(k - order) * a[..., k]
    return total
