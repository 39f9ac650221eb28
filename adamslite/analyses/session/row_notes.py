"""What the rows of a run show, in words: forces out of their laws, joints that stand still, columns
without numbers, how accurate they are, which takes a second run when somebody asks for it.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from adamslite.analyses.findings.accuracy_notes import Ended, accuracy_notes
from adamslite.analyses.findings.buckling import buckled
from adamslite.analyses.findings.second_runs import second_runs
from adamslite.analyses.findings.slack import compressed
from adamslite.results.outcomes import Outcome

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

    from adamslite.analyses.dynamics.history import History
    from adamslite.analyses.session.session import Session

#: So many columns without numbers are named.
MOST_NAMED = 5
#: Numbers of an interrupted run that are looked through: who waits for its end waits for that.
MOST_LOOKED_AT = 2**24
#: Evaluations of routines of a user that a second run may repeat.
ROUTINE_CALLS = 5_000
#: Bytes of the code of kernels that take as long as an unknown of an equation.
CODE = 4096
ACCURACY = "accuracy"
#: Statements that may name a table, which is read again for a model that commands change.
WITH_FILES = ("SPLINE", "MATRIX")
#: Numbers of rows that are copied for a comparison with a second run that may come later, or not.
MOST_COPIED = 2**19
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
    return {
        **_analyses(session), **_beyond(session, slack), **_standing(session),
        **_without_value(history),
    }  # fmt: skip


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


class Comments(dict[str, str]):
    """Comments of a run; ``later`` makes the one on its accuracy, when it or all are looked at."""

    def __init__(self, known: Mapping[str, str], later: Callable[[], str] | None) -> None:
        super().__init__(known)
        self.later = later

    def settle(self) -> None:
        """Make it now; empty it is none."""
        later = self.later
        if later and (text := later()):
            dict.setdefault(self, ACCURACY, text)
        self.later = None  # last: another thread may look meanwhile

    def __missing__(self, key: str) -> str:
        if key in self:
            return self[key]
        raise KeyError(key)

    def __contains__(self, key: object) -> bool:
        if key == ACCURACY:
            self.settle()
        return super().__contains__(key)

    def get(self, key: str, default: Any = None) -> Any:
        return self[key] if key in self else default

    def __reduce__(self) -> tuple[Any, ...]:
        return dict, (dict(self),)


def _settled(method: Callable[..., Any]) -> Callable[..., Any]:
    """A method of mappings that looks at all comments."""

    def looking(comments: Comments, *arguments: Any) -> Any:
        for each in (comments, *arguments):
            if isinstance(each, Comments):
                each.settle()
        return method(comments, *arguments)

    return looking


for _name in (
    "__iter__", "__reversed__", "__len__", "__eq__", "__ne__", "__or__", "__ror__", "__repr__",
    "__delitem__", "keys", "values", "items", "copy", "pop", "popitem", "setdefault",
):  # fmt: skip
    setattr(Comments, _name, _settled(getattr(dict, _name)))


def with_accuracy(known: Mapping[str, str], session: Session) -> Comments:
    """Comments of a run and the one on its accuracy: made now where there are many rows, and where
    it depends on what may be different later: files, routines of the user, a limit of memory.
    """
    none = "not looked for" in known or not session.counts.steps
    deck, many = session.deck, session.history.numbers > MOST_COPIED
    files = session.saves.files.folder or any(
        getattr(each, "file", None) for keyword in WITH_FILES for each in deck.of(keyword)
    )
    waits = not (many or files or session.journal or session.memory or deck.user.used)
    found = Comments(known, None if none else _accuracy_note(session, waits))
    if not waits:
        found.settle()
    return found


def _accuracy_note(session: Session, copied: bool) -> Callable[[], str] | None:
    """What makes the note: of a copy of the rows, which their user may change, or of themselves."""
    settings, counts, again = session.chosen.settings, session.counts, session.again
    system, routines = session.system, session.deck.user.used
    groups, model = session.kernels.groups, session.kernels.model
    outcome, history = session.outcome, session.history
    if not (system.dof or system.ns):
        return None
    ended = Ended.of(system, outcome)
    size = system.nz + sum(len(each.code) * len(each.instances) for each in groups) // CODE
    few = not routines or counts.residuals < ROUTINE_CALLS
    repeated = again if outcome.is_requested and few else None
    history = history.copy() if copied else history

    def note() -> str:
        seconds, factor = list[Any](), 0.0
        if repeated:
            seconds, factor = second_runs(settings, counts, size, history, repeated)
        found = accuracy_notes(ended, settings, counts, history, seconds, factor)
        grown = buckled(model, history)
        return "; ".join(sentence for sentence in (grown, found) if sentence)

    return note
