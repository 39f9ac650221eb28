"""Calls of a user's routine by native code: array T of :mod:`adamslite.symbolic.routines`."""

from __future__ import annotations

from adamslite.native.translate import Reals, call_address, native
from adamslite.symbolic.routines import ADDRESS, ANSWER


@native
def routine_answer(T: Reals, component: int, one: int, other: int) -> float:
    """A value of the routine at the inputs in T, or its derivative by inputs ``one`` and ``other``,
    counted from 1; 0: by none.
    """
    call_address(int(T[ADDRESS]), component, one, other)
    return T[ANSWER]
