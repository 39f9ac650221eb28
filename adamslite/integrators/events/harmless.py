"""Branches that differ at the end of a step without changing a value: no search is needed."""

from __future__ import annotations

from adamslite.integrators.accelerations import accelerations
from adamslite.integrators.contract import Problem
from adamslite.integrators.event_rows import (
    BEFORE,
    CHANGES,
    END,
    INSIDE,
    JUMPS,
    LOW_ROW,
    NONE,
)
from adamslite.integrators.events.guards import (
    CHATTER,
    HARMLESS,
    SAME_TIME,
    crossing_share,
    is_relation,
    keeps_returning,
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
from adamslite.integrators.motion_equations import PART, residual, vector_rates
from adamslite.native.translate import Reals, native, seldom

# So many groups of changes are tried one after another, and so many pieces of floors.
MOST_GROUPS, MOST_PIECES = 5, 20
# Where, on the way back from the end to the first change, branches are compared once more.
SHORTLY = 0.1


@native
@seldom
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
    pieces = 0
    while harmless and lags(P):
        pieces += 1
        harmless = pieces < MOST_PIECES and small_change(P, L, phases, cu)
    if harmless and not (exposes(P) or slides(P)) and not matters_before(P, L, phases, cu):
        forget(P)
    else:
        turn_back(P)


@native
def lags(P: Problem) -> bool:
    """Whether floors that were turned over have not come to the piece of the end yet: they are
    turned to the next one.  Each piece on the way may be the one that matters.
    """
    count, first, found = P.sizes.watched, P.sizes.nw + P.sizes.clocks, False
    margins(P, INSIDE)
    for k in range(count):
        branch, before = P.W[first + k], P.margin[BEFORE * count + k]
        if branch != before and P.margin[INSIDE * count + k] < 0.0:
            if not is_relation(P.kind[P.sizes.clocks + k]):
                P.W[first + k] = branch + (1.0 if P.guard[first + k] > branch else -1.0)
                found = True
    return found


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
    return moves_little(P, L, cu, HARMLESS)


@native
def moves_little(P: Problem, L: Plan, cu: float, share: float) -> bool:
    """Whether Newton's increment for the residual in ``P.F`` is below a share of ERROR."""
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
    return largest <= share * P.settings.error


@native
def matters_before(P: Problem, L: Plan, phases: int, cu: float) -> bool:
    """Whether shortly before the end the branches that the step kept are off by more than ERROR.

    At the end alone branches may make no difference by chance: a force ends at zero, or centres
    meet and no normal says which way they move.  The state before it is that of the end, moved back
    along its rates; any near it would do.  There guards are evaluated as they are.
    """
    nw, count, change = P.sizes.nw, P.sizes.watched, 1.0
    first = nw + P.sizes.clocks
    for k in range(count):
        P.margin[LOW_ROW * count + k] = P.W[first + k]
        if P.margin[END * count + k] < 0.0:
            change = min(change, crossing_share(P, k))
    for k in range(nw):
        P.guard[k] = P.W[k]
    move_back(P, SHORTLY * (1.0 - change) * P.search.size)
    for k in range(count):
        P.W[first + k] = 0.0
    residual(P, phases, P.F)
    for i in range(P.sizes.nz):
        P.x[i] = P.F[i]
    turn_back(P)
    residual(P, phases, P.F)
    for i in range(P.sizes.nz):
        P.F[i] -= P.x[i]
    for k in range(nw):
        P.W[k] = P.guard[k]
    for k in range(count):
        P.W[first + k] = P.margin[LOW_ROW * count + k]
    return not moves_little(P, L, cu, 1.0)


@native
def move_back(P: Problem, time: float) -> None:
    """The workspace's state ``time`` earlier, to first order."""
    W, first = P.W, P.sizes.m + P.sizes.nv
    W[0] -= time
    for b in range(P.sizes.nb):
        o = P.body[b].at
        for k in range(3):
            W[o + k] -= time * W[o + 3 + k]
            W[o + 3 + k] -= time * W[o + 6 + k]
        if P.body[b].width == PART:
            turn_back_part(W[o + 9 :], W[o + 15 :], time)
            for k in range(3):
                W[o + 9 + k] -= time * W[o + 12 + k]
    for k in range(P.sizes.ns):
        W[P.scalar[first + k]] -= time * W[P.scalar[first + k] + 1]


@native
def turn_back_part(w: Reals, R: Reals, time: float) -> None:
    """R - time [w] R."""
    for j in range(3):
        x, y, z = R[j], R[3 + j], R[6 + j]
        R[j] -= time * (w[1] * z - w[2] * y)
        R[3 + j] -= time * (w[2] * x - w[0] * z)
        R[6 + j] -= time * (w[0] * y - w[1] * x)


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
def slides(P: Problem) -> bool:
    """Whether a guard would be let go for the changes of this step where a value jumps: an event
    decides whether the motion slides along the jump.
    """
    count, keeps_changing, jumps = P.sizes.watched, False, False
    for k in range(count):
        changes = P.margin[END * count + k] < 0.0
        keeps_changing = keeps_changing or (changes and keeps_returning(P, k, P.W[0], CHATTER))
        if P.kind[P.sizes.clocks + k] >= JUMPS:
            jumps = jumps or changes or P.margin[CHANGES * count + k] < 0.0
    return keeps_changing and jumps


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


@native
@seldom
def force_ahead(P: Problem, L: Plan, t: float, time: float) -> float:
    """What the branches that were turned over in the last step add to accelerations and rates of
    states at ``t + time``, against max(1, |u|) and max(1, |s|).

    The state, accelerations, algebraic unknowns and rates of states at ``t`` are the accepted ones
    (q, u, ra, rz, rd), and are so afterwards; not so the workspace.
    """
    n, ns, count, first = P.sizes.n, P.sizes.ns, P.sizes.watched, P.sizes.nw + P.sizes.clocks
    states = P.sizes.m + P.sizes.nv
    new, rates, top = P.trial[2 * n :], P.trial[3 * n + ns :], 0.0
    for k in range(ns):
        rates[k] = P.rd[k]
    known = accelerations_ahead(P, L, t, time, rates)
    for i in range(n):
        new[i] = P.a[i]
    for k in range(ns):
        new[n + k] = P.rd[k]
    for k in range(count):
        P.margin[LOW_ROW * count + k] = P.W[first + k]
    turn_back(P)
    known = accelerations_ahead(P, L, t, time, rates) and known
    for k in range(count):
        P.W[first + k] = P.margin[LOW_ROW * count + k]
    for i in range(n):
        top = max(top, abs(new[i] - P.a[i]) / max(1.0, abs(P.u[i])))
        P.a[i] = P.ra[i]
    for k in range(ns):
        size = max(1.0, abs(P.rz[states + k]))
        top = max(top, abs(new[n + k] - P.rd[k]) / size)
        P.rd[k] = rates[k]
    for k in range(P.z.size):
        P.z[k] = P.rz[k]
    return top if known else 0.0


@native
@seldom
def accelerations_ahead(P: Problem, L: Plan, t: float, time: float, rates: Reals) -> bool:
    """Accelerations of the present branches at ``t + time``, to first order; False without any."""
    n, first = P.sizes.n, P.sizes.m + P.sizes.nv
    y = P.trial[0:]
    vector_rates(P, P.q, P.u, y)
    for i in range(n):
        y[i], y[n + i] = P.q[i] + time * y[i], P.u[i] + time * P.ra[i]
        P.a[i] = P.ra[i]
    for k in range(P.sizes.ns):
        P.z[first + k] = P.rz[first + k] + time * rates[k]
        P.rd[k] = rates[k]
    return accelerations(P, L, t + time, y, y[n:], P.a, P.z, P.rd)
