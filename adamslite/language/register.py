"""A register: what the modules of a room enter by name, complete whenever that could matter.

A module enters what it holds when it is imported.  Whoever takes one entry by a name that is there
waits for nothing else; a name that is not there, and a look at all names, import the whole room
first.  A deck that has been read thus needs the modules of its own statements only.
"""

from __future__ import annotations

from collections.abc import ItemsView, Iterator, KeysView, ValuesView
from importlib import import_module
from importlib.util import find_spec
from typing import Any, TypeVar, cast

T = TypeVar("T")


class Register(dict[str, T]):
    """Entries by name, in the order of the modules of ``room`` once all of them are there."""

    def __init__(self, room: str) -> None:
        super().__init__()
        self.room = room
        self._home: dict[str, str] = {}

    def enter(self, name: str, entry: T, module: str) -> None:
        """Enter what ``module`` holds under a name.

        Raises
        ------
        ValueError
            When it is there already.
        """
        if super().__contains__(name):
            raise ValueError(f"{name} is registered twice")
        self[name], self._home[name] = entry, module

    def complete(self) -> None:
        """Import every module of the room."""
        for module in import_module(self.room).modules():
            import_module(module)
        entries = sorted(super().items(), key=lambda entry: self._home.get(entry[0], ""))
        self.clear()
        self.update(entries)
        cast(Any, self).__class__ = _Complete

    def __missing__(self, name: str) -> T:
        """The entry of a module that is named like it, or of any."""
        home = f"{self.room}.{name.lower()}"
        if find_spec(home):
            import_module(home)
        if not super().__contains__(name):
            self.complete()
        return self[name]

    def __contains__(self, name: object) -> bool:
        if super().__contains__(name):
            return True
        self.complete()
        return name in self

    def get(self, name: str, default: T | None = None) -> T | None:  # type: ignore[override]
        return self[name] if name in self else default

    def __iter__(self) -> Iterator[str]:
        self.complete()
        return iter(self)

    def __len__(self) -> int:
        self.complete()
        return len(self)

    def keys(self) -> KeysView[str]:  # type: ignore[override]
        self.complete()
        return self.keys()

    def values(self) -> ValuesView[T]:  # type: ignore[override]
        self.complete()
        return self.values()

    def items(self) -> ItemsView[str, T]:  # type: ignore[override]
        self.complete()
        return self.items()


class _Complete(Register[T]):
    """A register of which nothing is missing: a dictionary, at the speed of one."""

    __contains__ = dict.__contains__
    __iter__ = dict.__iter__
    __len__ = dict.__len__
    get = dict.get  # type: ignore[assignment]
    keys = dict.keys
    values = dict.values
    items = dict.items

    def complete(self) -> None:
        """It is."""

    def __missing__(self, name: str) -> T:
        raise KeyError(name)
