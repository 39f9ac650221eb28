"""The progress that a caller of Python means."""

from __future__ import annotations

import sys
from collections.abc import Callable
from typing import Any

from adamslite.errors import UsageError
from adamslite.progress.base import CalledProgress, Progress
from adamslite.progress.terminal import TalkingProgress


def progress_of(given: Progress | Callable[[float, float], Any] | bool | None) -> Progress:
    """True shows it, None in notebooks alone; a function is called with the time and the end."""
    if isinstance(given, Progress):
        return given
    if callable(given):
        return CalledProgress(given)
    if not isinstance(given, bool | None):
        raise UsageError(f"progress={given!r}: it is True, False or a function of time and end")
    if given is False or (given is None and not in_notebook()):
        return Progress()
    if in_notebook():
        from adamslite.progress.notebook import NotebookProgress

        return NotebookProgress()
    return TalkingProgress()


def in_notebook() -> bool:
    """Whether this process is the kernel of a notebook, which can show HTML."""
    ipython: Any = sys.modules.get("IPython")
    shell = ipython.get_ipython() if ipython else None
    return getattr(shell, "kernel", None) is not None
