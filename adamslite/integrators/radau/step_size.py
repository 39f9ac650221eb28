"""Step sizes of the Radau formula: equal ones to the next target, the next from two errors."""

from __future__ import annotations

from math import floor

from adamslite.integrators.contract import Problem
from adamslite.integrators.events.stops import horizon, longest_step, set_pace
from adamslite.integrators.radau.control import Control
from adamslite.integrators.radau.corrector import QUICK
from adamslite.integrators.stepping.outcome import ALMOST, cut, round_off
from adamslite.native.translate import native

# The next step aims at this share of the step that the error allows; it is changed only when it
# grows by more than KEEP_GROWTH, because every other size needs new factors.
SAFETY, MOST_GROWTH, LEAST_SHRINK, KEEP_GROWTH = 0.9, 5.0, 0.125, 1.2
# Iterations that cost little of the safety.
FEW_TURNS = 14.0
# Errors below the first are as good as none; the next step is not chosen from one below the second.
LEAST_ERROR, LEAST_REMEMBERED = 1e-10, 0.01
# Further from the target than this many steps they need not fit.
MANY_STEPS = 100.0


@native
def limit_step(P: Problem, C: Control) -> None:
    """Keep the step within its pace; equal steps to the horizon or, unless they may be
    interpolated, to the next output time.  A step to a crossing keeps its size.
    """
    set_pace(P, C.t)
    target, row = horizon(P), C.row
    if not P.settings.interpolate and row < P.times.size:
        target = min(target, P.times[row])
    C.h = min(C.h, longest_step(P))
    left = target - C.t
    if P.search.hunt:
        C.h = min(C.h, left)
        return
    C.to_target = floor((left - round_off(P, C)) / C.h + 1.0 - ALMOST)
    if C.to_target < MANY_STEPS:
        C.h = left / max(1.0, C.to_target)


@native
def choose_step(P: Problem, C: Control, error: float) -> None:
    """The next step, from the errors of the last two (Gustafsson), and what is kept for it."""
    h = C.h
    factor = step_factor(C, error)
    if C.last_size > 0.0:
        ratio = max(C.last_norm, LEAST_ERROR) / max(error, LEAST_ERROR) ** 2.0
        trend = h / C.last_size * ratio**0.25
        factor = min(factor, max(LEAST_SHRINK, SAFETY * trend))
    if C.cautious and C.last_size > 0.0:
        factor = min(factor, 1.0)
    C.last_size, C.last_norm = h, max(LEAST_REMEMBERED, error)
    C.retries, C.fresh, C.cautious, C.norm = 0, False, False, 0.0
    C.separate = False
    C.age += 1
    if C.theta > QUICK:
        C.known = False
    if C.passed > h:
        resume(C)
    elif factor < 1.0 or min(factor * h, longest_step(P)) > KEEP_GROWTH * h:
        C.h *= cut(P, C, factor)
    C.passed, C.lengthened = 0.0, 0


@native
def step_factor(C: Control, error: float) -> float:
    """Change of the step that the error allows; many iterations ask for caution."""
    safety = min(SAFETY, SAFETY * (1.0 + FEW_TURNS) / (C.turns + FEW_TURNS))
    return max(LEAST_SHRINK, min(MOST_GROWTH, safety * max(error, LEAST_ERROR) ** -0.25))


@native
def resume(C: Control) -> None:
    """A step shortened to a crossing ends, maybe, just before it: the next is the rest of the one
    that has passed its test.  Derivatives of a step this short, and its error, are round-off.
    """
    C.h = max(C.passed - C.h, C.h)
    C.h_last, C.last_size = 0.0, 0.0
