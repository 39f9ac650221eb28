"""Step sizes after failures: not below HMIN, and when they have become too small."""

from __future__ import annotations

from adamslite.integrators.contract import Problem
from adamslite.integrators.events.stops import least_step
from adamslite.integrators.stepping.control import StepControl
from adamslite.native.translate import native

# A step longer than HMIN by more than this share may be cut to it.
LONGER = 1.0000001
# A step cut to HMIN is HMIN but for its last digit.
LAST_DIGIT = 1e-12


@native
def cut(P: Problem, C: StepControl, factor: float) -> float:
    """``factor`` of the step, but not below HMIN, unless a step of HMIN has failed."""
    least = P.settings.h_min
    if C.h * factor >= least:
        return factor
    if C.h > least * LONGER:
        return least / C.h
    return factor if has_failed(C) else max(factor, 1.0)


@native
def too_small(P: Problem, C: StepControl) -> bool:
    """Whether failed tries have come down below HMIN; a step that only reaches a stop may be as
    short.
    """
    least = P.settings.h_min if has_failed(C) else least_step(P)
    return C.h < (1.0 - LAST_DIGIT) * least


@native
def round_off(P: Problem, C: StepControl) -> float:
    """By how much a step may be extended to a stop that it all but reaches: one that was given up
    has to get shorter.
    """
    return 0.0 if has_failed(C) else least_step(P)


@native
def has_failed(C: StepControl) -> bool:
    """Whether a try was given up since the last accepted step."""
    return C.retries > 0 or C.norm > 0.0
