"""Step sizes of HHT and NEWMARK."""

from __future__ import annotations

from adamslite.integrators.contract import Problem
from adamslite.integrators.events.stops import (
    fitted,
    horizon,
    longest_step,
    set_pace,
    step_limit,
)
from adamslite.integrators.hht.control import Control
from adamslite.integrators.implicit.step_size import step_ratio
from adamslite.integrators.stepping.outcome import LONGER, cut, round_off
from adamslite.native.translate import native

ORDER = 2
# The next step aims at an estimated error below ERROR by this factor.
SAFETY = 2.0
# A step changes only when that pays for a new matrix, and never grows by more than this at once.
LEAST_GROWTH, LEAST_SHRINK, MOST_GROWTH = 1.25, 0.9, 2.0


@native
def fixed_step(P: Problem) -> float:
    """The step when HINIT, HMAX and HMIN say that all are equal, else 0."""
    s = P.settings
    return s.h_init if s.h_init > 0.0 and s.h_init == s.h_max and s.h_init == s.h_min else 0.0


@native
def limit_step(P: Problem, C: Control) -> None:
    """Keep the step within its pace, the horizon and, when stepped onto, the output times."""
    set_pace(P, C.t)
    left = horizon(P) - C.t
    C.h = min(C.h, longest_step(P))
    if not P.settings.interpolate and C.fixed == 0.0:
        C.h = fitted(C.h, step_limit(P, C.row) - C.t, round_off(P, C))
    elif C.h * LONGER + round_off(P, C) > left:
        C.h = left
    elif C.fixed == 0.0 and 2.0 * C.h > left:
        C.h = 0.5 * left


@native
def choose_step(P: Problem, C: Control, norm: float) -> None:
    """The next step; one that was divided grows back."""
    h = C.h
    if C.fixed > 0.0:
        C.h = min(2.0 * h, C.fixed)
        return
    C.equal += 1
    factor = step_ratio(SAFETY * norm, ORDER)
    room = min(MOST_GROWTH, longest_step(P) / h)
    if (C.equal > 1 and min(factor, room) > LEAST_GROWTH) or factor < LEAST_SHRINK:
        C.h *= cut(P, C, min(factor, room))
        C.equal = 0
