"""What keeps the steps of a running integration short, as seen from outside.

Counts and the last error estimate are memory of the run; reading them costs the integrator nothing.
"""

from __future__ import annotations

from collections import deque
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from adamslite.equations.unknown_names import equation, placed, tested
from adamslite.integrators.event_rows import CHANGES, SINCE

if TYPE_CHECKING:
    from adamslite.equations.system import System

#: Looks that count: the last two seconds or so.
LOOKS = 20
#: Events, or failures of the corrector, limit the steps when there is one in so many steps.
EVENTS, FAILURES = 50, 10


class Seen(NamedTuple):
    """Counts at one look."""

    steps: int
    events: int
    failures: int


START = Seen(0, 0, 0)


class StepLimits:
    """What limits the steps of a run; to be asked while it runs."""

    def __init__(self, system: System, first: Seen = START) -> None:
        self._system = system
        self._seen: deque[Seen] = deque([first], maxlen=LOOKS)

    def look(self) -> None:
        """Note the present counts."""
        count = self._system.count
        self._seen.append(Seen(int(count.steps), int(count.events), int(count.failures)))

    def reason(self) -> str:
        """Events and who has them, equations that do not converge, or the largest error."""
        system, first, last = self._system, self._seen[0], self._seen[-1]
        if system.settings.fixed_step > 0.0:
            return ""
        steps = max(last.steps - first.steps, 1)
        if EVENTS * (last.events - first.events) > steps:
            return f"events{self._changing()}"
        if FAILURES * (last.failures - first.failures) > steps and system.report.iteration:
            row = equation(system, int(system.report.open_row))
            return f"the corrector fails, most for {row}"
        where = int(system.report.where)
        return f"the error of {tested(system, where)}" if where >= 0 else ""

    def _changing(self) -> str:
        """The statement whose branch has changed most, the latest of several."""
        watched = self._system.guarded["watch"]
        if not watched:
            return ""
        rows = self._system.margin.reshape(-1, len(watched))
        often, since = np.abs(rows[CHANGES]), rows[SINCE]
        if not often.any():
            return ""
        return f" of {placed(watched[int(np.lexsort((since, often))[-1])][0])}"
