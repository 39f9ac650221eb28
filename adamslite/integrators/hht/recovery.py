"""Recovery from a failed try of a step of HHT or NEWMARK: a shorter step, or the end."""

from __future__ import annotations

from adamslite.integrators.contract import INDEX3, NOT_FINITE, Problem
from adamslite.integrators.events.guards import crawls, let_go
from adamslite.integrators.failure_notes import note_trouble
from adamslite.integrators.hht.control import Control
from adamslite.integrators.hht.state import restore_state
from adamslite.integrators.hht.step_size import ORDER, SAFETY
from adamslite.integrators.implicit.failures import wildest
from adamslite.integrators.implicit.step_size import retry_factor, shrunk
from adamslite.integrators.linalg.plan import Plan
from adamslite.integrators.stepping.control import RUNNING
from adamslite.integrators.stepping.outcome import OVERFLOW, why_stuck
from adamslite.integrators.stepping.step_size import cut, too_small
from adamslite.native.translate import native, rare, seldom

# Share of a fixed step below which it is not divided any more.
LEAST_SHARE = 1e-9


@native
def is_stuck(P: Problem, C: Control) -> bool:
    """Whether steps have become too small to go on."""
    if C.fixed > 0.0:
        return C.h < LEAST_SHARE * C.fixed or crawls(P, C.h)
    return too_small(P, C) or crawls(P, C.h)


@native
@seldom
def after_failure(P: Problem, C: Control) -> int:
    """A shorter step with a new matrix; near a singular posture also longer ones."""
    P.count.failures += 1
    C.factored, C.equal = 0.0, 0
    if C.fixed > 0.0:
        P.report.divided += 1
    if let_go(P):
        return RUNNING
    C.retries += 1
    C.blamed = wildest(P)
    note_trouble(P, INDEX3, P.report.iteration)
    C.h *= cut(P, C, retry_factor(C)) if C.fixed == 0.0 else retry_factor(C)
    return RUNNING


@native
@seldom
def after_rejection(P: Problem, C: Control, norm: float) -> int:
    """The error was too large: a smaller step."""
    if not norm < OVERFLOW:
        return NOT_FINITE
    P.count.rejected += 1
    C.equal, C.norm = 0, norm
    C.h *= cut(P, C, shrunk(SAFETY * norm, ORDER))
    return RUNNING


@native
@rare
def stuck(P: Problem, L: Plan, C: Control) -> int:
    """Back to the accepted state, and why the step became too small."""
    restore_state(P, C)
    return why_stuck(P, L, C)
