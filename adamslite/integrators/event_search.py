"""The first crossing within a tried step: found at its ends and middle, bracketed and located.

Reference: Oliveira, Takahashi, ACM Trans. Math. Softw. 47 (2021) 5 (ITP, the bracketing).
"""

from __future__ import annotations

from adamslite.integrators.base import ERROR, WATCHED, Problem
from adamslite.integrators.event_guards import copy_margins, let_go, margins, take_up
from adamslite.integrators.event_places import (
    AGAIN,
    BUDGET,
    END,
    FOUND,
    HIGH,
    HIGH_ROW,
    HUNT,
    HUNT_END,
    INSIDE,
    LET_GO,
    LOW,
    LOW_ROW,
    NONE,
    OPEN,
    SHARE,
    SIZE,
    START,
    TOLERANCE,
    WHOLE,
)
from adamslite.integrators.event_stops import least_step
from adamslite.translate import native

# An event is met when the step ends behind it by less than this share of the step in which it was
# seen, or this multiple of ERROR.
CLOSE, CLOSE_ERROR = 1e-6, 0.01
TIME_ROUND_OFF = 4e-15
# Steps below this over ERROR give velocities that are round-off of positions.
NOISE = 1e-15


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
        S[TOLERANCE] = max(share * h + TIME_ROUND_OFF * abs(t), least_step(P))
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
