"""What a run may spend: so many steps, and not for ever steps that are no progress.

A run creeps when the steps that it has taken are by more than ``P.budget.patience``, and by more
than a tenth of all, too many for the time that they took: steps of ``P.budget.short``, a share of
the analysis that the caller decides on, are as many as they may be.  What lies ahead would take
more than 1e10 of them.

It does not creep while steps become longer: of a vibration that dies out, each half as many steps
as the patience cover more time than any before.
"""

from __future__ import annotations

from adamslite.integrators.contract import CREEPING, STEP_LIMIT, Problem
from adamslite.integrators.stepping.control import RUNNING
from adamslite.native.translate import native, rare

# Short steps in a row, against all that the run has taken, that are worth waiting for.
WORTH_WAITING = 0.1
# Times as long as before, a step is on its way to be progress.
LONGER = 1.1
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
    if B.crept > B.patience and B.crept > WORTH_WAITING * P.count.steps and not B.growing:
        return CREEPING
    return STEP_LIMIT if B.most > 0 and P.count.steps >= B.most else RUNNING


@native
def note_advance(P: Problem, h: float, count: int) -> None:
    """``count`` steps of length ``h`` were accepted; one that leads back is no progress."""
    if h < least_progress(P):
        note_creeping(P, h, count)
    elif P.budget.crept > 0.0:
        make_up(P, h, count)


@native
@rare
def make_up(P: Problem, h: float, count: int) -> None:
    """A longer step makes up for as many shorter ones as fit into it."""
    B = P.budget
    B.crept = max(0.0, B.crept - count * (h / least_progress(P) - 1.0))


@native
@rare
def note_creeping(P: Problem, h: float, count: int) -> None:
    """The same of steps that are no progress."""
    B, least = P.budget, least_progress(P)
    if least <= 0.0:  # a step back where all steps are progress
        return
    if B.crept == 0.0:
        note_first(P)
    B.crept += count * (1.0 - max(0.0, h) / least)
    B.halved += count
    B.covered += h * count
    if 2 * B.halved >= B.patience:
        mean = B.covered / B.halved
        B.growing = mean >= LONGER * B.longest
        B.longest = max(mean, B.longest)
        B.halved, B.covered = 0, 0.0


@native
def note_first(P: Problem) -> None:
    """The first of steps that are no progress is taken."""
    B = P.budget
    B.events, B.failures, B.rejected = P.count.events, P.count.failures, P.count.rejected
    B.halved, B.covered, B.longest, B.growing = 0, 0.0, 0.0, False


@native
def least_progress(P: Problem) -> float:
    """The shortest step that is progress; paces are known to come to an end."""
    return min(P.budget.short, PACED * P.paces[P.search.pace_at].longest)


@native
def would_overspend(P: Problem, h: float, count: int) -> int:
    """The same as of :func:`spent` of ``count`` more steps of length ``h``, all or none."""
    B = P.budget
    if h < least_progress(P) and B.crept + count > B.patience:
        if B.crept == 0.0:
            note_first(P)
        return CREEPING
    return STEP_LIMIT if B.most > 0 and P.count.steps + count > B.most else RUNNING
