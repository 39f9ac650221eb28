"""What a run reports, and who takes it."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any


def _nothing() -> str:
    return ""


@dataclass(frozen=True, kw_only=True)
class RunState:
    """A running integration at one moment.

    Parameters
    ----------
    time, start, end : float
        Time reached, and where the analysis begins and ends [time].
    step : float
        Size of the present step [time]; 0 where it is not known.
    order : int
        Its order; 0 for a method of one order.
    steps : int
        Steps taken so far.
    longest : float
        The longest step that is allowed [time]; 0 where it is not known.
    limit : function that returns a str
        Names what keeps steps short at present.
    """

    time: float
    end: float
    start: float = 0.0
    step: float = 0.0
    order: int = 0
    steps: int = 0
    longest: float = 0.0
    limit: Callable[[], str] = _nothing

    @property
    def share(self) -> float:
        """Part of the analysis that is done, 0 to 1."""
        span = self.end - self.start
        return min(max((self.time - self.start) / span, 0.0), 1.0) if span > 0.0 else 1.0

    @property
    def reached(self) -> str:
        """How far it is, in words."""
        return f"t = {self.time:.4g} of {self.end:g}"

    @property
    def counted(self) -> str:
        """What ``steps`` counts."""
        return "steps"


class RunsState(RunState):
    """``time`` and ``steps`` are the runs that are done, ``end`` is how many there are."""

    @property
    def reached(self) -> str:
        return f"{self.steps} of {self.end:g} runs"

    @property
    def counted(self) -> str:
        return "runs"


class Progress:
    """Reports nothing; the base of those that do."""

    def is_due(self) -> bool:
        """Whether a look at the run would be shown."""
        return True

    def watch(self, state: RunState) -> None:
        """Take a look at the run."""

    def say(self, sentence: str) -> None:
        """Report a sentence."""

    def close(self) -> None:
        """No more is coming; a later run may begin again."""


class CalledProgress(Progress):
    """Calls a function of Python as ``function(time, end)``; passes sentences to its ``say``."""

    def __init__(self, function: Callable[[float, float], Any]) -> None:
        self.function = function

    def watch(self, state: RunState) -> None:
        self.function(state.time, state.end)

    def say(self, sentence: str) -> None:
        getattr(self.function, "say", _ignored)(sentence)

    def close(self) -> None:
        getattr(self.function, "close", _nothing)()


def _ignored(sentence: str) -> None:
    pass
