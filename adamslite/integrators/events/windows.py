"""The windows of a step in which the cubic through values and rates of guards can be trusted.

The first window is the whole step.  Where a guard that may dip below zero is in the middle of the
window, or at the dip, elsewhere than its cubic says, the window ends there instead, with the rate
that the dense output has there; behind a window that can be trusted the next one reaches to the end
of the step again.  Where the cubics of the step before foretell this one, nothing but dips is
looked at.

For a function of order 4 the cubic errs by f''''/24 x^2 (1 - x)^2 h^4, nowhere by more than in the
middle; others may err by a multiple of that.
"""

from __future__ import annotations

from adamslite.integrators.contract import WATCHED, Problem
from adamslite.integrators.event_rows import (
    EARLY,
    END,
    INSIDE,
    LATE,
    LEFT,
    LEFT_RATE,
    LOOKED,
    LOOKS,
    MIDDLE,
    NONE,
    PAST,
    PAST_RATE,
    PAST_SIZE,
    RATE_RIGHT,
    RIGHT,
    RIGHT_RATE,
    SHARE,
    SIZE,
    STAGE,
    START,
    WINDOW_HIGH,
    WINDOW_LOW,
)
from adamslite.integrators.events.dips import DEEPEST, LITTLE, NEAR, cubic, dip
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
    P.search[WINDOW_LOW] = 0.0
    extend_window(P)


@native
def extend_window(P: Problem) -> None:
    """The window reaches to the end of the step."""
    P.search[WINDOW_HIGH] = 1.0
    look_at_middle(P)


@native
def look_at_middle(P: Problem) -> None:
    S = P.search
    S[LOOKED], S[STAGE] = S[WINDOW_LOW], MIDDLE
    S[SHARE] = 0.5 * (S[WINDOW_LOW] + S[WINDOW_HIGH])


@native
def next_window(P: Problem) -> None:
    """The present window is done with: the next one begins at its right side."""
    copy_margins(P, RIGHT, LEFT)
    copy_margins(P, RIGHT_RATE, LEFT_RATE)
    P.search[WINDOW_LOW] = P.search[WINDOW_HIGH]
    extend_window(P)


@native
def left_row(P: Problem) -> int:
    """Row of the margins at the left side of the window."""
    return LEFT if P.search[WINDOW_LOW] > 0.0 else START


@native
def is_expected(P: Problem) -> bool:
    """Whether the cubics of the step before go on as far as the end of this one, or miss it by so
    little that no guard can have come to zero.

    Beyond the step before a function of order 4 is off by f''''/24 x^2 (x - 1)^2 h^4, for equal
    steps by 64 times what the cubic of the present step is off in its middle.
    """
    count, h, past = P.sizes[WATCHED], P.search[SIZE], P.search[PAST_SIZE]
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
    S[WINDOW_HIGH], S[STAGE] = S[SHARE], RATE_RIGHT
    S[SHARE] -= LITTLE * (S[SHARE] - S[WINDOW_LOW])


@native
def rates_at_right(P: Problem) -> None:
    """Rates between the right side of the window and what was looked at inside, per time."""
    count, S = P.sizes[WATCHED], P.search
    w = 1.0 / ((S[WINDOW_HIGH] - S[SHARE]) * S[SIZE])
    for k in range(count):
        P.margin[RIGHT_RATE * count + k] = w * (
            P.margin[RIGHT * count + k] - P.margin[INSIDE * count + k]
        )
    look_at_middle(P)


@native
def is_trusted(P: Problem) -> bool:
    """Whether the cubics through both sides of the window say what was found inside of it."""
    S, count = P.search, P.sizes[WATCHED]
    if S[LOOKS] >= MOST_LOOKS:
        return True
    left, early = left_row(P), LEFT_RATE if S[WINDOW_LOW] > 0.0 else EARLY
    right, late = END, LATE
    if S[WINDOW_HIGH] < 1.0:
        right, late = RIGHT, RIGHT_RATE
    width = S[WINDOW_HIGH] - S[WINDOW_LOW]
    x, h, at_dip = (S[SHARE] - S[WINDOW_LOW]) / width, width * S[SIZE], S[STAGE] != MIDDLE
    for k in range(count):
        a, b = P.margin[left * count + k], P.margin[right * count + k]
        r, s = h * P.margin[early * count + k], h * P.margin[late * count + k]
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
    S, count, first = P.search, P.sizes[WATCHED], NONE
    if S[LOOKS] >= MOST_LOOKS:
        return NONE
    left, early = left_row(P), LEFT_RATE if S[WINDOW_LOW] > 0.0 else EARLY
    right, late = END, LATE
    if S[WINDOW_HIGH] < 1.0:
        right, late = RIGHT, RIGHT_RATE
    width = S[WINDOW_HIGH] - S[WINDOW_LOW]
    h, behind = width * S[SIZE], (S[LOOKED] - S[WINDOW_LOW]) / width
    for k in range(count):
        a, b = P.margin[left * count + k], P.margin[right * count + k]
        r, s = h * P.margin[early * count + k], h * P.margin[late * count + k]
        swing = abs(r) + abs(s)
        if min(a, b) < DEEPEST * swing and (b >= 0.0 or s < 0.0) and not is_taken(P, k):
            first = min(first, dip(a, b, r, s, behind))
    return S[WINDOW_LOW] + width * first if first < 1.0 else NONE
