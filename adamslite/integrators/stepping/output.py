"""The rows of the record that lie in the accepted step."""

from __future__ import annotations

from adamslite.integrators.accelerations import accelerations
from adamslite.integrators.contract import Problem
from adamslite.integrators.linalg.plan import Plan
from adamslite.integrators.records import has_room, write_record
from adamslite.integrators.stepping.control import StepControl
from adamslite.native.translate import Reals, native

# An output time behind the end of a step by less than this share of its size lies in it.
WITHIN = 1e-9


@native
def is_due(P: Problem, C: StepControl) -> bool:
    """Whether the next output time lies in the accepted step, which ends at t."""
    return C.row < P.times.size and P.times[C.row] <= C.t + WITHIN * C.h_last


@native
def is_next(P: Problem, C: StepControl) -> bool:
    """Whether the next output time lies in the accepted step, and there is room for its row."""
    return is_due(P, C) and has_room(P, C.row)


@native
def record_start(P: Problem, C: StepControl) -> None:
    """Write the workspace's state as the row of the time at which the run begins."""
    while is_due(P, C):
        write_record(P, C.row)
        C.row += 1


@native
def record_next(P: Problem, L: Plan, C: StepControl, y: Reals) -> bool:
    """Write the next row from interpolated q and u in ``y`` and states in ``P.z``.

    Accelerations, multipliers and variables are solved for, so that reactions are as exact as the
    motion; False when they are not determined.
    """
    if not accelerations(P, L, P.times[C.row], y, y[P.sizes.n :], P.a, P.z, P.rd):
        return False
    write_record(P, C.row)
    C.row += 1
    return True
