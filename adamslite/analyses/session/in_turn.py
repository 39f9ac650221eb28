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
from adamslite.progress import AnalysisProgress, RunState
from adamslite.results.outcomes import Outcome

if TYPE_CHECKING:
    from adamslite.analyses.dynamics.history import Outlet
    from adamslite.analyses.session.session_state import SessionState
    from adamslite.progress import Progress

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
        outcome = _rest(session, times, reach, operation, outlet)
        if outlet and outcome is Outcome.DONE:
            outlet.end(contract.DONE, final=True)
        return outcome
    finally:
        session.time = float(system.report.t)
        if system.count.records:
            session.keep(system, times, at_rest)


def _rest(
    session: SessionState, times: np.ndarray, reach: Reach, operation: int, outlet: Outlet | None
) -> Outcome:
    """Reach the output times from that behind the last row on."""
    system, progress = session.system, None
    block, count = system.block, system.count
    if session.progress:
        progress = AnalysisProgress(session.progress, float(times[0]), float(times[-1]))
    for row in range(int(count.records), len(times)):
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
        if progress:
            _show(progress, times, row, outlet)
    return Outcome.DONE


def _show(progress: Progress, times: np.ndarray, row: int, outlet: Outlet | None) -> None:
    """How far it is."""
    start, time, end = (float(times[k]) for k in (0, row, -1))
    progress.watch(RunState(time=time, start=start, end=end, steps=row))
    if outlet and (note := outlet.journal.note()):
        progress.say(note)
