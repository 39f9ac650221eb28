"""Straight-line native code from sympy expressions: the value builder.

A value is a Python ``float`` (known now) or an SSA name (known at run time).  Every operation folds
constants and is numbered by its operands, so equal subexpressions are computed once and a symbolic
zero costs nothing.  The text produced is LLVM assembly; :mod:`adamslite.native.compiler` compiles
it.

Floating point: products and sums may be contracted and reassociated, divisions may become products
with a reciprocal; infinities and not-a-numbers keep their meaning.
"""

from __future__ import annotations

from fractions import Fraction
from typing import Any

Value = float | str

FAST = "reassoc nsz arcp contract"
COMMUTATIVE = {"fadd", "fmul"}
LIBRARY = frozenset("sin cos tan asin acos atan atan2 sinh cosh tanh exp log floor".split())
INTRINSICS = {"sqrt", "sin", "cos", "exp", "log", "floor", "pow"}
COMPARISONS = {"<": "olt", "<=": "ole", ">": "ogt", ">=": "oge", "==": "oeq", "!=": "une"}


def literal(value: float) -> str:
    """The exact LLVM spelling of a double."""
    import struct

    return f"0x{struct.unpack('<Q', struct.pack('<d', value))[0]:016X}"


class Builder:
    """Collects numbered instructions of one loop body."""

    def __init__(self) -> None:
        self.lines: list[str] = []
        self.numbered: dict[tuple, str] = {}
        self.declared: set[str] = set()
        self.called: set[str] = set()
        self.count = 0

    def fresh(self) -> str:
        self.count += 1
        return f"%v{self.count}"

    def emit(self, key: tuple, text: str) -> str:
        """One numbered instruction; an equal earlier one is reused."""
        if key in self.numbered:
            return self.numbered[key]
        name = self.fresh()
        self.lines.append(f"  {name} = {text}")
        self.numbered[key] = name
        return name

    def operand(self, value: Value) -> str:
        return value if isinstance(value, str) else literal(float(value))

    def _binary(self, op: str, a: Value, b: Value) -> Value:
        if op in COMMUTATIVE and str(a) > str(b):
            a, b = b, a
        text = f"{op} {FAST} double {self.operand(a)}, {self.operand(b)}"
        return self.emit((op, a, b), text)

    def add(self, a: Value, b: Value) -> Value:
        if not isinstance(a, str) and not isinstance(b, str):
            return a + b
        if a == 0.0:
            return b
        if b == 0.0:
            return a
        return self._binary("fadd", a, b)

    def sub(self, a: Value, b: Value) -> Value:
        if not isinstance(a, str) and not isinstance(b, str):
            return a - b
        if b == 0.0:
            return a
        if a == 0.0:
            return self.neg(b)
        if a == b:
            return 0.0
        return self._binary("fsub", a, b)

    def neg(self, a: Value) -> Value:
        if not isinstance(a, str):
            return -a
        return self.emit(("fneg", a), f"fneg {FAST} double {a}")

    def mul(self, a: Value, b: Value) -> Value:
        if not isinstance(a, str) and not isinstance(b, str):
            return a * b
        for one, other in ((a, b), (b, a)):
            if one == 0.0:
                return 0.0
            if one == 1.0:
                return other
            if one == -1.0:
                return self.neg(other)
        return self._binary("fmul", a, b)

    def div(self, a: Value, b: Value) -> Value:
        if a == 0.0:
            return 0.0
        if b == 1.0:
            return a
        if not isinstance(a, str) and not isinstance(b, str) and b != 0.0:
            return a / b
        return self._binary("fdiv", a, b)

    def call(self, name: str, *args: Value) -> Value:
        """A mathematical function of doubles from LLVM or the C library."""
        target = f"llvm.{name}.f64" if name in INTRINSICS else name
        self.declared.add(f"declare double @{target}({', '.join(['double'] * len(args))})")
        operands = ", ".join(f"double {self.operand(a)}" for a in args)
        return self.emit((target, *args), f"call {FAST} double @{target}({operands})")

    def call_native(self, name: str, result: str, *args: tuple[str, Value]) -> str:
        """A native function (:mod:`adamslite.native.translate`) of arguments (type, value); it
        reads only what this kernel does not write.
        """
        self.called.add(name)
        operands = ", ".join(f"{kind} {_operand(kind, value)}" for kind, value in args)
        return self.emit((name, *args), f"call {result} @{name}({operands})")

    def power(self, base: Value, exponent: Fraction) -> Value:
        """``base**exponent``: products for integers, square roots for halves."""
        if exponent < 0:
            return self.div(1.0, self.power(base, -exponent))
        if exponent.denominator == 2:
            root = self.call("sqrt", base)
            return self.mul(root, self.power(base, Fraction(exponent.numerator - 1, 2)))
        if exponent.denominator != 1 or exponent > 64:
            return self.call("pow", base, float(exponent))
        result: Value = 1.0
        square, n = base, int(exponent)
        while n:
            if n & 1:
                result = self.mul(result, square)
            n >>= 1
            if n:
                square = self.mul(square, square)
        return result

    def compare(self, relation: str, a: Value, b: Value) -> str:
        code = COMPARISONS[relation]
        text = f"fcmp {code} double {self.operand(a)}, {self.operand(b)}"
        return self.emit(("fcmp", code, a, b), text)

    def sum_as_written(self, a: Value, b: Value) -> Value:
        """a + b, never taken apart: a huge ``b`` outweighs whatever ``a`` was made of."""
        return self.emit(("sum", a, b), f"fadd double {self.operand(a)}, {self.operand(b)}")

    def logic(self, op: str, a: str, b: str) -> str:
        return self.emit((op, a, b), f"{op} i1 {a}, {b}")

    def select(self, condition: str, a: Value, b: Value) -> Value:
        if a == b:
            return a
        text = f"select i1 {condition}, double {self.operand(a)}, double {self.operand(b)}"
        return self.emit(("select", condition, a, b), text)

    def int_at(self, position: int) -> str:
        """Integer ``position`` of the present instance."""
        address = self.emit(("ia", position), f"getelementptr i64, ptr %ip, i64 {position}")
        return self.emit(("i", position), f"load i64, ptr {address}, !invariant.load !7")

    def table_at(self, position: int) -> str:
        """The table whose address is integer ``position`` of the present instance."""
        address = self.emit(("ia", position), f"getelementptr i64, ptr %ip, i64 {position}")
        return self.emit(("table", position), f"load ptr, ptr {address}, !invariant.load !7")

    def real_at(self, position: int) -> str:
        """Real ``position`` of the present instance."""
        address = self.emit(("ra", position), f"getelementptr double, ptr %rp, i64 {position}")
        return self.emit(("r", position), f"load double, ptr {address}")

    def address(self, array: str, base: str, shift: int) -> str:
        first = self.emit(("p", array, base), f"getelementptr double, ptr %{array}, i64 {base}")
        if not shift:
            return first
        return self.emit(
            ("p", array, base, shift), f"getelementptr double, ptr {first}, i64 {shift}"
        )

    def read(self, array: str, base: str, shift: int) -> str:
        """``array[base + shift]`` of an array this kernel does not write."""
        return self.emit(
            ("read", array, base, shift), f"load double, ptr {self.address(array, base, shift)}"
        )

    def accumulate(self, array: str, base: str, shift: int, value: Value) -> None:
        """``array[base + shift] += value``."""
        if value == 0.0:
            return
        address, old, new = self.address(array, base, shift), self.fresh(), self.fresh()
        self.lines.append(f"  {old} = load double, ptr {address}")
        self.lines.append(f"  {new} = fadd {FAST} double {old}, {self.operand(value)}")
        self.lines.append(f"  store double {new}, ptr {address}")

    def store_real(self, position: int, value: Value) -> None:
        """Overwrite real ``position`` of the present instance."""
        address = self.emit(("ra", position), f"getelementptr double, ptr %rp, i64 {position}")
        self.lines.append(f"  store double {self.operand(value)}, ptr {address}")


def _operand(kind: str, value: Value) -> str:
    return literal(float(value)) if kind == "double" and not isinstance(value, str) else f"{value}"


def joined(factors: tuple[Any, ...]) -> list[Any]:
    """Factors of a product with x**e/x as x**(e - 1): the slope of x**e, at x = 0 not 0/0."""
    raised = [f for f in factors if f.is_Pow and not f.exp.is_number]
    if not raised:
        return list(factors)
    powers: dict[Any, Any] = {}
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

    def __init__(self, builder: Builder, leaves: dict[Any, Value], tables_at: int = 0) -> None:
        self.b = builder
        self.leaves = leaves
        self.tables_at = tables_at
        self.branches: dict[Any, Value] = {}
        self.memo: dict[Any, Value] = {}

    def __call__(self, expr: Any) -> Value:
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

    def _rule(self, expr: Any) -> Any:
        name = type(expr).__name__
        rule = getattr(self, f"_{name}", None)
        if rule is not None:
            return rule
        if name in LIBRARY:
            return lambda e: self.b.call(name, *[self(a) for a in e.args])
        raise TypeError(f"no native code for {name}")

    def _Add(self, expr: Any) -> Value:
        plus = [a for a in expr.args if not a.could_extract_minus_sign()]
        minus = [a for a in expr.args if a.could_extract_minus_sign()]
        total: Value = 0.0
        for term in plus:
            total = self.b.add(total, self(term))
        for term in minus:
            total = self.b.sub(total, self(-term))
        return total

    def _Mul(self, expr: Any) -> Value:
        top: Value = 1.0
        bottom: Value = 1.0
        for factor in joined(expr.args):
            if factor.is_Pow and factor.exp.is_Rational and factor.exp < 0:
                bottom = self.b.mul(bottom, self(factor.base ** (-factor.exp)))
            else:
                top = self.b.mul(top, self(factor))
        return self.b.div(top, bottom)

    def _Pow(self, expr: Any) -> Value:
        base, exponent = expr.base, expr.exp
        if exponent.is_Rational:
            return self.b.power(self(base), Fraction(int(exponent.p), int(exponent.q)))
        return self.b.call("pow", self(base), self(exponent))

    def _Piecewise(self, expr: Any) -> Value:
        held = getattr(expr, "order", None) is not None
        pieces = list(expr.args)
        last = pieces.pop()
        value = self(last.expr)
        if last.cond != True:  # noqa: E712  sympy's own true
            value = self.b.select(self.condition(last.cond, held), value, float("nan"))
        for piece in reversed(pieces):
            value = self.b.select(self.condition(piece.cond, held), self(piece.expr), value)
        return value

    def _floor(self, expr: Any) -> Value:
        value = self.b.call("floor", self(expr.args[0]))
        held = self.branches.get(expr) if getattr(expr, "order", None) is not None else None
        if held is None:
            return value
        return self.b.select(self.b.compare("==", held, 0.0), value, self.b.sub(held, 0.5))

    def _Lookup(self, expr: Any) -> Value:
        number, curve, order, x = expr.args
        table, at = self._table(number), ("double", self(x))
        piece = self.b.call_native("piece_at", "i64", table, at)
        known = (table, ("i64", piece), ("i64", int(curve)))
        return self.b.call_native("on_piece", "double", *known, at, ("i64", int(order)))

    def _LookupBetween(self, expr: Any) -> Value:
        number, order, z_order, x, z = expr.args
        table, at, across = self._table(number), ("double", self(x)), ("double", self(z))
        piece = self.b.call_native("piece_at", "i64", table, at)
        strip = self.b.call_native("strip_at", "i64", table, across)
        known = (table, ("i64", piece), ("i64", strip), at, across)
        orders = (("i64", int(order)), ("i64", int(z_order)))
        return self.b.call_native("on_strip", "double", *known, *orders)

    def _table(self, number: Any) -> tuple[str, Value]:
        return "ptr", self.b.table_at(self.tables_at + int(number))

    def condition(self, cond: Any, held: bool = False) -> str:
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

    def gap(self, cond: Any) -> Value:
        """What is positive where a relation holds: the larger side less the smaller one."""
        less = cond.rel_op.startswith("<")
        large, small = (cond.rhs, cond.lhs) if less else (cond.lhs, cond.rhs)
        return self.b.sub(self(large), self(small))
