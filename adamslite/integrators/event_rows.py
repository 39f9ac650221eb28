"""Where events keep their numbers: rows of ``P.margin`` and places in ``P.search``."""

from __future__ import annotations

# Columns of P.group.
CLOCK, WATCH = 7, 8
# How guards are read, and the bit of those at which a value jumps.
STRICT, WEAK, JUMPS = 0, 1, 4
# What a branch adds to the gap of its relation.
HUGE = 1e200
# Rows of P.margin: at the start, at the end and inside of the step; the bracket; how often a guard
# has changed lately, and since when; branches before they were turned over, and before they were
# let go for a try; rates at the start and the end; values and rates at both sides of the
# window within the step that is looked at; at the start of the step before.
START, END, INSIDE, LOW_ROW, HIGH_ROW, CHANGES, SINCE, BEFORE, HELD, EARLY, LATE = range(11)
LEFT, RIGHT, LEFT_RATE, RIGHT_RATE, PAST, PAST_RATE, MARGIN_ROWS = range(11, 18)
# Rows of P.zone: the first three as above, and rates at the start and the end.
ZONE_EARLY, ZONE_LATE = 3, 4
# A share of the step that says that there is none.
NONE = 2.0
# Places in P.search.
(
    STOP_AT, OPEN, LOW, HIGH, SHARE, FOUND, SIZE, TOLERANCE, BUDGET, JUMP, FREED, CULPRIT, HUNT,
    LOOSE, LET_GO, AGAIN, CRAWL, HUNT_END, WHOLE, LOOKS, LOOKED, KNOWN, RATED, CUT, TAKEN, STAGE,
    SPAN, PACE_AT, WINDOW_LOW, WINDOW_HIGH, PAST_SIZE,
) = range(31)  # fmt: skip
PLACES = 31
# What the look at the present share is for, in S[STAGE]: the rates at the end and the start, the
# middle of the window, the rate at its right side, a dip in it, the bracket of a crossing.
RATE_BEHIND, RATE_BEFORE, MIDDLE, RATE_RIGHT, DIP, BRACKET = range(6)
