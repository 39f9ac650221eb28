"""What statements may ask of the deck and of the model that are built from them."""

from __future__ import annotations

from collections.abc import Callable, Hashable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, Protocol, TypeAlias, TypeVar

if TYPE_CHECKING:  # the modules that read a deck do without numpy
    import numpy as np

Key: TypeAlias = int | str
"""An id as references hold it: a number, or a name in capitals."""
ID_DIGITS = 18
"""Digits of an id that is a number: any such number fits into 64 bits."""
T = TypeVar("T")


def key_of(word: str) -> Key:
    """The id that a word is: a number if it has only decimal digits, and not too many; else the
    word itself.
    """
    return int(word) if word.isdecimal() and len(word) <= ID_DIGITS else word


class Lookup(Protocol):
    """The deck, once the ids of all statements are known."""

    def find(self, keyword: str, id: Key) -> Any:
        """The statement of that kind with that id or name; None when there is none."""

    def of(self, kind: str) -> Sequence[Any]:
        """All statements of one kind."""


class DrawnPlace(Protocol):
    """Where a marker sits on its body, or on the ground."""

    @property
    def kind(self) -> str: ...
    @property
    def body(self) -> int: ...
    @property
    def p(self) -> np.ndarray: ...
    @property
    def axes(self) -> np.ndarray: ...


class DrawnBody(Protocol):
    """A moving body as the deck draws it: its mass centre and its attitude, in ground."""

    @property
    def x(self) -> np.ndarray: ...
    @property
    def attitude(self) -> np.ndarray: ...
    @property
    def mass(self) -> float: ...


class DrawnModel(Protocol):
    """The model in the posture that the deck draws, :class:`adamslite.model.model.Model`."""

    @property
    def bodies(self) -> Sequence[DrawnBody]: ...
    @property
    def folder(self) -> Path: ...

    def start_of(self, body: int) -> tuple[np.ndarray, np.ndarray]:
        """Place and attitude of a body from which turns and travels count."""

    def marker(self, marker_id: Key) -> DrawnPlace:
        """Where a marker sits."""

    def element(self, keyword: str, element_id: Key) -> Any:
        """The statement of that kind with that id."""

    def variable(self, variable_id: Key) -> Any:
        """The VARIABLE of that id."""

    def once(self, what: Hashable, compute: Callable[[], T]) -> T:
        """Values that are computed for this model when they are first needed."""
