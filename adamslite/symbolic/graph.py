"""Expressions as graphs: a part that occurs many times is one node.

A node is a kind and its arguments (:mod:`adamslite.symbolic.structure`).  Equal nodes are the same
object, so that they are compared, found and differentiated once.  The operations below fold numbers
and what cannot matter (zeros, ones, double signs, powers of one base); they never multiply out and
never rearrange: what was written with shared parts keeps them.

All numbers are real.  What has no value (a pole, the root of a negative number) is not a number,
and so is everything that is made of it.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable
from typing import Any

from adamslite.symbolic.structure import OPPOSITE, Vertex, factors, holds, raised

Given = Any
"""A node, or a number or a truth in its place."""
EVEN, ODD = ("cos", "cosh"), ("sin", "tan", "asin", "atan", "sinh", "tanh")


class Node(Vertex):
    """A part of an expression; made by the functions of this module only."""

    __slots__ = ()

    def __add__(self, other: Given) -> Node:
        return add(self, node(other))

    def __radd__(self, other: Given) -> Node:
        return add(node(other), self)

    def __sub__(self, other: Given) -> Node:
        return sub(self, node(other))

    def __rsub__(self, other: Given) -> Node:
        return sub(node(other), self)

    def __mul__(self, other: Given) -> Node:
        return mul(self, node(other))

    def __rmul__(self, other: Given) -> Node:
        return mul(node(other), self)

    def __truediv__(self, other: Given) -> Node:
        return div(self, node(other))

    def __rtruediv__(self, other: Given) -> Node:
        return div(node(other), self)

    def __pow__(self, other: Given) -> Node:
        return power(self, node(other))

    def __rpow__(self, other: Given) -> Node:
        return power(node(other), self)

    def __neg__(self) -> Node:
        return neg(self)

    def __lt__(self, other: Given) -> Node:
        return relation("<", self, node(other))

    def __le__(self, other: Given) -> Node:
        return relation("<=", self, node(other))

    def __gt__(self, other: Given) -> Node:
        return relation(">", self, node(other))

    def __ge__(self, other: Given) -> Node:
        return relation(">=", self, node(other))


class Part(Node):
    """A node that is no number; it equals itself alone, which dicts find out fastest."""

    __slots__ = ()


class Number(Node):
    """A node that equals numbers of its value."""

    __slots__ = ()

    def __hash__(self) -> int:
        return hash(self.value)

    def __eq__(self, other: object) -> bool:
        plain = other.value if isinstance(other, Number) else other
        return self is other or bool(self.value == plain)


_known: dict[tuple[Any, ...], Node] = {}
"""The nodes of the expressions that are being written."""


def forget() -> None:
    """Begin anew: what is written from here on does not depend on what was written before."""
    _known.clear()
    for constant in (NAN, ZERO, ONE, TRUE, FALSE):
        _known[constant.kind, constant.value, None] = constant


def made(kind: str, *args: Node, value: Any = None, order: int | None = None) -> Node:
    """The node of a kind with given arguments."""
    key = (kind, value, order, *args)
    found = _known.get(key)
    if found is None:
        of = Number if kind == "number" else Part
        found = _known[key] = of(kind, args, value, order)
    return found


def number(value: float) -> Node:
    """A number; infinity is not one."""
    value = float(value)
    if not math.isfinite(value):
        return NAN
    return made("number", value=value)


NAN: Node
ZERO: Node
ONE: Node
NAN, ZERO, ONE = (Number("number", (), value, None) for value in (math.nan, 0.0, 1.0))
TRUE, FALSE = Part("true", (), True, None), Part("false", (), False, None)
forget()


def symbol(name: str) -> Node:
    """What is known when the expression is evaluated."""
    return made("symbol", value=name)


def node(given: Given) -> Node:
    """A node of itself, of a number or of a truth."""
    if isinstance(given, Node):
        return given
    if isinstance(given, bool):
        return TRUE if given else FALSE
    return number(given)


def _numbers(*args: Node) -> bool:
    return all(each.kind == "number" for each in args)


def _either(kind: str, a: Node, b: Node) -> Node:
    """A node whose arguments may be exchanged: as they were when it was first written."""
    other = _known.get((kind, None, None, b, a))
    return made(kind, a, b) if other is None else other


def add(a: Node, b: Node) -> Node:
    if a is NAN or b is NAN:
        return NAN
    if _numbers(a, b):
        return number(a.value + b.value)
    if a is ZERO:
        return b
    if b is ZERO:
        return a
    if b.kind == "neg":
        return sub(a, b.args[0])
    if a.kind == "neg":
        return sub(b, a.args[0])
    return mul(number(2.0), a) if a is b else _either("+", a, b)


def sub(a: Node, b: Node) -> Node:
    if a is NAN or b is NAN:
        return NAN
    if _numbers(a, b):
        return number(a.value - b.value)
    if a is b:
        return ZERO
    if a is ZERO:
        return neg(b)
    if b is ZERO:
        return a
    if b.kind == "neg":
        return add(a, b.args[0])
    return neg(add(a.args[0], b)) if a.kind == "neg" else made("-", a, b)


def neg(a: Node) -> Node:
    if a.kind == "number":
        return number(-a.value)
    if a.kind == "neg":
        return a.args[0]
    if a.kind == "-":
        return sub(a.args[1], a.args[0])
    if a.kind == "*" and a.args[0].kind == "number":
        return mul(number(-a.args[0].value), a.args[1])
    return made("neg", a)


def mul(a: Node, b: Node) -> Node:
    if a is NAN or b is NAN:
        return NAN
    if b.kind == "number":
        a, b = b, a
    if a.kind == "number":
        return _multiple(a, b)
    if a.kind == "neg":
        return neg(mul(a.args[0], b))
    if b.kind == "neg":
        return neg(mul(a, b.args[0]))
    (base, m), (other_base, n) = raised(a), raised(b)
    if base is other_base and m is not None and n is not None:
        return power(base, number(m + n))
    return _either("*", a, b)


def _multiple(factor: Node, b: Node) -> Node:
    """A number times a node."""
    if b.kind == "number":
        return number(factor.value * b.value)
    if factor is ZERO:
        return ZERO
    if factor is ONE:
        return b
    if factor.value == -1.0:
        return neg(b)
    if b.kind == "neg":
        return _multiple(number(-factor.value), b.args[0])
    if b.kind == "*" and b.args[0].kind == "number":
        return _multiple(number(factor.value * b.args[0].value), b.args[1])
    return made("*", factor, b)


def div(a: Node, b: Node) -> Node:
    if a is NAN or b is NAN or b is ZERO:
        return NAN
    if _numbers(a, b):
        return number(a.value / b.value)
    if a is ZERO:
        return ZERO
    if b.kind == "number" and math.isfinite(1.0 / b.value):
        return mul(number(1.0 / b.value), a)
    if a.kind == "neg":
        return neg(div(a.args[0], b))
    if b.kind == "neg":
        return neg(div(a, b.args[0]))
    (base, m), (other_base, n) = raised(a), raised(b)
    if base is other_base and m is not None and n is not None:
        return power(base, number(m - n))
    return made("/", a, b)


def power(base: Node, exponent: Node) -> Node:
    """A real power; a constant whole exponent may have any base."""
    if base is NAN or exponent is NAN:
        return NAN
    if _numbers(base, exponent):
        return _of_numbers(math.pow, base, exponent)
    if exponent.kind != "number":
        return made("**", base, exponent)
    n = exponent.value
    if n == 0.0:
        return ONE
    if n == 1.0:
        return base
    if n < 0.0:
        return div(ONE, power(base, number(-n)))
    if n == int(n):
        return _whole_power(base, n)
    taken, rest = _without_squares(base, n)
    return mul(taken, made("**", rest, exponent)) if rest is not ONE else taken


def _whole_power(base: Node, n: float) -> Node:
    if base.kind == "neg":
        positive = power(base.args[0], number(n))
        return neg(positive) if n % 2.0 else positive
    inner, m = raised(base)
    if base.kind == "**" and m is not None:
        return power(inner, number(m * n))
    return made("**", base, number(n))


def _without_squares(base: Node, n: float) -> tuple[Node, Node]:
    """Factors of the n-th power of a base that are the power of a square or of a number, and the
    rest of the base: a root alone of a square has no slope where that is zero.
    """
    taken = rest = ONE
    for factor in factors(base):
        inner, m = raised(factor)
        if factor.kind == "number" and factor.value > 0.0:
            taken = mul(taken, number(factor.value**n))
        elif factor.kind == "**" and m is not None and m % 2.0 == 0.0:
            taken = mul(taken, power(magnitude(inner), number(m * n)))
        else:
            rest = mul(rest, factor)
    return taken, rest


def magnitude(x: Node, order: int | None = 0) -> Node:
    """|x|, with the derivative 1 at zero."""
    return choice([(x, relation(">=", x, ZERO)), (neg(x), TRUE)], order)


def function(name: str, value: Callable[..., float], *args: Node) -> Node:
    """A function of the C library; ``value``: the same of numbers."""
    if NAN in args:
        return NAN
    if _numbers(*args):
        return _of_numbers(value, *args)
    if args[0].kind == "neg" and name in EVEN:
        return made(name, args[0].args[0])
    if args[0].kind == "neg" and name in ODD:
        return neg(made(name, args[0].args[0]))
    return made(name, *args)


def _of_numbers(value: Callable[..., float], *args: Node) -> Node:
    try:
        return number(value(*[each.value for each in args]))
    except (ArithmeticError, ValueError):
        return NAN


def floor(x: Node, order: int | None) -> Node:
    """Largest integer not above x."""
    return number(math.floor(x.value)) if _numbers(x) and x is not NAN else _floor(x, order)


def _floor(x: Node, order: int | None) -> Node:
    return x if x is NAN else made("floor", x, order=order)


def relation(kind: str, a: Node, b: Node) -> Node:
    """A comparison, decided where numbers or squares decide it."""
    if _numbers(a, b):
        return node(holds(kind, a.value - b.value))
    if a is b:
        return node(holds(kind, 0.0))
    for sign, gap in ((1.0, sub(a, b)), (-1.0, sub(b, a))):
        if gap.kind == "number" and gap is not NAN:
            return node(holds(kind, sign * gap.value))
        if gap.least > 0.0:
            return node(holds(kind, sign))
        if gap.least == 0.0 and kind in ("<", ">=") and sign > 0.0:
            return node(kind == ">=")
        if gap.least == 0.0 and kind in (">", "<=") and sign < 0.0:
            return node(kind == "<=")
    return made(kind, a, b)


def joined(kind: str, conditions: Iterable[Given]) -> Node:
    """All of the conditions (``and``) or one of them (``or``)."""
    deciding, other = (FALSE, TRUE) if kind == "and" else (TRUE, FALSE)
    kept: dict[Node, None] = {}
    for each in map(node, conditions):
        if each is deciding:
            return deciding
        kept.update(dict.fromkeys(each.args if each.kind == kind else (each,)))
    kept.pop(other, None)
    if len(kept) < 2:
        return next(iter(kept), other)
    return made(kind, *kept)


def opposite(condition: Given) -> Node:
    """Whether a condition does not hold."""
    condition = node(condition)
    if condition in (TRUE, FALSE):
        return FALSE if condition is TRUE else TRUE
    if condition.kind == "not":
        return condition.args[0]
    if condition.is_relation:
        return made(OPPOSITE[condition.kind], *condition.args)
    return made("not", condition)


def choice(pieces: Iterable[tuple[Given, Given]], order: int | None) -> Node:
    """The value of the first condition that holds; the last one is true.

    ``order``: where the choice changes, derivatives up to this one are continuous.
    """
    kept: list[Node] = []
    for value, condition in pieces:
        if condition is FALSE or condition is False:
            continue
        kept.append(node(value))
        if condition is TRUE or condition is True:
            break
        kept.append(condition)
    if all(each is kept[-1] for each in kept[:-1:2]):
        return kept[-1]
    return made("choice", *kept, order=order)
