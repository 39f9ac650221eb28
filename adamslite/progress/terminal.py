"""Progress on a stream: one line that is redrawn on a terminal, a few lines elsewhere."""

from __future__ import annotations

import os
import sys
import time as clock
from collections.abc import Callable
from typing import TYPE_CHECKING, TextIO

from adamslite.notation import visible
from adamslite.progress.base import Progress
from adamslite.progress.meter import Meter

if TYPE_CHECKING:
    from adamslite.progress.bar import Bar
    from adamslite.progress.base import RunState
    from adamslite.progress.meter import Look

#: Least time between two drawings [s].
INTERVAL = 0.1
#: Runs up to this time print no lines [s].
PATIENCE = 5.0
#: Lines are printed at every such share of an analysis, and whenever its time has doubled.
SHARES = 10


class TalkingProgress(Progress):
    """Reports to a stream, by default standard error.

    On a terminal one line shows the present state, with a bar where `rich` is installed.  Elsewhere
    a run that takes longer than ``PATIENCE`` prints a line at every tenth of its time.
    """

    def __init__(
        self, stream: TextIO | None = None, now: Callable[[], float] = clock.monotonic
    ) -> None:
        own: TextIO = getattr(sys.stderr, "obeyed", sys.stderr)
        self._stream = stream or own
        self._live = self._stream.isatty() and os.environ.get("TERM") != "dumb"
        self._now, self._width = now, 0
        self._bar: Bar | None = None
        self._begin()

    def _begin(self) -> None:
        self._meter = Meter(self._now)
        self._began: float | None = None
        self._drawn_at = self._printed_at = -INTERVAL
        self._printed_share = 0

    def watch(self, state: RunState) -> None:
        look = self._meter.look(state)
        if self._began is None:
            self._began = look.at
        if self._live:
            self._redraw(look)
        else:
            self._print(look, look.at - self._began)

    def say(self, sentence: str) -> None:
        self._clear()
        self._stream.write(visible(sentence) + "\n")
        self._stream.flush()

    def close(self) -> None:
        self._clear()
        self._begin()

    def _print(self, look: Look, taken: float) -> None:
        """A line of its own, where one is due."""
        share = int(SHARES * look.state.share)
        if share < self._printed_share:  # another analysis
            self._printed_share = share
        due = share > self._printed_share or taken >= 2.0 * max(self._printed_at, PATIENCE / 2.0)
        if taken >= PATIENCE and due:
            self._stream.write(look.text.strip() + "\n")
            self._stream.flush()
            self._printed_at = taken
            self._printed_share = share

    def _redraw(self, look: Look) -> None:
        if look.at < self._drawn_at + INTERVAL:
            return
        self._drawn_at = look.at
        if self._bar is None and _has_rich():
            from adamslite.progress.bar import Bar

            self._bar = Bar(self._stream)
        if self._bar is not None:
            self._bar.draw(look)
            return
        from shutil import get_terminal_size

        columns = get_terminal_size().columns - 1
        self._write_over(look.text[:columns])

    def _clear(self) -> None:
        if self._bar is not None:
            self._bar.clear()
            self._bar = None
        if self._width:
            self._write_over("")
            self._stream.write("\r")
            self._stream.flush()
            self._width = 0

    def _write_over(self, line: str) -> None:
        self._stream.write("\r" + line.ljust(self._width))
        self._stream.flush()
        self._width = len(line)


class SentenceProgress(Progress):
    """Reports sentences to standard error, and nothing of runs that go on: several may at once."""

    def say(self, sentence: str) -> None:
        sys.stderr.write(sentence + "\n")
        sys.stderr.flush()


def _has_rich() -> bool:
    from importlib.util import find_spec

    return find_spec("rich") is not None
