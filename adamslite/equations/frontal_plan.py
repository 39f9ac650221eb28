"""The plan of an elimination by fronts: native code finds order, tree and fronts; here are places.

Nodes are numbered in the order of elimination, in which every front has its own without a gap.
"""

from __future__ import annotations

import ctypes
from functools import cache
from itertools import chain

import numpy as np

from adamslite.equations.engine import address_of, distinct, ints
from adamslite.integrators.linalg.elimination_tree import NONE, Tree
from adamslite.integrators.linalg.minimum_degree import Graph
from adamslite.integrators.linalg.plan import Front, Run
from adamslite.native.translate import Record, Rows

LINALG = "adamslite.integrators.linalg."
# Room for elements beside all couplings, for each node; with one it is tidied more often.
SPARE = 3


class FrontalPlan:
    """Fronts of nodes with ``widths`` unknowns, coupled by the blocks (rows, columns).

    ``late[node]``: nodes that must have been eliminated before.

    Attributes
    ----------
    fronts, runs : Rows
        As native code takes them.
    place : ndarray
        Of the first unknown of each node in the order of elimination.
    size, room : int
        Entries of the factors, numbers of workspace.
    """

    def __init__(
        self, widths: np.ndarray, rows: np.ndarray, columns: np.ndarray, late: dict[int, set[int]]
    ) -> None:
        n = len(widths)
        apart = rows != columns
        pairs = rows[apart] * n + columns[apart], columns[apart] * n + rows[apart]
        self.row, self.column = np.divmod(distinct(np.concatenate(pairs)), n)
        order = _least_degree(widths, self.row, self.column, late)
        tree = _tree(widths, order, self.row, self.column)
        _call("elimination_tree.find_fronts", tree)
        of, count = tree.front, tree.fronts
        last = np.zeros(count, dtype=np.int64)
        np.maximum.at(last, of, np.arange(n))
        above = tree.parent[last]
        parent = np.where(above == NONE, NONE, of[above])
        by_front = np.argsort(of, kind="stable")
        self.order, self.front = order[by_front], of[by_front]
        self.rank = _inverse(self.order)
        self._find_rows(widths, parent)
        self._number(widths[self.order], parent, tree.before[:count])

    def _find_rows(self, widths: np.ndarray, parent: np.ndarray) -> None:
        """Nodes behind each front that are coupled to it, front by front."""
        tree = _tree(widths, self.order, self.row, self.column)
        tree.fronts, tree.front = len(parent), self.front
        tree.parent[: len(parent)] = parent
        _call("elimination_tree.find_rows", tree)
        counts = tree.wide[: len(parent)].copy()
        tree.rows = np.zeros(counts.sum(), dtype=np.int64)
        tree.wide[: len(parent)] = np.cumsum(counts) - counts
        if tree.rows.size:
            _call("elimination_tree.find_rows", tree)
        self.behind, self.owner = tree.rows, np.repeat(np.arange(len(parent)), counts)

    def _number(self, widths: np.ndarray, parent: np.ndarray, before: np.ndarray) -> None:
        """Unknowns, runs, and where everything stands; ``widths`` in the order of elimination."""
        count = len(parent)
        self.begin = np.concatenate([[0], np.cumsum(widths)])
        self.place = self.begin[self.rank]
        own = np.bincount(self.front, widths, count).astype(np.int64)
        rest = np.bincount(self.owner, widths[self.behind], count).astype(np.int64)
        start = np.cumsum(own) - own
        first = np.cumsum(rest) - rest
        wide = widths[self.behind]
        # Of the nodes behind a front, the first unknown among all of the front.
        self.at = own[self.owner] + np.cumsum(wide) - wide - first[self.owner]
        self.own, self.rest, self.start = own, rest, start
        places = own * (own + 2 * rest)
        self.panel = np.cumsum(places) - places
        self.lower = self.panel + own * (own + rest)
        self.size = int(places.sum())
        first_run = self._find_runs(widths, parent)
        keep, self.room = _stack(own, rest, before)
        table = (own, start, rest, self.panel, self.lower, first_run[:-1], first_run[1:], before)
        self.fronts = Rows(Front, np.ascontiguousarray(np.column_stack([*table, keep])))

    def _find_runs(self, widths: np.ndarray, parent: np.ndarray) -> np.ndarray:
        """Neighbours that stand together in the parent, too; returns the first run of each."""
        above = parent[self.owner]
        to = self._in_front(self.behind, above)
        outside = to >= self.own[above]
        begins = np.ones(len(self.behind), dtype=bool)
        begins[1:] = (
            (np.diff(self.owner) > 0) | (np.diff(self.behind) > 1) | (outside[1:] != outside[:-1])
        )
        number = np.cumsum(begins) - 1
        wide = np.bincount(number, widths[self.behind]).astype(np.int64)
        runs = [self.begin[self.behind[begins]], wide[: begins.sum()], to[begins]]
        self.runs = Rows(Run, np.ascontiguousarray(np.column_stack(runs)))
        return np.searchsorted(self.owner[begins], np.arange(len(parent) + 1))

    def _in_front(self, node: np.ndarray, front: np.ndarray) -> np.ndarray:
        """Which unknown of a front the first one of a node is."""
        n = len(self.front)
        found = np.searchsorted(self.owner * n + self.behind, front * n + node)
        inside = self.begin[node] - self.start[front]
        behind = np.append(self.at, 0)[found]
        return np.where(self.front[node] == front, inside, behind)

    def locate(self, rows: np.ndarray, columns: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Of blocks (row, column): the place of the first entry, and the leading dimension.

        A block is in the front of the node that is eliminated first.
        """
        r, c = self.rank[rows], self.rank[columns]
        front = self.front[np.minimum(r, c)]
        own, wide = self.own[front], self.own[front] + self.rest[front]
        i, j = self._in_front(r, front), self._in_front(c, front)
        below = i >= own
        at = np.where(below, self.lower[front] + (i - own) * own, self.panel[front] + i * wide)
        return at + j, np.where(below, own, wide)


@cache
def codes() -> np.ndarray:
    """Addresses of elimination by fronts: REAL, COMPLEX."""
    entries = ("fronts.work_on_fronts", "complex_fronts.work_on_complex_fronts")
    return ints([address_of(LINALG + entry) for entry in entries])


def _least_degree(
    widths: np.ndarray, row: np.ndarray, column: np.ndarray, late: dict[int, set[int]]
) -> np.ndarray:
    """Nodes in the order of their elimination; ``row column``: both ways and sorted."""
    n = len(widths)
    graph = Graph.zeros()
    for name in ("elements", "degree", "flag", "following", "before", "bucket", "member",
                 "last_member", "order"):  # fmt: skip
        setattr(graph, name, np.zeros(n, dtype=np.int64))
    graph.weight = widths.copy()
    graph.head = np.zeros(int(widths.sum()) + 1, dtype=np.int64)
    graph.length = np.bincount(row, minlength=n)
    graph.start = np.cumsum(graph.length) - graph.length
    graph.near = np.concatenate([column, np.zeros(SPARE * n + 1, dtype=np.int64)])
    graph.free = len(column)
    waiting = np.repeat(ints([*late]), ints([len(before) for before in late.values()]))
    before = ints([*chain.from_iterable(late.values())])
    graph.waits = np.bincount(waiting, minlength=n)
    graph.freed = waiting[np.argsort(before, kind="stable")]
    graph.freed_from = np.concatenate([[0], np.cumsum(np.bincount(before, minlength=n))])
    placed = _call("minimum_degree.minimum_degree", graph)
    assert placed == n
    return graph.order


def _tree(widths: np.ndarray, order: np.ndarray, row: np.ndarray, column: np.ndarray) -> Tree:
    """Nodes numbered in the order of elimination, each with those before that it is coupled to."""
    n, rank = len(order), _inverse(order)
    r, c = rank[row], rank[column]
    r, c = r[c < r], c[c < r]
    tree = Tree.zeros()
    tree.weight = widths[order]
    tree.first = np.concatenate([[0], np.cumsum(np.bincount(r, minlength=n))])
    tree.column = c[np.argsort(r, kind="stable")]
    for name in ("parent", "below", "wide", "entries", "front", "mark", "before"):
        setattr(tree, name, np.zeros(n, dtype=np.int64))
    return tree


def _stack(own: np.ndarray, rest: np.ndarray, before: np.ndarray) -> tuple[np.ndarray, int]:
    """Where each front leaves what it adds to its parent, and how high the stack becomes.

    It is formed on top of what its children have left, and moved down to where these began.
    """
    areas = (rest * rest).tolist()
    keep: list[int] = []
    top = highest = 0
    for k, (area, first) in enumerate(zip(areas, before.tolist(), strict=True)):
        # Beside it, while signs of pivots are counted, a copy of its own rows and columns.
        highest = max(highest, top + area)
        keep.append(top if first == k else keep[first])
        top = keep[k] + area
    return ints(keep), highest + 2 * int(own.max(initial=0)) ** 2


def _inverse(order: np.ndarray) -> np.ndarray:
    rank = np.zeros(len(order), dtype=np.int64)
    rank[order] = np.arange(len(order))
    return rank


def _call(name: str, record: Record) -> int:
    """A native function of one record."""
    return _native(name)(record.address)


@cache
def _native(name: str) -> ctypes._CFunctionType:
    return ctypes.CFUNCTYPE(ctypes.c_int64, ctypes.c_void_p)(address_of(LINALG + name))
