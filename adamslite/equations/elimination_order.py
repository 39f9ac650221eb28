"""The elimination order of the Newton matrix, fixed once per model.

Nodes are eliminated by least degree, a constraint's multipliers only after the bodies that make
their own block regular (:mod:`adamslite.equations.spanning_tree`).  On a chain this works from the
free ends inwards and on a tree from the leaves to the root: no fill, cost proportional to the
number of bodies. Reference: George, Liu, SIAM Review 31 (1989) 1 (minimum degree).
"""

from __future__ import annotations

import heapq
from dataclasses import dataclass

import numpy as np

# With constraints, up to this many unknowns ordinary dense elimination with pivoting is as quick
# and safer, unless it takes so many times the multiplications of the blocks, as on a chain;
# without constraints every block is regular and blocks win from the first.
DENSE, WASTE = 96, 20


@dataclass
class EliminationOrder:
    """The plan for :mod:`adamslite.integrators.linalg.blocks` and where each block is copied to.

    ``places[(row, column)]``: offset and leading dimension in the factor array of ``size`` entries.
    """

    plan: dict[str, np.ndarray]
    places: dict[tuple[int, int], tuple[int, int]]
    size: int
    widest: int


def analyse(
    widths: list[int],
    starts: list[int],
    pairs: set[tuple[int, int]],
    late: dict[int, set[int]],
    pivoting: bool = False,
) -> EliminationOrder:
    """Order and fill for nodes of ``widths`` unknowns at ``starts`` coupled by ``pairs``.

    ``late[node]``: nodes that must have been eliminated before ``node``; ``pivoting``: treat the
    matrix as one dense block.
    """
    total = sum(widths)
    if pivoting:
        return _dense(widths, starts, pairs, total)
    order, below = _order(len(widths), pairs, late)
    if late and total <= DENSE and total**3 <= WASTE * _work(widths, order, below):
        return _dense(widths, starts, pairs, total)
    return _block_plan(widths, starts, order, below)


def _work(widths: list[int], order: list[int], below: list[list[int]]) -> int:
    """Multiplications of the elimination by blocks; a dense one of n unknowns counts n^3."""
    work = 0
    for node, rest in zip(order, below, strict=True):
        own, others = widths[node], sum(widths[other] for other in rest)
        work += own * (own * own + own * others + others * others)
    return work


def _place(widths: list[int], starts: list[int], first: list[int]) -> np.ndarray:
    place = np.zeros(sum(widths), dtype=np.int64)
    for node, width in enumerate(widths):
        place[starts[node] : starts[node] + width] = first[node] + np.arange(width)
    return place


def _dense(
    widths: list[int], starts: list[int], pairs: set[tuple[int, int]], total: int
) -> EliminationOrder:
    places = {(r, c): (starts[r] * total + starts[c], total) for r, c in pairs}
    empty = np.zeros(1, dtype=np.int64)
    plan = {name: empty for name in ("start", "diagonal", "node", "lower", "upper", "target")}
    plan |= {
        "size": np.array([total], dtype=np.int64),
        "first": np.zeros(2, dtype=np.int64),
        "place": np.arange(total, dtype=np.int64),
    }
    return EliminationOrder(plan, places, total * total, total)


class _Graph:
    """What is still to be eliminated: couplings, and what each node waits for."""

    def __init__(self, count: int, pairs: set[tuple[int, int]], late: dict[int, set[int]]) -> None:
        self.near: list[set[int]] = [set() for _ in range(count)]
        for r, c in pairs:
            if r != c:
                self.near[r].add(c)
                self.near[c].add(r)
        self.waiting = {node: set(before) for node, before in late.items() if before}
        self.frees: dict[int, list[int]] = {}
        for node, before in self.waiting.items():
            for each in before:
                self.frees.setdefault(each, []).append(node)
        self.done = [False] * count
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
    count: int, pairs: set[tuple[int, int]], late: dict[int, set[int]]
) -> tuple[list[int], list[list[int]]]:
    """Minimum degree order, and for each node those that stay coupled to it below."""
    graph = _Graph(count, pairs, late)
    order: list[int] = []
    below: list[list[int]] = []
    while len(order) < count:
        order.append(graph.least())
        below.append(graph.eliminate(order[-1]))
    return order, below


def _block_plan(
    widths: list[int], starts: list[int], order: list[int], below: list[list[int]]
) -> EliminationOrder:
    rank = {node: k for k, node in enumerate(order)}
    places: dict[tuple[int, int], tuple[int, int]] = {}
    size = 0

    def place(row: int, column: int) -> int:
        nonlocal size
        if (row, column) not in places:
            places[row, column] = (size, widths[column])
            size += widths[row] * widths[column]
        return places[row, column][0]

    first, node, lower, upper, diagonal = [0], [], [], [], []
    for k, pivot in enumerate(order):
        rest = sorted(below[k], key=rank.__getitem__)
        diagonal.append(place(pivot, pivot))
        for other in rest:
            node.append(rank[other])
            lower.append(place(other, pivot))
            upper.append(place(pivot, other))
        first.append(len(node))
    target = []
    for k in range(len(order)):
        rest = [order[r] for r in node[first[k] : first[k + 1]]]
        target += [place(row, column) for row in rest for column in rest]
    begin = np.concatenate([[0], np.cumsum([widths[n] for n in order])]).astype(int)
    at = [int(begin[rank[n]]) for n in range(len(widths))]
    arrays = {
        "size": [widths[n] for n in order],
        "start": begin[:-1],
        "diagonal": diagonal,
        "first": first,
        "node": node or [0],
        "lower": lower or [0],
        "upper": upper or [0],
        "target": target or [0],
        "place": _place(widths, starts, at),
    }
    plan = {name: np.ascontiguousarray(values, dtype=np.int64) for name, values in arrays.items()}
    return EliminationOrder(plan, places, size, max(widths, default=0))
