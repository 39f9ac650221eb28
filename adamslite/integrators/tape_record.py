"""The tape of a run: its accepted states, for what is worked out along them afterwards."""

from __future__ import annotations

from adamslite.native.translate import Reals, Record

# The head of a row: time, size and order of the step that ends there, what it is, restarts so far.
TAPE_TIME, TAPE_STEP, TAPE_ORDER, TAPE_KIND, TAPE_RESTARTS, TAPE_HEAD = range(6)
# What a row is: the start, the end of a step, the state behind an event.
AT_START, AT_STEP, AT_EVENT = 0.0, 1.0, 2.0


class Tape(Record):
    """Rows of ``width`` numbers: the head, the workspace, ``base`` (9 nb,) and the first ``kept``
    numbers of the history; ``rows``: how many there are, ``full``: there was no room for more.

    ``width`` 0: nothing is kept.
    """

    width: int
    rows: int
    kept: int
    full: bool
    data: Reals
