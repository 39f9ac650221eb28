"""Objects of Python as entries of the cache, unpickled only when verified.

What is known to both sides is left out of an entry: it is given as a list of objects (no numbers,
texts, tuples, lists or dictionaries), and an entry refers to them by number, so that they are the
same objects again.
"""

from __future__ import annotations

import pickle
from collections.abc import Sequence
from io import BytesIO
from typing import Any

from adamslite.caching import entries
from adamslite.caching.folder import cache_folder, warn
from adamslite.gc_pause import without_collection

MOST = 1 << 26
"""Larger entries would drive out many others [bytes]."""


def find(name: str, known: Sequence[object] = ()) -> Any:
    """The object kept under a name; None when there is none or it fails."""
    content = entries.find(name)
    if content is None:
        return None
    try:
        with without_collection():
            return _Reader(BytesIO(content), known).load()
    except Exception as fault:  # an object that its class of today does not take
        warn(f"the cache entry {cache_folder() / name} is rebuilt: {fault!r}")
        return None


def keep(name: str, thing: object, known: Sequence[object] = ()) -> None:
    """Keep an object under a name, if it is of a kind and size that can be kept."""
    content = BytesIO()
    try:
        with without_collection():
            (_Writer(content, known) if known else _plain(content)).dump(thing)
    except (pickle.PicklingError, TypeError, AttributeError, RecursionError):
        return
    if content.tell() <= MOST:
        entries.keep(name, content.getvalue())


def known_object(number: int) -> object:
    """Stands in an entry for what is known to both sides."""
    raise NotImplementedError  # the reader has its own


def _plain(file: BytesIO) -> pickle.Pickler:
    return pickle.Pickler(file, pickle.HIGHEST_PROTOCOL)


class _Writer(pickle.Pickler):
    # Unlike `persistent_id` it is not asked about every number and every tuple.

    def __init__(self, file: BytesIO, known: Sequence[object]) -> None:
        super().__init__(file, pickle.HIGHEST_PROTOCOL)
        self._numbers = {id(each): number for number, each in enumerate(known)}

    def reducer_override(self, thing: object) -> Any:
        number = self._numbers.get(id(thing))
        return NotImplemented if number is None else (known_object, (number,))


class _Reader(pickle.Unpickler):
    def __init__(self, file: BytesIO, known: Sequence[object]) -> None:
        super().__init__(file)
        self._known = known

    def find_class(self, module: str, name: str) -> Any:
        if (module, name) == (__name__, known_object.__name__):
            return self._known.__getitem__
        return super().find_class(module, name)
