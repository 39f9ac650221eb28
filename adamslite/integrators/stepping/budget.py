"""What a run may spend: so many steps, and not for ever steps that are no progress.

A run creeps when ``MOST_CREPT`` accepted steps in a row are each shorter than ``P.budget.short``, a
share of the analysis that the caller decides on: what lies ahead would take more than 1e10 of them.
"""

from __future__ import annotations

from adamslite.integrators.contract import CREEPING, STEP_LIMIT, Problem
from adamslite.integrators.stepping.control import RUNNING
from adamslite.native.translate import native

# Accepted steps in a row that are no progress, and no more.
MOST_CREPT = 10_000
# Steps that keep a pace are as long as that, but for what fits.
PACED = 0.5


@native
def spent(P: Problem, t: float) -> int:
    """STEP_LIMIT or CREEPING when the budget is spent by the steps accepted up to ``t``, else
    RUNNING.
    """
    B = P.budget
    if P.count.steps != B.seen:
        note_advance(P, t - B.t, 1)
        B.seen, B.t = P.count.steps, t
    if B.crept > MOST_CREPT:
        return CREEPING
    return STEP_LIMIT if B.most > 0 and P.count.steps >= B.most else RUNNING


@native
def note_advance(P: Problem, h: float, count: int) -> None:
    """``count`` steps of length ``h`` were accepted; one that leads back is no progress."""
    B = P.budget
    if h >= least_progress(P):
        B.crept = 0
        return
    if B.crept == 0:
        B.events, B.failures, B.rejected = P.count.events, P.count.failures, P.count.rejected
    B.crept += count


@native
def least_progress(P: Problem) -> float:
    """The shortest step that is progress; paces are known to come to an end."""
    return min(P.budget.short, PACED * P.paces[P.search.pace_at].longest)


@native
def would_overspend(P: Problem, h: float, count: int) -> int:
    """The same as of :func:`spent` of ``count`` more steps of length ``h``, all or none."""
    B = P.budget
    if h < least_progress(P) and B.crept + count > MOST_CREPT:
        if B.crept == 0:
            B.events, B.failures, B.rejected = P.count.events, P.count.failures, P.count.rejected
        return CREEPING
    return STEP_LIMIT if B.most > 0 and P.count.steps + count > B.most else RUNNING
