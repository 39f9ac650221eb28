"""Recovery from a failed try of an explicit step: a shorter step, another start, or the end.

Near a posture in which constraints lose rank shorter steps do not help, because the state they
start from is spoilt by round-off (:mod:`adamslite.integrators.step_back`): after a few failures the
step that led there is taken back and made shorter, so that the next one passes the posture with a
leap.
"""

from __future__ import annotations

from adamslite.integrators.accelerations import mass_vanishes
from adamslite.integrators.contract import (
    CHATTERING,
    NEWTON_FAILED,
    SINGULAR_MASS,
    STEP_TOO_SMALL,
    Problem,
)
from adamslite.integrators.events.guards import let_go
from adamslite.integrators.explicit.control import Control
from adamslite.integrators.explicit.error import LARGE, NOW_POWER, SAFETY, SHRINK, cut_step
from adamslite.integrators.explicit.state import (
    stand_again,
)
from adamslite.integrators.linalg.plan import Plan
from adamslite.integrators.step_back import before_trouble
from adamslite.integrators.stepping.control import RUNNING
from adamslite.integrators.stepping.outcome import OVERFLOW
from adamslite.native.translate import native

SINGULAR_RESOLUTION = 1e-6
# Tries in vain around one place before the step that led there is taken back: failures of the
# equations, rejections.
FEW_FAILURES, FEW_REJECTIONS = 2, 3.0


@native
def start_elsewhere(P: Problem, w: int) -> bool:
    """Back to the state before the trouble, with a shorter step; False when that was tried enough
    or is of no use.
    """
    C = Control(P.control)
    share = before_trouble(P, C.t + C.h)
    if share == 0.0:
        return False
    C.cautious = True
    C.h *= share
    stand_again(P, w)
    return True


@native
def shorten(P: Problem, w: int, factor: float) -> int:
    """Accelerations could not be solved for within the step: a shorter one."""
    C = Control(P.control)
    P.count.failures += 1
    C.retries, C.tries = C.retries + 1, C.tries + 1
    if P.sizes.m > 0 and C.retries >= FEW_FAILURES and start_elsewhere(P, w):
        return RUNNING
    C.cautious = True
    cut_step(P, factor)
    if P.sizes.implicit_mass and C.h < SINGULAR_RESOLUTION * P.settings.h_max:
        return SINGULAR_MASS
    return RUNNING


@native
def reject(P: Problem, w: int, error: float) -> int:
    """The error was too large: a smaller step."""
    C = Control(P.control)
    P.count.rejected += 1
    if not error < LARGE and let_go(P):
        return RUNNING
    P.undoing.trouble += 1.0
    C.tries += 1
    if P.sizes.m > 0 and P.undoing.trouble >= FEW_REJECTIONS and start_elsewhere(P, w):
        return RUNNING
    C.cautious = True
    cut_step(P, max(SHRINK, SAFETY * error**NOW_POWER) if error < OVERFLOW else SHRINK)
    return RUNNING


@native
def why_stuck(P: Problem, L: Plan, w: int) -> int:
    """The step became too small: because a mass vanishes, the equations could not be solved, or for
    accuracy.
    """
    C = Control(P.control)
    stand_again(P, w)
    if mass_vanishes(P, L, C.signature):
        return SINGULAR_MASS
    if P.search.freed > 0:
        return CHATTERING
    return NEWTON_FAILED if C.retries > 0 else STEP_TOO_SMALL
