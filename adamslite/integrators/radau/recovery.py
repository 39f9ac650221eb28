"""Recovery from a failed try of a Radau step: other derivatives, another step, or the end."""

from __future__ import annotations

from adamslite.integrators.contract import NOT_FINITE, Problem
from adamslite.integrators.events.guards import let_go
from adamslite.integrators.failure_notes import note_trouble
from adamslite.integrators.implicit.failures import wildest
from adamslite.integrators.implicit.formulation import equations_kept
from adamslite.integrators.implicit.step_size import retry_factor
from adamslite.integrators.linalg.plan import Plan
from adamslite.integrators.radau.control import Control
from adamslite.integrators.radau.events import is_at_crossing, switch_at_start
from adamslite.integrators.radau.stages import put_stage
from adamslite.integrators.radau.state import restore_state
from adamslite.integrators.radau.step_size import step_factor
from adamslite.integrators.stepping.control import RUNNING
from adamslite.integrators.stepping.outcome import OVERFLOW, why_stuck
from adamslite.integrators.stepping.step_size import cut
from adamslite.native.translate import native, rare, seldom

# Below this share of HMAX the error of a step is round-off, and nobody's.
BLAMELESS = 1e-9


@native
@seldom
def after_failure(P: Problem, C: Control) -> int:
    """Newton failed: new derivatives when they were old, else another step."""
    P.count.failures += 1
    old = not C.fresh and C.known
    C.known, C.factored, C.rate, C.cautious = False, 0.0, 1.0, True
    if not old and not let_go(P):
        C.retries += 1
        C.blamed = wildest(P)
        put_stage(P, 3, C.h)
        note_trouble(P, equations_kept(P), C.turns)
        C.h *= cut(P, C, retry_factor(C))
    return RUNNING


@native
@seldom
def after_rejection(P: Problem, L: Plan, C: Control, error: float) -> int:
    """The error was too large: a shorter step, with new derivatives where they were old, because
    these may be all that is wrong with the estimate.
    """
    if not error < OVERFLOW:
        return NOT_FINITE
    if is_at_crossing(P, C, error):
        return switch_at_start(P, L, C)
    P.count.rejected += 1
    C.cautious, C.norm = True, error
    if not C.fresh:
        C.known = False
    C.h *= cut(P, C, step_factor(C, error))
    if C.h > BLAMELESS * P.settings.h_max:
        C.blamed = P.report.where
    return RUNNING


@native
@rare
def stuck(P: Problem, L: Plan, C: Control) -> int:
    """Back to the accepted state, and why the step became too small."""
    restore_state(P, C)
    return why_stuck(P, L, C)
