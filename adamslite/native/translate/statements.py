"""Statements and functions of the native language."""

from __future__ import annotations

import ast
import inspect
import textwrap
from typing import Self

from adamslite.native.translate.expressions import Expressions
from adamslite.native.translate.language import signature, symbol
from adamslite.native.translate.writer import Value


class Translator(Expressions):
    """Translates one function."""

    def translate(self) -> Self:
        """Write the body."""
        arguments, self.result = signature(self.function)
        tree = ast.parse(textwrap.dedent(inspect.getsource(self.function))).body[0]
        assert isinstance(tree, ast.FunctionDef)
        for name, kind in arguments:
            self.store_local(name, Value(f"%arg.{name}", kind))
        self.block(tree.body)
        if self.open:
            self.line("ret void" if self.result == "void" else "unreachable")
        return self

    def define(self, linkage: str = "", attributes: str = "nounwind") -> str:
        """The function as LLVM assembly, once it is translated."""
        arguments, _ = signature(self.function)
        head = ", ".join(f"{self.passed(name, kind)} %arg.{name}" for name, kind in arguments)
        body = "\n".join(["entry:", *self.allocations, *self.lines])
        name = f"{self.result} @{symbol(self.function)}"
        return f"define {linkage}{name}({head}) {attributes} {{\n{body}\n}}"

    def declare(self) -> str:
        """What another module states of the function to call it."""
        arguments, result = signature(self.function)
        types = ", ".join(self.passed(name, kind) for name, kind in arguments)
        return f"declare {result} @{symbol(self.function)}({types}) nounwind"

    def block(self, body: list[ast.stmt]) -> None:
        for statement in body:
            self.present = statement.lineno
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
        address, kind = self.target(node.target)
        old = self.load(address, kind)
        new = self.arithmetic(node, node.op, old, self.expression(node.value))
        self.store(address, self.convert(new, kind))

    def assign(self, target: ast.expr, value: Value) -> None:
        if isinstance(target, ast.Name):
            self.store_local(target.id, value)
        elif isinstance(target, ast.Subscript) and isinstance(target.slice, ast.Slice):
            if target.slice.lower or target.slice.upper or target.slice.step:
                raise self.fail(target, "only a whole record is set as a slice")
            self.fill(self.expression(target.value), value)
        else:
            address, kind = self.target(target)
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
        self.jump_back(test, self.loop_body(node.body, test, after))
        self.lengths += 1
        self.start(after)

    def on_For(self, node: ast.For) -> None:
        if not isinstance(node.iter, ast.Call) or ast.unparse(node.iter.func) != "range":
            raise self.fail(node, "only a range is looped over")
        if node.orelse:
            raise self.fail(node, "else of a loop is not translated")
        assert isinstance(node.target, ast.Name)
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
        name = self.loop_body(node.body, following, after)
        self.start(following)
        nxt = self.value("i64", f"add nsw i64 {i.text}, {step.text}")
        self.line(f"store i64 {nxt.text}, ptr {counter}")
        self.jump_back(test, name)
        self.start(after)
        self.lengths += low.text.startswith("%") or high.text.startswith("%")

    def loop_body(self, body: list[ast.stmt], following: str, after: str) -> str:
        """Which of ``LOOPS`` it is: whether there is a loop of any length in it."""
        before = self.lengths
        self.loops.append((following, after))
        self.block(body)
        self.loops.pop()
        return "outer" if self.lengths > before else "inner"

    def on_Break(self, node: ast.Break) -> None:
        self.jump(self.loops[-1][1])

    def on_Continue(self, node: ast.Continue) -> None:
        self.jump(self.loops[-1][0])
