"""Functions of Python in expressions: a routine of the user that kernels call back.

A call holds its routine, which of its values it is, and what the routine reads.  Its derivatives
are numbers of the routine too: those that it gives itself, or differences.

The array T of a routine, through which kernels talk to it, holds

    address of its callback | its answer | inputs, the time first
"""

from __future__ import annotations

from functools import cache

from adamslite.symbolic.scope import UNFORESEEN, Scope, UndefinedRate
from adamslite.symbolic.sympy_nodes import sp
from adamslite.symbolic.types import Expr

ADDRESS, ANSWER, INPUTS = range(3)
# Arguments of a node before those of the routine.
FIRST = 5


@cache
def _node() -> type:
    class RoutineValue(sp.Function):
        """(routine, component, input of a derivative, of the second one, unforeseen, inputs ...)

        Inputs of derivatives are counted from 1, the time; 0 means none.
        """

        is_extended_real = True

        def fdiff(self, argindex: int = FIRST + 1) -> Expr:
            routine, component, one, other, *inputs = self.args
            by = argindex - FIRST
            if by < 1:
                return sp.S.Zero
            if other != 0:
                raise UndefinedRate(("third", by))
            pair = (one, by) if one != 0 else (by, 0)
            return self.func(routine, component, *pair, *inputs)

    return RoutineValue


def routine_value(scope: Scope, routine: int, component: int, inputs: tuple[Expr, ...]) -> Expr:
    """A value of a routine at ``inputs``, the time first.

    No bound of it is known before a run, not even where it depends on TIME alone: a symbol stands
    for that, so that what it decides is followed as what the state decides.
    """
    return _node()(routine, component, 0, 0, scope.symbol(UNFORESEEN), *inputs)
