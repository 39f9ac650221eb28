"""Recovery from a failed try of a BDF step: another matrix, length or start, or the end."""

from __future__ import annotations

from adamslite.integrators.bdf.control import Control
from adamslite.integrators.bdf.order import SAFETY
from adamslite.integrators.bdf.state import resize, restore_state
from adamslite.integrators.contract import NEWTON_FAILED, NOT_FINITE, SINGULAR_MASS, Problem
from adamslite.integrators.events.guards import let_go
from adamslite.integrators.failure_notes import note_trouble, wildest
from adamslite.integrators.implicit.formulation import equations_kept
from adamslite.integrators.implicit.step_size import CUTS, retry_factor, shrunk
from adamslite.integrators.linalg.plan import Plan
from adamslite.integrators.step_back import before_trouble
from adamslite.integrators.stepping.control import RUNNING
from adamslite.integrators.stepping.outcome import (
    NEARER,
    OVERFLOW,
    SINGULAR_RESOLUTION,
    cut,
    why_stuck,
)
from adamslite.native.translate import native, rare, seldom

# A step is noise, not truncation, when the error estimates of this many tries in turn keep more
# than this share of the one before, although each was shorter.
NOISY_TRIES, NOISY_SHARE = 2.0, 0.3
# Below this share of HMAX the error is round-off, and anybody's.
TINY = 1e-9


@native
@seldom
def after_failure(P: Problem, C: Control) -> int:
    """The corrector failed: renew an old matrix, else cut the step."""
    P.count.failures += 1
    old = not C.fresh and C.factored != 0.0
    C.factored = 0.0
    if old or let_go(P):
        return RUNNING
    C.retries += 1
    P.undoing.trouble += 1.0
    C.fresh = False
    C.blamed = wildest(P)
    note_trouble(P, equations_kept(P), P.report.iteration)
    if P.settings.fixed_step > 0.0:
        P.report.where = C.blamed
        return NEWTON_FAILED
    if C.retries != CUTS or not land_elsewhere(P, C):
        resize(P, C, cut(P, C, retry_factor(C)))
    return RUNNING


@native
def land_elsewhere(P: Problem, C: Control) -> bool:
    """Back to before the trouble, with a shorter step; False when that was tried enough."""
    share = before_trouble(P, C.t + C.h)
    if share == 0.0:
        return False
    C.factored, C.retries, C.fresh, C.norm, C.noisy = 0.0, 0, False, 0.0, 0
    restore_state(P, C)
    resize(P, C, share)
    return True


@native
@seldom
def after_rejection(P: Problem, C: Control, norm: float) -> int:
    """The error was too large: a smaller step."""
    P.count.rejected += 1
    C.fresh = False
    P.undoing.trouble += 1.0
    if not norm < OVERFLOW:
        return NOT_FINITE
    factor = shrunk(SAFETY * norm, C.order)
    if C.h > TINY * P.settings.h_max:
        C.blamed = P.report.where
    C.noisy = C.noisy + 1 if norm > NOISY_SHARE * C.norm and C.norm > 0.0 else 0
    C.norm = norm
    if C.noisy >= NOISY_TRIES and land_elsewhere(P, C):
        return RUNNING
    if C.order > 2:
        cap = C.cap
        cap.bad += 1.0
    resize(P, C, cut(P, C, factor))
    return RUNNING


@native
@rare
def near_singularity(P: Problem, C: Control) -> int:
    """The acceleration matrix became singular within the step: approach the place, never pass
    it.
    """
    if C.h < SINGULAR_RESOLUTION * P.settings.h_max or P.settings.fixed_step > 0.0:
        return SINGULAR_MASS
    C.fresh = False
    resize(P, C, NEARER)
    return RUNNING


@native
@rare
def stuck(P: Problem, L: Plan, C: Control) -> int:
    """The step became too small: another start, or the end of the run."""
    if land_elsewhere(P, C):
        return RUNNING
    restore_state(P, C)
    return why_stuck(P, L, C)
