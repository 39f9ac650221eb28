"""Lines of LLVM assembly: values, labels, local variables and memory of one function."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterable

from adamslite.native.llvm_builder import FAST, literal
from adamslite.native.translate.language import (
    AS_WRITTEN,
    Native,
    Untranslatable,
    llvm_type,
    name_of,
    position,
)
from adamslite.native.translate.records import ARRAYS, SLOT, Kind, RowsOf, is_record

# Which accesses never meet: numbers of each kind, and the addresses in records.
ALIAS = {"i64": "!2", "double": "!1", "ptr": "!3"}
METADATA = """!0 = !{!"adamslite"}
!1 = !{!4, !4, i64 0}
!2 = !{!5, !5, i64 0}
!3 = !{!6, !6, i64 0}
!4 = !{!"double", !0}
!5 = !{!"integer", !0}
!6 = !{!"address", !0}
!7 = !{}
!8 = !{!"llvm.loop.align", i32 64}
!9 = !{!"llvm.loop.unroll.disable"}
!10 = !{!"llvm.loop.unroll.runtime.disable"}"""
# Properties of a loop, by its name at the jump back to its start.
LOOPS = {"loop": "!8", "inner": "!8, !10", "outer": "!8, !9"}


def module_text(declared: Iterable[str], definitions: Iterable[str]) -> str:
    """LLVM assembly of a module, whose loops start on a line of the processor's cache: elsewhere
    a short loop takes up to a tenth longer, by chance, after any change of the code before it.
    A loop around loops of any length is not written out three times, with all vectors in it.
    """
    nodes: list[str] = []

    def numbered(name: re.Match[str]) -> str:
        number = 11 + len(nodes)
        nodes.append(f"!{number} = distinct !{{!{number}, {LOOPS[name[1]]}}}")
        return f"!{number}"

    text = "\n".join([*sorted(declared), *definitions, METADATA])
    loops = re.sub(f"!({'|'.join(LOOPS)})$", numbered, text, flags=re.MULTILINE)
    return "\n".join([loops, *nodes])


class Value:
    """An SSA value or constant with its kind: i64, double, i1, Ints, Reals, a record, rows."""

    def __init__(self, text: str, kind: Kind) -> None:
        self.text = text
        self.kind = kind


class Writer:
    """What a function has written so far, and the plain instructions."""

    def __init__(self, function: Native) -> None:
        self.function = function
        self.globals = function.__globals__
        self.freedom = "" if function in AS_WRITTEN else f"{FAST} "
        self.locals: dict[str, Kind] = {}
        self.lines: list[str] = []
        self.allocations: list[str] = []
        self.called: list[Native] = []
        self.declared: set[str] = set()
        self.loops: list[tuple[str, str]] = []
        self.lengths = 0
        self.count = 0
        self.present = 1
        self.open = True

    def passed(self, name: str, kind: Kind) -> str:
        """Type of an argument with what is promised of it."""
        hint = self.function.__annotations__[name]
        alone = getattr(hint, "__name__", hint) == "Alone"
        return llvm_type(kind) + (" noalias" if alone else "")

    def fail(self, node: ast.AST | None, why: str) -> Untranslatable:
        """``node``: where; None for the statement that is being translated."""
        line = getattr(node, "lineno", self.present)
        return Untranslatable(f"{position(self.function, line)}: {why}")

    def line(self, text: str) -> None:
        if self.open:
            self.lines.append("  " + text)

    def value(self, kind: Kind, text: str) -> Value:
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

    def jump_back(self, label: str, name: str) -> None:
        """To the start of a loop, which is one of ``LOOPS``."""
        self.jump(f"{label}, !llvm.loop !{name}")

    def branch(self, condition: Value, yes: str, no: str) -> None:
        self.line(f"br i1 {condition.text}, label %{yes}, label %{no}")
        self.open = False

    def slot(self, kind: Kind) -> str:
        self.count += 1
        self.allocations.append(f"  %s{self.count} = alloca {llvm_type(kind)}")
        return f"%s{self.count}"

    def store_local(self, name: str, value: Value) -> None:
        if name not in self.locals:
            self.locals[name] = value.kind
            self.allocations.append(f"  %var.{name} = alloca {llvm_type(value.kind)}")
        kind = self.locals[name]
        if value.kind not in (kind, "i64"):
            raise self.fail(None, f"{name} is {name_of(kind)}, not {name_of(value.kind)}")
        value = self.convert(value, kind)
        self.line(f"store {llvm_type(kind)} {value.text}, ptr %var.{name}")

    def load_local(self, name: str) -> Value:
        kind = self.locals[name]
        return self.value(kind, f"load {llvm_type(kind)}, ptr %var.{name}")

    def shifted(self, array: Value, index: Value) -> str:
        """Address of an element of an array."""
        index = self.convert(index, "i64")
        if isinstance(array.kind, RowsOf):
            element = f"[{array.kind.record.slots} x i64]"
        else:
            element = ARRAYS[array.kind]
        text = f"getelementptr inbounds {element}, ptr {array.text}, i64 {index.text}"
        return self.value("ptr", text).text

    def place(self, record: Value, slot: int) -> str:
        """Address of a slot of a record."""
        if slot == 0:
            return record.text
        text = f"getelementptr inbounds i64, ptr {record.text}, i64 {slot}"
        return self.value("ptr", text).text

    def load(self, address: str, kind: str) -> Value:
        """A number; a bool fills a slot."""
        if kind == "i1":
            return self.value("i1", f"icmp ne i64 {self.load(address, 'i64').text}, 0")
        return self.value(kind, f"load {kind}, ptr {address}, !tbaa {ALIAS[kind]}")

    def store(self, address: str, value: Value) -> None:
        if value.kind == "i1":
            value = self.value("i64", f"zext i1 {value.text} to i64")
        self.line(f"store {value.kind} {value.text}, ptr {address}, !tbaa {ALIAS[value.kind]}")

    def fill(self, record: Value, value: Value) -> None:
        """All numbers of a record: those of another one, or none."""
        if not is_record(record.kind) or record.kind.refers:
            raise self.fail(None, f"{name_of(record.kind)} is not set as a whole")
        size = SLOT * record.kind.slots
        if value.kind is record.kind:
            self.copy_bytes(record.text, value.text, str(size))
        elif value.text == "0":
            self.declared.add("declare void @llvm.memset.p0.i64(ptr, i8, i64, i1)")
            operands = f"ptr align 8 {record.text}, i8 0"
            self.line(f"call void @llvm.memset.p0.i64({operands}, i64 {size}, i1 false)")
        else:
            raise self.fail(None, f"{name_of(value.kind)} where {name_of(record.kind)} is needed")

    def copy_bytes(self, target: str, source: str, size: str) -> None:
        """What lies at an address to another, whatever kinds of numbers it is."""
        self.declared.add("declare void @llvm.memcpy.p0.p0.i64(ptr, ptr, i64, i1)")
        operands = f"ptr align 8 {target}, ptr align 8 {source}"
        self.line(f"call void @llvm.memcpy.p0.p0.i64({operands}, i64 {size}, i1 false)")

    def constant(self, node: ast.AST, value: object) -> Value:
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

    def convert(self, value: Value, kind: Kind) -> Value:
        if value.kind == kind:
            return value
        if is_record(kind) and is_record(value.kind) and issubclass(value.kind, kind):
            return Value(value.text, kind)
        if value.kind == "i64" and kind == "double":
            if not value.text.startswith("%"):
                return Value(literal(float(value.text)), "double")
            return self.value("double", f"sitofp i64 {value.text} to double")
        raise self.fail(None, f"{name_of(value.kind)} where {name_of(kind)} is needed")
