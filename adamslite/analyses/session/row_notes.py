"""What the rows of a run show, in words: forces out of their laws, joints that stand still, columns
without numbers, how accurate they are.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from adamslite.analyses.findings.accuracy_notes import accuracy_notes, second_run
from adamslite.analyses.findings.buckling import buckled
from adamslite.analyses.findings.slack import compressed
from adamslite.results.outcomes import Outcome

if TYPE_CHECKING:
    from adamslite.analyses.dynamics.history import History
    from adamslite.analyses.session.session import Session

#: So many columns without numbers are named.
MOST_NAMED = 5
#: Numbers of an interrupted run that are looked through: who waits for its end waits for that.
MOST_LOOKED_AT = 2**24
#: Evaluations of routines of a user that a second run may repeat.
ROUTINE_CALLS = 5_000
LATER = (
    "columns without numbers, cables that push, joints that stand still and the accuracy, "
    "in {rows} rows: what goes on with the run does, when it is done"
)


def seen_in_rows(session: Session) -> dict[str, str]:
    """What the rows show.  Of a run that is interrupted not very many are looked through."""
    history = session.history
    if session.outcome is Outcome.INTERRUPTED and history.numbers > MOST_LOOKED_AT:
        return {**_beyond(session), "not looked for": LATER.format(rows=history.count)}
    slack = compressed(session.deck, history) if history.count else ""
    found = {
        **_analyses(session), **_beyond(session, slack), **_standing(session),
        **_without_value(history),
    }  # fmt: skip
    if session.counts.steps and (note := _accuracy_note(session)):
        found["accuracy"] = note
    return found


def _analyses(session: Session) -> dict[str, str]:
    """The rows of each analysis, where two have rows of their own at one time."""
    history, begun = session.history, session.analyses
    ends = [*(count for *_, count in begun), history.count][1:]  # none where nothing has begun
    texts, repeated = [], False
    for (kind, start, first), end in zip(begun, ends, strict=True):
        near = next(history.parts(2, first - 1))[0].tolist() if first else []
        repeated |= near == [start, start]
        row = first + (near[:1] != [start] or near[1:] == [start])  # one may end the last, too
        texts.append(f"{kind} row {row}" + (f" to {end}" if end > row else ""))
    return {"analyses": "; ".join(texts)} if repeated else {}


def _beyond(session: Session, slack: str = "") -> dict[str, str]:
    """Elements that the motion carried beyond what their law is meant for."""
    texts = [f"{label} {how}" for label, how in session.out_of_law.items()]
    texts += [slack] if slack else []
    return {"out of its law": "; ".join(texts)} if texts else {}


def _standing(session: Session) -> dict[str, str]:
    """Joints that stood still while others moved."""
    joints = [each for each in session.deck.statements if each.keyword == "JOINT"]
    if len(joints) < 2 or not session.counts.steps or not session.history.count:
        return {}
    # Most runs of few parts do without.
    from adamslite.analyses.findings.standstill import standing

    note = standing(session.kernels.model, session.history)
    return {"not moved": note} if note else {}


def _without_value(history: History) -> dict[str, str]:
    """The first columns with entries that are no numbers, and since when."""
    since: dict[int, float] = {}
    for time, values in history.blocks():
        missing = ~np.isfinite(values)
        for k in np.flatnonzero(missing.any(axis=0)).tolist():
            since.setdefault(k, float(time[np.argmax(missing[:, k])]))
    columns = sorted(since)
    texts = [f"{history.names[k]} at t = {since[k]:.6g}" for k in columns[:MOST_NAMED]]
    more = f" and {len(columns) - MOST_NAMED} more" if len(columns) > MOST_NAMED else ""
    return {"no number": "; ".join(texts) + more} if texts else {}


def _accuracy_note(session: Session) -> str:
    settings, history, counts = session.chosen.settings, session.history, session.counts
    second, factor = None, 0.0
    system, routines = session.system, session.deck.user.used
    if not (system.dof or system.ns):
        return ""
    few = not routines or counts.residuals < ROUTINE_CALLS
    if session.again and session.outcome.is_requested and few:
        options, factor = second_run(settings, counts, system.nz, history)
        second = session.again(**options) if options else None
        if second and second.outcome not in (session.outcome, Outcome.STEP_LIMIT):
            second = None
    note = accuracy_notes(system, settings, counts, history, second, factor)
    grown = buckled(session.kernels.model, history)
    return "; ".join(sentence for sentence in (grown, note) if sentence)
