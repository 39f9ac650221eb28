"""Layouts: what the equations of a model have in common however often they are set up.

Where blocks stand and in which order they are eliminated depends on what is connected with what,
and on no number of the deck.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import cached_property
from itertools import chain
from typing import TYPE_CHECKING, Any, NamedTuple, TypeVar

import numpy as np

if TYPE_CHECKING:
    from scipy.sparse import csr_array

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


class JacobianBlocks:
    """Blocks by (node of the rows, node of the columns); ``size``: entries of all of them."""

    def __init__(self, numbering: Numbering) -> None:
        self.starts, self.widths, self.nz = numbering.starts, numbering.widths, numbering.nz
        self.offsets: dict[tuple[int, int], int] = {}
        self.size = 0

    def offset(self, row: int, column: int) -> int:
        """Where a block begins; it is made on first use."""
        if (row, column) not in self.offsets:
            self.offsets[row, column] = self.size
            self.size += self.widths[row] * self.widths[column]
        return self.offsets[row, column]

    def offsets_of(self, rows: np.ndarray, columns: np.ndarray) -> np.ndarray:
        """Where each of many blocks begins; those not met before are made, in this order."""
        keys = rows * len(self.widths) + columns
        _, first, which = np.unique(keys, return_index=True, return_inverse=True)
        row, column = rows[first], columns[first]
        pairs = zip(row.tolist(), column.tolist(), strict=True)
        found = np.array([self.offsets.get(pair, -1) for pair in pairs], dtype=np.int64)
        fresh = np.flatnonzero(found < 0)
        fresh = fresh[np.argsort(first[fresh])]
        wide = np.array(self.widths, dtype=np.int64)
        sizes = wide[row[fresh]] * wide[column[fresh]]
        found[fresh] = self.size + np.cumsum(sizes) - sizes
        made = (each[fresh].tolist() for each in (row, column, found))
        self.offsets.update(((r, c), at) for r, c, at in zip(*made, strict=True))
        self.size += int(sizes.sum())
        return found[which]

    def dense(self, entries: np.ndarray) -> np.ndarray:
        """Their entries (size,) as one matrix (nz, nz)."""
        rows, columns, places = self._entries
        full = np.zeros((self.nz, self.nz))
        full[rows, columns] = entries[places]
        return full

    def sparse(self, entries: np.ndarray) -> csr_array:
        """Their entries (size,) as one sparse matrix (nz, nz)."""
        from scipy.sparse import coo_array

        rows, columns, places = self._entries
        return coo_array((entries[places], (rows, columns)), shape=(self.nz, self.nz)).tocsr()

    @cached_property
    def _entries(self) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Row, column and place in the array of every entry of every block."""
        pairs = np.fromiter(chain.from_iterable(self.offsets), np.int64, 2 * len(self.offsets))
        at = np.fromiter(self.offsets.values(), np.int64, len(self.offsets))
        starts, widths = (np.array(each, dtype=np.int64) for each in (self.starts, self.widths))
        row, column = pairs[::2], pairs[1::2]
        sizes = widths[row] * widths[column]
        within = np.arange(sizes.sum()) - np.repeat(np.cumsum(sizes) - sizes, sizes)
        down, across = np.divmod(within, np.repeat(widths[column], sizes))
        rows = np.repeat(starts[row], sizes) + down
        columns = np.repeat(starts[column], sizes) + across
        return rows, columns, np.repeat(at, sizes) + within
