"""Errors that are not mistakes of a deck: wrong use of a command, or of a file."""

from typing import Any

from adamslite.notation import shown


class UsageError(ValueError):
    """The command was not given what it needs; the message says what is missing.

    It is written as the command line has it and shown to users of Python as they write it.
    """

    def __str__(self) -> str:
        return shown(super().__str__())


class NoRoom(UsageError):
    """A run that is not begun, because it would need more memory or disk than there is."""


class RunFailed(RuntimeError):
    """A run that did not reach the requested state; the message gives the reason.

    ``results``: the results so far, of a run by ``simulate(..., strict=True)``.
    """

    def __init__(self, message: str = "", results: Any = None) -> None:
        super().__init__(message)
        self.results = results


class OutOfMemory(RunFailed):
    """A run that ended, with no room for what it had, for want of memory."""


class FormatError(ValueError):
    """A file that is not what it should be; the message says file, line and why."""


class RunWarning(RuntimeWarning):
    """A run that did not reach its end: how it ended, where and why; its results are returned."""


class DeckWarning(UserWarning):
    """A warning about a deck that Python reads on the way to a run, with its place and a hint."""
