"""Errors that are not mistakes of a deck: wrong use of a command, or of a file."""


class UsageError(ValueError):
    """The command was not given what it needs; the message says what is missing."""


class RunFailed(RuntimeError):
    """A run that did not reach the requested state; the message gives the reason."""


class FormatError(ValueError):
    """A file that is not what it should be; the message says file, line and why."""


class DeckWarning(UserWarning):
    """A warning about a deck that Python reads on the way to a run, with its place and a hint."""
