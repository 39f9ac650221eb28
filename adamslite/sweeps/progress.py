"""How far a sweep is."""

from __future__ import annotations

from dataclasses import dataclass

from adamslite.progress import RunState


@dataclass(frozen=True, kw_only=True)
class RunsState(RunState):
    """``time`` and ``steps`` are the runs that are done, ``end`` is how many there are."""

    @property
    def reached(self) -> str:
        return f"{self.steps} of {self.end:g} runs"

    @property
    def counted(self) -> str:
        return "runs"
