"""The part of a step in which the cubic through values and rates of guards is trusted.

The first window is the whole step.  Where a guard that may dip below zero is in the middle of the
window, or at the dip, elsewhere than its cubic says, the window ends there instead, with the rate
that the dense output has there; behind a window that can be trusted the next one reaches to the end
of the step again.  Where the cubics of the step before foretell this one, nothing but dips is
looked at.

For a function of order 4 the cubic errs by f''''/24 x^2 (1 - x)^2 h^4, nowhere by more than in the
middle; others may err by a multiple of that.
"""

from __future__ import annotations

from adamslite.integrators.contract import Problem
from adamslite.integrators.event_rows import (
    EARLY,
    END,
    INSIDE,
    LATE,
    LEFT,
    LEFT_RATE,
    MIDDLE,
    NONE,
    PAST,
    PAST_RATE,
    RATE_RIGHT,
    RIGHT,
    RIGHT_RATE,
    START,
)
from adamslite.integrators.events.dips import DEEPEST, LITTLE, NEAR, cubic, dip, tangent
from adamslite.integrators.events.guards import copy_margins, is_taken
from adamslite.native.translate import native

# Looks at middles, rates and dips in one step.
MOST_LOOKS = 40.0
# A cubic that is off by this share of the range of a guard, or that is closer to zero than this
# multiple of what it is off, is not trusted.
TRUSTED, ELSEWHERE = 0.01, 16.0
# Nor is one that the step before missed by this share of the range of the guard; guards that are
# further from zero than this multiple of their swing need no trust.
UNEXPECTED, FLAT = 0.3, 16.0
# No more is a dip that is not below zero, when it is off by this share of its height.
SHALLOW = 0.1


@native
def open_window(P: Problem) -> None:
    """The window is the whole step."""
    P.search.window_low = 0.0
    extend_window(P)


@native
def extend_window(P: Problem) -> None:
    """The window reaches to the end of the step."""
    P.search.window_high = 1.0
    look_at_middle(P)


@native
def look_at_middle(P: Problem) -> None:
    S = P.search
    S.looked, S.stage = S.window_low, MIDDLE
    S.share = 0.5 * (S.window_low + S.window_high)


@native
def next_window(P: Problem) -> None:
    """The present window is done with: the next one begins at its right side."""
    copy_margins(P, RIGHT, LEFT)
    copy_margins(P, RIGHT_RATE, LEFT_RATE)
    P.search.window_low = P.search.window_high
    extend_window(P)


@native
def left_row(P: Problem) -> int:
    """Row of the margins at the left side of the window."""
    return LEFT if P.search.window_low > 0.0 else START


@native
def is_expected(P: Problem) -> bool:
    """Whether the cubics of the step before go on as far as the end of this one, or miss it by so
    little that no guard can have come to zero.

    Beyond the step before a function of order 4 is off by f''''/24 x^2 (x - 1)^2 h^4, for equal
    steps by 64 times what the cubic of the present step is off in its middle.
    """
    count, h, past = P.sizes.watched, P.search.size, P.search.past_size
    if past == 0.0:
        return False
    x = 1.0 + h / past
    for k in range(count):
        a, b = P.margin[START * count + k], P.margin[END * count + k]
        r, s = P.margin[EARLY * count + k], P.margin[LATE * count + k]
        swing = h * (abs(r) + abs(s))
        low = min(a, b)
        if low < FLAT * swing and not is_taken(P, k):
            before, rate = P.margin[PAST * count + k], P.margin[PAST_RATE * count + k]
            off = abs(b - cubic(before, a, past * rate, past * r, x))
            if low - DEEPEST * swing < off and off > UNEXPECTED * (swing + abs(b - a)):
                return False
    return True


@native
def end_window_here(P: Problem) -> None:
    """The window ends where was looked last; look for the rates there."""
    S = P.search
    copy_margins(P, INSIDE, RIGHT)
    S.window_high, S.stage = S.share, RATE_RIGHT
    S.share -= LITTLE * (S.share - S.window_low)


@native
def rates_at_right(P: Problem) -> None:
    """Rates between the right side of the window and the last place examined inside, per time."""
    count, S = P.sizes.watched, P.search
    w = 1.0 / ((S.window_high - S.share) * S.size)
    for k in range(count):
        P.margin[RIGHT_RATE * count + k] = w * (
            P.margin[RIGHT * count + k] - P.margin[INSIDE * count + k]
        )
    look_at_middle(P)


@native
def is_trusted(P: Problem) -> bool:
    """Whether the cubics through both sides of the window say what was found inside of it."""
    S, count = P.search, P.sizes.watched
    if S.looks >= MOST_LOOKS:
        return True
    left, early = left_row(P), LEFT_RATE if S.window_low > 0.0 else EARLY
    right, late = END, LATE
    if S.window_high < 1.0:
        right, late = RIGHT, RIGHT_RATE
    width = S.window_high - S.window_low
    x, h, at_dip = (S.share - S.window_low) / width, width * S.size, S.stage != MIDDLE
    for k in range(count):
        a, b = P.margin[left * count + k], P.margin[right * count + k]
        r, s = h * P.margin[early * count + k], h * P.margin[late * count + k]
        if width == 1.0:
            ahead = S.ahead / S.size
            slope = tangent(r, s, b - a, ahead, LITTLE)
            r, s = slope, tangent(s, r, b - a, LITTLE, ahead)
        m, swing = P.margin[INSIDE * count + k], abs(r) + abs(s)
        off = abs(m - cubic(a, b, r, s, x))
        low = min(a, b, m) - DEEPEST * swing
        if low < ELSEWHERE * off and not is_taken(P, k):
            if off > TRUSTED * (swing + abs(b - a)):
                return False
            if at_dip and m < NEAR * swing and off > SHALLOW * m:
                return False
    return True


@native
def next_dip(P: Problem) -> float:
    """Share of the step of the first dip behind those looked at in the window; ``NONE`` where there
    is none.
    """
    S, count, first = P.search, P.sizes.watched, NONE
    if S.looks >= MOST_LOOKS:
        return NONE
    left, early = left_row(P), LEFT_RATE if S.window_low > 0.0 else EARLY
    right, late = END, LATE
    if S.window_high < 1.0:
        right, late = RIGHT, RIGHT_RATE
    width = S.window_high - S.window_low
    h, behind = width * S.size, (S.looked - S.window_low) / width
    for k in range(count):
        a, b = P.margin[left * count + k], P.margin[right * count + k]
        r, s = h * P.margin[early * count + k], h * P.margin[late * count + k]
        swing = abs(r) + abs(s)
        if min(a, b) < DEEPEST * swing and (b >= 0.0 or s < 0.0) and not is_taken(P, k):
            if width == 1.0:
                ahead = S.ahead / S.size
                slope = tangent(r, s, b - a, ahead, LITTLE)
                r, s = slope, tangent(s, r, b - a, LITTLE, ahead)
            first = min(first, dip(a, b, r, s, behind))
    return S.window_low + width * first if first < 1.0 else NONE
