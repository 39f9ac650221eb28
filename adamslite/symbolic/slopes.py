"""The slopes of one node by its arguments."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial

from adamslite.symbolic.graph import ONE, Node, add, div, made, neg, node, number
from adamslite.symbolic.slopes_by_sympy import SLOPES

MINUS_ONE = number(-1.0)
# Orders of the derivatives of tables: cubic pieces, straight from curve to curve.
CUBIC, STRAIGHT = 3, 1


Slopes = list[tuple[Node, Callable[[], Node]]]


def slopes(top: Node) -> Slopes:
    """Arguments with the slopes by them, formed when they are needed."""
    rule = RULES.get(top.kind)
    if rule is not None:
        return rule(top)
    return [(each, partial(_by_sympy, top, n)) for n, each in enumerate(top.args)]


def _by_sympy(top: Node, n: int) -> Node:
    rule: Callable[..., tuple[Node, ...]] = SLOPES[top.kind]
    return node(rule(*top.args)[n])


def _sum(top: Node) -> Slopes:
    return [(each, lambda: ONE) for each in top.args]


def _difference(top: Node) -> Slopes:
    return [(top.args[0], lambda: ONE), (top.args[1], lambda: MINUS_ONE)]


def _product(top: Node) -> Slopes:
    a, b = top.args
    return [(a, lambda: b), (b, lambda: a)]


def _quotient(top: Node) -> Slopes:
    a, b = top.args
    return [(a, lambda: div(ONE, b)), (b, lambda: neg(div(top, b)))]


def _flat(top: Node) -> Slopes:
    return []


def _lookup(top: Node) -> Slopes:
    """(table, curve, order, x) or (table, curve, order, piece, x)"""
    table, curve, order, *piece, x = top.args
    if int(order) >= CUBIC:
        return []
    return [(x, lambda: made(top.kind, table, curve, add(order, ONE), *piece, x))]


def _lookup_between(top: Node) -> Slopes:
    """(table, order by x, order by z, x, z) or (table, ..., strip, x, z)"""
    table, order, z_order, *strip, x, z = top.args
    found: Slopes = []
    if int(order) < CUBIC:
        further = add(order, ONE)
        found.append((x, lambda: made(top.kind, table, further, z_order, *strip, x, z)))
    if int(z_order) < STRAIGHT:
        across = add(z_order, ONE)
        found.append((z, lambda: made(top.kind, table, order, across, *strip, x, z)))
    return found


RULES: dict[str, Callable[[Node], Slopes]] = {
    "+": _sum,
    "-": _difference,
    "neg": lambda top: [(top.args[0], lambda: MINUS_ONE)],
    "*": _product,
    "/": _quotient,
    "floor": _flat,
    "Lookup": _lookup,
    "LookupHeld": _lookup,
    "LookupBetween": _lookup_between,
    "LookupBetweenHeld": _lookup_between,
}
"""Rules of the kinds that are no functions of numbers; others are added by who makes such nodes."""
