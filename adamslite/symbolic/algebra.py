"""The functions in which formulas are written, for nodes of a graph.

Formulas reach them by :data:`adamslite.symbolic.formulas.fn`, which has those of
:mod:`adamslite.symbolic.duals` in their place where numbers are wanted.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from types import SimpleNamespace

from adamslite.symbolic import graph
from adamslite.symbolic.graph import NAN, Given, Node, node, number

pi = number(math.pi)
S = SimpleNamespace(Zero=graph.ZERO, One=graph.ONE, Half=number(0.5))
nan = NAN


def _of_library(name: str) -> Callable[..., Node]:
    value = getattr(math, name)

    def function(*args: Given) -> Node:
        return graph.function(name, value, *map(node, args))

    return function


sin, cos, tan = map(_of_library, ("sin", "cos", "tan"))
asin, acos, atan, atan2 = map(_of_library, ("asin", "acos", "atan", "atan2"))
sinh, cosh, tanh = map(_of_library, ("sinh", "cosh", "tanh"))
exp, log = map(_of_library, ("exp", "log"))


def power(base: Given, exponent: Given) -> Node:
    """base**exponent."""
    return graph.power(node(base), node(exponent))


def sqrt(x: Given) -> Node:
    """The square root."""
    return power(x, 0.5)


def And(*conditions: Given) -> Node:  # noqa: N802  as a word it is Python's
    """Whether all hold."""
    return graph.joined("and", conditions)


def Or(*conditions: Given) -> Node:  # noqa: N802
    """Whether one holds."""
    return graph.joined("or", conditions)


def Not(condition: Given) -> Node:  # noqa: N802
    """Whether it does not hold."""
    return graph.opposite(condition)


def Eq(a: Given, b: Given) -> Node:  # noqa: N802
    """Whether two numbers are equal."""
    return graph.relation("==", node(a), node(b))


def chosen(*pieces: tuple[Given, Given], otherwise: Given, order: int | None) -> Node:
    """The value of the first condition that holds."""
    return graph.choice([*pieces, (otherwise, True)], order)


def floor(x: Given, order: int | None) -> Node:
    """The largest whole number not above x."""
    return graph.floor(node(x), order)


def lookup(table: int, x: Given, curve: int, order: int) -> Node:
    """A curve of a table at ``x``, or its derivative."""
    return _value_of_table("Lookup", table, curve, order, x)


def lookup_between(table: int, x: Given, z: Given, order: int, z_order: int) -> Node:
    """A table of two arguments, or its derivatives."""
    return _value_of_table("LookupBetween", table, order, z_order, x, z)


def lookup_with_corners(table: int, pieces: int, x: Given, order: int) -> Node:
    """A table of straight lines on the piece that an integrator holds, or its derivative."""
    piece = floor(lookup(pieces, x, 0, 0), -1 if order else 0)
    return _value_of_table("LookupHeld", table, 0, order, piece, x)


def lookup_between_with_corners(table: int, strips: int, x: Given, z: Given) -> Node:
    """A table of two arguments, on the strip that an integrator holds."""
    strip = floor(lookup(strips, z, 0, 0), 0)
    return _value_of_table("LookupBetweenHeld", table, 0, 0, strip, x, z)


def _value_of_table(kind: str, *args: Given) -> Node:
    return graph.made(kind, *map(node, args))
