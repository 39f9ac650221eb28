"""Blocks of the Newton matrix: derived products, the order of elimination, redundant rows."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence

import numpy as np

from adamslite.equations.elimination_order import analyse
from adamslite.equations.engine import ints
from adamslite.equations.jacobian_blocks import JacobianBlocks
from adamslite.equations.numbering import Numbering
from adamslite.equations.spanning_tree import prerequisites
from adamslite.integrators.contract import WORK
from adamslite.model.model import PART


class Elimination:
    """Where every block of the Jacobian stands in the factors.

    ``dropped``: redundant constraint rows; ``held``: unknowns that a reduction keeps where they
    are, with their multipliers; ``dead``: all unknowns that are left out.
    """

    dead: np.ndarray

    def __init__(self, numbering: Numbering, blocks: JacobianBlocks, pivoting: bool) -> None:
        """``pivoting``: eliminate the whole matrix with row pivoting, whatever its size."""
        self.numbering, self.blocks, self.pivoting = numbering, blocks, pivoting
        self.nodes, self.node_at = numbering.nodes, numbering.node_at
        self.starts, self.widths = numbering.starts, numbering.widths
        self.plan: dict[str, np.ndarray] = {}
        self._derive()
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
        left = set(dead)
        self.live = [
            [k for k in range(width) if start + k not in left]
            for start, width in zip(self.starts, self.widths, strict=True)
        ]
        self._plan()

    def _derive(self) -> None:
        """Blocks made of others, and room for all."""
        self.mixed = ints(self._mixed_products() if self.numbering.stabilised else [])
        self.turning = ints(self._turning_blocks())
        self.product = ints(
            [
                value
                for (row, column), offset in self.blocks.offsets.items()
                if max(row, column) < len(self.numbering.model.bodies)
                for value in (
                    offset,
                    self.widths[row],
                    self.widths[column],
                    self.starts[row],
                    self.starts[column],
                )  # fmt: skip
            ]
        )

    def _plan(self) -> None:
        """The order of elimination and where blocks are copied to."""
        counts = [len(live) for live in self.live]
        nodes = [k for k, count in enumerate(counts) if count]
        at = {node: k for k, node in enumerate(nodes)}
        mu = [k for k in nodes if self.nodes[k][0] == "MU"]
        late = {
            at[k]: {at[b] for b in before if b in at}
            for k, before in self._late_nodes(counts).items()
            if k in at
        }
        for k in mu:
            late[at[k]] = {at[self.node_at[self.nodes[k][1]]]}
        kept = [(r, c) for r, c in self.blocks.offsets if r in at and c in at]
        pairs = {(at[r], at[c]) for r, c in kept} | {(k, k) for k in range(len(nodes))}
        widths = [counts[k] for k in nodes]
        starts = np.concatenate([[0], np.cumsum(widths)]).astype(int)[:-1].tolist()
        found = analyse(widths, starts, pairs, late, self.pivoting)
        self.plan = {**found.plan, "place": self._places(found.plan["place"])}
        self.copies = ints(
            [x for r, c in kept for x in self._copies(r, c, *found.places[at[r], at[c]])]
        )
        self.unit = ints(
            [
                found.places[at[k], at[k]][0] + c * (found.places[at[k], at[k]][1] + 1)
                for k in mu
                for c in range(counts[k])
            ]
        )
        self.LV, self.LA = np.zeros(found.size + 1), np.zeros(found.size + 1)
        nz = self.numbering.nz
        self.pivots, self.pivots_a = ints([0] * (nz + 1)), ints([0] * (nz + 1))
        self.work = np.zeros(max(WORK, found.widest**2))

    def unknowns(self) -> list[int]:
        """The unknowns that are solved for: all but those of redundant rows."""
        return [s + k for s, own in zip(self.starts, self.live, strict=True) for k in own]

    def _places(self, place: np.ndarray) -> np.ndarray:
        """Of every unknown in the order of elimination; those left out share the one behind."""
        places = np.full(self.numbering.nz, place.size, dtype=np.int64)
        live = self.unknowns()
        places[live] = place
        return places

    def _copies(self, row: int, column: int, at: int, lead: int) -> Iterator[int]:
        """What of a block goes where: the whole of it, or runs of neighbours in its rows."""
        offset, width = self.blocks.offsets[row, column], self.widths[column]
        rows, columns = self.live[row], self.live[column]
        if len(rows) == self.widths[row] and len(columns) == width:
            yield from (offset, len(rows), width, at, lead)
            return
        for r, i in enumerate(rows):
            for first, run in _runs(columns):
                yield from (offset + i * width + columns[first], 1, run)
                yield from (at + r * lead + first, lead)

    def _late_nodes(self, counts: list[int]) -> dict[int, set[int]]:
        """For each constraint's node, what must be eliminated before it, by unknowns of a node."""
        held: dict[int, set[int]] = {}
        for row, column in self.blocks.offsets:
            if self._is_multiplier(row) and self.nodes[column][0] == "BODY":
                held.setdefault(row, set()).add(column)
        constraints = [(k, frozenset(b), counts[k]) for k, b in sorted(held.items()) if counts[k]]
        return prerequisites(constraints, counts[: len(self.numbering.model.bodies)])

    def _is_multiplier(self, node: int) -> bool:
        return self.nodes[node] in self.numbering.model.held

    def _mixed_products(self) -> list[int]:
        """Columns of mu: D[row, body] W G[constraint, body]^T for every block of D."""
        touched: dict[int, list[int]] = {}
        for row, column in self.blocks.offsets:
            if self._is_multiplier(row) and ("MU", self.nodes[row]) in self.node_at:
                if self.nodes[column][0] == "BODY":
                    touched.setdefault(column, []).append(row)
        products = []
        for (row, body), offset in list(self.blocks.offsets.items()):
            if self.nodes[body][0] != "BODY":
                continue
            for constraint in touched.get(body, ()):
                mu = self.node_at["MU", self.nodes[constraint]]
                target = self.blocks.offset(row, mu)
                gradient = self.blocks.offsets[constraint, body]
                products += [target, self.widths[mu], offset, self.widths[row]]
                products += [self.widths[body], gradient, body]
        return products

    def _turning_blocks(self) -> list[int]:
        found = []
        for (row, column), offset in self.blocks.offsets.items():
            if self.nodes[column][0] == "BODY" and self.widths[column] == PART:
                found += [offset, self.widths[row], column]
        return found


def _runs(numbers: Sequence[int]) -> Iterator[tuple[int, int]]:
    """Runs of successive numbers: index of the first, and how many."""
    first = 0
    for k in range(1, len(numbers) + 1):
        if k == len(numbers) or numbers[k] != numbers[k - 1] + 1:
            yield first, k - first
            first = k
