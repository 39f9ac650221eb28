"""Branches that differ at the end of a step without changing a value: no search is needed."""

from __future__ import annotations

from adamslite.integrators.contract import Problem
from adamslite.integrators.event_rows import BEFORE, END, INSIDE, NONE
from adamslite.integrators.events.guards import (
    HARMLESS,
    SAME_TIME,
    crossing_share,
    margins,
    note_changes,
    remember_branches,
    turn_back,
    turn_over,
)
from adamslite.integrators.events.search import ends_beyond
from adamslite.integrators.events.sensors import meets_sensor
from adamslite.integrators.linalg.blocks import solve
from adamslite.integrators.linalg.plan import HUGE, Plan
from adamslite.integrators.motion_equations import residual
from adamslite.native.translate import native

# So many groups of changes are tried one after another.
MOST_GROUPS = 5


@native
def take_harmless(P: Problem, L: Plan, phases: int, cu: float) -> None:
    """Where the step ends beyond changes that do not matter, and none is being hunted, take them:
    Newton's next increment on the other branches, dq with du = cu dq, is too small.  The converged
    end of the step stands in the workspace.

    Branches are changed one after another as they were met: two that cancel at the end (a force
    that acts only in a thin layer) need not have cancelled on the way.
    """
    if not ends_beyond(P) or P.search.hunt or meets_sensor(P):
        return
    share, groups, harmless = -1.0, 0, True
    remember_branches(P)
    while harmless and share < 1.0:
        groups += 1
        share = next_change(P, share) if groups < MOST_GROUPS else 1.0
        turn_back(P)
        turn_over(P, END, share)
        harmless = small_change(P, L, phases, cu)
    if harmless and not exposes(P):
        forget(P)
    else:
        turn_back(P)


@native
def next_change(P: Problem, share: float) -> float:
    """Estimated share of the step of the first change after ``share``; 1 for the last one."""
    count, found, last = P.sizes.watched, 1.0, 0.0
    for k in range(count):
        if P.margin[END * count + k] < 0.0:
            at = crossing_share(P, k)
            last = max(last, at)
            if at > share + SAME_TIME:
                found = min(found, at)
    return found if found < last - SAME_TIME else 1.0


@native
def small_change(P: Problem, L: Plan, phases: int, cu: float) -> bool:
    """Whether the residual of the present branches moves the converged state too little to see."""
    residual(P, phases, P.F)
    solve(L, P.LV, P.pivots, P.F, P.x, P.work)
    largest, first = 0.0, P.sizes.m + P.sizes.nv
    for k in range(P.sizes.ns):
        size = abs(P.F[P.sizes.n + first + k])
        largest = max(largest, size / max(1.0, abs(P.z[first + k])))
    for i in range(P.sizes.n):
        size = abs(P.F[i])
        largest = max(largest, size / max(1.0, abs(P.q[i])), cu * size / max(1.0, abs(P.u[i])))
    for k in range(P.sizes.nz):
        if not abs(P.F[k]) < HUGE:
            return False
    return largest <= HARMLESS * P.settings.error


@native
def exposes(P: Problem) -> bool:
    """Whether the branches that were turned over move the margin of another guard: what that one
    decides may have changed on the way (MAX(ABS(x) - a, 0): with the branch of ABS that of MAX).
    """
    count, first = P.sizes.watched, P.sizes.nw + P.sizes.clocks
    margins(P, INSIDE)
    for k in range(count):
        same = P.W[first + k] == P.margin[BEFORE * count + k]
        if same and P.margin[INSIDE * count + k] != P.margin[END * count + k]:
            return True
    return False


@native
def forget(P: Problem) -> None:
    """The branches that were turned over are those of the end; others are still examined.  A guard
    that keeps changing so is let go, and no reason to end the run.
    """
    crawl, freed = P.search.crawl, P.search.freed
    note_changes(P, P.W[0], END)
    P.search.crawl, P.search.freed = crawl, freed
    P.search.taken, P.search.high = True, NONE
    margins(P, END)
