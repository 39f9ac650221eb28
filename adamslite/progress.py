"""Progress reports of a running simulation.

`simulate(..., progress=p)` calls `p(time, end)` after each output step and `p.say(sentence)` before
something that takes long, such as compiling the engine the first time.
"""

import sys
import time as clock
from typing import TextIO


class Progress:
    """Says nothing; the base of those that do."""

    def __call__(self, time: float, end: float) -> None:
        """Tell that the run has reached `time` of `end` [time]."""

    def say(self, sentence: str) -> None:
        """Tell `sentence`."""

    def close(self) -> None:
        """Tell that no more is coming."""


class TalkingProgress(Progress):
    """Tells sentences on a stream and, when that is a terminal, redraws one line with the time."""

    #: Least real time between two drawings [s].
    INTERVAL = 0.1

    def __init__(self, stream: TextIO | None = None) -> None:
        self._stream = stream or sys.stderr
        self._live = self._stream.isatty()
        self._drawn_at = -self.INTERVAL
        self._width = 0

    def __call__(self, time: float, end: float) -> None:
        if not self._live or clock.monotonic() < self._drawn_at + self.INTERVAL:
            return
        self._drawn_at = clock.monotonic()
        self._draw(f"t = {time:.4g} of {end:g}")

    def say(self, sentence: str) -> None:
        self.close()
        self._stream.write(sentence + "\n")
        self._stream.flush()

    def close(self) -> None:
        if self._width:
            self._draw("")
            self._stream.write("\r")
            self._stream.flush()
            self._width = 0

    def _draw(self, line: str) -> None:
        self._stream.write("\r" + line.ljust(self._width))
        self._stream.flush()
        self._width = len(line)
