"""A scope of three moving frames whose every number follows from formulas in t.

``FRAMES`` states the poses; their derivatives come from mpmath at many digits.  ``SampleScope``
hands out one symbol per number, as the real scope does, and remembers what each stands for.
"""

from __future__ import annotations

from bisect import bisect
from functools import cache
from math import factorial
from types import SimpleNamespace

import mpmath as mp
import numpy as np
from graph_values import value

from adamslite.symbolic.algebra import atan2
from adamslite.symbolic.derivatives import along
from adamslite.symbolic.graph import Node, symbol
from adamslite.symbolic.interpolant import Interpolant, interpolant, piece_numbers
from adamslite.symbolic.scope import Load

GROUND = -1
NOW = mp.mpf("0.7")
DIGITS = 60


# The table of every SPLINE: number in an expression, kind, points.
KINDS = ("linear", "akima", "natural")
KNOTS, VALUES = np.array([-1.5, -0.7, -0.1, 0.4, 1.3]), np.array([1.0, -2.0, 0.5, 3.0, 1.0])


@cache
def sample_table(number: int) -> Interpolant:
    """A table by its number; after those of all kinds that of the numbers of pieces."""
    if number == len(KINDS):
        return piece_numbers(KNOTS)
    return interpolant(KNOTS, np.outer(VALUES, [1.0, -0.5, 0.25]), KINDS[number])


def table_value(number: int, curve: int, order: int, x) -> mp.mpf:
    """A derivative of a curve of a table, at many digits."""
    table = sample_table(int(number))
    piece = bisect(table.knots, x)
    t = x - mp.mpf(table.knots[max(piece - 1, 0)])
    coefficients = table.pieces[piece, int(curve)]
    return mp.fsum(
        factorial(k) // factorial(k - int(order)) * mp.mpf(coefficients[k]) * t ** (k - int(order))
        for k in range(int(order), 4)
    )


def held_value(number: int, curve: int, order: int, piece, x) -> mp.mpf:
    """The same of the straight line that runs through piece ``piece``."""
    assert piece == bisect(KNOTS, x)
    return table_value(number, curve, order, x)


# Values of the nodes that mpmath knows no function for.
TABLES = {"Lookup": table_value, "LookupHeld": held_value}


def turn(axis: int, angle) -> mp.matrix:
    """Rotation matrix about one axis."""
    c, s = mp.cos(angle), mp.sin(angle)
    a, b = (axis + 1) % 3, (axis + 2) % 3
    r = mp.eye(3)
    r[a, a], r[a, b], r[b, a], r[b, b] = c, -s, s, c
    return r


# frame: three position functions, three angles of the body 3-1-3 sequence
FRAMES = {
    0: (
        (lambda t: 1 + t**2, lambda t: mp.sin(3 * t), lambda t: 2 * t - t**3),
        (lambda t: 1 + 2 * t, lambda t: mp.mpf("0.9") + t**2 / 3, lambda t: mp.cos(2 * t)),
    ),
    1: (
        (lambda t: mp.cos(t), lambda t: -2 + t / 2, lambda t: t**2 / 5),
        (lambda t: mp.sin(t) - 2, lambda t: 1 + t / 4, lambda t: t**3 - t),
    ),
    2: (
        (lambda t: 3 - t, lambda t: 2 * t**2, lambda t: mp.exp(-t)),
        (lambda t: t**2, lambda t: 2 - t / 3, lambda t: 1 / (1 + t)),
    ),
}


def column(functions, t) -> mp.matrix:
    return mp.matrix([f(t) for f in functions])


def place(frame: int, t) -> mp.matrix:
    return mp.zeros(3, 1) if frame == GROUND else column(FRAMES[frame][0], t)


def attitude(frame: int, t) -> mp.matrix:
    """Columns are the axes of the frame in ground."""
    if frame == GROUND:
        return mp.eye(3)
    psi, theta, phi = (f(t) for f in FRAMES[frame][1])
    return turn(2, psi) * turn(0, theta) * turn(2, phi)


def spin(frame: int, t) -> mp.matrix:
    """Angular velocity: each rate along the axis it turns about."""
    if frame == GROUND:
        return mp.zeros(3, 1)
    psi, theta, _ = (f(t) for f in FRAMES[frame][1])
    rates = [mp.diff(f, t) for f in FRAMES[frame][1]]
    unit = [mp.matrix([int(a == b) for a in range(3)]) for b in range(3)]
    nodes = turn(2, psi) * unit[0]
    return (
        rates[0] * unit[2] + rates[1] * nodes + rates[2] * (turn(2, psi) * turn(0, theta) * unit[2])
    )


def rate(vector, order: int = 1) -> mp.matrix:
    """Derivative of a vector function of t, now."""
    return mp.matrix([mp.diff(lambda t, c=c: vector(t)[c], NOW, order) for c in range(3)])


@cache
def state(name: str, frame: int) -> mp.matrix:
    """Position, velocity, acceleration, angular velocity or acceleration, axes of a frame, now."""
    with mp.workdps(DIGITS):
        return {
            "d": lambda: place(frame, NOW),
            "v": lambda: rate(lambda t: place(frame, t)),
            "a": lambda: rate(lambda t: place(frame, t), 2),
            "w": lambda: spin(frame, NOW),
            "al": lambda: rate(lambda t: spin(frame, t)),
            "x": lambda: attitude(frame, NOW),
        }[name]()


class SampleScope:
    """The scope of deck functions over the frames 0, 1, 2 and ``GROUND``."""

    def __init__(self) -> None:
        self.values: dict[Node, mp.mpf] = {}
        self.loads: list[tuple] = []

    def symbol(self, name: str, value) -> Node:
        made = symbol(name)
        self.values[made] = mp.mpf(value)
        return made

    def vector(self, name: str, values) -> tuple:
        return tuple(self.symbol(f"{name}_{c}", values[c]) for c in range(3))

    def _difference(self, name: str, i: int, j: int) -> tuple:
        if i == j:
            return (0, 0, 0)
        return self.vector(f"{name}_{i}_{j}", state(name, i) - state(name, j))

    def is_ground(self, frame: int) -> bool:
        return frame == GROUND

    def position(self, i: int, j: int) -> tuple:
        return self._difference("d", i, j)

    def velocity(self, i: int, j: int) -> tuple:
        return self._difference("v", i, j)

    def acceleration(self, i: int, j: int) -> tuple:
        return self._difference("a", i, j)

    def omega(self, i: int, j: int = GROUND) -> tuple:
        return self._difference("w", i, j)

    def alpha(self, i: int, j: int = GROUND) -> tuple:
        return self._difference("al", i, j)

    def axes(self, k: int) -> tuple:
        if k == GROUND:
            return ((1, 0, 0), (0, 1, 0), (0, 0, 1))
        matrix = state("x", k)
        return tuple(self.vector(f"x_{k}_{c}", matrix[:, c]) for c in range(3))

    def side(self, normal, clear, of):
        return self.symbol("side", 1)

    def angle(self, sine, cosine, of):
        return atan2(sine, cosine) + self.symbol("turns", 2 * mp.pi)

    def load(self, id, jflag: int) -> tuple:
        self.loads.append((id, jflag))
        sign = -1 if jflag else 1
        return tuple(
            tuple(sign * s for s in self.vector(name, values))
            for name, values in (("f", (3, -4, 12)), ("m", ("0.5", 2, -1)))
        )

    def statement(self, id) -> SimpleNamespace:
        values = {"value": "1.5", "state": "2.5", "rate": "-0.5", "multiplier": "3.5"}
        values["kept"] = "4.5"
        tables = {kind: number for number, kind in enumerate(KINDS)}
        return SimpleNamespace(
            **{name: self.symbol(f"{name}_{id}", value) for name, value in values.items()},
            **tables, pieces=len(KINDS), family=None, over_alpha=1, first=-1, last=1, closed=None,
            origin=1, points=[self._point(id)],
            cls=SimpleNamespace(values=lambda view, scope: self._values(id)),
        )  # fmt: skip

    def _values(self, id) -> list:
        """What FRICTION lists of a friction element."""
        return [self.symbol(f"listed_{id}_{n}", f"0.{n + 1}") for n in range(20)]

    def _point(self, id) -> SimpleNamespace:
        """A point of contact: between frames 0 and 2."""
        return SimpleNamespace(
            turned=None,
            own_loads=lambda scope: [Load(0, *scope.load(id, 0), 2, True)],
            cls=SimpleNamespace(depth=lambda point, scope: self.symbol(f"depth_{id}", "0.3")),
        )

    def touch(self, relation, in_length=True):
        return relation

    def of_time(self, expr) -> bool:
        return False

    def derivative(self, expr):
        return along(expr, {s: self.symbol(f"rate_of_{s}", "0.25") for s in list(self.values)})


def evaluate(expr, values: dict) -> mp.mpf:
    """Value of an expression at many digits."""
    with mp.workdps(DIGITS):
        return value(expr, values, mp, TABLES)
