"""Progress in a notebook: one output that is replaced."""

from __future__ import annotations

import time as clock
from collections.abc import Callable
from html import escape
from typing import TYPE_CHECKING, Any

from adamslite.progress.base import Progress
from adamslite.progress.meter import Meter

if TYPE_CHECKING:
    from adamslite.progress.base import RunState

#: Least time between two outputs [s]; shorter runs show none.
INTERVAL = 0.5


class NotebookProgress(Progress):
    """Shows state and sentences in the output of the cell; the state goes when the run ends."""

    def __init__(self, now: Callable[[], float] = clock.monotonic) -> None:
        self._now = now
        self._handle: Any = None
        self._begin()

    def _begin(self) -> None:
        self._meter, self._shown_at = Meter(self._now), self._now()

    def watch(self, state: RunState) -> None:
        look = self._meter.look(state)
        if look.at < self._shown_at + INTERVAL:
            return
        self._shown_at = look.at
        bar = f'<progress value="{state.share:.4f}" max="1"></progress>'
        self._show(look.text, f"{bar} <code>{escape(look.text)}</code>")

    def say(self, sentence: str) -> None:
        self._show(sentence, escape(sentence))

    def close(self) -> None:
        if self._handle is not None:
            self._show("", "")
            self._handle = None
        self._begin()

    def _show(self, text: str, html: str) -> None:
        """Replace the output, or make it."""
        from IPython.display import display

        content = {"text/plain": text, "text/html": html}
        if self._handle is None:
            self._handle = display(content, raw=True, display_id=True)
        else:
            self._handle.update(content, raw=True)
