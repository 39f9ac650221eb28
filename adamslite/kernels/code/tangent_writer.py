"""The tangent of a residual: how it changes when its numbers and the state do.

    tangent(n, ints, reals, W, dreals, dW, dF)      dF += dF/dreals dreals + dF/dW dW

Each instruction of the residual is followed by that of its derivative, so that whatever it is made
of (levers, tables, routines, turns of angles) is differentiated, and the result is exact to
round-off.  What a branch holds is held in the tangent, too.

Reference: Griewank, Walther, Evaluating Derivatives, 2008, section 6.1 (forward mode).
"""

from __future__ import annotations

from collections.abc import Callable

from adamslite.kernels.code.lookup import on_held_piece, on_held_strip, on_piece, on_strip
from adamslite.kernels.code.module_text import LOOP
from adamslite.kernels.code.residual_writer import ResidualWriter
from adamslite.kernels.code.routine_call import routine_answer
from adamslite.kernels.code.shape import Outputs, Shape
from adamslite.native.llvm_builder import Builder, Value
from adamslite.native.translate import REGISTERED, symbol
from adamslite.native.translate.modules import definitions
from adamslite.native.translate.writer import module_text
from adamslite.symbolic.guards import guards
from adamslite.symbolic.routines import INPUTS
from adamslite.symbolic.scope import Scope
from adamslite.symbolic.types import Leaf

HEAD = (
    "define void @{name}(i64 %n, ptr noalias readonly %ints, ptr noalias readonly %reals, "
    "ptr readonly %W, ptr noalias readonly %dreals, ptr %dW, ptr %F) nounwind"
)
Given = tuple[str, Value]
GUARDED = ("clock", "watch")

#: Of native functions of tables: which argument is a place, and which is the order by it.
PLACES: dict[str, tuple[tuple[int, int], ...]] = {
    symbol(on_piece): ((3, 4),),
    symbol(on_held_piece): ((3, 4),),
    symbol(on_strip): ((3, 5), (4, 6)),
    symbol(on_held_strip): ((2, 4), (3, 5)),
}


class TangentBuilder(Builder):
    """Numbers with their derivatives: ``d`` has those of values that are not constant."""

    def __init__(self) -> None:
        super().__init__()
        self.d: dict[str, Value] = {}
        self.plain = 0

    def of(self, value: Value) -> Value:
        """The derivative of a value."""
        return self.d.get(value, 0.0) if isinstance(value, str) else 0.0

    def follow(self, value: Value, rule: Callable[[], Value]) -> Value:
        """A value that is followed by its derivative, once; none has one of its own."""
        if isinstance(value, str) and value not in self.d and not self.plain:
            self.plain += 1
            self.d[value] = rule()
            self.plain -= 1
        return value

    def add(self, a: Value, b: Value) -> Value:
        return self.follow(super().add(a, b), lambda: self.add(self.of(a), self.of(b)))

    def sub(self, a: Value, b: Value) -> Value:
        return self.follow(super().sub(a, b), lambda: self.sub(self.of(a), self.of(b)))

    def neg(self, a: Value) -> Value:
        return self.follow(super().neg(a), lambda: self.neg(self.of(a)))

    def mul(self, a: Value, b: Value) -> Value:
        return self.follow(
            super().mul(a, b), lambda: self.add(self.mul(self.of(a), b), self.mul(a, self.of(b)))
        )

    def div(self, a: Value, b: Value) -> Value:
        value = super().div(a, b)
        return self.follow(
            value, lambda: self.div(self.sub(self.of(a), self.mul(value, self.of(b))), b)
        )

    def sum_as_written(self, a: Value, b: Value) -> Value:
        return self.follow(super().sum_as_written(a, b), lambda: self.add(self.of(a), self.of(b)))

    def select(self, condition: str, a: Value, b: Value) -> Value:
        return self.follow(
            super().select(condition, a, b), lambda: self._chosen(condition, self.of(a), self.of(b))
        )

    def _chosen(self, condition: str, a: Value, b: Value) -> Value:
        return a if a == b else Builder.select(self, condition, a, b)

    def call(self, name: str, *args: Value) -> Value:
        value = super().call(name, *args)
        return self.follow(value, lambda: self._of_function(name, value, *args))

    def _of_function(self, name: str, value: Value, *args: Value) -> Value:
        total: Value = 0.0
        for n, each in enumerate(args):
            rate = self.of(each)
            if rate != 0.0 and name != "floor":
                total = self.add(total, self.mul(SLOPES[name, n](self, value, *args), rate))
        return total

    def call_native(self, name: str, result: str, *args: Given) -> str:
        value = super().call_native(name, result, *args)
        if name in PLACES:
            self.follow(value, lambda: self._of_table(name, result, args))
        return value

    def _of_table(self, name: str, result: str, args: tuple[Given, ...]) -> Value:
        total: Value = 0.0
        for place, order in PLACES[name]:
            rate = self.of(args[place][1])
            if rate != 0.0:
                next_one = [*args]
                next_one[order] = ("i64", int(args[order][1]) + 1)
                slope = Builder.call_native(self, name, result, *next_one)
                total = self.add(total, self.mul(slope, rate))
        return total

    def call_routine(
        self, name: str, table: str, which: list[int], inputs: list[Value], first: int
    ) -> str:
        value = super().call_routine(name, table, which, inputs, first)
        self.follow(value, lambda: self._of_routine(table, which, inputs))
        return value

    def _of_routine(self, table: str, which: list[int], inputs: list[Value]) -> Value:
        component, one, other = which
        total: Value = 0.0
        for by, each in enumerate(inputs, 1):
            rate = self.of(each)
            if rate != 0.0 and other == 0:
                pair = [one, by] if one else [by, 0]
                slope = Builder.call_routine(
                    self, symbol(routine_answer), table, [component, *pair], inputs, INPUTS
                )
                total = self.add(total, self.mul(slope, rate))
        return total

    def read(self, array: str, base: str, shift: int) -> str:
        value = super().read(array, base, shift)
        if array == "W":
            self.follow(value, lambda: Builder.read(self, "dW", base, shift))
        return value

    def real_at(self, position: int) -> str:
        return str(self.follow(super().real_at(position), lambda: self._its_rate(position)))

    def _its_rate(self, position: int) -> str:
        at = self.emit(("da", position), f"getelementptr double, ptr %dp, i64 {position}")
        return self.emit(("dr", position), f"load double, ptr {at}")

    def accumulate(self, array: str, base: str, shift: int, value: Value) -> None:
        """The derivative of what a residual adds."""
        self.plain += 1
        super().accumulate(array, base, shift, self.of(value))
        self.plain -= 1


def _root(b: Builder, square: Value) -> Value:
    return b.call("sqrt", square)


def _gap(b: Builder, x: Value, sign: float) -> Value:
    """1 + sign x^2"""
    return b.add(1.0, b.mul(sign, b.mul(x, x)))


def _point(b: Builder, y: Value, x: Value) -> Value:
    return b.add(b.mul(x, x), b.mul(y, y))


#: By name and argument: the slope of a function, of its value and its arguments.
SLOPES: dict[tuple[str, int], Callable[..., Value]] = {
    ("sin", 0): lambda b, v, x: b.call("cos", x),
    ("cos", 0): lambda b, v, x: b.neg(b.call("sin", x)),
    ("tan", 0): lambda b, v, x: _gap(b, v, 1.0),
    ("asin", 0): lambda b, v, x: b.div(1.0, _root(b, _gap(b, x, -1.0))),
    ("acos", 0): lambda b, v, x: b.div(-1.0, _root(b, _gap(b, x, -1.0))),
    ("atan", 0): lambda b, v, x: b.div(1.0, _gap(b, x, 1.0)),
    ("sinh", 0): lambda b, v, x: b.call("cosh", x),
    ("cosh", 0): lambda b, v, x: b.call("sinh", x),
    ("tanh", 0): lambda b, v, x: _gap(b, v, -1.0),
    ("exp", 0): lambda b, v, x: v,
    ("log", 0): lambda b, v, x: b.div(1.0, x),
    ("sqrt", 0): lambda b, v, x: b.div(0.5, v),
    ("atan2", 0): lambda b, v, y, x: b.div(x, _point(b, y, x)),
    ("atan2", 1): lambda b, v, y, x: b.neg(b.div(y, _point(b, y, x))),
    ("pow", 0): lambda b, v, x, n: b.mul(n, b.call("pow", x, b.sub(n, 1.0))),
    ("pow", 1): lambda b, v, x, n: b.mul(v, b.call("log", x)),
}


class TangentWriter(ResidualWriter):
    """Writes the loop body of the tangent."""

    b: TangentBuilder

    def __init__(self, shape: Shape, scope: Scope) -> None:
        super().__init__(shape, scope, TangentBuilder())

    def leaf(self, leaf: Leaf) -> Value:
        value = super().leaf(leaf)
        if leaf[0] in ("t", "now"):
            self.b.follow(value, lambda: self.b.emit(("dt",), "load double, ptr %dW"))
        return value


def write_tangents(shape: Shape, name: str, face: str, n_ints: int) -> str:
    """LLVM text of the tangent of a shape's residual, and of those of its guards of the clock and
    of the state where it has some; ``n_ints``: integers of an instance.
    """
    scope = Scope(shape.slots)
    out: Outputs = shape.outputs(scope)
    shape.n_angles, shape.n_limits = len(scope.angles) + len(scope.kept), len(scope.limits)
    if face != "output":
        shape.guards = guards(out.expressions, scope.leaves, face, scope.written)
    writer = TangentWriter(shape, scope)
    writer.residual(out)
    bodies = [(f"{name}_tangent", writer)]
    kinds = shape.guards.kinds
    for place, found in enumerate((kinds["clock"], kinds["watch"] + kinds["zone"])):
        if found:
            writer = TangentWriter(shape, scope)
            writer.guard_values(place)
            bodies.append((f"{name}_tangent_{GUARDED[place]}", writer))
    return _module(bodies, n_ints, shape.n_reals)


def _module(bodies: list[tuple[str, TangentWriter]], n_ints: int, n_reals: int) -> str:
    declared, parts = definitions(
        REGISTERED[name] for name in sorted({name for _, w in bodies for name in w.b.called})
    )
    for name, writer in bodies:
        lines = ["  %dp = getelementptr double, ptr %dreals, i64 %ro", *writer.b.finished()]
        head, body = HEAD.format(name=name), "\n".join(lines)
        parts.append(LOOP.format(head=head, prelude="", n_ints=n_ints, n_reals=n_reals, body=body))
        declared |= writer.b.declared
    return module_text(declared, parts)
