"""When an instance has nothing to add: what it evaluates vanishes on the branches that are held.

Most pairs that may touch do not.  Where the held branches say so, the loop goes on to the next
instance before a root, a power or an angle is computed.  A value vanishes

    a product      where one of its factors does and the other has a value
    a quotient     where its first part does and the other is not zero
    a sum          where all of its terms do
    a choice       where each piece that its held conditions leave open vanishes

A condition that is not held leaves both sides open.  Zero times what has no value (a quotient by
zero, the root of a negative number) has none either, and a run must not go on as if it were zero.
Denominators and arguments of roots are computed for the test, unless parameters alone, or a branch
that is held, say that they are positive; what else may lack a value is computed itself.  Only a sum
or product that is too large for a double is taken for a number.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from functools import reduce

from adamslite.native.llvm_builder import Builder, Value
from adamslite.symbolic.structure import ordered
from adamslite.symbolic.types import Expr

Truth = bool | str
"""Known now, or the name of an ``i1``."""
ALWAYS: Truth = True
NEVER: Truth = False
DEEPEST = 100
"""Nodes below each other that the test goes through: it calls itself for each."""
#: Functions that have a value wherever their arguments have one.
TOTAL = frozenset("+ - * neg sin cos tan atan atan2 tanh floor".split())


class IdleTest:
    """Writes the test, for derivatives: factors beside one that vanishes are taken for numbers.

    ``branches``: the value that holds the branch of each guard.
    """

    def __init__(self, builder: Builder, branches: dict[Expr, Value]) -> None:
        self.b = builder
        self.branches = branches
        self.memo: dict[Expr, Truth] = {}

    def __call__(self, expressions: Sequence[Expr]) -> Truth:
        """Whether all of them vanish; what is nested too deeply is taken not to."""
        if any(each.depth > DEEPEST for each in expressions):
            return NEVER
        return reduce(self._both, map(self._vanishes, expressions), ALWAYS)

    def _vanishes(self, expr: Expr) -> Truth:
        if expr not in self.memo:
            self.memo[expr] = self._found(expr)
        return self.memo[expr]

    def _found(self, expr: Expr) -> Truth:
        if expr.kind == "number":
            return bool(expr == 0)
        if expr.kind == "neg":
            return self._vanishes(expr.args[0])
        if expr.kind == "/":
            return self._beside(expr.args[0], self._divides, expr.args[1])
        if expr.kind == "*":
            a, b = expr.args
            return self._either(self._beside(a, self._finite, b), self._beside(b, self._finite, a))
        if expr.kind in ("+", "-"):
            return reduce(self._both, map(self._vanishes, expr.args), ALWAYS)
        return expr.kind == "choice" and expr.order is not None and self._choice(expr)

    def _beside(self, factor: Expr, rule: Callable[[Expr], Truth], other: Expr) -> Truth:
        """Whether a factor vanishes, and the other part of the product is as the rule says."""
        found = self._vanishes(factor)
        return found and self._both(found, rule(other))

    def _finite(self, expr: Expr) -> Truth:
        """Whether an expression has a value."""
        return ALWAYS

    def _divides(self, expr: Expr) -> Truth:
        """Whether an expression has a value that is not zero."""
        return ALWAYS

    def _choice(self, expr: Expr) -> Truth:
        """From the last piece back to the first: what the conditions before it leave open."""
        found = self._vanishes(expr.args[-1])
        for piece, condition in reversed([*expr.pieces]):
            here, passed = self._vanishes(piece), self._fails(condition)
            kept = self._both(here, self._either(found, self._holds(condition)))
            found = self._either(kept, self._both(passed, found))
        return found

    def _holds(self, cond: Expr) -> Truth:
        """Whether a condition is known to hold."""
        return self._known(cond, ">")

    def _fails(self, cond: Expr) -> Truth:
        """Whether a condition is known not to hold."""
        return self._known(cond, "<")

    def _known(self, cond: Expr, side: str) -> Truth:
        opposite = "<" if side == ">" else ">"
        if cond.kind in ("and", "or"):
            parts = [self._known(each, side) for each in cond.args]
            every = (cond.kind == "and") == (side == ">")
            return (
                reduce(self._both, parts, ALWAYS) if every else reduce(self._either, parts, NEVER)
            )
        if cond.kind == "not":
            return self._known(cond.args[0], opposite)
        branch = self.branches.get(cond)
        return False if branch is None else self.b.compare(side, branch, 0.0)

    def _both(self, a: Truth, b: Truth) -> Truth:
        if isinstance(a, bool) or a == b:
            return b if a else False
        return self._both(b, a) if isinstance(b, bool) else self.b.logic("and", a, b)

    def _either(self, a: Truth, b: Truth) -> Truth:
        if isinstance(a, bool):
            return True if a else b
        if a == b or b is False:
            return a
        return True if b is True else self.b.logic("or", a, b)


class StrictIdleTest(IdleTest):
    """Writes the test for values: the factors beside one that vanishes must have a value.

    ``value`` writes an expression; ``is_parameter``: of a symbol.
    """

    def __init__(
        self,
        builder: Builder,
        branches: dict[Expr, Value],
        value: Callable[[Expr], Value],
        is_parameter: Callable[[Expr], bool],
    ) -> None:
        super().__init__(builder, branches)
        self.value = value
        self.is_parameter = is_parameter
        self.valued: dict[Expr, Truth] = {}
        self.ranges: dict[Expr, tuple[Value, Value] | None] = {}

    def _finite(self, expr: Expr) -> Truth:
        if expr not in self.valued:
            self.valued[expr] = self._has_value(expr)
        return self.valued[expr]

    def _has_value(self, expr: Expr) -> Truth:
        if expr.kind == "number":
            return math.isfinite(expr.value)
        if expr.kind == "symbol":
            return expr.value != "nan"
        if expr.kind == "/":
            return self._both(self._finite(expr.args[0]), self._divides(expr.args[1]))
        if expr.kind == "**" and expr.args[1].kind == "number":
            return self._power(expr.args[0], expr.args[1].value)
        if expr.kind in TOTAL:
            return reduce(self._both, map(self._finite, expr.args), ALWAYS)
        if expr.kind == "choice":
            pieces = [*(piece for piece, _ in expr.pieces), expr.args[-1]]
            return reduce(self._both, map(self._finite, pieces), ALWAYS)
        value = self.value(expr)
        return self._both(
            self.b.compare("<", value, math.inf), self.b.compare(">", value, -math.inf)
        )

    def _power(self, base: Expr, exponent: float) -> Truth:
        """Whether a power has a value."""
        if exponent % 1.0 != 0.0 and not _is_sum_of_squares(base):
            positive = self._surely_positive(base)
            if positive is not NEVER:
                return self._both(positive, self._finite(base))
            return self.b.compare(">=" if exponent > 0.0 else ">", self.value(base), 0.0)
        return self._finite(base) if exponent > 0.0 else self._divides(base)

    def _divides(self, expr: Expr) -> Truth:
        if expr.kind == "number":
            return bool(expr.value != 0.0)
        positive = self._surely_positive(expr)
        if positive is not NEVER:
            return self._both(positive, self._finite(expr))
        if expr.kind == "**" and expr.args[1] == 0.5:
            return self.b.compare(">", self.value(expr.args[0]), 0.0)
        value = self.value(expr)
        return self._either(self.b.compare("<", value, 0.0), self.b.compare(">", value, 0.0))

    def _surely_positive(self, expr: Expr) -> Truth:
        """Whether the least value by parameters is positive, or what a held branch says that an
        expression exceeds; NEVER where nothing says so.
        """
        inside = expr.args[0] if expr.kind == "**" and expr.args[1] == 0.5 else expr
        if found := self._range(inside):
            return self._positive(found[0])
        truths = [NEVER]
        for low, cond, side in self._below(expr):
            found = self._range(low)
            if found and (positive := self._positive(found[0])) is not NEVER:
                truths.append(self._both(self._known(cond, side), positive))
        return reduce(self._either, truths)

    def _positive(self, value: Value) -> Truth:
        return self.b.compare(">", value, 0.0) if isinstance(value, str) else value > 0.0

    def _below(self, expr: Expr) -> Iterator[tuple[Expr, Expr, str]]:
        """What does not exceed an expression on one side of a condition that may be held."""
        for cond in self.branches:
            if cond.is_relation:
                ends = cond.args if cond.kind in (">", ">=") else cond.args[::-1]
                for high, low, side in ((*ends, ">"), (*ends[::-1], "<")):
                    if high is expr:
                        yield low, cond, side

    def _range(self, expr: Expr) -> tuple[Value, Value] | None:
        """The least and the largest value that parameters allow, if they say so."""
        if expr not in self.ranges:
            self.ranges[expr] = self._range_of(expr)
        return self.ranges[expr]

    def _range_of(self, expr: Expr) -> tuple[Value, Value] | None:
        if expr.kind in ("sin", "cos"):
            return -1.0, 1.0
        if expr.kind == "number":
            return expr.value, expr.value
        if expr.kind == "symbol" and self.is_parameter(expr):
            return self.value(expr), self.value(expr)
        parts = [self._range(each) for each in expr.args[: 1 if expr.kind == "**" else None]]
        known = [each for each in parts if each]
        if len(known) < len(parts) or expr.kind not in ("+", "-", "*", "/", "neg", "**"):
            return None
        return self._combined(expr, known)

    def _combined(self, expr: Expr, parts: list[tuple[Value, Value]]) -> tuple[Value, Value] | None:
        b, (low, high), other = self.b, parts[0], parts[-1]
        if expr.kind == "neg":
            return b.neg(high), b.neg(low)
        if expr.kind == "+":
            return b.add(low, other[0]), b.add(high, other[1])
        if expr.kind == "-":
            return b.sub(low, other[1]), b.sub(high, other[0])
        if expr.kind == "**":
            return (b.call("sqrt", low), b.call("sqrt", high)) if expr.args[1] == 0.5 else None
        if expr.kind == "*" and low == high:
            (low, high), other = other, parts[0]
        if other[0] != other[1]:
            return None
        operation = b.div if expr.kind == "/" else b.mul
        one, two = operation(low, other[0]), operation(high, other[0])
        less = b.compare("<", one, two)
        return b.select(less, one, two), b.select(less, two, one)


def _is_sum_of_squares(expr: Expr) -> bool:
    """Whether an expression is never negative, by its form."""
    terms = ordered([expr], lambda top: top.args if top.kind == "+" else ())
    return all(each.kind == "+" or _is_even_power(each) for each in terms)


def _is_even_power(expr: Expr) -> bool:
    return expr.kind == "**" and expr.args[1].kind == "number" and expr.args[1].value % 2.0 == 0.0
