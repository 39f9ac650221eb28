"""Control numbers of a method between steps: those that every method has."""

from __future__ import annotations

from adamslite.native.translate import Record

RUNNING = -1
"""A run goes on: the outcome of a step before there is one."""

NOBODY = -1
"""``blamed`` before a corrector failed."""


class StepControl(Record):
    """What every method remembers from step to step; each extends it by its own numbers.

    t, h, h_last         accepted time, size of the next try, of the last step (0: none)
    row                  the next row of the record
    retries, blamed      failures of the corrector in a row, the unknown that moved most
    norm                 error of the last rejected try (0: none)
    signature            signs of the pivots of the acceleration matrix
    open                 whether rows of the accepted step are still to be written, and
    accepted             its error, with which the next step is chosen behind them
    """

    t: float
    h: float
    h_last: float
    row: int
    retries: int
    blamed: int
    norm: float
    signature: int
    open: bool
    accepted: float
