"""Recovery from a failed try of a BDF step: another matrix, length or start, or the end."""

from __future__ import annotations

from adamslite.integrators.accelerations import mass_vanishes
from adamslite.integrators.bdf.order import SAFETY
from adamslite.integrators.bdf.order_cap import CAP, OrderCap
from adamslite.integrators.bdf.state import resize, restore_state
from adamslite.integrators.contract import (
    CHATTERING,
    INDEX3,
    NEWTON_FAILED,
    NOT_FINITE,
    SINGULAR_MASS,
    STABILISED,
    STEP_TOO_SMALL,
    Problem,
)
from adamslite.integrators.events.guards import let_go
from adamslite.integrators.failure_notes import note_trouble
from adamslite.integrators.implicit.control import (
    BLAMED,
    FACTORED,
    FRESH,
    NOISY,
    NORM,
    NOW,
    RETRIES,
    RUNNING,
    SIGNATURE,
    H,
    K,
)
from adamslite.integrators.implicit.failures import SINGULAR_RESOLUTION, corrector_failed, wildest
from adamslite.integrators.implicit.step_size import CUTS, cut, retry_factor
from adamslite.integrators.linalg.plan import Plan
from adamslite.integrators.step_back import before_trouble
from adamslite.native.translate import native

# A step is noise, not truncation, when the error estimates of this many tries in turn keep more
# than this share of the one before, although each was shorter.
NOISY_TRIES, NOISY_SHARE = 2.0, 0.3


@native
def after_failure(P: Problem, w: int) -> int:
    """The corrector failed: renew an old matrix, else cut the step."""
    C = P.control
    P.count.failures += 1
    old = C[FRESH] == 0.0 and C[FACTORED] != 0.0
    C[FACTORED] = 0.0
    if old or let_go(P):
        return RUNNING
    C[RETRIES] += 1.0
    P.undoing.trouble += 1.0
    C[FRESH] = 0.0
    C[BLAMED] = float(wildest(P))
    stabilised = P.sizes.si2 and P.sizes.holonomic > 0
    note_trouble(P, STABILISED if stabilised else INDEX3, P.report.iteration)
    if P.settings.fixed_step > 0.0:
        P.report.where = int(C[BLAMED])
        return NEWTON_FAILED
    if int(C[RETRIES]) != CUTS or not land_elsewhere(P, w):
        resize(P, w, cut(P, retry_factor(C)))
    return RUNNING


@native
def land_elsewhere(P: Problem, w: int) -> bool:
    """Back to before the trouble, with a shorter step; False when that was tried enough."""
    C = P.control
    share = before_trouble(P, C[NOW] + C[H])
    if share == 0.0:
        return False
    C[FACTORED], C[RETRIES], C[FRESH], C[NORM], C[NOISY] = 0.0, 0.0, 0.0, 0.0, 0.0
    restore_state(P, P.history, w, C[NOW])
    resize(P, w, share)
    return True


@native
def after_rejection(P: Problem, w: int, norm: float) -> int:
    """The error was too large: a smaller step."""
    C = P.control
    P.count.rejected += 1
    C[FRESH] = 0.0
    P.undoing.trouble += 1.0
    if not norm < 1e12:
        return NOT_FINITE
    factor = max(0.2, (SAFETY * norm) ** (-1.0 / (C[K] + 1.0)))
    # At the last, tiny steps the error is round-off, and anybody's.
    if C[H] > 1e-9 * P.settings.h_max:
        C[BLAMED] = float(P.report.where)
    C[NOISY] = C[NOISY] + 1.0 if norm > NOISY_SHARE * C[NORM] and C[NORM] > 0.0 else 0.0
    C[NORM] = norm
    if C[NOISY] >= NOISY_TRIES and land_elsewhere(P, w):
        return RUNNING
    if C[K] > 2.0:
        cap = OrderCap(P.control[CAP:])
        cap.bad += 1.0
    resize(P, w, cut(P, factor))
    return RUNNING


@native
def near_singularity(P: Problem, w: int) -> int:
    """The acceleration matrix became singular within the step: approach the place, never pass
    it.
    """
    if P.control[H] < SINGULAR_RESOLUTION * P.settings.h_max or P.settings.fixed_step > 0.0:
        return SINGULAR_MASS
    P.control[FRESH] = 0.0
    resize(P, w, 0.25)
    return RUNNING


@native
def stuck(P: Problem, L: Plan, w: int) -> int:
    """Why the step became too small: a vanishing pivot of the acceleration matrix, or something
    else.
    """
    restore_state(P, P.history, w, P.control[NOW])
    if mass_vanishes(P, L, int(P.control[SIGNATURE])):
        return SINGULAR_MASS
    P.report.where = int(P.control[BLAMED])
    if P.search.freed > 0:
        return CHATTERING
    return NEWTON_FAILED if corrector_failed(P.control) else STEP_TOO_SMALL
