"""Blocks of the Newton matrix: derived products, the order of elimination, redundant rows."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from itertools import chain
from typing import TYPE_CHECKING, Any

import numpy as np

from adamslite.equations.elimination_order import analyse
from adamslite.equations.engine import ints
from adamslite.equations.layout import Derived, Layout, Planned
from adamslite.equations.spanning_tree import prerequisites
from adamslite.integrators.contract import WORK
from adamslite.model.model import PART

if TYPE_CHECKING:
    from adamslite.equations.layout import JacobianBlocks
    from adamslite.equations.numbering import Numbering


class Elimination:
    """Where every block of the Jacobian stands in the factors.

    ``dropped``: redundant constraint rows; ``held``: unknowns that a reduction keeps where they
    are, with their multipliers; ``dead``: all unknowns that are left out.
    """

    dead: np.ndarray

    def __init__(self, numbering: Numbering, layout: Layout, pivoting: bool) -> None:
        """``pivoting``: eliminate the whole matrix with row pivoting, whatever its size."""
        self.numbering, self.layout, self.pivoting = numbering, layout, pivoting
        self.blocks: JacobianBlocks = layout.blocks
        self.nodes, self.node_at = numbering.nodes, numbering.node_at
        self.starts, self.widths = numbering.starts, numbering.widths
        self.plan: dict[str, Any] = {}
        self._products, self._turns, self.product = layout.derived(self._derive)
        self.drop([])

    def drop(self, rows: list[int]) -> None:
        """Leave out redundant constraint rows (counted from the first multiplier): lam = mu = 0."""
        self.dropped = rows
        self.unfold()

    def fold(self, coordinates: Iterable[int], rows: Iterable[int], loose: float) -> None:
        """Keep coordinates where they are, and leave out the constraint rows that would hold them.

        A run ends where one of their equations is off by more than ``loose``.
        """
        held = [*coordinates, *self._multipliers(set(rows) - set(self.dropped))]
        self.held, self.loose = ints(held), np.full(len(held) + 1, loose)
        self._leave_out([*held, *self._multipliers(self.dropped)])

    def freeze(self, states: Iterable[int]) -> None:
        """Keep states as they are, whatever their equations; :meth:`unfold` ends it."""
        self._leave_out([*self._multipliers(self.dropped), *states])

    def unfold(self) -> None:
        """Let everything move again."""
        self.held, self.loose = ints([]), np.zeros(1)
        self._leave_out([*self._multipliers(self.dropped)])

    def _multipliers(self, rows: Iterable[int]) -> Iterator[int]:
        """Unknowns of constraint rows: lam and, stabilised, mu."""
        for row in rows:
            yield self.numbering.n + row
            if self.numbering.stabilised and row < self.numbering.holonomic:
                yield self.numbering.nz - self.numbering.holonomic + row

    def _leave_out(self, dead: list[int]) -> None:
        """Plan the elimination without some unknowns and their equations."""
        if self.plan and np.array_equal(self.dead, dead):
            return
        self.dead = ints(dead)
        found = self.layout.plan((self.pivoting, *dead), self._planned)
        self.live, self.plan, self.copies, self.unit, self.mixed, self.turning, size, room = found
        self._make_room(size, room)

    def _planned(self) -> Planned:
        left = set(self.dead.tolist())
        whole = {width: [*range(width)] for width in set(self.widths)}
        self.live = [whole[width] for width in self.widths]
        for k, (start, width) in enumerate(zip(self.starts, self.widths, strict=True)):
            if left and not left.isdisjoint(range(start, start + width)):
                self.live[k] = [i for i in range(width) if start + i not in left]
        return self._plan()

    def _derive(self) -> Derived:
        """Blocks made of others, and room for all."""
        products = self._mixed_products() if self.numbering.stabilised else []
        rows, columns, at = self._entries()
        inner = np.maximum(rows, columns) < self.n_bodies
        rows, columns, at = rows[inner], columns[inner], at[inner]
        wide, first = np.array(self.widths, dtype=int), np.array(self.starts, dtype=int)
        facts = (at, wide[rows], wide[columns], first[rows], first[columns])
        return Derived(products, self._turning_blocks(), ints(np.column_stack(facts).ravel()))

    def _entries(self) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Of all blocks of the Jacobian: node of the rows, of the columns, and where it begins."""
        offsets = self.blocks.offsets
        pairs = np.fromiter(chain.from_iterable(offsets), np.int64, 2 * len(offsets))
        at = np.fromiter(offsets.values(), np.int64, len(offsets))
        return pairs[::2], pairs[1::2], at

    def _plan(self) -> Planned:
        """The order of elimination and where blocks are copied to."""
        counts = [len(live) for live in self.live]
        nodes = [k for k, count in enumerate(counts) if count]
        number = np.full(len(self.nodes), -1)
        number[nodes] = np.arange(len(nodes))
        mu = [k for k in nodes if self.nodes[k][0] == "MU"]
        late = {
            int(number[k]): {int(number[b]) for b in before if number[b] >= 0}
            for k, before in self._late_nodes(counts).items()
            if number[k] >= 0
        }
        for k in mu:
            late[int(number[k])] = {int(number[self.node_at[self.nodes[k][1]]])}
        rows, columns, _ = self._entries()
        kept = (number[rows] >= 0) & (number[columns] >= 0)
        pairs = np.stack([number[each[kept]] for each in (rows, columns)])
        found = analyse([counts[k] for k in nodes], pairs, late, self.pivoting)
        plan = {**found.plan, "place": self._places(found.plan["place"])}
        copies = self._copies(kept, *found.places.locate(*pairs))
        own = number[mu]
        at, lead = (each.tolist() for each in found.places.locate(own, own))
        unit = ints(
            [at[k] + c * (lead[k] + 1) for k, node in enumerate(mu) for c in range(counts[node])]
        )
        mixed = ints([*chain.from_iterable(self._live_products())])
        turning = ints([*chain.from_iterable(self._live_turns())])
        return Planned(self.live, plan, copies, unit, mixed, turning, found.size, found.room)

    def _make_room(self, size: int, room: int) -> None:
        """Arrays of the factors, and workspace."""
        nz, self.room = self.numbering.nz, max(WORK, room)
        self.LV, self.LA = np.zeros(size + 1), np.zeros(size + 1)
        self.pivots, self.pivots_a = ints([0] * (nz + 1)), ints([0] * (nz + 1))
        self.work = np.zeros(self.room)

    def unknowns(self) -> list[int]:
        """The unknowns that are solved for: all but those of redundant rows."""
        return [s + k for s, own in zip(self.starts, self.live, strict=True) for k in own]

    def _places(self, place: np.ndarray) -> np.ndarray:
        """Of every unknown in the order of elimination; those left out share the one behind."""
        places = np.full(self.numbering.nz, place.size, dtype=np.int64)
        live = self.unknowns()
        places[live] = place
        return places

    def _copies(self, kept: np.ndarray, at: np.ndarray, lead: np.ndarray) -> np.ndarray:
        """What of the blocks that are ``kept`` goes where: the whole of one, or runs of neighbours
        in its rows.
        """
        rows, columns, offset = (each[kept] for each in self._entries())
        wide = np.array(self.widths, dtype=np.int64)
        whole = np.array([len(live) for live in self.live], dtype=np.int64) == wide
        copies = np.column_stack([offset, wide[rows], wide[columns], at, lead])
        if whole.all():
            return np.ascontiguousarray(copies.ravel())
        found: list[int] = []
        for row, column, copy in zip(rows.tolist(), columns.tolist(), copies.tolist(), strict=True):
            if whole[row] and whole[column]:
                found += copy
            else:
                found += self._part_of(self.live[row], self.live[column], copy)
        return ints(found)

    @staticmethod
    def _part_of(rows: list[int], columns: list[int], copy: list[int]) -> Iterator[int]:
        """Runs of neighbours in the rows of a block of which not everything is copied."""
        offset, _, width, at, lead = copy
        for r, i in enumerate(rows):
            for first, run in _runs(columns):
                yield from (offset + i * width + columns[first], 1, run)
                yield from (at + r * lead + first, lead)

    def _late_nodes(self, counts: list[int]) -> dict[int, set[int]]:
        """For each constraint's node, what must be eliminated before it, by unknowns of a node."""
        held: dict[int, set[int]] = {}
        rows, columns, _ = self._entries()
        tied = self._is_multiplier()[rows] & (columns < self.n_bodies)
        for row, column in zip(rows[tied].tolist(), columns[tied].tolist(), strict=True):
            held.setdefault(row, set()).add(column)
        constraints = [(k, frozenset(b), counts[k]) for k, b in sorted(held.items()) if counts[k]]
        return prerequisites(constraints, counts[: self.n_bodies])

    @property
    def n_bodies(self) -> int:
        """Bodies, whose nodes come first."""
        return len(self.numbering.model.bodies)

    def _is_multiplier(self) -> np.ndarray:
        """Of every node, whether it has the multipliers of a constraint."""
        held, nb = self.numbering.model.held, self.n_bodies
        return np.array([False] * nb + [node in held for node in self.nodes[nb:]], dtype=bool)

    def _mixed_products(self) -> list[tuple[int, int, int, int, int, int]]:
        """Columns of mu: D[row, body] W G[constraint, body]^T for every block of D; the nodes of
        the row and of mu, where target, D and G begin, the body.
        """
        touched: dict[int, list[int]] = {}
        rows, columns, at = self._entries()
        with_mu = [("MU", node) in self.node_at for node in self.nodes]
        tied = (
            self._is_multiplier()[rows]
            & np.array(with_mu, dtype=bool)[rows]
            & (columns < self.n_bodies)
        )
        for row, column in zip(rows[tied].tolist(), columns[tied].tolist(), strict=True):
            touched.setdefault(column, []).append(row)
        products = []
        for row, body, offset in zip(rows.tolist(), columns.tolist(), at.tolist(), strict=True):
            for constraint in touched.get(body, ()):
                mu = self.node_at["MU", self.nodes[constraint]]
                target = self.blocks.offset(row, mu)
                gradient = self.blocks.offsets[constraint, body]
                products.append((row, mu, target, offset, gradient, body))
        return products

    def _live_products(self) -> Iterator[tuple[int, ...]]:
        """Entries of ``Problem.mixed`` without rows and columns that are left out."""
        for row, mu, target, source, gradient, body in self._products:
            lead, width = self.widths[mu], self.widths[body]
            for first, rows in _runs(self.live[row]):
                r = self.live[row][first]
                for begin, count in _runs(self.live[mu]):
                    j = self.live[mu][begin]
                    place = (target + r * lead + j, lead, count, source + r * width, rows)
                    yield (*place, width, gradient + j * width, body)

    def _turning_blocks(self) -> list[tuple[int, int, int]]:
        """Per block with a rotating column: the node of its rows, the body, where it begins."""
        rows, columns, at = self._entries()
        wide = np.array(self.widths, dtype=np.int64)
        turns = (columns < self.n_bodies) & (wide[columns] == PART)
        found = (each[turns].tolist() for each in (rows, columns, at))
        return list(zip(*found, strict=True))

    def _live_turns(self) -> Iterator[tuple[int, int, int, int]]:
        """Entries of ``Problem.turning`` without rows and columns that are left out."""
        for row, body, at in self._turns:
            columns = sum(1 << k - 3 for k in self.live[body] if k >= 3)
            for first, rows in _runs(self.live[row] if columns else []):
                yield at + PART * self.live[row][first], rows, body, columns


def _runs(numbers: Sequence[int]) -> Iterator[tuple[int, int]]:
    """Runs of successive numbers: index of the first, and how many."""
    first = 0
    for k in range(1, len(numbers) + 1):
        if k == len(numbers) or numbers[k] != numbers[k - 1] + 1:
            yield first, k - first
            first = k
