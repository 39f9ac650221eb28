"""The rows of ``P.margin``, the slots of ``P.search`` and the rows of sensors that events use."""

from __future__ import annotations

from adamslite.native.translate import Record

# How guards are read, and the bit of those at which a value jumps; how zones are read.
STRICT, WEAK, JUMPS = 0, 1, 4
ZONE, POLE, ROOT, NARROW = 3, 5, 6, 7
# What a branch adds to the gap of its relation.
HUGE = 1e200
# Rows of P.margin: at the start, at the end and inside of the step; the bracket; how often a guard
# has changed lately, and since when; branches before they were turned over, and before they were
# let go for a try; rates at the start and the end; values and rates at both sides of the
# window within the step that is examined; at the start of the step before; the least distance of
# relations that do not hold at the end of a step so far, 0 without a step, -1 once one has held.
START, END, INSIDE, LOW_ROW, HIGH_ROW, CHANGES, SINCE, BEFORE, HELD, EARLY, LATE = range(11)
LEFT, RIGHT, LEFT_RATE, RIGHT_RATE, PAST, PAST_RATE, CLOSEST, MARGIN_ROWS = range(11, 19)
# Rows of P.zone: the first three as above, and rates at the start and the end.
ZONE_EARLY, ZONE_LATE = 3, 4
# A share of the step that says that there is none.
NONE = 2.0
# What the look at the present share is for: the rates at the end and the start, the middle of the
# window, the rate at its right side, a dip in it, the bracket of a crossing, the start itself.
RATE_BEHIND, RATE_BEFORE, MIDDLE, RATE_RIGHT, DIP, BRACKET, AT_START = range(7)


class Search(Record):
    """The location of events in one step; shares are of that step.

    stop_at, pace_at     the present stop and pace
    open                 whether the search continues, with a look at ``share``; ``stage``: what for
    low, high, budget    the bracket of a crossing, and how far ITP may leave its middle
    found, cut           the share of the crossing and of a zone, ``NONE`` without
    size, tolerance      of the step; how near to the crossing it has to end
    jump                 how much accelerations changed at an event
    freed, culprit       how many guards were let go for good, the last of them
    hunt                 whether a crossing found in a step of size ``whole`` that ended at
                         ``hunt_end`` is still ahead
    loose, let_go        guards are evaluated as they are: always, for one try; ``again``: for this
    crawl                tiny steps after a guard was let go
    turned               changes of branches at the start of a step since the last accepted one
    looks, looked        looks in this step, the last share that was examined for a dip
    known, rated         whether the rates at the start and at the end are known
    taken                whether guards were turned over because that makes no difference
    span                 share of a zone that a step may cross
    window_low, window_high   the window that is examined
    past_size            size of the step before, 0 when its rates are not known
    ahead                time from the start of the step to where its early rates reach
    since, tries         the start of the step, and how many tries from there were looked at
    quiet, stale         until when poles and zones of narrow functions stay far away, and whether
                         what is known of the start of the step is that of an earlier one
    """

    stop_at: int
    open: bool
    low: float
    high: float
    share: float
    found: float
    size: float
    tolerance: float
    budget: float
    jump: float
    freed: int
    culprit: int
    hunt: bool
    loose: bool
    let_go: bool
    again: bool
    crawl: int
    hunt_end: float
    whole: float
    looks: int
    looked: float
    known: bool
    rated: bool
    cut: float
    taken: bool
    stage: int
    span: float
    pace_at: int
    window_low: float
    window_high: float
    past_size: float
    turned: int
    ahead: float
    since: float
    tries: int
    quiet: float
    stale: bool


class SensorRow(Record):
    """A sensor: workspace offsets of the branches of its one or two relations, what they were (1
    true, -1 false, 0 not known), whether it has triggered; whether it has before and has not been
    false since (``asleep``), and the time up to which it does not do so again.
    """

    first: int
    second: int
    first_was: int
    second_was: int
    triggered: int
    asleep: int
    quiet: float
