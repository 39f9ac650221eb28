"""Expressions of the native language."""

from __future__ import annotations

import ast

from adamslite.native.llvm_builder import COMPARISONS, literal
from adamslite.native.translate.language import is_native, llvm_type, name_of, signature, symbol
from adamslite.native.translate.records import (
    ARRAYS,
    SLOT,
    ByReference,
    Inside,
    Nested,
    RecordField,
    RowsOf,
    Scalar,
    is_record,
)
from adamslite.native.translate.writer import Value, Writer

INT_OPS = {
    ast.Add: "add",
    ast.Sub: "sub",
    ast.Mult: "mul",
    ast.FloorDiv: "sdiv",
    ast.Mod: "srem",
    ast.BitAnd: "and",
}
FLOAT_OPS = {ast.Add: "fadd", ast.Sub: "fsub", ast.Mult: "fmul", ast.Div: "fdiv"}
#: Relations: the symbol, and the test of integers.
TESTS = {
    ast.Lt: ("<", "slt"),
    ast.LtE: ("<=", "sle"),
    ast.Gt: (">", "sgt"),
    ast.GtE: (">=", "sge"),
    ast.Eq: ("==", "eq"),
    ast.NotEq: ("!=", "ne"),
}
# How what stands in a record of an array is loaded: it stays as it is in a run.
ADDRESS = "!tbaa !3, !invariant.load !7"


class Expressions(Writer):
    """Translates an expression to a value."""

    def target(self, node: ast.expr) -> tuple[str, str]:
        """Address and kind of the number that ``array[index]`` or ``record.field`` is."""
        if isinstance(node, ast.Attribute):
            owner, field = self.field(node)
            if isinstance(field, Scalar):
                return self.place(owner, field.at), field.kind
        elif isinstance(node, ast.Subscript):
            array = self.expression(node.value)
            if array.kind in ARRAYS:
                return self.shifted(array, self.expression(node.slice)), ARRAYS[array.kind]
        raise self.fail(node, "only numbers in arrays and records can be assigned")

    def field(self, node: ast.Attribute) -> tuple[Value, RecordField]:
        """The record and its field that ``record.field`` means."""
        owner = self.expression(node.value)
        if not is_record(owner.kind):
            raise self.fail(node, f"{name_of(owner.kind)} is not a record")
        if node.attr not in owner.kind.fields:
            raise self.fail(node, f"{owner.kind.__name__} has no field {node.attr}")
        return owner, owner.kind.fields[node.attr]

    def expression(self, node: ast.expr) -> Value:
        handler = getattr(self, f"of_{type(node).__name__}", None)
        if handler is None:
            raise self.fail(node, f"{type(node).__name__} is not translated")
        return handler(node)

    def of_Constant(self, node: ast.Constant) -> Value:
        return self.constant(node, node.value)

    def of_Name(self, node: ast.Name) -> Value:
        if node.id in self.locals:
            return self.load_local(node.id)
        if node.id not in self.globals:
            raise self.fail(node, f"{node.id} is not known here")
        return self.constant(node, self.globals[node.id])

    def of_Attribute(self, node: ast.Attribute) -> Value:
        """``C.now``, what a record holds; ``P.q.size``, the length of an array that it holds."""
        if node.attr == "size" and isinstance(node.value, ast.Attribute):
            owner, field = self.field(node.value)
            if isinstance(field, Inside):
                return Value(str(field.slots), "i64")
            if isinstance(field, ByReference):
                at = self.place(owner, field.at + 1)
                return self.value("i64", f"load i64, ptr {at}, {ADDRESS}")
        owner, field = self.field(node)
        at = self.place(owner, field.at)
        if isinstance(field, Scalar):
            return self.load(at, field.kind)
        if isinstance(field, Nested | Inside):
            return Value(at, field.kind)
        return self.value(field.kind, f"load ptr, ptr {at}, {ADDRESS}")

    def of_Subscript(self, node: ast.Subscript) -> Value:
        array = self.expression(node.value)
        if array.kind not in ARRAYS and not isinstance(array.kind, RowsOf):
            raise self.fail(node, f"{name_of(array.kind)} is not an array")
        if isinstance(node.slice, ast.Slice):
            if node.slice.lower is None or node.slice.upper or node.slice.step:
                raise self.fail(node, "a slice has a start only")
            if isinstance(array.kind, RowsOf):
                raise self.fail(node, "rows are not shifted")
            return Value(self.shifted(array, self.expression(node.slice.lower)), array.kind)
        at = self.shifted(array, self.expression(node.slice))
        if isinstance(array.kind, RowsOf):
            return Value(at, array.kind.record)
        return self.load(at, ARRAYS[array.kind])

    def of_BinOp(self, node: ast.BinOp) -> Value:
        if isinstance(node.op, ast.Pow):
            return self.power(node)
        return self.arithmetic(
            node, node.op, self.expression(node.left), self.expression(node.right)
        )

    def arithmetic(self, node: ast.AST, op: ast.operator, a: Value, b: Value) -> Value:
        if a.kind == b.kind == "i64" and type(op) in INT_OPS:
            return self.value("i64", f"{INT_OPS[type(op)]} i64 {a.text}, {b.text}")
        if type(op) not in FLOAT_OPS:
            raise self.fail(node, f"{type(op).__name__} needs integers")
        x, y = self.convert(a, "double"), self.convert(b, "double")
        text = f"{FLOAT_OPS[type(op)]} {self.freedom}double {x.text}, {y.text}"
        return self.value("double", text)

    def power(self, node: ast.BinOp) -> Value:
        base, exponent = (
            self.convert(self.expression(n), "double") for n in (node.left, node.right)
        )
        if exponent.text == literal(0.5):
            return self.library("llvm.sqrt.f64", base)
        return self.library("llvm.pow.f64", base, exponent)

    def of_UnaryOp(self, node: ast.UnaryOp) -> Value:
        if isinstance(node.op, ast.Not):
            return self.value("i1", f"xor i1 {self.truth(node.operand).text}, true")
        if not isinstance(node.op, ast.USub):
            raise self.fail(node, f"{type(node.op).__name__} is not translated")
        if isinstance(node.operand, ast.Constant) and isinstance(node.operand.value, int | float):
            return self.constant(node, -node.operand.value)
        value = self.expression(node.operand)
        if value.kind == "i64":
            return self.value("i64", f"sub i64 0, {value.text}")
        return self.value("double", f"fneg double {value.text}")

    def of_Compare(self, node: ast.Compare) -> Value:
        op, a, b = (
            type(node.ops[0]),
            self.expression(node.left),
            self.expression(node.comparators[0]),
        )
        if len(node.ops) > 1:
            raise self.fail(node, "chained comparisons are not translated")
        if op not in TESTS:
            raise self.fail(node, f"{op.__name__} is not translated")
        relation, of_integers = TESTS[op]
        if a.kind == b.kind and a.kind in ("i64", "i1"):
            return self.value("i1", f"icmp {of_integers} {a.kind} {a.text}, {b.text}")
        x, y = self.convert(a, "double"), self.convert(b, "double")
        return self.value("i1", f"fcmp {COMPARISONS[relation]} double {x.text}, {y.text}")

    def truth(self, node: ast.expr) -> Value:
        value = self.expression(node)
        if value.kind == "i64":
            return self.value("i1", f"icmp ne i64 {value.text}, 0")
        if value.kind != "i1":
            raise self.fail(node, "a condition must be a comparison, a bool or an int")
        return value

    def of_BoolOp(self, node: ast.BoolOp) -> Value:
        """Short circuit through a memory slot."""
        result, after = self.slot("i1"), self.label()
        for position, part in enumerate(node.values):
            value = self.truth(part)
            self.line(f"store i1 {value.text}, ptr {result}")
            if position + 1 < len(node.values):
                following = self.label()
                ends = (following, after) if isinstance(node.op, ast.And) else (after, following)
                self.branch(value, *ends)
                self.start(following)
        self.start(after)
        return self.value("i1", f"load i1, ptr {result}")

    def of_IfExp(self, node: ast.IfExp) -> Value:
        yes, no, after = self.label(), self.label(), self.label()
        self.branch(self.truth(node.test), yes, no)
        self.start(yes)
        first = self.expression(node.body)
        result = self.slot(first.kind)
        self.line(f"store {llvm_type(first.kind)} {first.text}, ptr {result}")
        self.jump(after)
        self.start(no)
        second = self.convert(self.expression(node.orelse), first.kind)
        self.line(f"store {llvm_type(first.kind)} {second.text}, ptr {result}")
        self.start(after)
        return self.value(first.kind, f"load {llvm_type(first.kind)}, ptr {result}")

    def of_Call(self, node: ast.Call) -> Value:
        if not isinstance(node.func, ast.Name) or node.keywords:
            raise self.fail(node, "only calls by name and by position are translated")
        name = node.func.id
        if name in ("min", "max"):
            return self.extreme(name, [self.expression(a) for a in node.args])
        args = [self.expression(a) for a in node.args]
        if name == "abs":
            return self.library("llvm.fabs.f64", *args)
        if name in ("sqrt", "floor"):
            return self.library(f"llvm.{name}.f64", *args)
        if name == "maximum":
            return self.library("llvm.maximum.f64", *args)
        if name in ("float", "int"):
            return self.number(name, args[0])
        if name in ("call_address", "copy"):
            return getattr(self, name)(node, args)
        if is_record(self.globals.get(name)):
            return self.seen_as(node, self.globals[name], args)
        return self.call_native(node, name, args)

    def number(self, name: str, value: Value) -> Value:
        """``float(value)``, ``int(value)``"""
        if name == "float" or value.kind == "i64":
            return self.convert(value, "double" if name == "float" else "i64")
        real = self.convert(value, "double")
        return self.value("i64", f"fptosi double {real.text} to i64")

    def seen_as(self, node: ast.Call, record: type, args: list[Value]) -> Value:
        """``Record(array)``: the same memory."""
        if len(args) != 1 or args[0].kind not in ARRAYS:
            raise self.fail(node, f"{record.__name__} of an array is translated, and nothing else")
        return Value(args[0].text, record)

    def extreme(self, name: str, args: list[Value]) -> Value:
        result = args[0]
        for value in args[1:]:
            kind = "i64" if result.kind == value.kind == "i64" else "double"
            a, b = self.convert(result, kind), self.convert(value, kind)
            relation = {"min": "lt", "max": "gt"}[name]
            test = f"icmp s{relation} i64" if kind == "i64" else f"fcmp o{relation} double"
            better = self.value("i1", f"{test} {b.text}, {a.text}")
            result = self.value(kind, f"select i1 {better.text}, {kind} {b.text}, {kind} {a.text}")
        return result

    def call_address(self, node: ast.Call, args: list[Value]) -> Value:
        target = self.value("ptr", f"inttoptr i64 {args[0].text} to ptr").text
        operands = []
        for value in args[1:]:
            operands.append(f"{llvm_type(value.kind)} {value.text}")
        self.line(f"call void {target}({', '.join(operands)})")
        return Value("", "void")

    def copy(self, node: ast.Call, args: list[Value]) -> Value:
        if len(args) != 3 or args[0].kind not in ARRAYS or args[1].kind != args[0].kind:
            raise self.fail(node, "copy takes two arrays of a kind and how many numbers")
        count = self.convert(args[2], "i64")
        size = self.value("i64", f"mul i64 {count.text}, {SLOT}").text
        self.copy_bytes(args[0].text, args[1].text, size)
        return Value("", "void")

    def call_native(self, node: ast.Call, name: str, args: list[Value]) -> Value:
        function = self.globals.get(name)
        if not is_native(function):
            raise self.fail(node, f"{name} is not a native function")
        self.called.append(function)
        name = symbol(function)
        arguments, result = signature(function)
        pairs = zip(args, arguments, strict=True)
        operands = ", ".join(f"{llvm_type(k)} {self.convert(a, k).text}" for a, (_, k) in pairs)
        if result == "void":
            self.line(f"call void @{name}({operands})")
            return Value("", "void")
        return self.value(result, f"call {result} @{name}({operands})")
