"""Measures of angles that count full turns, of statements and of what commands have replaced."""

from __future__ import annotations

from typing import TYPE_CHECKING

from adamslite.deck.redefinition import Redefinition
from adamslite.language.expression import Node, Num, calls, to_text
from adamslite.language.statement import STATEMENTS, expressions

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator, Sequence

    from adamslite.deck.redefinition import Command
    from adamslite.language.expression import Call
    from adamslite.language.statement import Statement

ANGLES = ("AX", "AY", "AZ", "INCANG")
"""Functions that count full turns, as ORIENT does in the system that has AX, AY and AZ."""
PROJECTED = Num(26.0)


def counted(statement: Statement) -> list[Call]:
    """The measures in its expressions that count full turns."""
    return [call for each in expressions(statement) for call in _counted_in(each)]


def brought(commands: Iterable[Command], statements: Iterable[Statement]) -> list[Call]:
    """The same of what commands redefine, where no statement has it yet."""
    changes = (each.changes.values() for each in commands if isinstance(each, Redefinition))
    nodes = (value for values in changes for value in values if isinstance(value, Node))
    found = [call for node in nodes for call in _counted_in(node)]
    known = {call for each in statements for call in counted(each)} if found else set()
    return [call for call in found if call not in known]


def _counted_in(node: Node) -> list[Call]:
    return [
        call for call in calls(node, *ANGLES, "ORIENT")
        if call.name != "ORIENT" or call.args[0] == PROJECTED
    ]  # fmt: skip


def counting(turns: Sequence[Call], statements: Iterable[Statement]) -> Iterator[Statement]:
    """Further statements that count what others have used or will use, and none does now."""
    known = {call for each in statements for call in counted(each)} if turns else set()
    for call in turns:
        if call not in known:
            yield STATEMENTS["VARIABLE"](id=to_text(call), function=call)
