"""Functions of Python in expressions: a routine of the user that kernels call back.

A call holds its routine, which of its values it is, and what the routine reads.  Its derivatives
are numbers of the routine too: those that it gives itself, or differences.

The array T of a routine, through which kernels talk to it, holds

    address of its callback | its answer | inputs, the time first
"""

from __future__ import annotations

from functools import partial

from adamslite.symbolic.graph import ZERO, Node, made, node, number
from adamslite.symbolic.scope import UNFORESEEN, Scope, UndefinedRate
from adamslite.symbolic.slopes import RULES, Slopes
from adamslite.symbolic.types import Expr

ADDRESS, ANSWER, INPUTS = range(3)
# The kind of its nodes.
ROUTINE = "RoutineValue"
# Arguments of a node before those of the routine.
FIRST = 5


def _slopes(value: Node) -> Slopes:
    """(routine, component, input of a derivative, of the second one, unforeseen, inputs ...)

    Inputs of derivatives are counted from 1, the time; 0 means none.
    """
    routine, component, one, other, *inputs = value.args

    def slope(by: int) -> Node:
        if other != 0:
            raise UndefinedRate(("third", by))
        pair = (one, number(by)) if one != 0 else (number(by), ZERO)
        return made(ROUTINE, routine, component, *pair, *inputs)

    return [(each, partial(slope, by)) for by, each in enumerate(inputs[1:], 1)]


RULES[ROUTINE] = _slopes


def routine_value(scope: Scope, routine: int, component: int, inputs: tuple[Expr, ...]) -> Expr:
    """A value of a routine at ``inputs``, the time first.

    No bound of it is known before a run, not even where it depends on TIME alone: a symbol stands
    for that, so that what it decides is followed as what the state decides.
    """
    unforeseen = scope.symbol(UNFORESEEN)
    return made(ROUTINE, *map(node, (routine, component, 0, 0, unforeseen, *inputs)))
