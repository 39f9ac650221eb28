"""The source files that influence an entry, and a digest of their content.

The files are found from the import graph: those of a module, of all it imports from this package,
and so on. Importing a module runs the packages that it lies in; a package that imports what it
finds in its folder covers all of its modules. The graph is read from the files themselves, once for
each state that the program is in, so nothing about it can be out of date.
"""

from __future__ import annotations

import hashlib
import os
import re
import sys
from functools import cache

import adamslite
from adamslite.caching import entries
from adamslite.caching.folder import warn
from adamslite.caching.program import PACKAGE, is_unchanged, program

#: An import from this package, as ruff formats it: its module, and the names taken from there.
IMPORT = re.compile(rb"\n *(?:from|import) adamslite\.?([\w.]*)(?: import (\([^)]*\)|.*))?")
NAME, DOT = re.compile(r"\w+"), re.compile(r"\.")
#: In a package that imports whatever modules its folder holds.
SEARCHES = b"iter_modules"


@cache
def version_of(*modules: str) -> str:
    """Changes whenever a file that ``modules`` are made of, or the Python that runs them, does.

    Kept under the identity of the whole program, of which those files are a part.
    """
    identity = program()
    if not identity:
        return digest_of(PACKAGE, *modules)
    name = hashlib.sha256(" ".join((identity, *modules)).encode()).hexdigest()[:32]
    kept = entries.find(f"version{name}.kept")
    if kept is not None:
        return kept.decode()
    found = digest_of(PACKAGE, *modules)
    if is_unchanged():
        entries.keep(f"version{name}.kept", found.encode())
    return found


def digest_of(package: str, *modules: str) -> str:
    """What :func:`version_of` says of the package in a folder.

    A file replaced since this process began may not be what the process runs: the digest is then
    one that no other process has.
    """
    stamps, replaced = [sys.implementation.cache_tag], []
    for path, content in sorted(covered(package, *modules).items()):
        stamps.append(f"{path[len(package) :]} {hashlib.sha256(content).hexdigest()}")
        if os.stat(path).st_ctime > adamslite.STARTED:
            stamps.append(f"{os.getpid()} {adamslite.STARTED}")
            replaced.append(path)
    if replaced:
        warn(f"{replaced[0]} is newer than this process: what is compiled is not found again")
    return hashlib.sha256("\n".join(stamps).encode()).hexdigest()


def covered(package: str, *modules: str) -> dict[str, bytes]:
    """The files that ``modules`` of the package in folder ``package`` need, with their content."""
    found: dict[str, bytes] = {}
    met = _with_packages({"", *modules})
    new = [*met]
    while new:
        for path in _files(package, new.pop()):
            if path not in found:
                found[path] = _content(path)
                fresh = _with_packages(_imported(package, found[path])) - met
                met |= fresh
                new += fresh
    return found


def _imported(package: str, content: bytes) -> set[str]:
    """Names of the modules that a file imports from this package."""
    found = set()
    for imported in IMPORT.finditer(b"\n" + content):
        module, names = imported[1].decode(), (imported[2] or b"").decode()
        found.add(module)
        if os.path.isdir(_place(package, module)):
            found |= {f"{module}.{name}".lstrip(".") for name in NAME.findall(names)}
    return found


def _with_packages(modules: set[str]) -> set[str]:
    """The modules and the packages that they lie in."""
    return modules | {name[: dot.start()] for name in modules for dot in DOT.finditer(name)}


def _files(package: str, module: str) -> list[str]:
    """The files of a module; none for what is no module."""
    place = _place(package, module)
    start = os.path.join(place, "__init__.py")
    if not os.path.isdir(place):
        return [f"{place}.py"] if os.path.isfile(f"{place}.py") else []
    if not os.path.isfile(start):
        return []
    if SEARCHES not in _content(start):
        return [start]
    inside = [os.path.join(at, file) for at, _, files in os.walk(place) for file in files]
    return [path for path in inside if path.endswith(".py")]


def _content(path: str) -> bytes:
    with open(path, "rb") as file:
        return file.read()


def _place(package: str, module: str) -> str:
    """A module's file without its suffix, or its folder."""
    return os.path.join(package, *filter(None, module.split(".")))
