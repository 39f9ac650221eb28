"""From sympy expressions to values of an :class:`~adamslite.native.llvm_builder.Builder`."""

from __future__ import annotations

from collections.abc import Callable
from fractions import Fraction

from adamslite.kernels.code.lookup import (
    on_held_piece,
    on_held_strip,
    on_piece,
    on_strip,
    piece_at,
    strip_at,
)
from adamslite.kernels.code.routine_call import routine_answer
from adamslite.native.llvm_builder import LIBRARY, Builder, Value
from adamslite.native.translate import symbol
from adamslite.symbolic.routines import FIRST as ROUTINE_FIRST
from adamslite.symbolic.routines import INPUTS
from adamslite.symbolic.types import Expr, Symbol


def joined(factors: tuple[Expr, ...]) -> list[Expr]:
    """Factors of a product with x**e/x as x**(e - 1): the slope of x**e, at x = 0 not 0/0."""
    raised = [f for f in factors if f.is_Pow and not f.exp.is_number]
    if not raised:
        return list(factors)
    powers: dict[Expr, Expr] = {}
    for factor in raised:
        powers[factor.base] = powers.get(factor.base, 0) + factor.exp
    rest = [f for f in factors if f not in raised]
    for factor in [f for f in rest if f.is_Pow and f.base in powers]:
        powers[factor.base] += factor.exp
        rest.remove(factor)
    return [*rest, *(base**exponent for base, exponent in powers.items())]


class Lowering:
    """Turns sympy expressions into builder values; ``leaves`` maps symbols to values.

    ``tables_at``: the integer that holds the address of table 0.

    ``branches`` maps the guards of choices (:mod:`adamslite.symbolic.guards`) to the value that
    holds their branch: zero evaluates the guard as it is, else its sign decides; of a floor it is
    the middle of the unit interval.
    """

    def __init__(self, builder: Builder, leaves: dict[Symbol, Value], tables_at: int = 0) -> None:
        self.b = builder
        self.leaves = leaves
        self.tables_at = tables_at
        self.branches: dict[Expr, Value] = {}
        self.memo: dict[Expr, Value] = {}

    def __call__(self, expr: Expr) -> Value:
        if expr in self.memo:
            return self.memo[expr]
        if expr in self.leaves:
            value = self.leaves[expr]
        elif expr.is_Number or expr.is_NumberSymbol:
            value = float(expr)
        else:
            value = self._rule(expr)(expr)
        self.memo[expr] = value
        return value

    def _rule(self, expr: Expr) -> Callable[[Expr], Value]:
        name = type(expr).__name__
        rule = getattr(self, f"_{name}", None)
        if rule is not None:
            return rule
        if name in LIBRARY:
            return lambda e: self.b.call(name, *[self(a) for a in e.args])
        raise TypeError(f"no native code for {name}")

    def _Add(self, expr: Expr) -> Value:
        plus = [a for a in expr.args if not a.could_extract_minus_sign()]
        minus = [a for a in expr.args if a.could_extract_minus_sign()]
        total: Value = 0.0
        for term in plus:
            total = self.b.add(total, self(term))
        for term in minus:
            total = self.b.sub(total, self(-term))
        return total

    def _Mul(self, expr: Expr) -> Value:
        top: Value = 1.0
        bottom: Value = 1.0
        for factor in joined(expr.args):
            if factor.is_Pow and factor.exp.is_Rational and factor.exp < 0:
                bottom = self.b.mul(bottom, self(factor.base ** (-factor.exp)))
            else:
                top = self.b.mul(top, self(factor))
        return self.b.div(top, bottom)

    def _Pow(self, expr: Expr) -> Value:
        base, exponent = expr.base, expr.exp
        if exponent.is_Rational:
            return self.b.power(self(base), Fraction(int(exponent.p), int(exponent.q)))
        return self.b.call("pow", self(base), self(exponent))

    def _Piecewise(self, expr: Expr) -> Value:
        held = getattr(expr, "order", None) is not None
        pieces = list(expr.args)
        last = pieces.pop()
        value = self(last.expr)
        if last.cond != True:  # noqa: E712  sympy's own true
            value = self.b.select(self.condition(last.cond, held), value, float("nan"))
        for piece in reversed(pieces):
            value = self.b.select(self.condition(piece.cond, held), self(piece.expr), value)
        return value

    def _floor(self, expr: Expr) -> Value:
        value = self.b.call("floor", self(expr.args[0]))
        held = self.branches.get(expr) if getattr(expr, "order", None) is not None else None
        if held is None:
            return value
        return self.b.select(self.b.compare("==", held, 0.0), value, self.b.sub(held, 0.5))

    def _Lookup(self, expr: Expr) -> Value:
        number, curve, order, x = expr.args
        table, at = self._table(number), ("double", self(x))
        piece = self.b.call_native(symbol(piece_at), "i64", table, at)
        known = (table, ("i64", piece), ("i64", int(curve)))
        return self.b.call_native(symbol(on_piece), "double", *known, at, ("i64", int(order)))

    def _LookupHeld(self, expr: Expr) -> Value:
        number, curve, order, piece, x = expr.args
        held, at = ("double", self(piece)), ("double", self(x))
        given = (self._table(number), held, ("i64", int(curve)), at, ("i64", int(order)))
        return self.b.call_native(symbol(on_held_piece), "double", *given)

    def _LookupBetweenHeld(self, expr: Expr) -> Value:
        number, order, z_order, strip, x, z = expr.args
        at = [("double", self(each)) for each in (strip, x, z)]
        orders = (("i64", int(order)), ("i64", int(z_order)))
        return self.b.call_native(
            symbol(on_held_strip), "double", self._table(number), *at, *orders
        )

    def _LookupBetween(self, expr: Expr) -> Value:
        number, order, z_order, x, z = expr.args
        table, at, across = self._table(number), ("double", self(x)), ("double", self(z))
        piece = self.b.call_native(symbol(piece_at), "i64", table, at)
        strip = self.b.call_native(symbol(strip_at), "i64", table, across)
        known = (table, ("i64", piece), ("i64", strip), at, across)
        orders = (("i64", int(order)), ("i64", int(z_order)))
        return self.b.call_native(symbol(on_strip), "double", *known, *orders)

    def _RoutineValue(self, expr: Expr) -> Value:
        number, *which = map(int, expr.args[: ROUTINE_FIRST - 1])
        table = self.b.table_at(self.tables_at + int(number))
        inputs = [self(each) for each in expr.args[ROUTINE_FIRST:]]
        return self.b.call_routine(
            symbol(routine_answer), table, [*map(int, which)], inputs, INPUTS
        )

    def _table(self, number: Expr) -> tuple[str, Value]:
        return "ptr", self.b.table_at(self.tables_at + int(number))

    def condition(self, cond: Expr, held: bool = False) -> str:
        """A sympy relation or logic expression as an ``i1`` value; ``held``: by its branch."""
        name = type(cond).__name__
        if name in ("And", "Or"):
            values = [self.condition(c, held) for c in cond.args]
            total = values[0]
            for value in values[1:]:
                total = self.b.logic(name.lower(), total, value)
            return total
        if name == "Not":
            return self.b.logic("xor", self.condition(cond.args[0], held), "true")
        if name in ("BooleanTrue", "BooleanFalse"):
            return "true" if cond else "false"
        branch = self.branches.get(cond) if held else None
        if branch is None:
            return self.b.compare(cond.rel_op, self(cond.lhs), self(cond.rhs))
        margin = self.b.sum_as_written(self.gap(cond), branch)
        return self.b.compare(">" if cond.rel_op in "<>" else ">=", margin, 0.0)

    def gap(self, cond: Expr) -> Value:
        """What is positive where a relation holds: the larger side less the smaller one."""
        less = cond.rel_op.startswith("<")
        large, small = (cond.rhs, cond.lhs) if less else (cond.lhs, cond.rhs)
        return self.b.sub(self(large), self(small))
