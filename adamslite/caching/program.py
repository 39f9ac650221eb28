"""The identity of the program: what it is made of, as one word.

Whatever is kept of a deck depends on every module that has read and checked it, on the grammars,
on Python and on some libraries.  The word is a digest of the content of all of these.

Reading some 600 files takes 10 ms.  Their facts take 2 ms: size, number of the inode, the times of
the last change of the content and of the inode.  The last one is the clock of the system and cannot
be put back by a program, so equal facts mean equal contents; the digest is kept under them.  Where
the system has no such time, the files are read.
"""

from __future__ import annotations

import hashlib
import os
import sys
import time
from collections.abc import Iterator
from functools import cache
from importlib.util import find_spec
from typing import NamedTuple

import adamslite
from adamslite import resources
from adamslite.caching import entries

PACKAGE = os.path.dirname(adamslite.__file__)
#: Libraries that shape what is kept, and the file of each that holds its version.
LIBRARIES = {
    "lark": "__init__.py", "llvmlite": "_version.py", "numpy": "version.py", "scipy": "version.py",
    "sympy": "release.py",
}  # fmt: skip
#: Files that hold the program, in the folder of the package, and folders that hold none.
SOURCES, WITHOUT = (".py", ".lark"), ("__pycache__", "decks", "node_modules")
#: Windows has the time of creation instead.
HAS_CHANGE_TIME = sys.platform != "win32"
NANO = 1e9
TICK = 2.0
"""A change within this time of another may have the same time [s]; file systems count in less."""


@cache
def program() -> str:
    """Changes whenever a source file, a grammar, Python or a library does.

    Empty where a file has been replaced since this process began: what the process runs may be the
    old one, so nothing that it makes may be kept, and nothing that is kept be used.
    """
    return identity_of([PACKAGE, str(resources.find("grammar")), *library_files()])


def identity_of(places: list[str]) -> str:
    """What :func:`program` says of the files in some folders."""
    facts = _facts(places)
    newest = max((each.changed for each in facts), default=0) / NANO
    if HAS_CHANGE_TIME and newest > adamslite.STARTED:
        return ""
    written = repr([tuple(each) for each in facts])
    name = f"program{hashlib.sha256(written.encode()).hexdigest()[:32]}.kept"
    lasting = HAS_CHANGE_TIME and newest <= time.time() - TICK
    kept = entries.find(name) if lasting else None
    if kept is not None:
        return kept.decode()
    found = content_digest([each.path for each in facts])
    if _facts(places) != facts:  # while they were read
        return ""
    if lasting:
        entries.keep(name, found.encode())
    return found


class Facts(NamedTuple):
    """A file, its size, where it is kept, when its content and its inode were changed [ns]."""

    path: str
    size: int
    device: int
    inode: int
    written: int
    changed: int


def _facts(places: list[str]) -> list[Facts]:
    found = ((path, os.stat(path)) for path in sorted(_files(places)))
    return [
        Facts(path, s.st_size, s.st_dev, s.st_ino, s.st_mtime_ns, s.st_ctime_ns)
        for path, s in found
    ]


def content_digest(paths: list[str]) -> str:
    """Digest of the names and contents of files, and of the Python that runs them."""
    found = hashlib.sha256(sys.version.encode())
    for path in paths:
        with open(path, "rb") as file:
            content = file.read()
        found.update(f"\0{path}\0{len(content)}\0".encode())
        found.update(content)
    return found.hexdigest()


@cache
def fingerprint() -> str:
    """Of the sources alone, wherever they are installed and whatever runs them: what another
    machine can have, too. Empty where :func:`program` is.
    """
    if not program():
        return ""
    found = hashlib.sha256()
    for place in (PACKAGE, str(resources.find("grammar"))):
        for path in sorted(_files([place])):
            with open(path, "rb") as file:
                content = file.read()
            name = os.path.relpath(path, place).replace(os.sep, "/")
            found.update(f"\0{name}\0{len(content)}\0".encode())
            found.update(content)
    return found.hexdigest()


def is_unchanged() -> bool:
    """Whether the program is still the one that this process began with."""
    before = program()
    program.cache_clear()
    return bool(before) and program() == before


def library_files() -> list[str]:
    """The files with the versions of libraries; none of a library that is not there."""
    found = []
    for name, file in LIBRARIES.items():
        spec = find_spec(name)
        if spec is not None and spec.origin is not None:
            found.append(os.path.join(os.path.dirname(spec.origin), file))
    return found


def _files(places: list[str]) -> Iterator[str]:
    """The files among some places, and the sources in the folders among them, at any depth."""
    for place in places:
        if os.path.isdir(place):
            with os.scandir(place) as inside:
                entries = [*inside]
            yield from (each.path for each in entries if each.name.endswith(SOURCES))
            deeper = (e.path for e in entries if "." not in e.name and e.name not in WITHOUT)
            yield from _files([path for path in deeper if os.path.isdir(path)])
        else:
            yield place
