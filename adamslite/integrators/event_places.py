"""Where events keep their numbers: rows of ``P.margin`` and places in ``P.search``."""

from __future__ import annotations

# Columns of P.group.
CLOCK, WATCH = 7, 8
STRICT, WEAK = 0, 1
# What a branch adds to the gap of its relation.
HUGE = 1e200
# Rows of P.margin: at the start, at the end and inside of the step; the bracket; how often a guard
# has changed lately, and since when; branches before they were turned over, and before they were
# let go for a try.
START, END, INSIDE, LOW_ROW, HIGH_ROW, CHANGES, SINCE, BEFORE, HELD = range(9)
# A share of the step that says that there is none.
NONE = 2.0
# Places in P.search.
(
    STOP_AT, OPEN, LOW, HIGH, SHARE, FOUND, SIZE, TOLERANCE, BUDGET, JUMP, FREED, CULPRIT, HUNT,
    LOOSE, LET_GO, AGAIN, CRAWL, HUNT_END, WHOLE,
) = range(19)  # fmt: skip
