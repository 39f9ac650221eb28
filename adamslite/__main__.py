"""`python -m adamslite` is the command `adamslite`; its script calls the same function.

What ends a command from outside, Ctrl-C and the signals of `ENDING`, does so in the same way
whenever it arrives: with a sentence, exit code 4, and what the command has by then.

    while modules are imported    at once: there is nothing to keep
    in the command                KeyboardInterrupt, but not in the middle of an import
    when it is over               not at all: its exit code stands
"""

import os
import sys
from _thread import get_ident, interrupt_main, start_new_thread
from importlib import import_module
from time import monotonic, sleep

TYPE_CHECKING = False
if TYPE_CHECKING:  # these, as all that is no part of Python itself, are loaded too late
    from types import FrameType
    from typing import Any

#: The module below `signal`, which loads enumerations, and these others, for some milliseconds.
signal: "Any" = import_module("_signal")

#: Signals that end a command like Ctrl-C, where the system knows them.
ENDING = ("SIGTERM", "SIGHUP")
INTERRUPTED, STOPPED_EARLY = b"adamslite: interrupted\n", 4
#: Files of the frames in which modules are imported.
IMPORTING = ("<frozen importlib._bootstrap>", "<frozen importlib._bootstrap_external>")
#: After which an interruption tries again, and for how long it waits for an import [s].
LATER, PATIENCE = 0.02, 0.4


def _heard() -> tuple[int, ...]:
    """Signals that reach this process; who starts it (`nohup`) may have chosen that they do not.

    A process of a worker imports this module by another name, and decides for itself.
    """
    if __name__ == "__mp_main__":
        return ()
    usual = (signal.default_int_handler, signal.SIG_DFL)
    known = (getattr(signal, name, None) for name in ("SIGINT", *ENDING))
    return tuple(each for each in known if each and signal.getsignal(each) in usual)


def _end_at_once(*_: object) -> None:
    """While modules are imported nothing is lost."""
    try:
        os.write(2, INTERRUPTED)
    except OSError:
        pass
    os._exit(STOPPED_EARLY)


HEARD = _heard()
for _each in HEARD:
    signal.signal(_each, _end_at_once)


def _interrupt(number: int, frame: "FrameType | None") -> None:
    """Raise KeyboardInterrupt; in the middle of an import a little later.

    Code of C that is being imported makes another fault of it, and locks of modules stay locked.
    """
    global _since
    _since = _since or monotonic()
    while frame is not None and monotonic() < _since + PATIENCE:
        if frame.f_code.co_filename in IMPORTING:
            _come_again(number)
            return
        frame = frame.f_back
    _since = 0.0
    if number != signal.SIGINT:
        _hang_up()
    raise KeyboardInterrupt


#: When an interruption that waits for an import came; 0 when none does.
_since = 0.0


def _hang_up() -> None:
    """One signal is enough; and a terminal that has gone cannot be written to."""
    for each in HEARD:
        if each != signal.SIGINT:
            signal.signal(each, signal.SIG_IGN)
    for stream in (1, 2):
        try:
            if os.isatty(stream):
                os.dup2(os.open(os.devnull, os.O_WRONLY), stream)
        except OSError:
            pass


def _come_again(number: "Any") -> None:
    """Send the main thread a signal a little later; it may wait for the system by then."""
    thread = get_ident()

    def wait() -> None:
        sleep(LATER)
        if hasattr(signal, "pthread_kill"):
            signal.pthread_kill(thread, number)
        else:
            interrupt_main(number)

    start_new_thread(wait, ())


def _not_raised(fault: "Any") -> None:
    """An interruption that met a finaliser, where nothing can be raised, comes again."""
    if isinstance(fault.exc_value, KeyboardInterrupt) and HEARD:
        _listen()
        _come_again(HEARD[0])
    else:
        sys.__unraisablehook__(fault)


def _listen() -> None:
    """From here on a signal is an exception."""
    sys.unraisablehook = _not_raised
    for each in HEARD:
        signal.signal(each, _interrupt)


def _ignore() -> None:
    """From here on the exit code is known."""
    for each in HEARD:
        signal.signal(each, signal.SIG_IGN)


def main() -> int:
    """Run the command line of the process and return the exit code."""
    from adamslite.cli.main import interrupted, leave
    from adamslite.cli.main import main as run_command

    try:
        try:
            _listen()
            return run_command()
        finally:
            _ignore()
    except KeyboardInterrupt:
        _ignore()
        code = interrupted()
        leave(code)
        return code


if __name__ == "__main__":
    sys.exit(main())
