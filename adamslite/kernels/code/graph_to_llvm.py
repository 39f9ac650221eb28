"""From expressions to values of an :class:`~adamslite.native.llvm_builder.Builder`."""

from __future__ import annotations

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
from adamslite.symbolic.structure import CONDITIONS, ordered
from adamslite.symbolic.types import Expr, Symbol

NAMES = {"+": "sum", "-": "difference", "*": "product", "/": "quotient", "**": "power"}


class Lowering:
    """Turns expressions into builder values; ``leaves`` maps symbols to values.

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
        if expr not in self.memo:
            for top in ordered([expr], lambda top: () if top in self.memo else top.args):
                if top not in self.memo and top.kind not in CONDITIONS:
                    self.memo[top] = self._value(top)
        return self.memo[expr]

    def _value(self, top: Expr) -> Value:
        if top.kind == "symbol":
            return self.leaves[top]
        if top.kind == "number":
            return float(top)
        rule = getattr(self, f"_{NAMES.get(top.kind, top.kind)}", None)
        if rule is not None:
            return rule(top)
        if top.kind in LIBRARY:
            return self.b.call(top.kind, *[self.memo[each] for each in top.args])
        raise TypeError(f"no native code for {top.kind}")

    def _sum(self, expr: Expr) -> Value:
        return self.b.add(*[self.memo[each] for each in expr.args])

    def _difference(self, expr: Expr) -> Value:
        return self.b.sub(*[self.memo[each] for each in expr.args])

    def _neg(self, expr: Expr) -> Value:
        return self.b.neg(self.memo[expr.args[0]])

    def _product(self, expr: Expr) -> Value:
        return self.b.mul(*[self.memo[each] for each in expr.args])

    def _quotient(self, expr: Expr) -> Value:
        return self.b.div(*[self.memo[each] for each in expr.args])

    def _power(self, expr: Expr) -> Value:
        base, exponent = expr.args
        if exponent.kind == "number" and 2.0 * float(exponent) % 1.0 == 0.0:
            return self.b.power(self.memo[base], Fraction(float(exponent)))
        return self.b.call("pow", self.memo[base], self.memo[exponent])

    def _choice(self, expr: Expr) -> Value:
        held = expr.order is not None
        value = self.memo[expr.args[-1]]
        for piece, condition in reversed([*expr.pieces]):
            value = self.b.select(self.condition(condition, held), self.memo[piece], value)
        return value

    def _floor(self, expr: Expr) -> Value:
        value = self.b.call("floor", self.memo[expr.args[0]])
        held = self.branches.get(expr) if expr.order is not None else None
        if held is None:
            return value
        return self.b.select(self.b.compare("==", held, 0.0), value, self.b.sub(held, 0.5))

    def _Lookup(self, expr: Expr) -> Value:
        number, curve, order, x = expr.args
        table, at = self._table(number), ("double", self.memo[x])
        piece = self.b.call_native(symbol(piece_at), "i64", table, at)
        known = (table, ("i64", piece), ("i64", int(curve)))
        return self.b.call_native(symbol(on_piece), "double", *known, at, ("i64", int(order)))

    def _LookupHeld(self, expr: Expr) -> Value:
        number, curve, order, piece, x = expr.args
        held, at = ("double", self.memo[piece]), ("double", self.memo[x])
        given = (self._table(number), held, ("i64", int(curve)), at, ("i64", int(order)))
        return self.b.call_native(symbol(on_held_piece), "double", *given)

    def _LookupBetweenHeld(self, expr: Expr) -> Value:
        number, order, z_order, strip, x, z = expr.args
        at = [("double", self.memo[each]) for each in (strip, x, z)]
        orders = (("i64", int(order)), ("i64", int(z_order)))
        return self.b.call_native(
            symbol(on_held_strip), "double", self._table(number), *at, *orders
        )

    def _LookupBetween(self, expr: Expr) -> Value:
        number, order, z_order, x, z = expr.args
        table, at, across = self._table(number), ("double", self.memo[x]), ("double", self.memo[z])
        piece = self.b.call_native(symbol(piece_at), "i64", table, at)
        strip = self.b.call_native(symbol(strip_at), "i64", table, across)
        known = (table, ("i64", piece), ("i64", strip), at, across)
        orders = (("i64", int(order)), ("i64", int(z_order)))
        return self.b.call_native(symbol(on_strip), "double", *known, *orders)

    def _RoutineValue(self, expr: Expr) -> Value:
        number, *which = map(int, expr.args[: ROUTINE_FIRST - 1])
        table = self.b.table_at(self.tables_at + int(number))
        inputs = [self.memo[each] for each in expr.args[ROUTINE_FIRST:]]
        return self.b.call_routine(
            symbol(routine_answer), table, [*map(int, which)], inputs, INPUTS
        )

    def _table(self, number: Expr) -> tuple[str, Value]:
        return "ptr", self.b.table_at(self.tables_at + int(number))

    def condition(self, cond: Expr, held: bool = False) -> str:
        """A condition as an ``i1`` value; ``held``: by its branch."""
        if cond.kind in ("and", "or"):
            values = [self.condition(c, held) for c in cond.args]
            total = values[0]
            for value in values[1:]:
                total = self.b.logic(cond.kind, total, value)
            return total
        if cond.kind == "not":
            return self.b.logic("xor", self.condition(cond.args[0], held), "true")
        if cond.kind in ("true", "false"):
            return cond.kind
        branch = self.branches.get(cond) if held else None
        if branch is None:
            return self.b.compare(cond.kind, *map(self, cond.args))
        margin = self.b.sum_as_written(self.gap(cond), branch)
        return self.b.compare(">" if cond.kind in "<>" else ">=", margin, 0.0)

    def gap(self, cond: Expr) -> Value:
        """What is positive where a relation holds: the larger side less the smaller one."""
        large, small = reversed(cond.args) if cond.kind.startswith("<") else cond.args
        return self.b.sub(self(large), self(small))
