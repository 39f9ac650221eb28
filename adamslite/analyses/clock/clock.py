"""Expressions of time alone: the clock programs of the kernels, with their numbers."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import TYPE_CHECKING

from adamslite.analyses.clock.enclosures import Instruction
from adamslite.language.interfaces import Key
from adamslite.symbolic.formulas import LOOKUPS
from adamslite.symbolic.interpolant import Interpolant

if TYPE_CHECKING:
    from adamslite.kernels.binding import Binding
    from adamslite.kernels.code.clock_program import Instruction as Written
    from adamslite.kernels.groups import Kernels
    from adamslite.language.statement import Statement

Program = tuple[Instruction, ...]
Used = float | Key | Interpolant


class Clock:
    """Programs that differ, each with the statement it belongs to; see
    :mod:`adamslite.kernels.code.clock_program` for what they compute.
    """

    def __init__(self, kernels: Kernels) -> None:
        self.kernels = kernels
        self._signals = {
            binding.nodes[0][1]: (group.meta["clock"]["rows"], binding)
            for group in kernels.groups
            if group.face == "signal"
            for _, binding in group.instances
        }
        self._rates: dict[tuple[Key, int], Program] = {}

    def programs(self, kind: str) -> dict[Program, Statement]:
        """Every different program of a kind, with the first statement that has it."""
        return {program: statement for _, statement, program in self._each(kind)}

    def driven(self) -> Iterator[tuple[str, Statement, Program]]:
        """Level, statement and program of what drives a constraint."""
        yield from self._each("driven")

    def _each(self, kind: str) -> Iterator[tuple[str, Statement, Program]]:
        for group in self.kernels.groups:
            for code in group.meta["clock"].get(kind, ()):
                seen: set[tuple[Used, ...]] = set()
                for statement, binding in group.instances:
                    used = tuple(_used(code, binding))
                    if used not in seen:
                        seen.add(used)
                        yield group.face, statement, self._bound(code, binding)

    def _bound(self, code: list[Written], binding: Binding) -> Program:
        """A program with numbers for parameters and the expressions of VARIABLEs put in."""
        found: dict[Instruction, int] = {}
        place: list[int] = []
        for name, *given in code:
            if name == "p":
                instruction: Instruction = ("number", binding.params[given[0]])
            elif name in LOOKUPS:
                table = binding.tables[given[0]]
                instruction = _moved((name, table, *given[1:]), place.__getitem__)
            elif name == "sig":
                inner: list[int] = []
                for each in self._rate(binding.signals[given[0]], given[1]):
                    instruction = _moved(each, inner.__getitem__)
                    inner.append(found.setdefault(instruction, len(found)))
            else:
                instruction = _moved((name, *given), place.__getitem__)
            place.append(found.setdefault(instruction, len(found)))
        return tuple(found)[: place[-1] + 1]

    def _rate(self, variable: Key, order: int) -> Program:
        """A derivative of a VARIABLE; those that it is made of are known, they stand before it."""
        if not self._rates:
            for key, (rows, binding) in self._signals.items():
                for number, row in enumerate(rows):
                    self._rates[key, number] = self._bound(row, binding)
        return self._rates[variable, order]


def _used(code: list[Written], binding: Binding) -> Iterator[Used]:
    """The parameters and VARIABLEs of an instance that a program needs."""
    for name, *given in code:
        if name == "p":
            yield binding.params[given[0]]
        elif name == "sig":
            yield binding.signals[given[0]]
        elif name in LOOKUPS:
            table = binding.tables[given[0]]
            assert isinstance(table, Interpolant)
            yield table


def _moved(instruction: Instruction, place: Callable[[int], int]) -> Instruction:
    """An instruction whose operands stand elsewhere."""
    name, *given = instruction
    if name in ("number", "decided"):
        return instruction
    if name == "root":
        return name, place(given[0]), *given[1:]
    if name in LOOKUPS:
        return name, *given[:3], *map(place, given[3:])
    if name == "choose":
        return name, given[0], *map(place, given[1:])
    return name, *map(place, given)
