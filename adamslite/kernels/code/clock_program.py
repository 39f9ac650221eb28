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
from fractions import Fraction
from typing import Any

from adamslite.native.llvm_builder import LIBRARY
from adamslite.symbolic.derivatives import Derivatives
from adamslite.symbolic.formulas import LOOKUPS
from adamslite.symbolic.graph import ONE, TRUE, ZERO, div, neg, sub
from adamslite.symbolic.guards import CLOCK_LEAVES, FIXED_LEAVES
from adamslite.symbolic.slopes import slopes
from adamslite.symbolic.structure import CONDITIONS, ordered
from adamslite.symbolic.types import Expr, Leaf, Symbol

Instruction = list[Any]
"""A word, the numbers of the instructions that it takes, other numbers."""
CURVED = LIBRARY - {"floor"}
SUMS = ("+", "-", "neg")
# The words of kinds that are called otherwise.
WORDS = {"+": "Add", "*": "Mul", "**": "Pow", "and": "And", "or": "Or", "not": "Not"}


class ClockWriter:
    """Instructions of expressions of time; ``leaves``: what their symbols stand for."""

    def __init__(self, leaves: dict[Symbol, Leaf]) -> None:
        self.leaves = leaves
        self.code: list[Instruction] = []
        self.known: dict[Expr, int] = {}
        self.clock: dict[Expr, bool] = {}
        self.symbols = Derivatives().symbols

    def on_clock(self, expr: Expr) -> bool:
        """Whether an expression changes with time and with nothing else."""
        if expr not in self.clock:
            kinds = {self.leaves[s][0] for s in self.symbols(expr)} - set(FIXED_LEAVES)
            self.clock[expr] = bool(kinds) and kinds <= set(CLOCK_LEAVES)
        return self.clock[expr]

    def place(self, expr: Expr) -> int:
        """Number of the instruction that gives the value of an expression."""
        if expr not in self.known:
            for top in ordered([expr], lambda top: () if top in self.known else _operands(top)):
                if top not in self.known:
                    self.code.append(self._instruction(top))
                    self.known[top] = len(self.code) - 1
        return self.known[expr]

    def _instruction(self, expr: Expr) -> Instruction:
        places = [self.known[each] for each in _operands(expr)]
        if expr.kind == "symbol":
            return list(self.leaves[expr])
        if expr.kind in ("true", "false"):
            return ["decided", bool(expr)]
        if expr.kind == "number":
            return ["number", float(expr)]
        if expr.kind == "**" and len(places) == 1:
            exponent = Fraction(float(expr.args[1]))
            return ["root", *places, exponent.numerator, exponent.denominator]
        if expr.kind == "choice":
            return ["choose", expr.order == -1, *places]
        if expr.kind in LOOKUPS:
            return [expr.kind, *map(int, expr.args[:3]), *places]
        return [WORDS.get(expr.kind, expr.kind), *places]

    def gap(self, guard: Expr) -> int:
        """Number of what is zero where a relation changes."""
        return self.place(sub(*guard.args))

    def closed(self, number: int) -> list[Instruction]:
        """The instructions that one needs, itself last."""
        needed, pending = set(), [number]
        while pending:
            at = pending.pop()
            if at not in needed:
                needed.add(at)
                pending += self._places(self.code[at])
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

    def _places(self, instruction: Instruction) -> list[int]:
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
        "guards": [writer.gap(g) for g in guards if g.is_relation],
        "floors": [writer.place(g.args[0]) for g in guards if not g.is_relation],
        "driven": [],
        "rows": [],
    }
    if face in ("position", "velocity"):
        driven = dict.fromkeys(x for e in expressions for x in _driven(e, writer))
        found["driven"] = [writer.place(x) for x in driven]
    if face == "signal":
        found["rows"] = [writer.place(e) for e in expressions]
    return {kind: [writer.closed(at) for at in places] for kind, places in found.items()}


def _operands(expr: Expr) -> list[Expr]:
    """What an instruction takes the values of."""
    if expr.kind == "choice":
        pieces = [each for value, condition in expr.pieces for each in (condition, value)]
        return [*pieces, TRUE, expr.args[-1]]
    if expr.kind == "**" and expr.args[1].kind == "number":
        return [expr.args[0]] if 2.0 * float(expr.args[1]) % 1.0 == 0.0 else list(expr.args)
    return list(expr.args[3 if expr.kind in LOOKUPS else 0 :])


def _curves(expression: Expr, writer: ClockWriter) -> Iterator[Expr]:
    """Functions of time in an expression that can change faster than their arguments."""
    for node in _nodes(expression, lambda node: reversed(node.args)):
        bent = node.kind in CURVED or (node.kind in LOOKUPS and not any(_orders(node)))
        if node.kind == "**":
            bent = node.args[1].kind != "number" or float(node.args[1]) % 1.0 != 0.0
        if bent and writer.on_clock(node):
            yield node
        elif node.kind == "/" and writer.on_clock(node.args[1]):
            yield div(ONE, node.args[1])


def _orders(lookup: Expr) -> tuple[int, ...]:
    """Of which derivative of a table it is the value."""
    return tuple(map(int, lookup.args[2:3] if lookup.kind == "Lookup" else lookup.args[1:3]))


def _slopes(curve: Expr) -> Iterator[Expr]:
    """The derivatives of a table by its arguments."""
    if curve.kind in LOOKUPS:
        for _, slope in slopes(curve):
            yield slope()


def _driven(expression: Expr, writer: ClockWriter) -> Iterator[Expr]:
    """The largest parts of an expression that depend on time alone."""

    def others(node: Expr) -> list[Expr]:
        return [] if writer.on_clock(node) else [x for x in _terms(node) if not writer.on_clock(x)]

    for node in _nodes(expression, others):
        timed = [each for each in _terms(node) if writer.on_clock(each)]
        if writer.on_clock(node):
            yield node
        elif timed:
            yield from [sum(timed, ZERO)] if node.kind in SUMS else timed


def _terms(node: Expr) -> list[Expr]:
    """The terms of a sum, with their signs; the arguments of anything else, but no conditions."""
    if node.kind not in SUMS:
        return [each for each in node.args if each.kind not in CONDITIONS]
    found, pending = [], [(node, 1)]
    while pending:
        top, sign = pending.pop()
        if top.kind in SUMS:
            second = -sign if top.kind == "-" else sign
            first = -sign if top.kind == "neg" else sign
            signs = (first, second)
            pending += [(each, s) for each, s in zip(top.args, signs, strict=False)][::-1]
        else:
            found.append(top if sign > 0 else neg(top))
    return found


def _nodes(expression: Expr, below: Callable[[Expr], Iterable[Expr]]) -> Iterator[Expr]:
    """Every different node of an expression, itself first; ``below``: what to continue with."""
    pending, seen = [expression], set()
    while pending:
        node = pending.pop()
        if node not in seen:
            seen.add(node)
            yield node
            pending.extend(below(node))
