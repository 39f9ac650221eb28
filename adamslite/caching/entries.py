"""Entries: bytes stored under a name that identifies their source.

An entry is verified before any part of it is used, and rebuilt when it fails::

    magic and format | length of the content | SHA-256 of name and content | content
    8 bytes            8 bytes                 32 bytes

The folder is kept to a size: what has not been used for longest goes first. Any number of processes
may read, write and clear at once: an entry appears whole by a rename, and one that has gone is made
again.
"""

from __future__ import annotations

import hashlib
import os
import stat
import struct
import time
from collections.abc import Callable
from contextlib import suppress
from itertools import count
from pathlib import Path
from typing import Any

from adamslite.caching.contents import DAY, DRAFT, entries, found_files, remove
from adamslite.caching.folder import HAS_OWNERS, OTHERS, cache_folder, is_trusted, warn
from adamslite.errors import UsageError

HEAD = struct.Struct("<8sQ32s")
MAGIC = b"alentry1"

BOUND = 512.0
"""Size of the folder [MB = 1e6 bytes] unless ``ADAMSLITE_CACHE_SIZE`` says another."""
SPARED = 0.9
"""Share of the bound to which a folder that has outgrown it is cut, so that it is not cut often."""
HOUR = 3600.0
"""A draft older than this was left by a process that has died [s]."""


def recall(name: str, make: Callable[[], bytes]) -> bytes:
    """The content kept under ``name``, verified; made and kept when there is none or it fails.

    Of several processes that need it at once, one makes it.
    """
    content = find(name)
    if content is None:
        from adamslite.caching.alone import alone  # most entries are there

        with alone(name):
            # Another process may have made it since, waited for or not.
            content = made_since(name)
            if content is None:
                content = make()
                keep(name, content)
    return content


def find(name: str) -> bytes | None:
    """The content kept under ``name``, verified; None when there is none or it fails."""
    path = cache_folder() / name
    try:
        return _verified(path)
    except FileNotFoundError:
        return None
    except (Damaged, OSError) as fault:
        warn(f"the cache entry {path} is rebuilt: {getattr(fault, 'strerror', None) or fault}")
        return None


def made_since(name: str) -> bytes | None:
    """The same without a word about one that fails, of which :func:`find` has spoken."""
    with suppress(Damaged, OSError):
        return _verified(cache_folder() / name)
    return None


def _verified(path: Path) -> bytes:
    content = unsealed(path.name, _own_bytes(path))
    _note_use(path)
    return content


def _own_bytes(path: Path) -> bytes:
    """What a file holds that nobody else can have written, or write to; read if it may be whole."""
    with open(path, "rb", opener=_at_once) as file:
        facts = os.fstat(file.fileno())
        if not stat.S_ISREG(facts.st_mode):
            raise Damaged("it is no file")
        if HAS_OWNERS and (not is_trusted(facts.st_uid) or facts.st_mode & OTHERS):
            raise Damaged("others could write to it")
        _head(file.read(HEAD.size) if facts.st_size else b"", facts.st_size)
        file.seek(0)
        return file.read()


def _at_once(path: str, flags: int) -> int:
    """Open what may be a pipe, which a writer would be waited for."""
    return os.open(path, flags | getattr(os, "O_NONBLOCK", 0))


def keep(name: str, content: bytes) -> None:
    """Keep a content under a name."""
    store(cache_folder() / name, content)


def recall_json(name: str, make: Callable[[], Any]) -> Any:
    """A value of JSON, kept as :func:`recall` does."""
    import json

    return json.loads(recall(name, lambda: json.dumps(make()).encode()))


class Damaged(Exception):
    """An entry that is not what was written; the argument says what is wrong."""


def sealed(name: str, content: bytes) -> bytes:
    """An entry: the content behind its head."""
    return HEAD.pack(MAGIC, len(content), _digest(name, content)) + content


def unsealed(name: str, entry: bytes) -> bytes:
    """The content of an entry; raises :class:`Damaged`."""
    digest = _head(entry[: HEAD.size], len(entry))
    content = entry[HEAD.size :]
    if digest != _digest(name, content):
        raise Damaged("its content is not what was written")
    return content


def _head(head: bytes, size: int) -> bytes:
    """The SHA-256 in the head of an entry of that size [bytes]; raises :class:`Damaged`."""
    if len(head) < HEAD.size:
        raise Damaged("it is cut short" if head else "it is empty")
    magic, length, digest = HEAD.unpack(head)
    if magic != MAGIC:
        raise Damaged("it does not begin as an entry does")
    if length != size - HEAD.size:
        raise Damaged(f"{size - HEAD.size} bytes follow where {length} were written")
    return bytes(digest)


def _digest(name: str, content: bytes) -> bytes:
    found = hashlib.sha256(name.encode() + b"\0")
    found.update(content)
    return found.digest()


def _note_use(path: Path) -> None:
    with suppress(OSError):
        if abs(time.time() - path.stat().st_mtime) > DAY:
            os.utime(path)


_numbers = count()


def store(path: Path, content: bytes) -> None:
    """Keep an entry, whole or not at all; a full disk only costs the entry."""
    draft = path.with_name(f".{path.name}.{os.getpid()}-{next(_numbers)}.part")
    entry = sealed(path.name, content)
    try:
        with open(draft, "xb", opener=_closed) as out:
            out.write(entry)
            out.flush()
            os.fsync(out.fileno())
        os.replace(draft, path)
    except OSError:
        return
    finally:
        with suppress(OSError):
            draft.unlink(missing_ok=True)
    _keep_bound(path.parent, len(entry))


def _closed(path: str, flags: int) -> int:
    """Open a file that is its user's alone, whatever the mask of the process."""
    return os.open(path, flags, 0o600)


# ---- the size of the folder -------------------------------------------------------------------


def bound() -> float:
    """How large the folder may become [bytes].

    Raises
    ------
    UsageError
        When ``ADAMSLITE_CACHE_SIZE`` is not a number of megabytes.
    """
    text = os.environ.get("ADAMSLITE_CACHE_SIZE", "")
    try:
        size = float(text or BOUND)
    except ValueError:
        size = -1.0
    if not size >= 0.0:
        raise UsageError(f"ADAMSLITE_CACHE_SIZE={text}: it is a number of megabytes, 0 or more")
    return 1e6 * size


def trim(folder: Path, most: float) -> int:
    """Remove what has not been used for longest until ``most`` bytes are left, and dead drafts.

    An entry of the future, of a clock that was put back, would be the last to go for ever: it
    counts as used now.  Returns the bytes that are left.
    """
    for draft in found_files(folder, DRAFT):
        if abs(time.time() - draft.used) > HOUR:
            remove(draft)
    for entry in entries(folder):
        if entry.used > time.time() + DAY:
            with suppress(OSError):
                os.utime(entry.path)
    kept = entries(folder)
    total = sum(entry.size for entry in kept)
    for entry in kept if total > most else ():
        remove(entry)
        total -= entry.size
        if total <= SPARED * most:
            break
    return total


_totals: dict[Path, int] = {}


def _keep_bound(folder: Path, added: int) -> None:
    """Trim the folder when this process first adds to it, and when its own additions fill it."""
    known = _totals.get(folder)
    if known is None or known + added > bound():
        _totals[folder] = trim(folder, bound())
    else:
        _totals[folder] = known + added
