"""What expressions consist of, and what is read off them: bases and exponents, factors, bounds.

====================  =============================================================
number                ``value``
symbol                ``value``, its name
+  -  *  /            of two
neg                   of one
**                    base, exponent
sin, atan2, ...       of their arguments
floor                 of one; ``order`` as in :func:`~adamslite.symbolic.graph.choice`
choice                value, condition, value, condition, ..., value where none holds
< <= > >= == !=       conditions of two sides
and, or, not          conditions of conditions
true, false           decided conditions
others                functions with a slope of their own (:mod:`adamslite.symbolic.slopes`)
====================  =============================================================
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Iterator
from typing import Any, Self, TypeVar

OPPOSITE = {"<": ">=", ">=": "<", ">": "<=", "<=": ">", "==": "!=", "!=": "=="}
CONDITIONS = {*OPPOSITE, "and", "or", "not", "true", "false"}

N = TypeVar("N", bound="Vertex")


class Vertex:
    """A part of an expression: its kind, its arguments, its value, its order.

    ``depth``: how many nodes are below each other in it, itself included.
    """

    __slots__ = ("kind", "args", "value", "order", "depth", "least")

    def __init__(self, kind: str, args: tuple[Any, ...], value: Any, order: int | None) -> None:
        self.kind = kind
        self.args: tuple[Self, ...] = args
        self.value = value
        self.order = order
        self.depth: int = 1 + max([each.depth for each in args], default=0)
        self.least: float = _least(self)
        """A bound that it does not fall below, as far as squares and numbers tell it."""

    def __bool__(self) -> bool:
        if self.kind in OPPOSITE or self.kind in ("and", "or", "not"):
            raise TypeError(f"whether {self} holds is not known yet")
        return self.kind != "false" and self.value != 0.0

    def __float__(self) -> float:
        if self.kind != "number":
            raise TypeError(f"{self} is not a number")
        return float(self.value)

    def __int__(self) -> int:
        return int(float(self))

    def __str__(self) -> str:
        if self.kind in ("number", "symbol"):
            return str(self.value)
        return f"{self.kind}({', '.join(map(str, self.args))})"

    __repr__ = __str__

    @property
    def is_relation(self) -> bool:
        return self.kind in OPPOSITE

    @property
    def pieces(self) -> Iterator[tuple[Self, Self]]:
        """Value and condition of each piece of a choice but the last one."""
        return zip(self.args[:-1:2], self.args[1::2], strict=True)


def raised(a: N) -> tuple[N, float | None]:
    """Base and exponent of a power; the exponent where it is a number, 1 of anything else."""
    if a.kind == "**":
        return a.args[0], a.args[1].value if a.args[1].kind == "number" else None
    return a, 1.0


def factors(a: N) -> Iterator[N]:
    """What a product is made of; anything else is its own factor."""
    pending = [a]
    while pending:
        top = pending.pop()
        if top.kind == "*":
            pending += reversed(top.args)
        else:
            yield top


def holds(kind: str, gap: float) -> bool:
    """Whether a relation is true of two sides that differ by ``gap``; of not a number it is not."""
    below, equal = gap < 0.0, gap == 0.0
    known = {"<": below, "<=": below or equal, "==": equal}
    return known[kind] if kind in known else gap == gap and not known[OPPOSITE[kind]]


def _least(a: Vertex) -> float:
    if a.kind == "number":
        return a.value if a.value == a.value else -math.inf
    if a.kind == "+":
        return a.args[0].least + a.args[1].least
    if a.kind == "**":
        n = raised(a)[1]
        return 0.0 if n is not None and (n % 2.0 == 0.0 or n % 1.0 != 0.0) else -math.inf
    if a.kind in ("*", "/"):
        both = a.args[0] is a.args[1] or min(each.least for each in a.args) >= 0.0
        return 0.0 if both else -math.inf
    return {"exp": 0.0, "cosh": 1.0}.get(a.kind, -math.inf)


def ordered(
    roots: Iterable[N], below: Callable[[N], Iterable[N]] = lambda top: top.args
) -> list[N]:
    """The nodes that ``roots`` are made of, each once and behind its own; ``below``: these."""
    found: dict[N, None] = {}
    pending = [(root, False) for root in roots][::-1]
    while pending:
        top, complete = pending.pop()
        if complete:
            found[top] = None
        elif top not in found:
            pending.append((top, True))
            pending += [(each, False) for each in below(top) if each not in found][::-1]
    return list(found)
