"""The first crossing within a tried step: detected from its ends, bracketed and located.

Guards and their rates are taken at both ends; where the cubic through them
(:mod:`adamslite.integrators.events.dips`) comes near zero in between, the dense output is looked
at.

Reference: Oliveira, Takahashi, ACM Trans. Math. Softw. 47 (2021) 5 (ITP, the bracketing).
"""

from __future__ import annotations

from adamslite.integrators.contract import Problem
from adamslite.integrators.event_rows import (
    AT_START,
    BRACKET,
    DIP,
    EARLY,
    END,
    HIGH_ROW,
    INSIDE,
    LATE,
    LOW_ROW,
    NONE,
    RATE_BEFORE,
    RATE_BEHIND,
    RATE_RIGHT,
    START,
    ZONE_EARLY,
    ZONE_LATE,
)
from adamslite.integrators.events.dips import LITTLE, rates, share_into_zones
from adamslite.integrators.events.guards import copy_margins, let_go, look, take_up, turn_back
from adamslite.integrators.events.stops import least_step
from adamslite.integrators.events.windows import (
    MOST_LOOKS,
    end_window_here,
    is_expected,
    is_trusted,
    left_row,
    next_dip,
    next_window,
    open_window,
    rates_at_right,
)
from adamslite.native.translate import native, seldom

# An event is met when the step ends behind it by less than this share of the step in which it was
# seen, or this multiple of ERROR.
CLOSE, CLOSE_ERROR = 1e-6, 0.01
TIME_ROUND_OFF = 4e-15
# From so many tries of a step on, each is at most half as long as the one before: where motion is
# no better than noise, what is found moves along with the end of the step.
MANY_TRIES, HALF = 32, 0.5
# The secant root is moved towards the middle by this times the square of the width (k1 of ITP), or
# this share of the tolerance.
NUDGE, LEAST_NUDGE = 0.2, 0.1


@native
def is_quiet(P: Problem, t: float, h: float) -> bool:
    """Whether nothing has to be looked at in the step from ``t``: nothing is watched, or poles and
    zones of narrow functions that are far away.
    """
    S = P.search
    if P.sizes.watched + P.sizes.zones == 0:
        return True
    if P.sizes.watched > 0 or t + h > S.quiet:
        return False
    S.found, S.cut, S.known, S.stale = NONE, NONE, False, True
    return True


@native
@seldom
def open_search(P: Problem, t: float, h: float) -> None:
    """Look at the end of the step from ``t``, which stands in the workspace."""
    S = P.search
    S.open, S.share, S.stage, S.taken = True, 1.0 - LITTLE, RATE_BEHIND, False
    S.found, S.cut, S.size, S.low, S.high = NONE, NONE, h, 0.0, NONE
    S.looks, S.window_low = 0, 0.0
    S.again = S.let_go
    S.tries = S.tries + 1 if S.since == t else 1
    S.since = t
    take_up(P)
    if S.hunt and t >= S.hunt_end:
        S.hunt = False
    if not S.hunt:
        S.hunt_end, S.whole = t + h, h
        share = min(CLOSE, CLOSE_ERROR * P.settings.error)
        S.tolerance = max(share * h + TIME_ROUND_OFF * abs(t), least_step(P))
    if look(P, END) > 0:
        S.high = 1.0
    if S.stale:
        S.stage, S.share = AT_START, 0.0


@native
def open_bracket(P: Problem, share: float, row: int) -> None:
    """A branch has changed somewhere before ``share``, where margins stand in a row."""
    S = P.search
    S.high, S.found, S.budget, S.stage = share, share, share - S.window_low, BRACKET
    S.low = S.window_low
    copy_margins(P, left_row(P), LOW_ROW)
    copy_margins(P, row, HIGH_ROW)
    S.share = next_share(P)


@native
def ends_beyond(P: Problem) -> bool:
    """Whether the end of the step is on other branches."""
    return P.search.high == 1.0


@native
@seldom
def judge(P: Problem) -> None:
    """Look at the guards at the workspace's state, and choose another share or close the search."""
    S = P.search
    found = look(P, INSIDE) > 0
    if S.stage == AT_START:
        for k in range(P.sizes.zones):
            P.zone[START * P.sizes.zones + k] = P.zone[INSIDE * P.sizes.zones + k]
        S.stale, S.stage, S.share = False, RATE_BEHIND, 1.0 - LITTLE
    elif S.stage == RATE_BEHIND:
        rates(P, END, LATE, ZONE_LATE)
        S.rated, S.stage, S.share = True, RATE_BEFORE, LITTLE
        if S.known:
            choose(P)
    elif S.stage == RATE_BEFORE:
        rates(P, START, EARLY, ZONE_EARLY)
        S.known, S.ahead = True, LITTLE * S.size
        choose(P)
    elif S.stage == BRACKET:
        narrow(P, found)
    else:
        S.looks += 1
        if found:
            open_bracket(P, S.share, INSIDE)
        else:
            look_further(P)
    if not S.open and S.taken and min(S.found, S.cut) <= 1.0:
        turn_back(P)


@native
def choose(P: Problem) -> None:
    """Rates are known: a shorter step where a zone requires it, else a look at the guards."""
    P.search.cut = share_into_zones(P)
    if P.search.cut > 1.0 and P.sizes.watched > 0:
        open_window(P)
        if is_expected(P):
            pass_window(P)
    else:
        P.search.open = False


@native
def look_further(P: Problem) -> None:
    """Nothing is below zero at the present share: where to look next, or the end of the search."""
    S = P.search
    if S.stage == RATE_RIGHT:
        rates_at_right(P)
    elif not is_trusted(P):
        end_window_here(P)
    else:
        if S.stage == DIP:
            S.looked = S.share
        pass_window(P)


@native
def pass_window(P: Problem) -> None:
    """The next dip in the window, the next window, the bracket of what has changed at the end of
    the step, or the end of the search.
    """
    S, share = P.search, next_dip(P)
    if share < 1.0:
        S.share, S.stage = share, DIP
    elif S.window_high < 1.0 and S.looks < MOST_LOOKS:
        next_window(P)
    elif S.high == 1.0:
        open_bracket(P, 1.0, END)
    else:
        S.open = False


@native
def narrow(P: Problem, found: bool) -> None:
    """Move one end of the bracket to the present share."""
    S = P.search
    if found:
        S.high, S.found = S.share, S.share
        copy_margins(P, INSIDE, HIGH_ROW)
    else:
        S.low = S.share
        copy_margins(P, INSIDE, LOW_ROW)
    S.budget *= 0.5
    S.open = (S.high - S.low) * S.size > 0.5 * S.tolerance
    S.share = next_share(P)


@native
def next_share(P: Problem) -> float:
    """Where to look next: the earliest secant root in the bracket, kept near enough to the middle
    that bisection would not be faster (ITP).
    """
    S, count = P.search, P.sizes.watched
    low, width = S.low, S.high - S.low
    middle, secant = low + 0.5 * width, S.high
    for k in range(count):
        after = P.margin[HIGH_ROW * count + k]
        if after < 0.0:
            before = max(0.0, P.margin[LOW_ROW * count + k])
            secant = min(secant, low + width * before / (before - after))
    towards = 1.0 if middle >= secant else -1.0
    nudge = max(NUDGE * width * width, LEAST_NUDGE * S.tolerance / S.size)
    share = secant + towards * nudge if nudge <= abs(middle - secant) else middle
    reach = max(2.0 * S.budget - 0.5 * width, 0.0)
    return share if abs(share - middle) <= reach else middle - towards * reach


@native
def ends_there(P: Problem) -> bool:
    """Whether the step can stay: no crossing, or one just before its end."""
    S = P.search
    if S.cut < 1.0:
        return False
    return S.found > 1.0 or (1.0 - S.found) * S.size <= S.tolerance


@native
def starts_there(P: Problem) -> bool:
    """Whether the crossing is so near to the start of the step that branches change there."""
    S = P.search
    return S.cut > 1.0 and S.found * S.size <= S.tolerance


@native
def shorter(P: Problem) -> float:
    """Size of the step that ends just behind the crossing, or before more of a zone is crossed than
    a share of it; half of the size at most after many tries.
    """
    S = P.search
    most = HALF * S.size if S.tries >= MANY_TRIES else S.size
    if S.again:
        let_go(P)
    if S.cut < 1.0:
        return min(S.cut * S.size, most)
    S.hunt = True
    return min(S.found * S.size + 0.5 * S.tolerance, most)
