"""A call in a thread of its own, which can be waited for in pieces and interrupted."""

from __future__ import annotations

from _thread import allocate_lock, start_new_thread
from collections.abc import Callable

# Time between two looks at a call that can be ended [s].
LOOK = 0.1


class Worker:
    """A call that has begun.

    A thread of ``threading`` costs twice as much and a pool of one thread five times, which is as
    much as a short run takes.  A lock is waited for because ``Thread.join``, when it is interrupted
    in Python 3.11, takes a running thread for finished.
    """

    def __init__(self, call: Callable[[], int]) -> None:
        self._call = call
        self._result, self._done = 0, False
        self._fault: BaseException | None = None
        self._busy = allocate_lock()
        self._busy.acquire()
        try:
            start_new_thread(self._run, ())
        except RuntimeError:  # there is no room for its stack
            raise MemoryError from None

    def _run(self) -> None:
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
        return not self._done

    def wait(self, timeout: float) -> None:
        """Until the call returns, but not longer than ``timeout`` [s]."""
        if self._busy.acquire(timeout=timeout):
            self._busy.release()

    def result(self) -> int:
        """What the call returned, when it works no longer; raises what it raised."""
        if self._fault is not None:
            raise self._fault
        return self._result


def interrupted(call: Callable[[], int], stop: Callable[[], None], over: Callable[[], bool]) -> int:
    """What a call returns that ``stop`` ends early: when it is ``over``, or the user interrupts.

    Raises
    ------
    KeyboardInterrupt
        After the call has returned, when the user has.
    """
    running, asked = Worker(call), False
    while running.works:
        try:
            running.wait(LOOK)
            if over():
                stop()
        except KeyboardInterrupt:
            asked = True
            stop()
    if asked:
        raise KeyboardInterrupt
    return running.result()
