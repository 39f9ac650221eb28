"""Native code from a small, typed part of Python: what the integrators are written in.

A function marked :func:`native` may use ``int`` (64 bit), ``float``, ``bool``, arrays (``Ints``,
``Reals``), fields of one :class:`Table`, ``if``, ``while``, ``for .. in range``, assignments,
arithmetic, comparisons, ``abs min max float int sqrt floor``, slices ``a[k:]`` (a shifted array),
calls of other native functions and ``call_address``.  Arguments carry annotations; a local
variable has the type of its first assignment. ``Alone`` is an array of reals that no other argument
reaches while the function runs. There is no bounds check, and division follows the processor.

The same functions run under plain Python on numpy arrays, which is how tests compare the two.
"""

from __future__ import annotations

import ast
import ctypes
import inspect
import textwrap
from collections.abc import Callable
from typing import Any

from adamslite.lowering import FAST, literal

Ints = "Ints"
Reals = "Reals"
Alone = "Alone"
SCALARS = {"int": "i64", "float": "double", "bool": "i1"}
ARRAYS = {"Ints": "i64", "Reals": "double"}
ALIAS = {"i64": "!2", "double": "!1", "ptr": "!3"}
METADATA = """!0 = !{!"adamslite"}
!1 = !{!4, !4, i64 0}
!2 = !{!5, !5, i64 0}
!3 = !{!6, !6, i64 0}
!4 = !{!"double", !0}
!5 = !{!"integer", !0}
!6 = !{!"address", !0}
!7 = !{}"""
INT_OPS = {
    ast.Add: "add",
    ast.Sub: "sub",
    ast.Mult: "mul",
    ast.FloorDiv: "sdiv",
    ast.Mod: "srem",
    ast.BitAnd: "and",
}
FLOAT_OPS = {ast.Add: "fadd", ast.Sub: "fsub", ast.Mult: "fmul", ast.Div: "fdiv"}
INT_TESTS = {
    ast.Lt: "slt",
    ast.LtE: "sle",
    ast.Gt: "sgt",
    ast.GtE: "sge",
    ast.Eq: "eq",
    ast.NotEq: "ne",
}
FLOAT_TESTS = {
    ast.Lt: "olt",
    ast.LtE: "ole",
    ast.Gt: "ogt",
    ast.GtE: "oge",
    ast.Eq: "oeq",
    ast.NotEq: "une",
}

REGISTERED: dict[str, Callable[..., Any]] = {}


class Untranslatable(Exception):
    """A native function uses something outside the language above."""


def native(function: Callable[..., Any]) -> Callable[..., Any]:
    """Mark a function for translation; it stays an ordinary Python function."""
    if function.__name__ in REGISTERED:
        raise Untranslatable(f"two native functions are called {function.__name__}")
    REGISTERED[function.__name__] = function
    return function


def call_address(address: int, *arguments: Any) -> None:
    """Call the kernel at an address; natively a plain call, under Python one through ctypes."""
    given = [
        ctypes.c_void_p(a.ctypes.data) if hasattr(a, "ctypes") else ctypes.c_int64(int(a))
        for a in arguments
    ]
    ctypes.CFUNCTYPE(None, *[type(a) for a in given])(int(address))(*given)


class Table:
    """A native argument that is a table of (address, length): one pair for each field, in order."""

    def __init__(self, name: str, fields: dict[str, str]) -> None:
        self.name = name
        self.fields = fields

    def place(self, field: str) -> int:
        return list(self.fields).index(field)


class Value:
    """An SSA value or constant with its type: i64, double, i1, Ints, Reals or a table's name."""

    def __init__(self, text: str, kind: str) -> None:
        self.text = text
        self.kind = kind


def signature(function: Callable[..., Any]) -> tuple[list[tuple[str, str]], str]:
    """Argument names with types, and the result type (``void`` for none)."""
    hints = function.__annotations__
    names = list(inspect.signature(function).parameters)
    words = [Reals if _word(hints[n]) == Alone else _word(hints[n]) for n in names]
    kinds = [(n, SCALARS.get(word, word)) for n, word in zip(names, words, strict=True)]
    result = _word(hints.get("return", "None"))
    return kinds, "void" if result == "None" else SCALARS[result]


def _word(hint: Any) -> str:
    return hint if isinstance(hint, str) else getattr(hint, "__name__", str(hint))


def llvm_type(kind: str) -> str:
    return kind if kind in ("i64", "double", "i1", "void") else "ptr"


def translate(entry: str, tables: list[Table]) -> str:
    """LLVM assembly of ``entry`` and every native function it reaches; the others are internal."""
    pending, done, texts = [entry], set(), []
    declared: set[str] = set()
    while pending:
        name = pending.pop()
        if name in done:
            continue
        done.add(name)
        work = Translator(REGISTERED[name], {t.name: t for t in tables})
        texts.append(work.define(internal=name != entry))
        declared |= work.declared
        pending.extend(work.called)
    return "\n".join([*sorted(declared), *texts, METADATA])


class Translator:
    """Translates one function."""

    def __init__(self, function: Callable[..., Any], tables: dict[str, Table]) -> None:
        self.function = function
        self.tables = tables
        self.globals = function.__globals__
        self.locals: dict[str, str] = {}
        self.lines: list[str] = []
        self.allocations: list[str] = []
        self.called: list[str] = []
        self.declared: set[str] = set()
        self.loops: list[tuple[str, str]] = []
        self.count = 0
        self.open = True

    def define(self, internal: bool) -> str:
        arguments, self.result = signature(self.function)
        tree = ast.parse(textwrap.dedent(inspect.getsource(self.function))).body[0]
        for name, kind in arguments:
            self.store_local(name, Value(f"%arg.{name}", kind))
        self.block(tree.body)
        if self.open:
            self.line("ret void" if self.result == "void" else "unreachable")
        head = ", ".join(f"{self.passed(name, kind)} %arg.{name}" for name, kind in arguments)
        linkage = "internal " if internal else ""
        body = "\n".join(["entry:", *self.allocations, *self.lines])
        name = self.function.__name__
        return f"define {linkage}{self.result} @{name}({head}) nounwind {{\n{body}\n}}"

    def passed(self, name: str, kind: str) -> str:
        """Type of an argument with what is promised of it."""
        alone = _word(self.function.__annotations__[name]) == Alone
        return llvm_type(kind) + (" noalias" if alone else "")

    def fail(self, node: ast.AST, why: str) -> Untranslatable:
        line = getattr(node, "lineno", 0)
        return Untranslatable(f"{self.function.__qualname__}, line {line}: {why}")

    def line(self, text: str) -> None:
        if self.open:
            self.lines.append("  " + text)

    def value(self, kind: str, text: str) -> Value:
        self.count += 1
        self.line(f"%t{self.count} = {text}")
        return Value(f"%t{self.count}", kind)

    def label(self) -> str:
        self.count += 1
        return f"l{self.count}"

    def start(self, label: str) -> None:
        if self.open:
            self.lines.append(f"  br label %{label}")
        self.lines.append(f"{label}:")
        self.open = True

    def jump(self, label: str) -> None:
        self.line(f"br label %{label}")
        self.open = False

    def branch(self, condition: Value, yes: str, no: str) -> None:
        self.line(f"br i1 {condition.text}, label %{yes}, label %{no}")
        self.open = False

    # statements

    def block(self, body: list[ast.stmt]) -> None:
        for statement in body:
            getattr(self, f"on_{type(statement).__name__}", self.on_other)(statement)

    def on_other(self, node: ast.AST) -> None:
        raise self.fail(node, f"{type(node).__name__} is not translated")

    def on_Pass(self, node: ast.Pass) -> None:
        return

    def on_Expr(self, node: ast.Expr) -> None:
        if not isinstance(node.value, ast.Constant):
            self.expression(node.value)

    def on_Return(self, node: ast.Return) -> None:
        if node.value is None:
            self.line("ret void")
        else:
            value = self.convert(self.expression(node.value), self.result)
            self.line(f"ret {self.result} {value.text}")
        self.open = False

    def on_Assign(self, node: ast.Assign) -> None:
        names = node.targets
        if len(names) == 1 and isinstance(names[0], ast.Tuple):
            if not isinstance(node.value, ast.Tuple):
                raise self.fail(node, "several names need as many values")
            values = [self.expression(v) for v in node.value.elts]
            for target, value in zip(names[0].elts, values, strict=True):
                self.assign(target, value)
            return
        value = self.expression(node.value)
        for target in names:
            self.assign(target, value)

    def on_AugAssign(self, node: ast.AugAssign) -> None:
        if isinstance(node.target, ast.Name):
            old = self.load_local(node.target.id)
            self.assign(
                node.target, self.arithmetic(node, node.op, old, self.expression(node.value))
            )
            return
        address, kind = self.element(node.target)
        old = self.load(address, kind)
        new = self.arithmetic(node, node.op, old, self.expression(node.value))
        self.store(address, self.convert(new, kind))

    def assign(self, target: ast.expr, value: Value) -> None:
        if isinstance(target, ast.Name):
            self.store_local(target.id, value)
        else:
            address, kind = self.element(target)
            self.store(address, self.convert(value, kind))

    def on_If(self, node: ast.If) -> None:
        yes, no, after = self.label(), self.label(), self.label()
        self.branch(self.truth(node.test), yes, no)
        self.start(yes)
        self.block(node.body)
        self.jump(after)
        self.start(no)
        self.block(node.orelse)
        self.start(after)

    def on_While(self, node: ast.While) -> None:
        test, body, after = self.label(), self.label(), self.label()
        self.start(test)
        self.branch(self.truth(node.test), body, after)
        self.start(body)
        self.loop_body(node.body, test, after)
        self.jump(test)
        self.start(after)

    def on_For(self, node: ast.For) -> None:
        if not isinstance(node.iter, ast.Call) or ast.unparse(node.iter.func) != "range":
            raise self.fail(node, "only a range is looped over")
        if node.orelse:
            raise self.fail(node, "else of a loop is not translated")
        bounds = [self.expression(a) for a in node.iter.args]
        low, high = (Value("0", "i64"), bounds[0]) if len(bounds) == 1 else bounds[:2]
        step = bounds[2] if len(bounds) > 2 else Value("1", "i64")
        down = step.text.startswith("-")
        counter = self.slot("i64")
        self.line(f"store i64 {low.text}, ptr {counter}")
        test, body, following, after = (self.label() for _ in range(4))
        self.start(test)
        i = self.value("i64", f"load i64, ptr {counter}")
        relation = "sgt" if down else "slt"
        more = self.value("i1", f"icmp {relation} i64 {i.text}, {high.text}")
        self.branch(more, body, after)
        self.start(body)
        self.store_local(node.target.id, i)
        self.loop_body(node.body, following, after)
        self.start(following)
        nxt = self.value("i64", f"add nsw i64 {i.text}, {step.text}")
        self.line(f"store i64 {nxt.text}, ptr {counter}")
        self.jump(test)
        self.start(after)

    def loop_body(self, body: list[ast.stmt], following: str, after: str) -> None:
        self.loops.append((following, after))
        self.block(body)
        self.loops.pop()

    def on_Break(self, node: ast.Break) -> None:
        self.jump(self.loops[-1][1])

    def on_Continue(self, node: ast.Continue) -> None:
        self.jump(self.loops[-1][0])

    # variables and memory

    def slot(self, kind: str) -> str:
        self.count += 1
        self.allocations.append(f"  %s{self.count} = alloca {llvm_type(kind)}")
        return f"%s{self.count}"

    def store_local(self, name: str, value: Value) -> None:
        if name not in self.locals:
            self.locals[name] = value.kind
            self.allocations.append(f"  %var.{name} = alloca {llvm_type(value.kind)}")
        kind = self.locals[name]
        if value.kind not in (kind, "i64"):
            why = f"{name} is {kind}, not {value.kind}"
            raise Untranslatable(f"{self.function.__qualname__}: {why}")
        value = self.convert(value, kind)
        self.line(f"store {llvm_type(kind)} {value.text}, ptr %var.{name}")

    def load_local(self, name: str) -> Value:
        kind = self.locals[name]
        return self.value(kind, f"load {llvm_type(kind)}, ptr %var.{name}")

    def element(self, node: ast.expr) -> tuple[str, str]:
        """Address and type of ``array[index]``."""
        if not isinstance(node, ast.Subscript):
            raise self.fail(node, "only array elements can be assigned")
        array = self.expression(node.value)
        if array.kind not in ARRAYS:
            raise self.fail(node, f"{array.kind} is not an array")
        return self.shifted(array, self.expression(node.slice)), ARRAYS[array.kind]

    def shifted(self, array: Value, index: Value) -> str:
        kind = ARRAYS[array.kind]
        text = f"getelementptr inbounds {kind}, ptr {array.text}, i64 {index.text}"
        return self.value("ptr", text).text

    def load(self, address: str, kind: str) -> Value:
        return self.value(kind, f"load {kind}, ptr {address}, !tbaa {ALIAS[kind]}")

    def store(self, address: str, value: Value) -> None:
        self.line(f"store {value.kind} {value.text}, ptr {address}, !tbaa {ALIAS[value.kind]}")

    # expressions

    def expression(self, node: ast.expr) -> Value:
        handler = getattr(self, f"of_{type(node).__name__}", None)
        if handler is None:
            raise self.fail(node, f"{type(node).__name__} is not translated")
        return handler(node)

    def constant(self, node: ast.AST, value: Any) -> Value:
        if isinstance(value, bool):
            return Value("true" if value else "false", "i1")
        if isinstance(value, int):
            return Value(str(value), "i64")
        if isinstance(value, float):
            return Value(literal(value), "double")
        raise self.fail(node, f"{value!r} is not a number")

    def of_Constant(self, node: ast.Constant) -> Value:
        return self.constant(node, node.value)

    def of_Name(self, node: ast.Name) -> Value:
        if node.id in self.locals:
            return self.load_local(node.id)
        if node.id not in self.globals:
            raise self.fail(node, f"{node.id} is not known here")
        return self.constant(node, self.globals[node.id])

    def of_Attribute(self, node: ast.Attribute) -> Value:
        """``P.field`` is an array, ``P.field.size`` its length."""
        length = node.attr == "size" and isinstance(node.value, ast.Attribute)
        inner = node.value if length else node
        owner = self.expression(inner.value)
        table = self.tables[owner.kind]
        place = 2 * table.place(inner.attr) + length
        at = self.value("ptr", f"getelementptr inbounds i64, ptr {owner.text}, i64 {place}").text
        if length:
            return self.value("i64", f"load i64, ptr {at}, !tbaa !3, !invariant.load !7")
        kind = table.fields[inner.attr]
        return self.value(kind, f"load ptr, ptr {at}, !tbaa !3, !invariant.load !7")

    def of_Subscript(self, node: ast.Subscript) -> Value:
        if isinstance(node.slice, ast.Slice):
            if node.slice.lower is None or node.slice.upper or node.slice.step:
                raise self.fail(node, "a slice has a start only")
            array = self.expression(node.value)
            return Value(self.shifted(array, self.expression(node.slice.lower)), array.kind)
        address, kind = self.element(node)
        return self.load(address, kind)

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
        return self.value("double", f"{FLOAT_OPS[type(op)]} {FAST} double {x.text}, {y.text}")

    def power(self, node: ast.BinOp) -> Value:
        base, exponent = (
            self.convert(self.expression(n), "double") for n in (node.left, node.right)
        )
        if exponent.text == literal(0.5):
            return self.library("llvm.sqrt.f64", base)
        return self.library("llvm.pow.f64", base, exponent)

    def library(self, name: str, *args: Value) -> Value:
        self.declared.add(f"declare double @{name}({', '.join(['double'] * len(args))})")
        operands = ", ".join(f"double {self.convert(a, 'double').text}" for a in args)
        return self.value("double", f"call {FAST} double @{name}({operands})")

    def of_UnaryOp(self, node: ast.UnaryOp) -> Value:
        if isinstance(node.op, ast.Not):
            return self.value("i1", f"xor i1 {self.truth(node.operand).text}, true")
        if not isinstance(node.op, ast.USub):
            raise self.fail(node, f"{type(node.op).__name__} is not translated")
        if isinstance(node.operand, ast.Constant):
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
        if op not in INT_TESTS:
            raise self.fail(node, f"{op.__name__} is not translated")
        if a.kind == b.kind and a.kind in ("i64", "i1"):
            return self.value("i1", f"icmp {INT_TESTS[op]} {a.kind} {a.text}, {b.text}")
        x, y = self.convert(a, "double"), self.convert(b, "double")
        return self.value("i1", f"fcmp {FLOAT_TESTS[op]} double {x.text}, {y.text}")

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
        if name == "float":
            return self.convert(args[0], "double")
        if name == "int":
            return (
                args[0]
                if args[0].kind == "i64"
                else self.value("i64", f"fptosi double {args[0].text} to i64")
            )
        if name == "call_address":
            return self.call_address(args)
        return self.call_native(node, name, args)

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

    def call_address(self, args: list[Value]) -> Value:
        target = self.value("ptr", f"inttoptr i64 {args[0].text} to ptr").text
        operands = []
        for value in args[1:]:
            operands.append(f"{llvm_type(value.kind)} {value.text}")
        self.line(f"call void {target}({', '.join(operands)})")
        return Value("", "void")

    def call_native(self, node: ast.Call, name: str, args: list[Value]) -> Value:
        if self.globals.get(name) is not REGISTERED.get(name) or name not in REGISTERED:
            raise self.fail(node, f"{name} is not a native function")
        self.called.append(name)
        arguments, result = signature(REGISTERED[name])
        pairs = zip(args, arguments, strict=True)
        operands = ", ".join(f"{llvm_type(k)} {self.convert(a, k).text}" for a, (_, k) in pairs)
        if result == "void":
            self.line(f"call void @{name}({operands})")
            return Value("", "void")
        return self.value(result, f"call {result} @{name}({operands})")

    def convert(self, value: Value, kind: str) -> Value:
        if value.kind == kind:
            return value
        if value.kind == "i64" and kind == "double":
            if not value.text.startswith("%"):
                return Value(literal(float(value.text)), "double")
            return self.value("double", f"sitofp i64 {value.text} to double")
        raise Untranslatable(f"{self.function.__qualname__}: {value.kind} where {kind} is needed")
