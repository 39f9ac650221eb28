"""Tables in native code: piecewise cubic curves over common knots.

Equation (knots x_1 < ... < x_n, piece p between x_p and x_(p+1), b its origin, z_1 < ... < z_m the
places of the curves)::

    c_k(x) = a_0 + a_1 t + a_2 t^2 + a_3 t^3,     t = x - b,   b = x_p, of piece 0 x_1
    f(x, z) = c_k(x) + (z - z_k)/(z_(k+1) - z_k) (c_(k+1)(x) - c_k(x))

Piece 0 lies before the first knot and piece n behind the last one: what a table is beyond its ends
are pieces like others.  Behind z_m and before z_1 the two outermost curves are extended.

The array T of a table holds

    n, m | n knots | m places | a_0 .. a_3 of every piece (n + 1) and curve (m), pieces outermost

:mod:`adamslite.symbolic.interpolant` makes it.  A piece is found by bisection: the time grows with
log n.
"""

from __future__ import annotations

from adamslite.native.translate import Reals, native

# Where the knots begin, and how many coefficients a curve has on a piece.
KNOTS, CUBIC = 2, 4


@native
def count_up_to(values: Reals, n: int, x: float) -> int:
    """How many of ``n`` ascending ``values`` are not above ``x``."""
    low, high = 0, n
    while low < high:
        middle = (low + high) // 2
        if values[middle] <= x:
            low = middle + 1
        else:
            high = middle
    return low


@native
def piece_at(T: Reals, x: float) -> int:
    """Number of the piece that ``x`` lies on; at a knot of the one after it, at the last knot of
    the one before it: a run may end where its table ends.
    """
    n = int(T[0])
    return count_up_to(T[KNOTS:], n, x) - (1 if x == T[KNOTS + n - 1] else 0)


@native
def on_piece(T: Reals, piece: int, curve: int, x: float, order: int) -> float:
    """Derivative of one curve by x, of ``order`` 0 or more, on a piece that is known."""
    n, m = int(T[0]), int(T[1])
    t = x - T[KNOTS + max(piece - 1, 0)]
    a = T[KNOTS + n + m + CUBIC * (piece * m + curve) :]
    if order == 0:
        return a[0] + t * (a[1] + t * (a[2] + t * a[3]))
    if order == 1:
        return a[1] + t * (2.0 * a[2] + t * (3.0 * a[3]))
    if order == 2:
        return 2.0 * a[2] + t * (6.0 * a[3])
    if order == 3:
        return 6.0 * a[3]
    return 0.0


@native
def on_held_piece(T: Reals, piece: float, curve: int, x: float, order: int) -> float:
    """Derivative of one curve by x on a piece that a branch holds, also where x has left it."""
    held = piece if piece > 0.0 else 0.0  # also for what is not a number
    return on_piece(T, int(min(held, T[0])), curve, x, order)


@native
def strip_at(T: Reals, z: float) -> int:
    """Number of the curve from which ``z`` leads to the next one; 0 where there is only one."""
    n, m = int(T[0]), int(T[1])
    return max(min(count_up_to(T[KNOTS + n :], m, z) - 1, m - 2), 0)


@native
def on_strip(
    T: Reals, piece: int, strip: int, x: float, z: float, order: int, z_order: int
) -> float:
    """Derivative between two curves by x and by z on a piece and a strip that are known."""
    n, m = int(T[0]), int(T[1])
    low = on_piece(T, piece, strip, x, order)
    if m == 1:
        return low if z_order == 0 else 0.0
    places = T[KNOTS + n + strip :]
    slope = (on_piece(T, piece, strip + 1, x, order) - low) / (places[1] - places[0])
    if z_order == 0:
        return low + (z - places[0]) * slope
    return slope if z_order == 1 else 0.0


@native
def on_held_strip(T: Reals, strip: float, x: float, z: float, order: int, z_order: int) -> float:
    """The same on a strip that a branch holds, also where z has left it."""
    held = strip if strip > 0.0 else 0.0  # also for what is not a number
    return on_strip(T, piece_at(T, x), int(min(held, max(T[1] - 2.0, 0.0))), x, z, order, z_order)


@native
def lookup(T: Reals, x: float, z: float, order: int, z_order: int) -> float:
    """The table, or its derivative of ``order`` by x and ``z_order`` by z."""
    return on_strip(T, piece_at(T, x), strip_at(T, z), x, z, order, z_order)
