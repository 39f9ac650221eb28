"""A call in a thread of its own, which can be waited for in pieces and interrupted."""

from __future__ import annotations

import signal
import threading
from _thread import allocate_lock, start_new_thread
from _weakref import ref
from collections.abc import Callable
from typing import Any, Generic, TypeAlias, TypeVar

# Time between two looks at a call that can be ended [s].
LOOK = 0.1
# How long a call that was asked to end is waited for [s].
GRACE = 0.3

Returned = TypeVar("Returned")
#: Whether something has gone on for longer than its caller allows; None where any time will do.
Over: TypeAlias = Callable[[], bool] | None


class Overspent(Exception):
    """A call has gone on for longer than its caller allows."""


def require_time(over: Over) -> None:
    """Go on, unless something is ``over``.

    Raises
    ------
    Overspent
        When it is.
    """
    if over is not None and over():
        raise Overspent


class _Held:
    """What a thread holds as long as there is one."""


class Worker(Generic[Returned]):
    """A call that has begun.

    A thread of ``threading`` costs twice as much and a pool of one thread five times, which is as
    much as a short run takes.  A lock is waited for because ``Thread.join``, when it is interrupted
    in Python 3.11, takes a running thread for finished.  A thread may end before it has begun, when
    there is no memory for its first frame: nothing of it has run then, but what it held is gone.
    """

    def __init__(self, call: Callable[[], Returned]) -> None:
        self._call = call
        self._result: Any = None
        self._done = False
        self._fault: BaseException | None = None
        self._busy = allocate_lock()
        self._busy.acquire()
        held = _Held()
        self._held = ref(held)
        try:
            start_new_thread(self._run, (held,))
        except RuntimeError:  # there is no room for its stack
            raise MemoryError from None

    def _run(self, held: _Held) -> None:
        try:
            self._result = self._call()
        except BaseException as fault:  # raised again where the result is asked for
            self._fault = fault
        finally:
            self._done = True
            self._busy.release()

    @property
    def works(self) -> bool:
        """Whether the call has not returned yet."""
        return not self._done and self._held() is not None

    def wait(self, timeout: float) -> None:
        """Until the call returns, but not longer than ``timeout`` [s]."""
        if self._busy.acquire(timeout=timeout):
            self._busy.release()

    def result(self) -> Returned:
        """What the call returned, when it works no longer; raises what it raised."""
        if self._fault is not None:
            raise self._fault
        if not self._done:
            raise MemoryError
        found: Returned = self._result
        return found


def is_interrupted_here() -> bool:
    """Whether an interruption arrives in this thread; it does not in workers of a sweep."""
    main = threading.current_thread() is threading.main_thread()
    return main and signal.getsignal(signal.SIGINT) is not signal.SIG_IGN


def _nothing() -> None:
    """Asks a call to end that cannot be asked."""


def interruptible(
    call: Callable[[], Returned],
    stop: Callable[[], None] = _nothing,
    over: Over = None,
) -> Returned:
    """What a call returns that the user may interrupt, or that may be ``over`` before.

    ``stop`` asks the call to end.  One that does not, as linear algebra and compilers cannot, is
    left to itself after GRACE: nothing waits for it any more, and what it changes is given up.

    Raises
    ------
    KeyboardInterrupt, Overspent
        When the user has interrupted it, when it was over.
    """
    if over is None and not is_interrupted_here():
        return call()
    running = Worker(call)
    fault: BaseException | None = None
    try:
        while running.works:
            running.wait(LOOK)
            require_time(over)
    except (KeyboardInterrupt, Overspent) as asked:
        fault = asked
    if fault is None:
        return running.result()
    stop()
    running.wait(GRACE)
    if running.works:
        _left.append(running)
    raise fault


def left_working() -> bool:
    """Whether a call that was left to itself still works; the process then ends without it."""
    return any(each.works for each in _left)


_left: list[Worker[Any]] = []
