"""Recovery from a failed try of an explicit step: a shorter step, another start, or the end.

Near a posture in which constraints lose rank shorter steps do not help, because the state they
start from is spoilt by round-off (:mod:`adamslite.integrators.step_back`): after a few failures the
step that led there is taken back and made shorter, so that the next one passes the posture with a
leap.
"""

from __future__ import annotations

from adamslite.integrators.contract import SINGULAR_MASS, Problem
from adamslite.integrators.events.guards import let_go
from adamslite.integrators.explicit.control import OLD, TIED, Control
from adamslite.integrators.explicit.error import LARGE, SHRINK, cut_step, smaller
from adamslite.integrators.explicit.stages import exact_rates, restore_state
from adamslite.integrators.linalg.plan import Plan
from adamslite.integrators.projection import sensitivity
from adamslite.integrators.step_back import before_trouble
from adamslite.integrators.stepping.control import RUNNING
from adamslite.integrators.stepping.outcome import OVERFLOW, SINGULAR_RESOLUTION, why_stuck
from adamslite.native.translate import native, rare, seldom

# Tries in vain around one place before the step that led there is taken back: failures; rejections
# where constraints hold so many times less firmly than at best (else: until one is low by chance).
FEW_FAILURES, FEW_REJECTIONS, LOOSER = 2, 3.0, 10.0
# Steps after a failure of the equations, and after one that left its branch.
CLOSER, HALF = 0.25, 0.5
# A projection that moves further than this times ERROR does not correct a step but leaves it, as
# where constraints lose rank and another branch is near.
FAR = 1.0
# Where steps below this share of HMAX are pulled so far this often, shorter ones will not help.
TINY, MOST_PULLED = 1e-6, 20
# Errors of velocities by round-off below this decide no branch.
FIRM = 1e-11
EPSILON = 2.220446049250313e-16


@native
@seldom
def after_failure(P: Problem, L: Plan, C: Control) -> int:
    """A stage had no accelerations: without held branches, else a shorter step."""
    start_afresh(P, L, C)
    return RUNNING if let_go(P) else shorten(P, C, CLOSER)


@native
def start_afresh(P: Problem, L: Plan, C: Control) -> None:
    """Accelerations and the matrix of the accepted state again: those of a try that failed may be
    no numbers, and what starts from them has none either.
    """
    restore_state(P, C)
    if C.kind == TIED:
        exact_rates(P, L, C, C.t, P.history[OLD * C.size :], P.history[0:])


@native
def start_elsewhere(P: Problem, C: Control) -> bool:
    """Back to the state before the trouble, with a shorter step; False when that was tried enough
    or is of no use.
    """
    share = before_trouble(P, C.t + C.h)
    if share == 0.0:
        return False
    C.cautious = True
    C.h *= share
    restore_state(P, C)
    return True


@native
def shorten(P: Problem, C: Control, factor: float) -> int:
    """Accelerations could not be solved for within the step: a shorter one."""
    P.count.failures += 1
    C.retries, C.tries = C.retries + 1, C.tries + 1
    if P.sizes.m > 0 and C.retries >= FEW_FAILURES and start_elsewhere(P, C):
        return RUNNING
    C.cautious = True
    cut_step(P, C, factor)
    if P.sizes.implicit_mass and C.h < SINGULAR_RESOLUTION * P.settings.h_max:
        return SINGULAR_MASS
    return RUNNING


@native
@seldom
def after_rejection(P: Problem, L: Plan, C: Control, error: float) -> int:
    """The error was too large: a smaller step."""
    P.count.rejected += 1
    if not error < LARGE:
        start_afresh(P, L, C)
        if let_go(P):
            return RUNNING
    P.undoing.trouble += 1.0
    C.tries += 1
    if P.sizes.m > 0 and P.undoing.trouble >= FEW_REJECTIONS:
        if sensitivity(P, L) > LOOSER * C.firmest and start_elsewhere(P, C):
            return RUNNING
    C.cautious = True
    cut_step(P, C, max(SHRINK, smaller(C, error)) if error < OVERFLOW else SHRINK)
    return RUNNING


@native
@rare
def near_singularity(P: Problem, C: Control) -> int:
    """The acceleration matrix became singular within the step: approach that, never pass it."""
    return shorten(P, C, CLOSER)


@native
@rare
def stuck(P: Problem, L: Plan, C: Control) -> int:
    """Back to the accepted state, and why the step became too small."""
    restore_state(P, C)
    return why_stuck(P, L, C)


@native
def left_branch(P: Problem, L: Plan, C: Control) -> bool:
    """Whether the step left its branch at its end, or may."""
    return P.report.moved > FAR * P.settings.error or is_loose(P, L, C)


@native
@seldom
def pull_back(P: Problem, L: Plan, C: Control) -> int:
    """The step left its branch, or ended where it may be left: a shorter one, another start."""
    if C.h < TINY * P.settings.h_max:
        C.pulled += 1
    if C.pulled <= MOST_PULLED:
        return shorten(P, C, HALF)
    C.retries += 1
    return stuck(P, L, C)


@native
def is_loose(P: Problem, L: Plan, C: Control) -> bool:
    """Whether constraints hold the new state so loosely that round-off decides its velocity.

    With the lever d of :mod:`adamslite.integrators.step_back`, 1 in the best posture so far,
    round-off e is an error e/d^2 of velocities: more than ERROR. Steps that become short walk into
    such places, and leave them on any branch.  Below FIRM it decides no branch, and is noted.
    """
    if P.sizes.m == 0:
        return False
    now = sensitivity(P, L)
    C.firmest = min(C.firmest, now) if C.firmest > 0.0 else now
    noise, most = EPSILON * (now / C.firmest) ** 2.0, max(P.settings.error, FIRM)
    if noise > P.settings.error and noise <= most:
        P.report.floor = max(P.report.floor, noise)
    return noise > most
