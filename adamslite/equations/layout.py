"""Layouts: what the equations of a model have in common however often they are set up.

Where blocks stand and in which order they are eliminated depends on what is connected with what,
and on no number of the deck.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any, NamedTuple, TypeVar

import numpy as np

from adamslite.equations.jacobian_blocks import JacobianBlocks

if TYPE_CHECKING:
    from adamslite.equations.numbering import Numbering

# Eliminations that are kept: of all unknowns, without redundant rows, in a plane.
MOST_PLANS = 8
# Other things that are kept.
MOST_KEPT = 32


Kept = TypeVar("Kept")


class Derived(NamedTuple):
    """Blocks made of others: products with columns of mu, rotating columns, inner blocks."""

    products: list[tuple[int, int, int, int, int, int]]
    turns: list[tuple[int, int, int]]
    inner: np.ndarray


class Planned(NamedTuple):
    """The elimination without some unknowns; nothing in it depends on numbers of the deck.

    ``live``: which unknowns of each node are solved for; ``size``, ``room``: of the factors, of the
    workspace; the others are arrays of ``Problem`` and of ``Plan``.
    """

    live: list[list[int]]
    plan: dict[str, Any]
    copies: np.ndarray
    unit: np.ndarray
    mixed: np.ndarray
    turning: np.ndarray
    size: int
    room: int


class Layout:
    """Blocks, plans of elimination and integers of instances, made by the first who needs them.

    Nothing that is kept is changed, so that several threads may share it.
    """

    def __init__(self, numbering: Numbering) -> None:
        self.blocks = JacobianBlocks(numbering)
        self._plans: dict[tuple[int, ...], Planned] = {}
        self._integers: dict[int, np.ndarray] = {}
        self._derived: Derived | None = None
        self._kept: dict[tuple[Any, ...], Any] = {}

    def derived(self, make: Callable[[], Derived]) -> Derived:
        """Blocks made of others."""
        if self._derived is None:
            self._derived = make()
        return self._derived

    def plan(self, without: tuple[int, ...], make: Callable[[], Planned]) -> Planned:
        """The elimination without some unknowns."""
        found = self._plans.get(without)
        if found is None:
            found = make()
            if len(self._plans) < MOST_PLANS:
                self._plans[without] = found
        return found

    def once(self, of: tuple[Any, ...], make: Callable[[], Kept]) -> Kept:
        """Anything else, by all that decides it beside the layout."""
        found: Kept | None = self._kept.get(of)
        if found is None:
            found = make()
            if len(self._kept) >= MOST_KEPT:
                self._kept.pop(next(iter(self._kept)), None)
            self._kept[of] = found
        return found

    def integers(self, group: int, make: Callable[[], np.ndarray]) -> np.ndarray:
        """What instances of a group read and write."""
        found = self._integers.get(group)
        if found is None:
            found = self._integers[group] = make()
        return found
