"""Between steps: the accepted state, steps after failures, and the end of a run: at its time, by
the user, at a singular posture, or because steps vanish.
"""

from __future__ import annotations

from adamslite.integrators.accelerations import mass_signature, mass_vanishes
from adamslite.integrators.contract import (
    CHATTERING,
    DONE,
    FULL,
    HELD,
    INTERRUPTED,
    NEWTON_FAILED,
    PAUSED,
    SINGULAR_MASS,
    STEP_TOO_SMALL,
    Problem,
)
from adamslite.integrators.events.stops import least_step
from adamslite.integrators.linalg.plan import Plan
from adamslite.integrators.motion_equations import PART
from adamslite.integrators.stepping.budget import spent
from adamslite.integrators.stepping.control import RUNNING, StepControl
from adamslite.native.translate import Reals, copy, native, rare

# A sign change of the effective mass is approached to this share of HMAX.
SINGULAR_RESOLUTION = 1e-6
# Change of the step where it passed that.
NEARER = 0.25
# A step that ends before a limit by less than this share of its size ends there.
ALMOST = 1e-7
# An error or an increment from here on, against ERROR or as it is, is no number to continue with.
OVERFLOW = 1e12


@native
def end_of_run(P: Problem, C: StepControl) -> int:
    """DONE at the end time, INTERRUPTED by the user, STEP_LIMIT or CREEPING where the budget is
    spent, HELD where a state is asked for, PAUSED after so many tries, else RUNNING.
    """
    over = spent(P, C.t)
    if C.t >= P.settings.t_end:
        return DONE
    if P.settings.stop:
        return INTERRUPTED
    if over != RUNNING:
        return over
    if P.block.hold:
        return HELD
    if P.settings.pause > 0 and P.count.tries >= P.settings.pause:
        return PAUSED
    P.count.tries += 1
    return RUNNING


@native
def goes_on(outcome: int) -> bool:
    """Whether the method will be called again, and finds everything as it has left it."""
    return outcome == PAUSED or outcome == FULL or outcome == HELD


@native
def is_cut_short(P: Problem, C: StepControl) -> bool:
    """Whether the user ends the run while rows of one step are written block by block; a redundant
    row that opens ends it behind all of them.
    """
    return C.open and P.settings.stop and P.report.torn == 0


@native
def note_try(P: Problem, C: StepControl, order: int) -> None:
    """What a message needs to know of the step that is tried."""
    P.report.t, P.report.h, P.report.order = C.t, C.h, order


@native
def end_of_step(P: Problem, C: StepControl, limit: float) -> float:
    """The time at which the tried step ends: ``limit`` where it all but reaches that, or leaves
    less of it than two of the shortest steps.
    """
    t = C.t + C.h
    return limit if t + max(ALMOST * C.h, 2.0 * least_step(P)) > limit else t


@native
def note_signature(P: Problem, L: Plan, C: StepControl, pivots: Reals) -> None:
    """Remember signs of the pivots of the acceleration matrix at the workspace's state."""
    if P.sizes.implicit_mass:
        C.signature = mass_signature(P, L, pivots)


@native
def passed_singularity(P: Problem, L: Plan, C: StepControl) -> bool:
    """Whether the acceleration matrix became singular within the step; its state is in the
    workspace.
    """
    if not P.sizes.implicit_mass:
        return False
    return mass_signature(P, L, P.x) != C.signature


@native
@rare
def near_singularity(P: Problem, C: StepControl) -> int:
    """The acceleration matrix became singular within the step: approach that, never pass it."""
    C.h *= NEARER
    return RUNNING if C.h > SINGULAR_RESOLUTION * P.settings.h_max else SINGULAR_MASS


@native
@rare
def why_stuck(P: Problem, L: Plan, C: StepControl) -> int:
    """Why the step became too small; the accepted state is in the workspace."""
    if mass_vanishes(P, L, C.signature):
        return SINGULAR_MASS
    if C.blamed >= 0:
        P.report.where = C.blamed
    if P.search.freed > 0:
        return CHATTERING
    return NEWTON_FAILED if corrector_failed(C) else STEP_TOO_SMALL


@native
@rare
def corrector_failed(C: StepControl) -> bool:
    """Whether the last tries failed for the corrector, not for accuracy."""
    return C.retries > 2 or (C.retries > 0 and C.norm == 0.0)


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


@native
def keep_solution(P: Problem) -> None:
    """Accelerations, multipliers, variables and states in place are the accepted ones."""
    copy(P.ra, P.a, P.sizes.n)
    for i in range(P.z.size):
        P.rz[i] = P.z[i]


@native
def count_from_here(P: Problem) -> None:
    """The workspace's attitudes become the base of rotation vectors."""
    for b in range(P.sizes.nb):
        if P.body[b].width == PART:
            i, o = P.body[b].first, P.body[b].at
            for k in range(9):
                P.base[9 * b + k] = P.W[o + 15 + k]
            for k in range(3, 6):
                P.q[i + k] = 0.0
