"""Expressions of time alone as instructions that can be evaluated on whole intervals.

Compiled code gives values; to be sure that nothing happens between two times an expression is
needed.  A kernel therefore carries those of its subexpressions that depend on nothing but time as
instructions, one list for each, in which an operand is the number of an earlier instruction:

==========  =====================================================================================
curves      functions that can change faster than their arguments: EXP, SIN, 1/x, tables ...
slopes      of the tables among them, which may jump
guards      what decides a branch of the clock: the gap of a relation
floors      the argument of a floor
driven      of a constraint: all of an equation that depends on time alone
rows        of a VARIABLE of time: its value and two rates
==========  =====================================================================================
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from typing import Any

from adamslite.native.llvm_builder import LIBRARY
from adamslite.symbolic.guards import CLOCK_LEAVES, FIXED_LEAVES
from adamslite.symbolic.sympy_nodes import LOOKUPS, sp
from adamslite.symbolic.types import Expr, Leaf, Symbol

Instruction = list[Any]
"""A word, the numbers of the instructions that it takes, other numbers."""
CURVED = LIBRARY - {"floor"}


class ClockWriter:
    """Instructions of expressions of time; ``leaves``: what their symbols stand for."""

    def __init__(self, leaves: dict[Symbol, Leaf]) -> None:
        self.leaves = leaves
        self.code: list[Instruction] = []
        self.known: dict[Expr, int] = {}
        self.clock: dict[Expr, bool] = {}

    def on_clock(self, expr: Expr) -> bool:
        """Whether an expression changes with time and with nothing else."""
        if expr not in self.clock:
            kinds = {self.leaves[s][0] for s in expr.free_symbols} - set(FIXED_LEAVES)
            self.clock[expr] = bool(kinds) and kinds <= set(CLOCK_LEAVES)
        return self.clock[expr]

    def place(self, expr: Expr) -> int:
        """Number of the instruction that gives the value of an expression."""
        if expr not in self.known:
            instruction = self._instruction(expr)
            self.code.append(instruction)
            self.known[expr] = len(self.code) - 1
        return self.known[expr]

    def _instruction(self, expr: Expr) -> Instruction:
        name = type(expr).__name__
        if expr in self.leaves:
            return list(self.leaves[expr])
        if expr in (sp.true, sp.false):
            return ["decided", bool(expr)]
        if expr.is_Number or expr.is_NumberSymbol:
            return ["number", float(expr)]
        if expr.is_Pow and expr.exp.is_Rational:
            return ["root", self.place(expr.base), int(expr.exp.p), int(expr.exp.q)]
        if name == "Piecewise":
            jumps = getattr(expr, "order", None) == -1
            pieces = [x for each in expr.args for x in (each.cond, each.expr)]
            return ["choose", jumps, *map(self.place, pieces)]
        if name in LOOKUPS:
            return [name, *map(int, expr.args[:3]), *map(self.place, expr.args[3:])]
        name = getattr(expr, "rel_op", name)
        return [name, *map(self.place, expr.args)]

    def gap(self, guard: Expr) -> int:
        """Number of what is zero where a relation changes."""
        return self.place(sp.Add(guard.lhs, -guard.rhs))

    def closed(self, number: int) -> list[Instruction]:
        """The instructions that one needs, itself last."""
        needed, pending = set(), [number]
        while pending:
            at = pending.pop()
            if at not in needed:
                needed.add(at)
                pending += self._operands(self.code[at])
        order = sorted(needed)
        new = {old: n for n, old in enumerate(order)}
        return [self._renumbered(self.code[old], new) for old in order]

    @staticmethod
    def _first(instruction: Instruction) -> int:
        """Where the operands of an instruction begin."""
        leaves = (*CLOCK_LEAVES, *FIXED_LEAVES, "number", "decided")
        if instruction[0] in LOOKUPS:
            return 4
        return len(instruction) if instruction[0] in leaves else 1 + (instruction[0] == "choose")

    def _operands(self, instruction: Instruction) -> list[int]:
        first = self._first(instruction)
        return instruction[first : 2 if instruction[0] == "root" else None]

    def _renumbered(self, instruction: Instruction, new: dict[int, int]) -> Instruction:
        first = self._first(instruction)
        last = 2 if instruction[0] == "root" else len(instruction)
        moved = [new[x] for x in instruction[first:last]]
        return [*instruction[:first], *moved, *instruction[max(first, last) :]]


def clock_programs(
    face: str, expressions: Iterable[Expr], guards: list[Expr], leaves: dict[Symbol, Leaf]
) -> dict[str, list[list[Instruction]]]:
    """The instructions that a kernel carries along."""
    writer, expressions = ClockWriter(leaves), list(expressions)
    curves = dict.fromkeys(x for e in expressions for x in _curves(e, writer))
    slopes = dict.fromkeys(x for curve in curves for x in _slopes(curve))
    found = {
        "curves": [writer.place(x) for x in curves],
        "slopes": [writer.place(x) for x in slopes],
        "guards": [writer.gap(g) for g in guards if hasattr(g, "rel_op")],
        "floors": [writer.place(g.args[0]) for g in guards if not hasattr(g, "rel_op")],
        "driven": [],
        "rows": [],
    }
    if face in ("position", "velocity"):
        driven = dict.fromkeys(x for e in expressions for x in _driven(e, writer))
        found["driven"] = [writer.place(x) for x in driven]
    if face == "signal":
        found["rows"] = [writer.place(e) for e in expressions]
    return {kind: [writer.closed(at) for at in places] for kind, places in found.items()}


def _curves(expression: Expr, writer: ClockWriter) -> Iterator[Expr]:
    """Functions of time in an expression that can change faster than their arguments."""
    for node in _nodes(expression, lambda node: reversed(node.args)):
        name = type(node).__name__
        bent = name in CURVED or (name in LOOKUPS and not any(_orders(node)))
        if node.is_Pow:
            bent = not (node.exp.is_Integer and node.exp > 0)
        if bent and writer.on_clock(node):
            yield node


def _orders(lookup: Expr) -> tuple[int, ...]:
    """Of which derivative of a table it is the value."""
    return lookup.args[2:3] if type(lookup).__name__ == "Lookup" else lookup.args[1:3]


def _slopes(curve: Expr) -> Iterator[Expr]:
    """The derivatives of a table by its arguments."""
    if type(curve).__name__ in LOOKUPS:
        for argument in range(4, len(curve.args) + 1):
            yield curve.fdiff(argument)


def _driven(expression: Expr, writer: ClockWriter) -> Iterator[Expr]:
    """The largest parts of an expression that depend on time alone."""

    def others(node: Expr) -> list[Expr]:
        return [] if writer.on_clock(node) else [x for x in node.args if not splits(node, x)]

    def splits(node: Expr, part: Expr) -> bool:
        return (node.is_Add or node.is_Mul) and writer.on_clock(part)

    for node in _nodes(expression, others):
        timed = [each for each in node.args if splits(node, each)]
        if writer.on_clock(node):
            yield node
        elif timed:
            yield node.func(*timed)


def _nodes(expression: Expr, below: Callable[[Expr], Iterable[Expr]]) -> Iterator[Expr]:
    """Every different node of an expression, itself first; ``below``: what to continue with."""
    pending, seen = [expression], set()
    while pending:
        node = pending.pop()
        if node not in seen:
            seen.add(node)
            yield node
            pending.extend(below(node))
