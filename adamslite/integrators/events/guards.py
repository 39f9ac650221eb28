"""Guards: the current branch of each, and its margin to the next.

A branch is stored as a number: +-HUGE for the two sides of a relation, n + 1/2 between two steps of
a whole number, 0 for a guard that is evaluated as it is.  The margin is negative where the guard
has left its branch.
"""

from __future__ import annotations

from math import floor

from adamslite.integrators.contract import Problem
from adamslite.integrators.event_rows import (
    BEFORE,
    CHANGES,
    CLOSEST,
    EARLY,
    END,
    HELD,
    HUGE,
    JUMPS,
    LATE,
    PAST,
    PAST_RATE,
    SINCE,
    START,
    STRICT,
    WEAK,
    ZONE_EARLY,
    ZONE_LATE,
)
from adamslite.integrators.events.dips import LITTLE, cubic, lowest, quiet_time
from adamslite.integrators.events.sensors import sense
from adamslite.integrators.motion_equations import WATCH, guard_values
from adamslite.native.translate import native

# A guard that changes this often within this share of HMAX is chattering: it is no longer held.
CHATTER, CHATTER_SPAN = 10.0, 1e-3
# Where a value jumps and the changes come this close, both sides lead back to the jump: the motion
# slides along it, and the equations as they are do not say how.
SLIDING_SPAN = 1e-4
# After that, this many steps below this share of HMAX show that nothing else helps.
CRAWLING, MOST_CRAWLED = 1e-4, 500
# Branches that change the end of a step by less than this share of ERROR need no event.
HARMLESS = 0.02
# A distance that is none, and is not taken for that of no step.
SMALLEST = 1e-300
# Changes nearer than this share of a step are one.
SAME_TIME = 1e-6


@native
def branch_of(kind: int, value: float) -> float:
    """What stands for the branch of a guard with this value."""
    if kind == STRICT or kind == STRICT + JUMPS:
        return HUGE if value > 0.0 else -HUGE
    if kind == WEAK or kind == WEAK + JUMPS:
        return HUGE if value >= 0.0 else -HUGE
    return floor(value) + 0.5


@native
def is_relation(kind: int) -> bool:
    """Whether a guard is a relation, and no floor."""
    return kind == STRICT or kind == WEAK or kind >= JUMPS


@native
def margin_of(kind: int, branch: float, value: float) -> float:
    """Negative when a guard has left its branch, else how far it is from that."""
    if branch == 0.0:
        return 1.0
    if is_relation(kind):
        return value if branch > 0.0 else 0.0 - value
    return 0.5 - abs(value - branch)


@native
def release_watch(P: Problem) -> None:
    """Evaluate watched guards as they are."""
    first = P.sizes.nw + P.sizes.clocks
    for k in range(P.sizes.watched):
        P.W[first + k] = 0.0


@native
def hold_watch(P: Problem) -> None:
    """Hold the branches of the workspace's state from now on; sensors that trigger end the run."""
    if P.search.loose:
        return
    if P.sizes.watched + P.sizes.zones > 0:
        hold_branches(P)
    sense(P)


@native
def hold_branches(P: Problem) -> None:
    """Hold the branches of the workspace's state from now on."""
    clocks, count = P.sizes.clocks, P.sizes.watched
    first = P.sizes.nw + clocks
    release_watch(P)
    guard_values(P, WATCH)
    for k in range(count):
        if P.margin[CHANGES * count + k] >= 0.0:
            P.W[first + k] = branch_of(P.kind[clocks + k], P.guard[first + k])
    look_at_start(P)


@native
def let_go(P: Problem) -> bool:
    """Evaluate guards as they are for the next try, because held ones led out of where an
    expression is defined (the root of a length that IF keeps positive); False when they are not
    held.
    """
    S, first, count = P.search, P.sizes.nw + P.sizes.clocks, P.sizes.watched
    if count == 0 or S.loose or S.let_go:
        return False
    S.let_go = True
    for k in range(count):
        P.margin[HELD * count + k] = P.W[first + k]
        P.W[first + k] = 0.0
    return True


@native
def take_up(P: Problem) -> None:
    """Hold the guards again that were let go for a try."""
    first, count = P.sizes.nw + P.sizes.clocks, P.sizes.watched
    if P.search.let_go:
        P.search.let_go = False
        for k in range(count):
            P.W[first + k] = P.margin[HELD * count + k]


@native
def margins(P: Problem, row: int) -> int:
    """Margins at the workspace's state into a row of ``P.margin``; how many are negative."""
    clocks, count, found = P.sizes.clocks, P.sizes.watched, 0
    first = P.sizes.nw + clocks
    guard_values(P, WATCH)
    for k in range(count):
        margin = margin_of(P.kind[clocks + k], P.W[first + k], P.guard[first + k])
        P.margin[row * count + k] = margin
        if margin < 0.0 and not is_taken(P, k):
            found += 1
    return found


@native
def is_taken(P: Problem, k: int) -> bool:
    """Whether a guard was turned over in this step because that makes no difference."""
    branch = P.W[P.sizes.nw + P.sizes.clocks + k]
    return P.search.taken and branch != P.margin[BEFORE * P.sizes.watched + k]


@native
def look(P: Problem, row: int) -> int:
    """Margins and places within zones at the workspace's state into a row; how many are
    negative.
    """
    count = P.sizes.zones
    if P.sizes.watched + count == 0:
        return 0
    first = P.sizes.nw + P.sizes.clocks + P.sizes.watched
    found = margins(P, row)
    for k in range(count):
        P.zone[row * count + k] = P.guard[first + k]
    return found


@native
def look_at_start(P: Problem) -> None:
    """The workspace's state is the start of the next step, with rates that are not known."""
    P.search.taken, P.search.known, P.search.past_size = False, False, 0.0
    P.search.quiet, P.search.stale = 0.0 - HUGE, False
    look(P, START)


@native
def copy_margins(P: Problem, source: int, target: int) -> None:
    for k in range(P.sizes.watched):
        P.margin[target * P.sizes.watched + k] = P.margin[source * P.sizes.watched + k]


@native
def keep_margins(P: Problem) -> None:
    """The step is accepted: its end is the next start."""
    S, zones = P.search, P.sizes.zones
    if P.sizes.watched + zones == 0 or S.stale:
        return
    if P.sizes.watched == 0:
        S.quiet = S.since + S.size + quiet_time(P)
    S.turned = 0
    keep_closest(P)
    copy_margins(P, START, PAST)
    copy_margins(P, EARLY, PAST_RATE)
    S.past_size = S.size if S.known else 0.0
    copy_margins(P, END, START)
    copy_margins(P, LATE, EARLY)
    for k in range(zones):
        P.zone[START * zones + k] = P.zone[END * zones + k]
        P.zone[ZONE_EARLY * zones + k] = P.zone[ZONE_LATE * zones + k]
    S.known, S.rated, S.ahead = S.rated, False, 0.0 - LITTLE * S.size


@native
def keep_closest(P: Problem) -> None:
    """How near relations have come that have never held: at the ends of the step, and inside of it
    by the cubic through values and rates, where these are known.
    """
    first, count, S = P.sizes.nw + P.sizes.clocks, P.sizes.watched, P.search
    for k in range(count):
        at, a, b = CLOSEST * count + k, P.margin[START * count + k], P.margin[END * count + k]
        if P.W[first + k] >= 0.0 or a < 0.0 or b < 0.0:
            P.margin[at] = -1.0
        elif P.margin[at] >= 0.0:
            margin = min(a, b)
            if S.known and S.rated:
                r = S.size * P.margin[EARLY * count + k]
                s = S.size * P.margin[LATE * count + k]
                share = lowest(a, b, r, s)
                if share < 1.0:
                    margin = min(margin, cubic(a, b, r, s, share))
            if P.margin[at] == 0.0 or margin < P.margin[at]:
                P.margin[at] = max(margin, SMALLEST)


@native
def crawls(P: Problem, h: float) -> bool:
    """Whether the run has come down to tiny steps after a guard was let go for good."""
    S = P.search
    if S.freed > 0 and h < CRAWLING * P.settings.h_max:
        S.crawl += 1
    return S.crawl > MOST_CRAWLED


@native
def turn_over(P: Problem, row: int, share: float) -> None:
    """Change the branch of every guard that is negative in a row of margins, the last looked at;
    with ``share`` below 1 only of those that change before it.
    """
    clocks, count = P.sizes.clocks, P.sizes.watched
    first = P.sizes.nw + clocks
    for k in range(count):
        branch = P.margin[BEFORE * count + k]
        if P.margin[row * count + k] < 0.0 and (
            share >= 1.0 or crossing_share(P, k) <= share + SAME_TIME
        ):
            P.margin[CLOSEST * count + k] = -1.0
            if is_relation(P.kind[clocks + k]):
                P.W[first + k] = 0.0 - branch
            else:
                P.W[first + k] = branch + (1.0 if P.guard[first + k] > branch else -1.0)


@native
def remember_branches(P: Problem) -> None:
    """Keep the branches so that they can be turned back."""
    first, count = P.sizes.nw + P.sizes.clocks, P.sizes.watched
    for k in range(count):
        P.margin[BEFORE * count + k] = P.W[first + k]


@native
def turn_back(P: Problem) -> None:
    """Branches as they were before they were turned over."""
    first, count = P.sizes.nw + P.sizes.clocks, P.sizes.watched
    for k in range(count):
        P.W[first + k] = P.margin[BEFORE * count + k]


@native
def crossing_share(P: Problem, k: int) -> float:
    """Where the straight line between the margins of a guard at both ends is zero."""
    count = P.sizes.watched
    before, after = max(0.0, P.margin[START * count + k]), P.margin[END * count + k]
    return before / (before - after)


@native
def note_changes(P: Problem, t: float, row: int) -> None:
    """Count the changes of guards that are negative in a row; one that chatters is let go."""
    count, first = P.sizes.watched, P.sizes.nw + P.sizes.clocks
    for k in range(count):
        often, since = CHANGES * count + k, SINCE * count + k
        if P.margin[row * count + k] < 0.0 and P.margin[often] >= 0.0:
            if P.margin[often] == 0.0 or t - P.margin[since] > CHATTER_SPAN * P.settings.h_max:
                P.margin[often], P.margin[since] = 0.0, t
            P.margin[often] += 1.0
            if P.margin[often] > CHATTER:
                jumps = P.kind[P.sizes.clocks + k] >= JUMPS
                if jumps and keeps_returning(P, k, t, CHATTER + 1.0):
                    P.search.crawl = MOST_CRAWLED + 1
                P.margin[often], P.W[first + k] = -1.0, 0.0
                P.search.freed += 1
                P.search.culprit = k


@native
def keeps_returning(P: Problem, k: int, t: float, changes: float) -> bool:
    """Whether a guard has changed that often within a short time: both sides lead back."""
    often, since = CHANGES * P.sizes.watched + k, SINCE * P.sizes.watched + k
    soon = t - P.margin[since] <= SLIDING_SPAN * P.settings.h_max
    return soon and P.margin[often] >= changes
