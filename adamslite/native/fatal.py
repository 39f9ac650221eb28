"""What LLVM cannot go on from ends its process: before that a sentence is written.

LLVM calls ``abort`` where it finds no memory, and no exception can leave its frames.  A handler of
the signal still runs, on the thread that compiles: it removes the locks of the cache that this
process holds, says what has happened, and ends a command with the exit code of a run that stopped.
A program of the user's own is left to end as ``abort`` ends it.
"""

from __future__ import annotations

import ctypes
import os
import signal
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from threading import Lock
from typing import Any

from adamslite import notation
from adamslite.caching import alone

SENTENCE = (
    b"adamslite: native code could not be compiled and LLVM has ended the process, most likely for "
    b"lack of memory: give it more, or solve a smaller model\n"
)
#: The exit code of a run that stopped early, of adamslite.cli.commands.codes.
STOPPED_EARLY = 4

HANDLER = ctypes.CFUNCTYPE(None, ctypes.c_int)


@contextmanager
def explained() -> Iterator[None]:
    """Inside, LLVM ends the process in a sentence; nothing is changed under Windows."""
    if sys.platform == "win32":
        yield
        return
    _enter()
    try:
        yield
    finally:
        _leave()


_busy, _lock, _before = 0, Lock(), [0]


def _enter() -> None:
    """The first of several threads sets the handler, and remembers the one that was there."""
    global _busy
    with _lock:
        if not _busy:
            _before[0] = _set(ctypes.cast(_END, ctypes.c_void_p).value)
        _busy += 1


def _leave() -> None:
    global _busy
    with _lock:
        _busy -= 1
        if not _busy:
            _set(_before[0])


def _set(handler: int | None) -> int:
    """The handler of C of the signal, in place of the one that is returned."""
    function = ctypes.CDLL(None).signal
    function.restype, function.argtypes = ctypes.c_void_p, [ctypes.c_int, ctypes.c_void_p]
    return function(int(signal.SIGABRT), handler) or 0


def _end(_: Any) -> None:
    os.write(2, SENTENCE)
    alone.let_go()
    if notation.current() == notation.COMMAND_LINE:
        os._exit(STOPPED_EARLY)


#: Made before memory is short.
_END = HANDLER(_end)
