"""The tree of an elimination, and its fronts: nodes that are eliminated together.

The parent of a node is the first of those coupled to it when it is eliminated.  Row i of the factor
reaches from each entry of row i of the matrix up the tree to i, which gives the number of entries
of each column without the entries themselves (Liu, SIAM J. Matrix Anal. Appl. 11 (1990) 134).

A front takes a node and its parent together when few entries of the factor are zeros because of it:
fewer and larger dense blocks (Ashcraft, Grimes, ACM Trans. Math. Softw. 15 (1989) 291).
"""

from __future__ import annotations

from adamslite.native.translate import Ints, Record, native

NONE = -1
# Fronts up to so many unknowns may have such a share of zeros.
TINY_FRONT, SMALL_FRONT, FRONT = 6, 24, 96
SOME, FEW, NEARLY_NONE = 0.5, 0.1, 0.05


class Tree(Record):
    """Nodes in the order of elimination.

    ``weight``: unknowns; ``first column``: ``column[first[i]:first[i + 1]]`` are the nodes before i
    that are coupled to it; ``parent``; ``below``: unknowns after a node that are coupled to it when
    it is eliminated; ``wide entries``: unknowns and entries of the front so far; ``front``: that of
    each node; ``mark``: workspace.

    Of fronts: ``before``: the first front of its subtree; ``rows``: nodes behind each that are
    coupled to it.
    """

    fronts: int
    weight: Ints
    first: Ints
    column: Ints
    parent: Ints
    below: Ints
    wide: Ints
    entries: Ints
    front: Ints
    mark: Ints
    before: Ints
    rows: Ints


@native
def find_fronts(T: Tree) -> int:
    """The tree, and ``front`` of each node: fronts are numbered such that each comes behind all of
    its subtree, and this without a gap.  Returns how many there are.
    """
    find_parents(T)
    count_rows(T)
    join(T)
    number_fronts(T)
    return T.fronts


@native
def find_parents(T: Tree) -> None:
    """``parent``; ``mark`` has shortcuts up the tree."""
    for i in range(T.weight.size):
        T.parent[i], T.mark[i] = NONE, NONE
        for p in range(T.first[i], T.first[i + 1]):
            k = T.column[p]
            while k != NONE and k < i:
                after = T.mark[k]
                T.mark[k] = i
                if after == NONE:
                    T.parent[k] = i
                k = after


@native
def count_rows(T: Tree) -> None:
    """``below``: every row adds its unknowns to the columns that it reaches."""
    for i in range(T.weight.size):
        T.below[i], T.mark[i] = 0, i
        for p in range(T.first[i], T.first[i + 1]):
            k = T.column[p]
            while T.mark[k] != i:
                T.mark[k] = i
                T.below[k] += T.weight[i]
                k = T.parent[k]


@native
def join(T: Tree) -> None:
    """``mark``: whether a node belongs to the front of its parent."""
    n = T.weight.size
    for k in range(n):
        T.wide[k] = T.weight[k]
        T.entries[k] = T.weight[k] * (T.weight[k] + 2 * T.below[k])
    for k in range(n):
        T.mark[k] = 0
        p = T.parent[k]
        if p != NONE:
            wide, entries = T.wide[k] + T.wide[p], T.entries[k] + T.entries[p]
            if is_worth(wide, wide * (wide + 2 * T.below[p]), entries):
                T.mark[k], T.wide[p], T.entries[p] = 1, wide, entries


@native
def is_worth(wide: int, places: int, entries: int) -> bool:
    """Whether a front of so many unknowns, places and entries is better than two."""
    zeros = float(places - entries) / places
    if wide <= TINY_FRONT:
        return zeros <= SOME
    if wide <= SMALL_FRONT:
        return zeros <= FEW
    return places == entries or (wide <= FRONT and zeros <= NEARLY_NONE)


@native
def number_fronts(T: Tree) -> None:
    """``front``, ``before`` and ``fronts``: ranges of numbers are given away from the roots down.

    Of the last node of each front: ``wide``: itself, ``below``: how many fronts its subtree has,
    ``entries``: the number behind the range that its children have left.
    """
    T.fronts = 0
    for k in range(T.weight.size - 1, -1, -1):  # parents are met before their children
        T.wide[k] = T.wide[T.parent[k]] if T.mark[k] else k
        T.below[k] = 0
    for k in range(T.weight.size):
        if not T.mark[k]:
            T.below[k] += 1
            if T.parent[k] == NONE:
                T.fronts += T.below[k]
            else:
                T.below[T.wide[T.parent[k]]] += T.below[k]
    left = T.fronts
    for k in range(T.weight.size - 1, -1, -1):
        if T.mark[k]:
            T.front[k] = T.front[T.wide[k]]
        else:
            behind = left
            if T.parent[k] == NONE:
                left -= T.below[k]
            else:
                p = T.wide[T.parent[k]]
                behind = T.entries[p]
                T.entries[p] -= T.below[k]
            T.front[k], T.entries[k] = behind - 1, behind - 1
            T.before[behind - 1] = behind - T.below[k]


@native
def find_rows(T: Tree) -> int:
    """Nodes are numbered anew, ``parent`` is that of fronts: the rows of each front in ascending
    order, put to the places that ``wide`` begins with, or only counted there.
    """
    for f in range(T.fronts):
        T.mark[f] = NONE
    for i in range(T.weight.size):
        own = T.front[i]
        for p in range(T.first[i], T.first[i + 1]):
            f = T.front[T.column[p]]
            while f != own and T.mark[f] != i:
                T.mark[f] = i
                if T.rows.size > 0:
                    T.rows[T.wide[f]] = i
                T.wide[f] += 1
                f = T.parent[f]
    return T.fronts
