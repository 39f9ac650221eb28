"""Compiled modules of the program itself, one entry for each command.

Python keeps the compiled form of a module in a file beside its source, if it may.  It may not where
the package belongs to somebody else, or where ``PYTHONDONTWRITEBYTECODE`` is set as in many images
of containers: every run then compiles each module that it imports, half of the CPU of a small deck.
Elsewhere it still looks for that many files.

The entry of a command holds the modules that it has imported, compiled from their sources.  It is
named by the identity of the program (:mod:`adamslite.caching.program`), so it holds what the
sources say; size and time of a source, by which Python recognises its files, may stay when it
changes.
"""

from __future__ import annotations

import marshal
import os
import sys
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from hashlib import sha256
from importlib.machinery import ModuleSpec, PathFinder, SourceFileLoader
from importlib.util import spec_from_file_location
from types import CodeType, ModuleType
from typing import Any, NamedTuple

from adamslite.caching import entries
from adamslite.caching.program import is_unchanged, program

PREFIX = "adamslite."


class Compiled(NamedTuple):
    """The file of a module, whether it is a package, and its code as bytes."""

    path: str
    is_package: bool
    code: bytes


@contextmanager
def kept_modules(command: str) -> Iterator[None]:
    """Inside, modules of the package come from the entry of a command; it takes up new ones."""
    try:
        identity = program()
    except OSError:  # the package is not in files
        identity = ""
    if not identity:
        yield
        return
    finder = Finder(_entry(identity, command))
    sys.meta_path.insert(0, finder)
    try:
        yield
    finally:
        sys.meta_path.remove(finder)
    finder.keep()


def _entry(identity: str, command: str) -> str:
    facts = (identity, command, str(sys.flags.optimize), str(sys.implementation.cache_tag))
    return f"modules{sha256(' '.join(facts).encode()).hexdigest()[:32]}.kept"


class Finder:
    """Finds modules of the package in an entry, else among the sources.

    (A subclass of ``importlib.abc.MetaPathFinder`` would import twenty modules with it.)
    """

    def __init__(self, entry: str) -> None:
        self.entry = entry
        content = entries.find(entry)
        kept: dict[str, Any] = marshal.loads(content) if content else {}
        self.kept = {name: Compiled(*facts) for name, facts in kept.items()}
        self.fresh: dict[str, Compiled] = {}

    def find_spec(
        self, fullname: str, path: Sequence[str] | None, target: ModuleType | None = None
    ) -> ModuleSpec | None:
        if not fullname.startswith(PREFIX):
            return None
        kept = self.kept.get(fullname)
        if kept is not None:
            inside = [os.path.dirname(kept.path)] if kept.is_package else None
            loader = Loader(fullname, kept.path, self)
            return spec_from_file_location(
                fullname, kept.path, loader=loader, submodule_search_locations=inside
            )
        spec = PathFinder.find_spec(fullname, path, target)
        if spec is not None and type(spec.loader) is SourceFileLoader:
            spec.loader = Loader(fullname, spec.loader.path, self)
        return spec

    def keep(self) -> None:
        """Keep the modules that were compiled besides those there were."""
        if self.fresh and is_unchanged():
            found = self.kept | self.fresh
            plain = {name: tuple(found[name]) for name in sorted(found)}
            entries.keep(self.entry, marshal.dumps(plain))


class Loader(SourceFileLoader):
    """Loads a module from its kept code, else compiles its source whatever Python has kept."""

    def __init__(self, fullname: str, path: str, finder: Finder) -> None:
        super().__init__(fullname, path)
        self.finder = finder

    def get_code(self, fullname: str) -> CodeType | None:
        kept = self.finder.kept.get(fullname)
        if kept is not None:
            code: CodeType = marshal.loads(kept.code)
            return code
        code = self.source_to_code(self.get_data(self.path), self.path)
        is_package = self.is_package(fullname)
        self.finder.fresh[fullname] = Compiled(self.path, is_package, marshal.dumps(code))
        return code
