"""What can be wrong besides the deck: the command, or a file that should hold results."""


class UsageError(ValueError):
    """The command was not given what it needs; the message says what is missing."""


class RunFailed(RuntimeError):
    """A run that did not reach the state it was asked for; the message says why."""


class FormatError(ValueError):
    """A file that is not what it should be; the message says file, line and why."""
