"""Drafts of files that are being written, and what killed programs have left of them.

A draft is ``.NAME.xxxxxxxx.part`` beside ``NAME`` and locked by whoever writes it, which a program
that is killed does no longer.
"""

import atexit
import os
import re
import stat
import time
from contextlib import suppress
from pathlib import Path
from typing import IO, Any

SUFFIX = ".part"
#: What follows ``.NAME.``; the file of an unfinished run has drafts, too.
DRAFT = re.compile(r"(?:part\.)?[0-9a-f]{8}\.part")
WINDOWS = os.name == "nt"
#: A draft may be unlocked for a moment when it is made, and without locks before it gets its name
#: [s].
YOUNG = 60.0


#: Drafts that this process writes, each with its number.
_written: set[tuple[int, Path]] = set()


def begun(draft: Path) -> None:
    """A draft is going to be written.  An interruption between two statements may keep whoever
    writes it from removing it: then it goes when the process ends.
    """
    _written.add((os.getpid(), draft))


def over(draft: Path) -> None:
    """A draft has got its name, or has gone."""
    _written.discard((os.getpid(), draft))


@atexit.register
def _remove_written() -> None:
    for process, draft in _written:
        with suppress(OSError):
            if process == os.getpid():
                draft.unlink(missing_ok=True)


def draft_of(target: Path) -> Path:
    """A name that nobody can expect: another thread, process or machine may write `target`, too."""
    return target.with_name(f".{target.name}.{os.urandom(4).hex()}{SUFFIX}")


def lock(stream: IO[Any]) -> bool | None:
    """Have a file to oneself until it is closed; False when another has it, None where the system
    cannot say.
    """
    try:
        import fcntl
    except ImportError:  # Windows lets nobody remove an open file, and no more
        return None
    try:
        fcntl.flock(stream, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except BlockingIOError:
        return False
    except OSError:  # a file system without locks
        return None
    return True


def remove_drafts(path: str | Path) -> None:
    """Take away the drafts of a file that nobody writes any more."""
    target = Path(os.path.realpath(path))
    start = f".{target.name}."
    with suppress(OSError), os.scandir(target.parent) as entries:
        left = [
            each.path
            for each in entries
            if each.name.startswith(start) and DRAFT.fullmatch(each.name, len(start))
        ]
        for each in left:
            with suppress(OSError):
                _remove(each)


def _remove(draft: str) -> None:
    found = os.lstat(draft)
    young = (WINDOWS or not found.st_size) and abs(time.time() - found.st_mtime) < YOUNG
    if young or not stat.S_ISREG(found.st_mode):
        return
    with open(draft, "r+b") as stream:
        held = lock(stream)
        if held:
            os.unlink(draft)
    if held is None and WINDOWS:
        os.unlink(draft)
