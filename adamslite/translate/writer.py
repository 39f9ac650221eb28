"""Lines of LLVM assembly: values, labels, local variables and memory of one function."""

from __future__ import annotations

import ast
from collections.abc import Callable
from typing import Any

from adamslite.lowering import FAST, literal
from adamslite.translate.language import ARRAYS, Alone, Table, Untranslatable, llvm_type, word_of

# Which accesses never meet: numbers of each kind, and the addresses in tables.
ALIAS = {"i64": "!2", "double": "!1", "ptr": "!3"}
METADATA = """!0 = !{!"adamslite"}
!1 = !{!4, !4, i64 0}
!2 = !{!5, !5, i64 0}
!3 = !{!6, !6, i64 0}
!4 = !{!"double", !0}
!5 = !{!"integer", !0}
!6 = !{!"address", !0}
!7 = !{}"""


class Value:
    """An SSA value or constant with its type: i64, double, i1, Ints, Reals or a table's name."""

    def __init__(self, text: str, kind: str) -> None:
        self.text = text
        self.kind = kind


class Writer:
    """What a function has written so far, and the plain instructions."""

    def __init__(self, function: Callable[..., Any], tables: dict[str, Table]) -> None:
        self.function = function
        self.tables = tables
        self.globals = function.__globals__
        self.freedom = "" if hasattr(function, "as_written") else f"{FAST} "
        self.locals: dict[str, str] = {}
        self.lines: list[str] = []
        self.allocations: list[str] = []
        self.called: list[str] = []
        self.declared: set[str] = set()
        self.loops: list[tuple[str, str]] = []
        self.count = 0
        self.open = True

    def passed(self, name: str, kind: str) -> str:
        """Type of an argument with what is promised of it."""
        alone = word_of(self.function.__annotations__[name]) == Alone
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

    def shifted(self, array: Value, index: Value) -> str:
        kind = ARRAYS[array.kind]
        text = f"getelementptr inbounds {kind}, ptr {array.text}, i64 {index.text}"
        return self.value("ptr", text).text

    def load(self, address: str, kind: str) -> Value:
        return self.value(kind, f"load {kind}, ptr {address}, !tbaa {ALIAS[kind]}")

    def store(self, address: str, value: Value) -> None:
        self.line(f"store {value.kind} {value.text}, ptr {address}, !tbaa {ALIAS[value.kind]}")

    def constant(self, node: ast.AST, value: Any) -> Value:
        if isinstance(value, bool):
            return Value("true" if value else "false", "i1")
        if isinstance(value, int):
            return Value(str(value), "i64")
        if isinstance(value, float):
            return Value(literal(value), "double")
        raise self.fail(node, f"{value!r} is not a number")

    def library(self, name: str, *args: Value) -> Value:
        self.declared.add(f"declare double @{name}({', '.join(['double'] * len(args))})")
        operands = ", ".join(f"double {self.convert(a, 'double').text}" for a in args)
        return self.value("double", f"call {self.freedom}double @{name}({operands})")

    def convert(self, value: Value, kind: str) -> Value:
        if value.kind == kind:
            return value
        if value.kind == "i64" and kind == "double":
            if not value.text.startswith("%"):
                return Value(literal(float(value.text)), "double")
            return self.value("double", f"sitofp i64 {value.text} to double")
        raise Untranslatable(f"{self.function.__qualname__}: {value.kind} where {kind} is needed")
