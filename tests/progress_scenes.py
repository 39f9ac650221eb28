"""States of a run, a clock that is set by hand, and streams: what progress is tested with."""

from __future__ import annotations

from typing import Any

from adamslite.progress import RunState


class Clock:
    """A clock that is set by hand [s]."""

    def __init__(self) -> None:
        self.now = 100.0

    def __call__(self) -> float:
        return self.now


class Stream:
    """What is written, to a terminal or to a file."""

    def __init__(self, terminal: bool) -> None:
        self.terminal, self.text = terminal, ""

    def isatty(self) -> bool:
        return self.terminal

    def write(self, text: str) -> None:
        self.text += text

    def flush(self) -> None:
        pass


def state(time: float, steps: int = 0, step: float = 0.01, **more: Any) -> RunState:
    facts = {"time": time, "end": 2.0, "step": step, "order": 3, "steps": steps, "longest": 0.1}
    return RunState(**{**facts, **more})
