"""The elimination order of the Newton matrix, fixed once per model.

Nodes are eliminated by least degree, a constraint's multipliers only after the bodies that make
their own block regular (:mod:`adamslite.equations.spanning_tree`).  On a chain this works from the
free ends inwards and on a tree from the leaves to the root: no fill, cost proportional to the
number of bodies. Reference: George, Liu, SIAM Review 31 (1989) 1 (minimum degree).

Before all others come nodes on which no equation but their own depends, as on a state of DIFF that
is an integral for the record: nothing is below their pivots, however much is beside them.

A pattern that fills, as a net does, is eliminated by fronts
(:mod:`adamslite.equations.frontal_plan`).
"""

from __future__ import annotations

import heapq
from dataclasses import dataclass
from math import inf
from typing import Any, Protocol

import numpy as np

from adamslite.integrators.linalg.plan import Front, Run
from adamslite.native.translate import Rows

# With constraints, up to this many unknowns ordinary dense elimination with pivoting is as quick
# and safer, unless it takes so many times the multiplications of the blocks, as on a chain;
# without constraints every block is regular and blocks win from the first.
DENSE, WASTE = 96, 20
# Block by block no more than so many updates, and for each node so many: a net of 14 x 14 point
# masses takes as long by blocks as by fronts.
UPDATES, UPDATES_OF_NODE = 4000, 32
# Without constraints, so many nodes with so many couplings each, their own included, are a net:
# its blocks need not be counted.
MANY, CROWDED = 1000, 4.5


class Places(Protocol):
    """Where blocks are in the factors."""

    def locate(self, rows: np.ndarray, columns: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Of blocks (row, column): the place of the first entry, and the leading dimension."""


@dataclass
class EliminationOrder:
    """The plan for :mod:`adamslite.integrators.linalg.blocks` and where each block is copied to.

    ``size``: entries of the factors; ``room``: numbers of workspace.
    """

    plan: dict[str, Any]
    places: Places
    size: int
    room: int


def analyse(
    widths: list[int],
    pairs: np.ndarray,
    late: dict[int, set[int]],
    pivoting: bool = False,
) -> EliminationOrder:
    """Order and fill for nodes of ``widths`` unknowns coupled by ``pairs`` (rows, columns).

    ``late[node]``: nodes that must have been eliminated before ``node``; ``pivoting``: treat the
    matrix as one dense block.
    """
    total = sum(widths)
    if pivoting:
        return _dense(widths, total)
    alone = _lone(len(widths), pairs)
    found = _order(len(widths), pairs, late, alone, spared=total <= DENSE)
    if found is None:
        return _by_fronts(widths, pairs, late)
    order, below = found
    if late and total <= DENSE and total**3 <= WASTE * _work(widths, order, below):
        return _dense(widths, total)
    return _block_plan(widths, order, below, len(alone))


def _lone(count: int, pairs: np.ndarray) -> dict[int, list[int]]:
    """Nodes on which no other depends, or only such as come before: the nodes beside them."""
    rows, columns = (each[pairs[0] != pairs[1]] for each in pairs)
    users = np.bincount(columns, minlength=count)
    beside: dict[int, list[int]] = {}
    pending = np.flatnonzero(users == 0).tolist()
    if pending:
        near: list[list[int]] = [[] for _ in range(count)]
        for row, column in zip(rows.tolist(), columns.tolist(), strict=True):
            near[row].append(column)
    while pending:
        node = pending.pop()
        beside[node] = sorted(set(near[node]))
        for other in near[node]:
            users[other] -= 1
            if users[other] == 0:
                pending.append(other)
    return beside


def _by_fronts(widths: list[int], pairs: np.ndarray, late: dict[int, set[int]]) -> EliminationOrder:
    from adamslite.equations.frontal_plan import FrontalPlan, codes

    found = FrontalPlan(np.array(widths, dtype=np.int64), pairs[0], pairs[1], late)
    plan = _filled(
        place=_place(widths, found.place), fronts=found.fronts, runs=found.runs, code=codes()
    )
    return EliminationOrder(plan, found, found.size, found.room)


def _filled(**given: Any) -> dict[str, Any]:
    """All arrays of a plan; those that are not given are empty."""
    names = "size start diagonal first node lower upper target place code".split()
    empty = np.zeros(0, dtype=np.int64)
    arrays = {name: np.ascontiguousarray(given.get(name, empty), dtype=np.int64) for name in names}
    none = {"fronts": Rows(Front, 0), "runs": Rows(Run, 0)}
    return {**arrays, **{name: given.get(name, each) for name, each in none.items()}}


def _work(widths: list[int], order: list[int], below: list[list[int]]) -> int:
    """Multiplications of the elimination by blocks; a dense one of n unknowns counts n^3."""
    work = 0
    for node, rest in zip(order, below, strict=True):
        own, others = widths[node], sum(widths[other] for other in rest)
        work += own * (own * own + own * others + others * others)
    return work


def _place(widths: list[int], first: np.ndarray) -> np.ndarray:
    """Of every unknown: its place, from those of the first unknowns of the nodes."""
    wide = np.array(widths, dtype=np.int64)
    behind = np.arange(wide.sum()) - np.repeat(np.cumsum(wide) - wide, wide)
    return np.repeat(first, wide) + behind


class _OneBlock:
    """Places in one dense matrix of nodes that start at ``starts``."""

    def __init__(self, starts: np.ndarray, total: int) -> None:
        self.starts, self.total = starts, total

    def locate(self, rows: np.ndarray, columns: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        at = self.starts[rows] * self.total + self.starts[columns]
        return at, np.full(len(at), self.total)


def _dense(widths: list[int], total: int) -> EliminationOrder:
    starts = np.cumsum(widths) - widths
    plan = _filled(size=[total], start=[0], diagonal=[0], first=[0, 0], place=np.arange(total))
    return EliminationOrder(plan, _OneBlock(starts, total), total * total, total * total)


class _Graph:
    """What is still to be eliminated: couplings, and what each node waits for."""

    def __init__(
        self, count: int, pairs: np.ndarray, late: dict[int, set[int]], gone: list[int]
    ) -> None:
        self.near: list[set[int]] = [set() for _ in range(count)]
        self.done = [False] * count
        for node in gone:
            self.done[node] = True
        for r, c in zip(*pairs.tolist(), strict=True):
            if r != c and not self.done[r]:
                self.near[r].add(c)
                self.near[c].add(r)
        left = {node: before.difference(gone) for node, before in late.items()}
        self.waiting = {node: before for node, before in left.items() if before}
        self.frees: dict[int, list[int]] = {}
        for node, before in self.waiting.items():
            for each in before:
                self.frees.setdefault(each, []).append(node)
        self.heap: list[tuple[int, int, int]] = []
        self.offered = 0
        for node in range(count):
            self.offer(node)

    def offer(self, node: int) -> None:
        """Put a node that waits for nothing on the heap with its present degree."""
        if node not in self.waiting and not self.done[node]:
            self.offered += 1
            heapq.heappush(self.heap, (len(self.near[node]), self.offered, node))

    def least(self) -> int:
        """The node of least degree; when all wait in a circle, the least coupled of those."""
        while self.heap:
            degree, _, node = heapq.heappop(self.heap)
            if not self.done[node] and degree == len(self.near[node]):
                return node
        node = min(self.waiting, key=lambda n: len(self.near[n]))
        self.waiting.pop(node)
        return node

    def eliminate(self, node: int) -> list[int]:
        """Couple the neighbours of a node with each other; returns them."""
        self.done[node] = True
        rest = self.near[node]
        for other in rest:
            self.near[other] |= rest
            self.near[other] -= {other, node}
        for other in self.frees.pop(node, ()):
            self._release(other, node)
        for other in rest:
            self.offer(other)
        return sorted(rest)

    def _release(self, waiting: int, node: int) -> None:
        before = self.waiting.get(waiting)
        if before is not None:
            before.discard(node)
            if not before:
                self.waiting.pop(waiting)
                self.offer(waiting)


def _order(
    count: int,
    pairs: np.ndarray,
    late: dict[int, set[int]],
    alone: dict[int, list[int]],
    spared: bool,
) -> tuple[list[int], list[list[int]]] | None:
    """Minimum degree order behind the nodes that are ``alone``, and for each node those that stay
    coupled to it below; None when there are more updates than blocks are good for, unless
    ``spared``.
    """
    most = inf if spared else UPDATES + UPDATES_OF_NODE * count
    if not late and count > MANY and pairs.shape[1] > CROWDED * count:
        return None
    order, below = list(alone), list(alone.values())
    graph = _Graph(count, pairs, late, order)
    updates = 0
    while len(order) < count and updates <= most:
        order.append(graph.least())
        below.append(graph.eliminate(order[-1]))
        updates += len(below[-1]) ** 2
    return (order, below) if updates <= most else None


class _Blocks:
    """Places of blocks of ``widths`` that follow each other as they are met."""

    def __init__(self, widths: list[int]) -> None:
        self.widths = widths
        self.places: dict[tuple[int, int], int] = {}
        self.size = 0

    def place(self, row: int, column: int) -> int:
        """Of one block, which is made on first use."""
        found = self.places.get((row, column))
        if found is None:
            found = self.places[row, column] = self.size
            self.size += self.widths[row] * self.widths[column]
        return found

    def locate(self, rows: np.ndarray, columns: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        pairs = zip(rows.tolist(), columns.tolist(), strict=True)
        at = np.array([self.places[pair] for pair in pairs], dtype=np.int64)
        return at, np.array(self.widths, dtype=np.int64)[columns]


def _block_plan(
    widths: list[int], order: list[int], below: list[list[int]], alone: int
) -> EliminationOrder:
    """``alone``: how many nodes of the order have nothing below."""
    rank = {node: k for k, node in enumerate(order)}
    blocks = _Blocks(widths)
    place = blocks.place
    first, node, lower, upper, diagonal = [0], [], [], [], []
    for k, pivot in enumerate(order):
        rest = sorted(below[k], key=rank.__getitem__)
        diagonal.append(place(pivot, pivot))
        for other in rest:
            node.append(rank[other])
            lower.append(place(other, pivot) if k >= alone else -1)
            upper.append(place(pivot, other))
        first.append(len(node))
    target = []
    for k in range(alone, len(order)):
        rest = [order[r] for r in node[first[k] : first[k + 1]]]
        target += [place(row, column) for row in rest for column in rest]
    begin = np.concatenate([[0], np.cumsum([widths[n] for n in order])]).astype(int)
    plan = _filled(
        size=[widths[n] for n in order], start=begin[:-1], diagonal=diagonal, first=first,
        node=node, lower=lower, upper=upper, target=target,
        place=_place(widths, begin[[rank[n] for n in range(len(widths))]]),
    )  # fmt: skip
    return EliminationOrder(plan, blocks, blocks.size, max(widths, default=0) ** 2)
