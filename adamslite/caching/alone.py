"""One process of a machine makes an entry, and others that need it wait until it is there."""

from __future__ import annotations

import os
import time
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path

from adamslite.caching.folder import cache_folder

#: So long is another process waited for, which may have been stopped, and between two tries [s].
PATIENCE, PAUSE = 120.0, 0.02


@contextmanager
def alone(name: str) -> Iterator[None]:
    """Inside, no other process makes the entry of this name; one may have made it before.

    Where files cannot be locked (Windows, some networks) everyone makes it.
    """
    path = cache_folder() / f".{name}.lock"
    lock = _taken(path)
    if lock is not None:
        _held[path] = os.getpid()
    try:
        yield
    finally:
        if lock is not None:
            _held.pop(path, None)
            with suppress(OSError):
                path.unlink()
            os.close(lock)


_held: dict[Path, int] = {}
"""Locks, and the process that has taken each: a process that was forked holds none of them."""


def let_go() -> None:
    """Remove the locks of this process, which ends before it can leave :func:`alone`."""
    for path, process in [*_held.items()]:
        if process == os.getpid():
            with suppress(OSError):
                path.unlink()


def _taken(path: Path) -> int | None:
    """The file that is locked, None where none can be."""
    end = time.monotonic() + PATIENCE
    while time.monotonic() < end:
        try:
            file = os.open(path, os.O_RDWR | os.O_CREAT, 0o600)
        except OSError:
            return None
        try:
            if _lock(file) and _is_there(file, path):
                return file
        except (ImportError, OSError):
            os.close(file)
            return None
        os.close(file)
        time.sleep(PAUSE)
    return None


def _lock(file: int) -> bool:
    import fcntl  # Unix alone has it

    try:
        fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except BlockingIOError:
        return False
    return True


def _is_there(file: int, path: Path) -> bool:
    """Whether it is still the file of this name: who had it before has removed it."""
    try:
        return os.path.samestat(os.fstat(file), path.stat())
    except FileNotFoundError:
        return False
