"""Events: where an expression changes its branch, and how an integrator meets them.

Within a step every guard (:mod:`adamslite.guards`) keeps the branch it had, so that the equations
are smooth.  Branches stand behind the state in the workspace: first those of the clock, then those
of the watch; 0 stands for a guard that is evaluated as it is.

*Stops* are the times at which a branch of the clock changes.  They are known before the run and
stand in ``P.stops``, the end of the run last.  *Crossings* are sign changes of watched guards; they
are found between the two ends of a step and at its middle, and located on the dense output.

An integrator

1. calls :func:`start_events` before it solves for the first accelerations and :func:`hold_watch`
   behind that, with the accelerations in the workspace;
2. never steps beyond :func:`horizon`, and ends a step exactly there;
3. looks for a crossing when a step has passed its error test, with the end of the step in the
   workspace::

       open_search(P, t, h)
       while P.search[OPEN] != 0.0:
           (the state at the share P.search[SHARE] of the step into the workspace)
           judge(P)

   and afterwards puts the end back.  Above 1, ``P.search[FOUND]`` says that there was none.  Where
   ``ends_beyond(P)`` right after ``open_search``, branches differ at the end; when they make no
   difference there (:func:`is_harmless`) they are changed without a search;
   A try that fails because nothing is defined behind a branch is done again after
   :func:`let_go`;
   A try after which it :func:`crawls` ends the run as CHATTERING;
4. does nothing more when :func:`ends_there`; otherwise takes the step again with the size
   :func:`shorter`, or, when :func:`starts_there`, changes branches where it stands;
5. accepts the step, writes the records of the time until then, and calls :func:`keep_margins`
   unless something :func:`happened`, else :func:`pass_event`; that leaves accelerations of the new
   branches, and in ``P.search[JUMP]`` how much they changed.  After a jump what is remembered of
   the past is worthless: it starts anew.  Behind the end of a STEP in time it may go on.

Reference: Shampine, Thompson, Appl. Math. Comput. 2000, "Event location for ODEs"; Oliveira,
Takahashi, ACM Trans. Math. Softw. 47 (2021) 5 (ITP, the bracketing).
"""

from __future__ import annotations

from math import floor

from adamslite.integrators.acceleration import accelerations
from adamslite.integrators.base import (
    CLOCKS,
    ERROR,
    EVENTS,
    H_MAX,
    H_MIN,
    NS,
    NW,
    NZ,
    WATCHED,
    N,
    Plan,
    Problem,
    T,
)
from adamslite.integrators.equations import guard_values, put_time, residual
from adamslite.integrators.linalg import solve
from adamslite.translate import native

# Columns of P.group.
CLOCK, WATCH = 7, 8
STRICT, WEAK = 0, 1
# What a branch adds to the gap of its relation.
HUGE = 1e200
# Rows of P.margin: at the start, at the end and inside of the step; the bracket; how often a guard
# has changed lately, and since when;
# branches before they were turned over, and before they were let go for a try.
START, END, INSIDE, LOW_ROW, HIGH_ROW, CHANGES, SINCE, BEFORE, HELD = range(9)
# An event is met when the step ends behind it by less than this share of the step in which it was
# seen, or this multiple of ERROR.
CLOSE, CLOSE_ERROR = 1e-6, 0.01
TIME_ROUND_OFF = 4e-15
# Steps below this over ERROR give velocities that are round-off of positions.
NOISE = 1e-15
# A guard that changes this often within this share of HMAX is chattering: it is no longer held.
CHATTER, CHATTER_SPAN = 10.0, 1e-3
# After that, this many steps below this share of HMAX show that nothing else helps.
CRAWLING, MOST_CRAWLED = 1e-4, 500.0
# Branches that change the end of a step by less than this share of ERROR need no event.
HARMLESS = 0.02
# Changes nearer than this share of a step are one; so many are tried one after another.
SAME_TIME, MOST_GROUPS = 1e-6, 5
NONE = 2.0

# Places in P.search.
(
    STOP_AT, OPEN, LOW, HIGH, SHARE, FOUND, SIZE, TOLERANCE, BUDGET, JUMP, FREED, CULPRIT, HUNT,
    LOOSE, LET_GO, AGAIN,
    CRAWL, HUNT_END, WHOLE,
) = range(19)  # fmt: skip


@native
def branch_of(kind: int, value: float) -> float:
    """What stands for the branch of a guard with this value."""
    if kind == STRICT:
        return HUGE if value > 0.0 else -HUGE
    if kind == WEAK:
        return HUGE if value >= 0.0 else -HUGE
    return floor(value) + 0.5


@native
def margin_of(kind: int, branch: float, value: float) -> float:
    """Negative when a guard has left its branch, else how far it is from that."""
    if branch == 0.0:
        return 1.0
    if kind == STRICT or kind == WEAK:
        return value if branch > 0.0 else 0.0 - value
    return 0.5 - abs(value - branch)


@native
def horizon(P: Problem) -> float:
    """The time that the present step must not pass."""
    return P.stops[int(P.search[STOP_AT])]


@native
def is_stop(P: Problem, t: float) -> bool:
    """Whether branches of the clock change at time ``t``, where a step has ended."""
    return t >= horizon(P) and int(P.search[STOP_AT]) < P.stops.size - 1


@native
def start_events(P: Problem, located: bool) -> None:
    """Nothing has happened yet; branches of the clock for the time until the first stop.

    ``located``: crossings are looked for; else watched guards are evaluated as they are.
    """
    for k in range(P.search.size):
        P.search[k] = 0.0
    P.search[FOUND], P.search[LOOSE] = NONE, 0.0 if located else 1.0
    for k in range(P.margin.size):
        P.margin[k] = 0.0
    release_watch(P)
    set_clock(P, P.settings[T])


@native
def set_clock(P: Problem, t: float) -> None:
    """Branches of the clock between ``t`` and the horizon: those in the middle."""
    W, first = P.W, P.sizes[NW]
    if P.sizes[CLOCKS] == 0:
        return
    for k in range(P.sizes[CLOCKS]):
        W[first + k] = 0.0
    put_time(P, 0.5 * (t + horizon(P)))
    guard_values(P, CLOCK)
    for k in range(P.sizes[CLOCKS]):
        W[first + k] = branch_of(P.kind[k], P.guard[first + k])


@native
def release_watch(P: Problem) -> None:
    """Evaluate watched guards as they are."""
    first = P.sizes[NW] + P.sizes[CLOCKS]
    for k in range(P.sizes[WATCHED]):
        P.W[first + k] = 0.0


@native
def hold_watch(P: Problem) -> None:
    """Hold the branches of the workspace's state from now on."""
    clocks, count = P.sizes[CLOCKS], P.sizes[WATCHED]
    if count == 0 or P.search[LOOSE] != 0.0:
        return
    first = P.sizes[NW] + clocks
    release_watch(P)
    guard_values(P, WATCH)
    for k in range(count):
        if P.margin[CHANGES * count + k] >= 0.0:
            P.W[first + k] = branch_of(P.kind[clocks + k], P.guard[first + k])
    margins(P, START)


@native
def let_go(P: Problem) -> bool:
    """Evaluate guards as they are for the next try, because held ones led out of where an
    expression is defined (the root of a length that IF keeps positive); False when they are not
    held.
    """
    S, first, count = P.search, P.sizes[NW] + P.sizes[CLOCKS], P.sizes[WATCHED]
    if count == 0 or S[LOOSE] != 0.0 or S[LET_GO] != 0.0:
        return False
    S[LET_GO] = 1.0
    for k in range(count):
        P.margin[HELD * count + k] = P.W[first + k]
        P.W[first + k] = 0.0
    return True


@native
def take_up(P: Problem) -> None:
    """Hold the guards again that were let go for a try."""
    first, count = P.sizes[NW] + P.sizes[CLOCKS], P.sizes[WATCHED]
    if P.search[LET_GO] != 0.0:
        P.search[LET_GO] = 0.0
        for k in range(count):
            P.W[first + k] = P.margin[HELD * count + k]


@native
def margins(P: Problem, row: int) -> int:
    """Margins at the workspace's state into a row of ``P.margin``; how many are negative."""
    clocks, count, found = P.sizes[CLOCKS], P.sizes[WATCHED], 0
    first = P.sizes[NW] + clocks
    guard_values(P, WATCH)
    for k in range(count):
        margin = margin_of(P.kind[clocks + k], P.W[first + k], P.guard[first + k])
        P.margin[row * count + k] = margin
        if margin < 0.0:
            found += 1
    return found


@native
def copy_margins(P: Problem, source: int, target: int) -> None:
    for k in range(P.sizes[WATCHED]):
        P.margin[target * P.sizes[WATCHED] + k] = P.margin[source * P.sizes[WATCHED] + k]


@native
def keep_margins(P: Problem) -> None:
    """The step is accepted: its end is the next start."""
    copy_margins(P, END, START)


@native
def open_search(P: Problem, t: float, h: float) -> None:
    """Look at the end of the step from ``t``, which stands in the workspace."""
    S = P.search
    S[OPEN], S[SHARE], S[FOUND], S[SIZE], S[LOW], S[HIGH] = 1.0, 0.5, NONE, h, 0.0, NONE
    S[AGAIN] = S[LET_GO]
    take_up(P)
    if S[HUNT] != 0.0 and t >= S[HUNT_END]:
        S[HUNT] = 0.0
    if S[HUNT] == 0.0:
        S[HUNT_END], S[WHOLE] = t + h, h
        share = min(CLOSE, CLOSE_ERROR * P.settings[ERROR])
        # A step to a crossing must not be shorter than any step may be.
        S[TOLERANCE] = max(share * h + TIME_ROUND_OFF * abs(t), P.settings[H_MIN])
    if margins(P, END) > 0:
        open_bracket(P, 1.0, END)


@native
def open_bracket(P: Problem, share: float, row: int) -> None:
    """A branch has changed somewhere before ``share``, where margins stand in a row."""
    S = P.search
    S[HIGH], S[FOUND], S[BUDGET] = share, share, share
    copy_margins(P, START, LOW_ROW)
    copy_margins(P, row, HIGH_ROW)
    S[SHARE] = next_share(P)


@native
def ends_beyond(P: Problem) -> bool:
    """Whether the end of the step is on other branches."""
    return P.search[HIGH] == 1.0


@native
def judge(P: Problem) -> None:
    """Look at the guards at the workspace's state, and choose another share or close the search."""
    S = P.search
    found = margins(P, INSIDE) > 0
    if S[HIGH] > 1.0:
        if found:
            open_bracket(P, S[SHARE], INSIDE)
        else:
            S[SHARE] = lowest(P) if S[SHARE] == 0.5 else NONE
            S[OPEN] = 1.0 if S[SHARE] < 1.0 else 0.0
        return
    if found:
        S[HIGH], S[FOUND] = S[SHARE], S[SHARE]
        copy_margins(P, INSIDE, HIGH_ROW)
    else:
        S[LOW] = S[SHARE]
        copy_margins(P, INSIDE, LOW_ROW)
    S[BUDGET] *= 0.5
    S[OPEN] = 1.0 if (S[HIGH] - S[LOW]) * S[SIZE] > 0.5 * S[TOLERANCE] else 0.0
    S[SHARE] = next_share(P)


@native
def next_share(P: Problem) -> float:
    """Where to look next: the earliest secant root in the bracket, kept near enough to the middle
    that bisection would not be faster (ITP).
    """
    S, count = P.search, P.sizes[WATCHED]
    low, width = S[LOW], S[HIGH] - S[LOW]
    middle, secant = low + 0.5 * width, S[HIGH]
    for k in range(count):
        after = P.margin[HIGH_ROW * count + k]
        if after < 0.0:
            before = max(0.0, P.margin[LOW_ROW * count + k])
            secant = min(secant, low + width * before / (before - after))
    towards = 1.0 if middle >= secant else -1.0
    nudge = max(0.2 * width * width, 0.1 * S[TOLERANCE] / S[SIZE])
    share = secant + towards * nudge if nudge <= abs(middle - secant) else middle
    reach = max(2.0 * S[BUDGET] - 0.5 * width, 0.0)
    return share if abs(share - middle) <= reach else middle - towards * reach


@native
def crawls(P: Problem, h: float) -> bool:
    """Whether the run has come down to tiny steps after a guard was let go for good."""
    S = P.search
    if S[FREED] > 0.0 and h < CRAWLING * P.settings[H_MAX]:
        S[CRAWL] += 1.0
    return S[CRAWL] > MOST_CRAWLED


@native
def lowest(P: Problem) -> float:
    """Where a parabola through the margins of a guard at start, middle and end dips below zero;
    ``NONE`` where all stay above.
    """
    count, share, least = P.sizes[WATCHED], NONE, 0.0
    for k in range(count):
        a, b = P.margin[START * count + k], P.margin[INSIDE * count + k]
        c = P.margin[END * count + k]
        bend = 2.0 * (a - 2.0 * b + c)
        slope = 4.0 * b - 3.0 * a - c
        if bend > 0.0 and slope < 0.0 and slope + 2.0 * bend > 0.0:
            dip = a - 0.25 * slope * slope / bend
            if dip < least:
                least, share = dip, 0.0 - 0.5 * slope / bend
    return share


@native
def ends_there(P: Problem) -> bool:
    """Whether the step can stay: no crossing, or one just before its end."""
    S = P.search
    return S[FOUND] > 1.0 or (1.0 - S[FOUND]) * S[SIZE] <= S[TOLERANCE]


@native
def starts_there(P: Problem) -> bool:
    """Whether the crossing is so near to the start of the step that branches change there."""
    least = max(P.search[TOLERANCE], NOISE / P.settings[ERROR])
    return P.search[FOUND] * P.search[SIZE] <= least


@native
def shorter(P: Problem) -> float:
    """Size of the step that ends just behind the crossing."""
    P.search[HUNT] = 1.0
    if P.search[AGAIN] != 0.0:
        let_go(P)
    return P.search[FOUND] * P.search[SIZE] + 0.5 * P.search[TOLERANCE]


@native
def happened(P: Problem, t: float) -> bool:
    """Whether the accepted step to ``t`` ends at a stop or a crossing."""
    return met(P) or is_stop(P, t)


@native
def met(P: Problem) -> bool:
    """Whether the accepted step ends at a crossing."""
    return P.search[FOUND] <= 1.0


@native
def turn_over(P: Problem, row: int, share: float) -> None:
    """Change the branch of every guard that is negative in a row of margins, the last looked at;
    with ``share`` below 1 only of those that change before it.
    """
    clocks, count = P.sizes[CLOCKS], P.sizes[WATCHED]
    first = P.sizes[NW] + clocks
    for k in range(count):
        branch = P.margin[BEFORE * count + k]
        if P.margin[row * count + k] < 0.0 and (
            share >= 1.0 or crossing_share(P, k) <= share + SAME_TIME
        ):
            if P.kind[clocks + k] == STRICT or P.kind[clocks + k] == WEAK:
                P.W[first + k] = 0.0 - branch
            else:
                P.W[first + k] = branch + (1.0 if P.guard[first + k] > branch else -1.0)


@native
def remember_branches(P: Problem) -> None:
    """Keep the branches so that they can be turned back."""
    first, count = P.sizes[NW] + P.sizes[CLOCKS], P.sizes[WATCHED]
    for k in range(count):
        P.margin[BEFORE * count + k] = P.W[first + k]


@native
def turn_back(P: Problem) -> None:
    """Branches as they were before they were turned over."""
    first, count = P.sizes[NW] + P.sizes[CLOCKS], P.sizes[WATCHED]
    for k in range(count):
        P.W[first + k] = P.margin[BEFORE * count + k]


@native
def is_harmless(P: Problem, L: Plan, phases: int, cu: float) -> bool:
    """Whether Newton's next increment on the other branches, dq with du = cu dq, would be too small
    to matter; then they are taken.  The converged end of the step stands in the workspace.

    Branches are changed one after another as they were met: two that cancel at the end (a force
    that acts only in a thin layer) need not have cancelled on the way.
    """
    share, groups, harmless = -1.0, 0, True
    remember_branches(P)
    while harmless and share < 1.0:
        groups += 1
        share = next_change(P, share) if groups < MOST_GROUPS else 1.0
        turn_back(P)
        turn_over(P, END, share)
        harmless = small_change(P, L, phases, cu)
    if harmless:
        forget(P)
    else:
        turn_back(P)
    return harmless


@native
def next_change(P: Problem, share: float) -> float:
    """Estimated share of the step of the first change after ``share``; 1 for the last one."""
    count, found, last = P.sizes[WATCHED], 1.0, 0.0
    for k in range(count):
        if P.margin[END * count + k] < 0.0:
            at = crossing_share(P, k)
            last = max(last, at)
            if at > share + SAME_TIME:
                found = min(found, at)
    return found if found < last - SAME_TIME else 1.0


@native
def crossing_share(P: Problem, k: int) -> float:
    """Where the straight line between the margins of a guard at both ends is zero."""
    count = P.sizes[WATCHED]
    before, after = max(0.0, P.margin[START * count + k]), P.margin[END * count + k]
    return before / (before - after)


@native
def small_change(P: Problem, L: Plan, phases: int, cu: float) -> bool:
    """Whether the residual of the present branches moves the converged state too little to see."""
    residual(P, phases, P.F)
    solve(L, P.LV, P.pivots, P.F, P.x, P.work)
    largest = 0.0
    for i in range(P.sizes[N]):
        size = abs(P.F[i])
        largest = max(largest, size / max(1.0, abs(P.q[i])), cu * size / max(1.0, abs(P.u[i])))
    for k in range(P.sizes[NZ]):
        if not abs(P.F[k]) < 1e300:
            return False
    return largest <= HARMLESS * P.settings[ERROR]


@native
def forget(P: Problem) -> None:
    """Close the search: the branches that were turned over are those of the end."""
    note_changes(P, P.W[0], END)
    P.search[OPEN], P.search[FOUND] = 0.0, NONE
    margins(P, END)


@native
def note_changes(P: Problem, t: float, row: int) -> None:
    """Count the changes of guards that are negative in a row; one that chatters is let go."""
    count, first = P.sizes[WATCHED], P.sizes[NW] + P.sizes[CLOCKS]
    for k in range(count):
        often, since = CHANGES * count + k, SINCE * count + k
        if P.margin[row * count + k] < 0.0 and P.margin[often] >= 0.0:
            if P.margin[often] == 0.0 or t - P.margin[since] > CHATTER_SPAN * P.settings[H_MAX]:
                P.margin[often], P.margin[since] = 0.0, t
            P.margin[often] += 1.0
            if P.margin[often] > CHATTER:
                P.margin[often], P.W[first + k] = -1.0, 0.0
                P.search[FREED] += 1.0
                P.search[CULPRIT] = float(k)


@native
def change_here(P: Problem, L: Plan, t: float) -> bool:
    """Change the branches that break at the start of the step; q, u and states are where they
    were, a and z those of the new branches.  False when the equations have no solution.
    """
    remember_branches(P)
    turn_over(P, HIGH_ROW, 1.0)
    note_changes(P, t, HIGH_ROW)
    P.count[EVENTS] += 1
    P.search[HUNT] = 0.0
    if not accelerations(P, L, t, P.q, P.u, P.a, P.z, P.rd):
        return False
    margins(P, START)
    return True


@native
def next_stop(P: Problem, t: float) -> None:
    """Branches of the clock behind the stop at ``t``."""
    P.search[STOP_AT] += 1.0
    set_clock(P, t)


@native
def pass_event(P: Problem, L: Plan, t: float) -> bool:
    """Behind a stop or a crossing at ``t``: branches and accelerations of the other side.

    The state stands in q, u, z, rd and P.a and in the workspace; ``P.search[JUMP]``: the largest
    change at a stop of an acceleration or of the rate of a state, against max(1, |u|) or
    max(1, |s|); at a crossing it is beyond all bounds.  False when the equations have no solution.
    """
    n, ns, S, old = P.sizes[N], P.sizes[NS], P.search, P.trial
    P.count[EVENTS] += 1
    S[HUNT], S[JUMP] = 0.0, 0.0
    if met(P):
        note_changes(P, t, END)
        S[JUMP] = HUGE
    elif not accelerations(P, L, t, P.q, P.u, P.a, P.z, P.rd):
        return False
    for i in range(n):
        old[i] = P.a[i]
    for k in range(ns):
        old[n + k] = P.rd[k]
    if is_stop(P, t):
        next_stop(P, t)
    release_watch(P)
    if not accelerations(P, L, t, P.q, P.u, P.a, P.z, P.rd):
        return False
    hold_watch(P)
    for i in range(n):
        S[JUMP] = max(S[JUMP], abs(P.a[i] - old[i]) / max(1.0, abs(P.u[i])))
    for k in range(ns):
        size = max(1.0, abs(P.z[P.z.size - 1 - ns + k]))
        S[JUMP] = max(S[JUMP], abs(P.rd[k] - old[n + k]) / size)
    return True


@native
def sample_clock(P: Problem) -> int:
    """Values of the guards of the clock at every asked time into the record; how many there are."""
    first, count = P.sizes[NW], P.sizes[CLOCKS]
    for k in range(count):
        P.W[first + k] = 0.0
    for row in range(P.times.size):
        put_time(P, P.times[row])
        guard_values(P, CLOCK)
        for k in range(count):
            P.record[row * count + k] = P.guard[first + k]
    return count
