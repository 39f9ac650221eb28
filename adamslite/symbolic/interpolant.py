"""Tables of interpolated curves, as data for :mod:`adamslite.kernels.code.lookup`.

==============  ==================================================================================
linear          straight lines from point to point
akima           slopes from the four chords next to a point; bends break at the points
natural         cubic spline, bends are zero at both ends
not-a-knot      cubic spline, third derivatives continuous next to both ends
periodic        cubic spline whose slopes and bends are the same at both ends, as the values are
==============  ==================================================================================

Beyond its ends a table continues as one of

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
    from collections.abc import Iterator

    import numpy as np
    from numpy.typing import ArrayLike

BEYOND = ("parabola", "tangent", "constant", "piece")
KINDS = ("linear", "akima", "natural", "not-a-knot", "periodic")
# Chords bend by less than this share of the sharpest bend: straight to round-off.
STRAIGHT = 1e-9
# Chords bend by round-off up to this share of the values over the distance.
ROUND_OFF = 1e-15
# What pieces that are one curve may be off a cubic, as a share of their range; what counts as at a
# knot, as a share of the shorter piece next to it; beyond all places.
LOOSE, KNOT, FAR = 0.01, 0.1, 1e200
# A neighbour that counts less than this is left out; rounds at most.
NEGLIGIBLE, ROUNDS = 1e-18, 50


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

        piece = pieces_at(self.knots, x)
        t = (x - self.knots[np.maximum(piece - 1, 0)])[:, None]
        return _polynomial(self.pieces[piece], t, order)


def pieces_at(knots: np.ndarray, x: np.ndarray) -> np.ndarray:
    """Numbers of the pieces that ``x`` lies on, as in :mod:`adamslite.kernels.code.lookup`."""
    import numpy as np

    return np.searchsorted(knots, x, side="right") - (np.asarray(x) == knots[-1])


def interpolant(
    x: ArrayLike, y: ArrayLike, kind: str, beyond: str = "parabola", places: ArrayLike | None = None
) -> Interpolant:
    """Curves of a kind through the columns of ``y`` (n, m) at ``x`` (n,), which ascends.

    ``places`` (m,): where along z each curve lies.
    """
    import numpy as np

    x, y = np.asarray(x, dtype=float), np.asarray(y, dtype=float)
    inner = _inner(x, y, kind)
    ends = [_end(x, y, inner, beyond, last) for last in (False, True)]
    if kind == "linear":
        kept = corners(x, y)
        inner = inner[kept[:-1]]
        return joined(x[kept], np.concatenate([ends[0][None], inner, ends[1][None]]), places)
    return joined(x, np.concatenate([ends[0][None], inner, ends[1][None]]), places)


def corners(x: np.ndarray, y: np.ndarray) -> np.ndarray:
    """Where straight lines through the points ``y`` (n, m) bend by more than round-off, and both
    ends, (n,): a step of an integrator may pass the other knots like any place of a line.
    """
    import numpy as np

    h = np.diff(x)[:, None]
    bends, size = np.abs(np.diff(np.diff(y, axis=0) / h, axis=0)), np.abs(y)
    round_off = ROUND_OFF * (size[:-2] + 2.0 * size[1:-1] + size[2:]) / np.minimum(h[:-1], h[1:])
    return np.concatenate([[True], (bends > round_off).any(axis=1), [True]])


def continued(knots: np.ndarray, pieces: np.ndarray) -> Interpolant:
    """The table of given ``pieces`` (n - 1, m, 4) between the knots, the outer two of which
    continue beyond them.
    """
    import numpy as np

    t = np.append(np.zeros(len(pieces)), knots[-1] - knots[-2])
    all_at = np.concatenate([pieces, pieces[-1:]])
    y = np.stack([_polynomial(a, each, 0) for a, each in zip(all_at, t, strict=True)])
    ends = [_end(knots, y, pieces, "piece", last) for last in (False, True)]
    return joined(knots, np.concatenate([ends[0][None], pieces, ends[1][None]]))


def joined(knots: np.ndarray, pieces: np.ndarray, places: ArrayLike | None = None) -> Interpolant:
    """The table of given ``pieces`` (n + 1, m, 4) over ``knots`` (n,)."""
    import numpy as np

    n, (_, m, _) = len(knots), pieces.shape
    places = np.arange(float(m)) if places is None else np.asarray(places, dtype=float)
    data = np.concatenate([[n, m], knots, places, pieces.ravel()])
    views = np.split(data, [2, 2 + n, 2 + n + m])[1:]
    return Interpolant(data, views[0], views[1], views[2].reshape(pieces.shape))


def piece_numbers(x: np.ndarray) -> Interpolant:
    """A table whose whole part is the number of the piece that a place lies on: it rises from k to
    k + 1 on piece k, and is 1/2 and n + 1/2 before and beyond all knots.
    """
    import numpy as np

    count = np.arange(len(x) + 1.0)
    pieces = np.zeros((len(x) + 1, 1, 4))
    pieces[:, 0, 0] = count
    pieces[[0, -1], 0, 0] += 0.5
    pieces[1:-1, 0, 1] = 1.0 / np.diff(x)
    return joined(np.asarray(x, dtype=float), pieces)


def reach(table: Interpolant, order: int, closed: bool, tight: float) -> np.ndarray:
    """How far a step of an integrator may go in a table, or in its derivative of an ``order``.

    The pieces between two knots are passed in one step where they are one smooth curve: where they
    are off the cubic through values and slopes at both knots by at most ``tight`` of the range of
    the table; or by ``LOOSE`` of their own range, halves of them by as much less as they are of a
    curve with a fourth derivative, and those halves may be passed.  What is narrower than a step
    fails one of these tests, whatever its height, while curves with many knots pass them.

    Returns
    -------
    n, period, x_1, and for steps upwards, then for those downwards with -x in place of x: n knots
    at which the next piece begins, of n + 1 pieces the place up to which steps aim, and the place
    that they may not pass.
    """
    import numpy as np

    knots, pieces = table.knots, table.pieces
    period = knots[-1] - knots[0] if closed else 0.0
    if closed:
        knots = np.concatenate([knots[:-1] - period, knots[:-1], knots + period])
        pieces = np.concatenate([pieces[:1], *[pieces[1:-1]] * 3, pieces[-1:]])
    n, more = len(knots), 2 ** len(pieces).bit_length()
    away = (knots[-1] - knots[0]) * np.arange(1, more + 1) / more
    ends = np.concatenate([knots[0] - away[::-1], knots, knots[-1] + away])
    own = np.repeat(np.arange(n + 1), [more, *[1] * (n - 1), more])
    start = ends[:-1] - knots[np.maximum(own - 1, 0)]
    up, down = np.arange(len(own)) + 1, np.arange(len(own))
    for length, first in _smooth_runs(pieces[own], start, ends, order, tight):
        up[first], down[first + length - 1] = first + length, first
    sides, h = [], np.diff(ends)
    close = KNOT * np.minimum(h[more - 1 : more + n - 1], h[more : more + n])
    for sign, bound in ((1.0, up[more - 1 : more + n]), (-1.0, down[more - 1 : more + n])):
        outside = (bound < more) | (bound > more + n - 1)
        bound = np.where(outside, more, bound)
        aim = np.where(outside, sign * FAR, ends[bound])
        side = [knots - sign * close, aim, aim + sign * KNOT * h[bound - (sign < 0.0)]]
        sides += side if sign > 0.0 else [-each[::-1] for each in side]
    return np.concatenate([[n, period, table.knots[0]], *sides])


def reach_size(table: Interpolant, closed: bool) -> int:
    """How many numbers :func:`reach` returns."""
    return 7 + 6 * (3 * len(table.knots) - 2 if closed else len(table.knots))


def _smooth_runs(
    pieces: np.ndarray, start: np.ndarray, ends: np.ndarray, order: int, tight: float
) -> Iterator[tuple[int, np.ndarray]]:
    """Numbers 2, 4, 8 ... of pieces, and the first pieces of those that are one smooth curve."""
    import numpy as np

    start, h = start[:, None], np.diff(ends)[:, None]
    a, r, b, s = (_polynomial(pieces, t, k) for t in (start, start + h) for k in (order, order + 1))
    size = np.ptp(a[start[:, 0] == 0.0], axis=0)
    a, r, b, s = (each / np.where(size > 0.0, size, np.inf) for each in (a, r, b, s))
    off, low, high, good, n = 0.0 * a, np.minimum(a, b), np.maximum(a, b), a[:, 0] < FAR, 1
    while 2 * n <= len(a) and good.any():
        one, two, left = off[:-n], off[n:], a[: len(off) - n]
        right, own = b[2 * n - 1 :], ends[: len(left) + 2 * n, None]
        width, whole = own[n:-n] - own[: -2 * n], own[2 * n :] - own[: -2 * n]
        x, first, final = width / whole, whole * r[: len(left)], whole * s[2 * n - 1 :]
        c, d = 3.0 * (right - left) - 2.0 * first - final, 2.0 * (left - right) + first + final
        value = left + x * (first + x * (c + x * d))
        slope = (first + x * (2.0 * c + x * 3.0 * d)) / whole
        before, behind = b[n - 1 : n - 1 + len(left)] - value, a[n : n + len(left)] - value
        fall = s[n - 1 : n - 1 + len(left)] - slope, r[n : n + len(left)] - slope
        other = whole - width
        before = np.maximum(np.abs(before), np.abs(before - fall[0] * width / 3.0))
        behind = np.maximum(np.abs(behind), np.abs(behind + fall[1] * other / 3.0))
        off = np.maximum(one + before, two + behind)
        low, high = np.minimum(low[:-n], low[n:]), np.maximum(high[:-n], high[n:])
        falls = (one <= np.maximum(tight, 2.0 * x**4 * off)) & (
            two <= np.maximum(tight, 2.0 * (1.0 - x) ** 4 * off)
        )
        smooth = (off <= tight) | (falls & (off <= LOOSE * (high - low)))
        good, n = good[:-n] & good[n:] & smooth.all(axis=1), 2 * n
        yield n, np.flatnonzero(good)


def _inner(x: np.ndarray, y: np.ndarray, kind: str) -> np.ndarray:
    """Coefficients (n - 1, m, 4) between the knots, from the slopes at them."""
    import numpy as np

    h = np.diff(x)[:, None]
    chords = np.diff(y, axis=0) / h
    if kind == "linear" or len(x) == 2:
        return np.stack([y[:-1], chords, 0.0 * chords, 0.0 * chords], axis=-1)
    slopes = _akima(chords) if kind == "akima" else _spline(h, chords, kind)
    first, last = slopes[:-1], slopes[1:]
    bends = (3.0 * chords - 2.0 * first - last) / h
    return np.stack([y[:-1], first, bends, (first + last - 2.0 * chords) / h**2], axis=-1)


def _akima(chords: np.ndarray) -> np.ndarray:
    """Slopes (n, m): of the chords on both sides, each the heavier the less the other side bends.
    Where neither bends the mean of both.
    """
    import numpy as np

    before, behind = 2.0 * chords[0] - chords[1], 2.0 * chords[-1] - chords[-2]
    outer = [2.0 * before - chords[0], before], [behind, 2.0 * behind - chords[-1]]
    m = np.concatenate([outer[0], chords, outer[1]])
    bend = np.abs(np.diff(m, axis=0))
    left, right = bend[2:], bend[:-2]
    straight = left + right <= STRAIGHT * (left + right).max(axis=0)
    left, right = np.where(straight, 1.0, left), np.where(straight, 1.0, right)
    return (left * m[1:-2] + right * m[2:-1]) / (left + right)


def _spline(h: np.ndarray, chords: np.ndarray, kind: str) -> np.ndarray:
    """Slopes (n, m) with which the second derivative is continuous: at a point between pieces of
    lengths h and k, k s_(i-1) + 2 (h + k) s_i + h s_(i+1) = 3 (k m_(i-1) + h m_i).
    """
    import numpy as np

    if kind == "not-a-knot" and len(h) == 2:
        bend = np.diff(chords, axis=0) / h.sum()
        return np.concatenate([chords - h * bend, chords[1:] + h[1] * bend])
    if kind == "periodic":
        slopes = _solved(*_rows(np.append(h[-1:], h, 0), np.append(chords[-1:], chords, 0)))
        return np.append(slopes, slopes[:1], 0)
    low, middle, high, sums = _rows(h, chords)
    start, end = _end_slope(h, chords, kind), _end_slope(h[::-1], chords[::-1], kind)
    for at, edge, (share, value) in ((0, low, start), (-1, high, end)):
        middle[at] -= share * edge[at]
        sums[at] -= edge[at] * value
        edge[at] = 0.0
    slopes = _solved(low, middle, high, sums)
    first, last = start[1] - start[0] * slopes[0], end[1] - end[0] * slopes[-1]
    return np.concatenate([first[None], slopes, last[None]])


def _rows(
    h: np.ndarray, chords: np.ndarray
) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
    """Factors of s_(i-1), s_i and s_(i+1) and the right side at the points between pieces."""
    low, high = h[1:].copy(), h[:-1].copy()
    return low, 2.0 * (low + high), high, 3.0 * (low * chords[:-1] + high * chords[1:])


def _end_slope(
    h: np.ndarray, chords: np.ndarray, kind: str
) -> tuple[np.ndarray | float, np.ndarray]:
    """Share and value of the first slope, s_0 = value - share s_1: without bend there, or the first
    two pieces are one cubic.
    """
    if kind == "natural":
        return 0.5, 1.5 * chords[0]
    both = h[0] + h[1]
    value = (h[0] + 2.0 * both) * h[1] * chords[0] + h[0] ** 2 * chords[1]
    return both / h[1], value / (both * h[1])


def _solved(low: np.ndarray, middle: np.ndarray, high: np.ndarray, sums: np.ndarray) -> np.ndarray:
    """Solution of low x_(i-1) + middle x_i + high x_(i+1) = sums, the last before the first.

    Cyclic reduction of all rows: each takes its neighbours out and knows those twice as far away.
    Their shares shrink with the square, so that a few rounds are enough for any number of rows.
    """
    import numpy as np

    for stride in (2**k for k in range(ROUNDS)):
        if not (low.any() or high.any()):
            break
        back, on = (lambda a, by=by: np.roll(a, by, axis=0) for by in (stride, -stride))
        down, up = low / back(middle), high / on(middle)
        middle, sums = (
            middle - down * back(high) - up * on(low),
            sums - down * back(sums) - up * on(sums),
        )
        low, high = -down * back(low), -up * on(high)
        small = (np.abs(low) + np.abs(high)) <= NEGLIGIBLE * np.abs(middle)
        low, high = np.where(small, 0.0, low), np.where(small, 0.0, high)
    return sums / middle


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
