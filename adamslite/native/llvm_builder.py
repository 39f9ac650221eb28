"""A builder of straight-line LLVM assembly.

A value is a Python ``float`` (known now) or an SSA name (known at run time).  Every operation folds
constants and is numbered by its operands, so equal subexpressions are computed once and a symbolic
zero costs nothing.  The text produced is LLVM assembly; :mod:`adamslite.native.compiler` compiles
it.

Floating point: products and sums may be contracted and reassociated, divisions may become products
with a reciprocal; infinities and not-a-numbers keep their meaning.
"""

from __future__ import annotations

from fractions import Fraction

Value = float | str


FAST = "reassoc nsz arcp contract"


COMMUTATIVE = {"fadd", "fmul"}


LIBRARY = frozenset("sin cos tan asin acos atan atan2 sinh cosh tanh exp log floor".split())


LONGEST_PRODUCT = 64
"""Greatest power that is written out as products: twelve at the most."""


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
        self.numbered: dict[tuple[object, ...], str] = {}
        self.declared: set[str] = set()
        self.called: set[str] = set()
        self.count = 0
        self.sums: dict[tuple[str, str, int], Value] = {}

    def fresh(self) -> str:
        self.count += 1
        return f"%v{self.count}"

    def emit(self, key: tuple[object, ...], text: str) -> str:
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

    def call_routine(
        self, name: str, table: str, which: list[int], inputs: list[Value], first: int
    ) -> str:
        """A native function of a table and integers that reads ``inputs`` from that table, where
        they are stored from position ``first`` on.
        """
        self.called.add(name)
        key = (name, table, *which, *inputs)
        if key in self.numbered:
            return self.numbered[key]
        for position, value in enumerate(inputs, first):
            at = self.emit(
                ("in", table, position), f"getelementptr double, ptr {table}, i64 {position}"
            )
            self.lines.append(f"  store double {self.operand(value)}, ptr {at}")
        given = ", ".join(f"i64 {number}" for number in which)
        return self.emit(key, f"call double @{name}(ptr {table}, {given})")

    def power(self, base: Value, exponent: Fraction) -> Value:
        """``base**exponent``: products for integers, square roots for halves."""
        if exponent < 0:
            return self.div(1.0, self.power(base, -exponent))
        if exponent.denominator == 2:
            root = self.call("sqrt", base)
            return self.mul(root, self.power(base, Fraction(exponent.numerator - 1, 2)))
        if exponent.denominator != 1 or exponent > LONGEST_PRODUCT:
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
        """``array[base + shift] += value``, once for all that is added there."""
        if value != 0.0:
            place = (array, base, shift)
            self.sums[place] = self.add(self.sums.get(place, 0.0), value)

    def finished(self) -> list[str]:
        """All instructions, those that write the sums at the end."""
        for (array, base, shift), value in self.sums.items():
            address, old, new = self.address(array, base, shift), self.fresh(), self.fresh()
            self.lines.append(f"  {old} = load double, ptr {address}")
            self.lines.append(f"  {new} = fadd {FAST} double {old}, {self.operand(value)}")
            self.lines.append(f"  store double {new}, ptr {address}")
        self.sums.clear()
        return self.lines

    def store(self, array: str, base: str, shift: int, value: Value) -> None:
        """``array[base + shift] = value``."""
        address = self.address(array, base, shift)
        self.lines.append(f"  store double {self.operand(value)}, ptr {address}")

    def store_real(self, position: int, value: Value) -> None:
        """Overwrite real ``position`` of the present instance."""
        address = self.emit(("ra", position), f"getelementptr double, ptr %rp, i64 {position}")
        self.lines.append(f"  store double {self.operand(value)}, ptr {address}")


def _operand(kind: str, value: Value) -> str:
    return literal(float(value)) if kind == "double" and not isinstance(value, str) else f"{value}"
