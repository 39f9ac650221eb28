"""The elimination order of the Newton matrix, fixed once per model.

Nodes are eliminated by least degree, a constraint's multipliers only after the bodies that make their own
block regular (:mod:`adamslite.topology`).  On a chain this works from the free ends inwards and
on a tree from the leaves to the root: no fill, cost proportional to the number of bodies.
Reference: George, Liu, SIAM Review 31 (1989) 1 (minimum degree).
"""

from __future__ import annotations

import heapq
from dataclasses import dataclass

import numpy as np

# Up to this many unknowns ordinary dense elimination with pivoting is as quick and safer.
DENSE = 36


@dataclass
class Elimination:
    """The plan for :mod:`adamslite.integrators.linalg` and where each block is copied to.

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
) -> Elimination:
    """Order and fill for nodes of ``widths`` unknowns at ``starts`` coupled by ``pairs``.

    ``late[node]``: nodes that must have been eliminated before ``node``; ``pivoting``: treat the matrix
    as one dense block.
    """
    total = sum(widths)
    if pivoting or total <= DENSE:
        return _dense(widths, starts, pairs, total)
    order, below = _order(len(widths), pairs, late)
    return _block_plan(widths, starts, order, below)


def _place(widths: list[int], starts: list[int], first: list[int]) -> np.ndarray:
    place = np.zeros(sum(widths), dtype=np.int64)
    for node, width in enumerate(widths):
        place[starts[node] : starts[node] + width] = first[node] + np.arange(width)
    return place


def _dense(
    widths: list[int], starts: list[int], pairs: set[tuple[int, int]], total: int
) -> Elimination:
    places = {(r, c): (starts[r] * total + starts[c], total) for r, c in pairs}
    empty = np.zeros(1, dtype=np.int64)
    plan = {name: empty for name in ("start", "diagonal", "node", "lower", "upper", "target")}
    plan |= {
        "size": np.array([total], dtype=np.int64),
        "first": np.zeros(2, dtype=np.int64),
        "place": np.arange(total, dtype=np.int64),
    }
    return Elimination(plan, places, total * total, total)


def _order(
    count: int, pairs: set[tuple[int, int]], late: dict[int, set[int]]
) -> tuple[list[int], list[list[int]]]:
    """Minimum degree order, and for each node those that stay coupled to it below."""
    near: list[set[int]] = [set() for _ in range(count)]
    for r, c in pairs:
        if r != c:
            near[r].add(c)
            near[c].add(r)
    done = [False] * count
    waiting = {node: set(before) for node, before in late.items() if before}
    heap = [(len(near[node]), node) for node in range(count) if node not in waiting]
    heapq.heapify(heap)
    freed: dict[int, list[int]] = {}
    for node, before in waiting.items():
        for each in before:
            freed.setdefault(each, []).append(node)
    order, below = [], []
    while len(order) < count:
        if not heap:
            node = min(waiting, key=lambda n: len(near[n]))
            waiting.pop(node)
            heap.append((len(near[node]), node))
        degree, node = heapq.heappop(heap)
        if done[node] or degree != len(near[node]):
            continue
        done[node] = True
        order.append(node)
        rest = near[node]
        below.append(sorted(rest))
        for other in rest:
            near[other] |= rest
            near[other] -= {other, node}
        for other in [*rest, *freed.pop(node, ())]:
            if other in waiting:
                waiting[other].discard(node)
                if not waiting[other]:
                    waiting.pop(other)
            if other not in waiting and not done[other]:
                heapq.heappush(heap, (len(near[other]), other))
    return order, below


def _block_plan(
    widths: list[int], starts: list[int], order: list[int], below: list[list[int]]
) -> Elimination:
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
    return Elimination(plan, places, size, max(widths))
