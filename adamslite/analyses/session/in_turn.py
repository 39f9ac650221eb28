"""Analyses that solve their output times in turn: equilibria, and postures that motions determine.

Their rows go to the history block by block.  Behind a row nothing but the arrays of the system says
how to go on, so that such an analysis is kept as a native run is
(:mod:`adamslite.analyses.dynamics.checkpoint`).
"""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from typing import TYPE_CHECKING

import numpy as np

from adamslite.analyses.dynamics import dynamic
from adamslite.integrators import contract
from adamslite.results.outcomes import Outcome

if TYPE_CHECKING:
    from adamslite.analyses.dynamics.history import Outlet
    from adamslite.analyses.session.session_state import SessionState

#: Brings the system of a session to the output time of this number; how that has ended.
Reach = Callable[[int], Outcome]


def in_turn(
    session: SessionState, times: np.ndarray, reach: Reach, operation: int, at_rest: bool
) -> Outcome:
    """Reach each of ``times`` (nt,) and add a row for it, which ``operation`` writes, to the
    history; ``at_rest``: they are equilibria.

    Raises
    ------
    KeyboardInterrupt, MemoryError
        By the user, where there is not so much; the rows so far are in the history.
    """
    system, journal = session.system, session.journal
    row = max(1, system.nw + system.sizes.n_out)
    system.start_record(times, max(2, dynamic.ROOM // row) if journal else None)
    spill = partial(session.spill, system, times, np.ones(len(times), dtype=bool), at_rest)
    outlet = journal.outlet(session.history, system, spill) if journal else None
    try:
        if outlet and outlet.begin() == contract.DONE:
            return Outcome.DONE
        outcome = _rest(session, len(times), reach, operation, outlet)
        if outlet and outcome is Outcome.DONE:
            outlet.end(contract.DONE, final=True)
        return outcome
    finally:
        session.time = float(system.report.t)
        if system.count.records:
            session.keep(system, times, at_rest)


def _rest(
    session: SessionState, rows: int, reach: Reach, operation: int, outlet: Outlet | None
) -> Outcome:
    """Reach the output times from that behind the last row on."""
    system = session.system
    block, count = system.block, system.count
    for row in range(int(count.records), rows):
        over = session.budget.spent(int(count.steps))
        if over:
            if outlet and outlet.journal.part:
                outlet.take(contract.HELD)
            return over
        if outlet and row - block.first == block.room:
            block.row = row
            outlet.take(contract.FULL)
        outcome = reach(row)
        if outcome is not Outcome.DONE:
            return outcome
        system.run(operation, row)
        if outlet and outlet.journal.is_due():
            outlet.take(contract.HELD)
        if outlet and session.progress and (note := outlet.journal.note()):
            session.progress.say(note)
    return Outcome.DONE
