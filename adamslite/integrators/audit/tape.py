"""Writing the tape of a run, where an audit would look at it: at accepted steps and events.

A run that goes back to an earlier state takes what it has passed since off the tape.
"""

from __future__ import annotations

from adamslite.integrators.audit_record import (
    AT_EVENT,
    AT_START,
    AT_STEP,
    TAPE_HEAD,
    TAPE_KIND,
    TAPE_ORDER,
    TAPE_RESTARTS,
    TAPE_STEP,
    TAPE_TIME,
)
from adamslite.integrators.contract import Problem
from adamslite.native.translate import copy, native, seldom


@native
@seldom
def tape_step(P: Problem, t: float) -> None:
    """The end of an accepted step, in the workspace."""
    T = P.tape
    while T.rows > 1 and T.data[(T.rows - 1) * T.width + TAPE_TIME] > P.audit.now.t:
        T.rows -= 1
    tape_row(P, t, AT_STEP)
    P.audit.now.t = t


@native
@seldom
def tape_event(P: Problem, t: float) -> None:
    """The state behind an event, or the start, in the workspace."""
    tape_row(P, t, AT_EVENT if P.tape.rows > 0 else AT_START)
    P.audit.now.t = t


@native
def tape_row(P: Problem, t: float, kind: float) -> None:
    """Add a row; a tape that is full ends the run."""
    T = P.tape
    if (T.rows + 1) * T.width > T.data.size:
        T.full, P.settings.stop = True, True
        return
    row = T.data[T.rows * T.width :]
    row[TAPE_TIME], row[TAPE_STEP], row[TAPE_ORDER] = t, P.report.h, float(P.report.order)
    row[TAPE_KIND], row[TAPE_RESTARTS] = kind, float(P.count.restarts)
    copy(row[TAPE_HEAD:], P.W, P.W.size)
    behind = TAPE_HEAD + P.W.size
    copy(row[behind:], P.base, 9 * P.sizes.nb)
    behind += 9 * P.sizes.nb
    copy(row[behind:], P.history, T.kept)
    copy(row[behind + T.kept :], P.history[T.further :], T.more)
    T.rows += 1
