"""Values of expressions (:mod:`adamslite.symbolic.graph`) by definition, node by node.

``m``: where the functions come from, mpmath for many digits or :data:`DOUBLES`.  A choice takes
the first piece whose condition holds.
"""

from __future__ import annotations

import operator
from collections.abc import Mapping
from types import SimpleNamespace
from typing import Any

import numpy as np

from adamslite.symbolic.graph import Given, Node, node

DOUBLES = SimpleNamespace(
    mpf=np.float64, power=np.power, floor=np.floor, sin=np.sin, cos=np.cos, tan=np.tan,
    asin=np.arcsin, acos=np.arccos, atan=np.arctan, atan2=np.arctan2, sinh=np.sinh, cosh=np.cosh,
    tanh=np.tanh, exp=np.exp, log=np.log,
)  # fmt: skip
OPERATIONS = {
    "+": operator.add, "-": operator.sub, "*": operator.mul, "/": operator.truediv,
    "neg": operator.neg, "<": operator.lt, "<=": operator.le, ">": operator.gt, ">=": operator.ge,
    "==": operator.eq, "!=": operator.ne, "not": operator.not_,
    "and": lambda *terms: all(terms), "or": lambda *terms: any(terms),
    "true": lambda: True, "false": lambda: False,
}  # fmt: skip


def value(expr: Given, numbers: Mapping[Node, Any], m: Any, tables: Mapping = {}) -> Any:
    """The value where symbols are ``numbers``; ``tables``: functions that are no one's."""
    known: dict[Node, Any] = {}

    def of(top: Node) -> Any:
        if top not in known:
            known[top] = found(top)
        return known[top]

    def found(top: Node) -> Any:
        if top.kind == "symbol":
            return m.mpf(numbers[top])
        if top.kind == "number":
            return m.mpf(float(top))
        if top.kind == "choice":
            holding = (piece for piece, condition in top.pieces if of(condition))
            return of(next(holding, top.args[-1]))
        if top.kind == "**":
            return m.power(*map(of, top.args))
        rule = OPERATIONS.get(top.kind) or tables.get(top.kind) or getattr(m, top.kind)
        return rule(*map(of, top.args))

    return of(node(expr))
