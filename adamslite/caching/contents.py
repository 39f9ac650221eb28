"""The contents of the cache folder: entries, and drafts of entries that are being written."""

from __future__ import annotations

import os
import re
from collections.abc import Iterator
from contextlib import suppress
from pathlib import Path
from typing import NamedTuple

#: Names of entries, and of those being written. Nothing else in the folder is ever touched.
ENTRY = re.compile(r"[a-z_]+[0-9a-f]{32}\.(?:o|json|parser|kept)")


DRAFT = re.compile(rf"\.{ENTRY.pattern}\.\d+-\d+\.part")


DAY = 24 * 3600.0
"""When an entry was last used is noted to a day [s]."""
DECKS = ".kept"
"""The suffix of what is kept of decks."""


class CacheEntry(NamedTuple):
    """A file of the folder: its size [bytes] and when it was last used [s since 1970]."""

    path: Path
    size: int
    used: float

    @property
    def worth(self) -> float:
        """By which entries go: compiled code, whose use is noted to the day, outlives decks of that
        day, which are read again in less time than code is compiled.
        """
        return self.used - DAY if self.path.suffix == DECKS else self.used


def entries(folder: Path) -> list[CacheEntry]:
    """The entries of a folder, in the order in which they are removed."""
    return sorted(found_files(folder, ENTRY), key=lambda entry: (entry.worth, entry.path))


def clear(folder: Path) -> list[CacheEntry]:
    """Remove every entry; returns those that there were."""
    found = entries(folder)
    for entry in (*found, *found_files(folder, DRAFT)):
        remove(entry)
    return found


def found_files(folder: Path, kind: re.Pattern[str]) -> Iterator[CacheEntry]:
    with suppress(OSError), os.scandir(folder) as files:
        for file in files:
            if kind.fullmatch(file.name):
                with suppress(FileNotFoundError):
                    facts = file.stat(follow_symlinks=False)
                    yield CacheEntry(Path(file.path), facts.st_size, facts.st_mtime)


def remove(entry: CacheEntry) -> None:
    with suppress(OSError):
        entry.path.unlink(missing_ok=True)
