"""The progress of one analysis, which may be integrated in many runs: DELAY, sensors."""

from __future__ import annotations

import time as clock
from collections.abc import Callable
from dataclasses import replace
from typing import TYPE_CHECKING

from adamslite.progress.base import Progress

if TYPE_CHECKING:
    from adamslite.progress.base import RunState

#: Least time between two looks, and before the first one [s].
INTERVAL = 0.09


class AnalysisProgress(Progress):
    """Passes looks at its runs on, as looks at the whole: not too many, and none at its end.

    Parameters
    ----------
    progress : Progress
    start, end : float
        Of the analysis [time].
    steps : function that returns an int
        Steps of the runs that are over; none by default.
    now : function
        The clock [s].
    """

    def __init__(
        self,
        progress: Progress,
        start: float,
        end: float,
        steps: Callable[[], int] = int,
        now: Callable[[], float] = clock.monotonic,
    ) -> None:
        self._progress, self._start, self._end, self._steps = progress, start, end, steps
        self._now, self._seen = now, now()

    def is_due(self) -> bool:
        return self._now() >= self._seen + INTERVAL

    def watch(self, state: RunState) -> None:
        if not self.is_due() or state.time >= self._end:
            return
        self._seen = self._now()
        steps = self._steps() + state.steps
        self._progress.watch(replace(state, start=self._start, end=self._end, steps=steps))

    def say(self, sentence: str) -> None:
        self._progress.say(sentence)
