"""An order of elimination by approximate minimum degree, for nodes that may wait for others.

What is left of eliminated nodes is a quotient graph: an *element* stands for the clique that the
elimination of a node makes of its neighbours, and absorbs the elements that it touches.  The degree
of a node is bounded from above by its unknowns in common with the present element and those of its
other elements outside of it.  Nodes with the same neighbours are merged and eliminated together.
A node that waits (the multipliers of a constraint, :mod:`adamslite.equations.spanning_tree`) is on
no list of degrees and is not merged until all that it waits for has been eliminated.

Reference: Amestoy, Davis, Duff, SIAM J. Matrix Anal. Appl. 17 (1996) 886; Davis, Direct Methods for
Sparse Linear Systems, 2006, section 7.1.
"""

from __future__ import annotations

from adamslite.native.translate import Ints, Record, native

NONE = -1


class Graph(Record):
    """Nodes that are left, and elements, in one numbering.

    ``free``: first place of ``near`` that is not used; ``least``: no listed degree is below it;
    ``left``: unknowns that are left; ``mark``: flags below it are old; ``largest``: the most
    unknowns of an element; ``placed``: nodes in ``order``.

    For each node: ``weight``: its unknowns with those of the nodes merged into it, negative in the
    present element, 0 when eliminated or merged; ``start length``: its neighbours in ``near``, of
    which the first ``elements`` are elements; ``degree flag``; ``following before``: its
    neighbours on the list of its degree, which begins at ``head``; ``bucket``: lists of nodes that
    may be alike; ``waits``: for how many nodes; ``freed[freed_from[k]:freed_from[k + 1]]``: nodes
    that wait for k; ``member last_member``: nodes merged.
    """

    free: int
    least: int
    left: int
    mark: int
    largest: int
    placed: int
    weight: Ints
    start: Ints
    length: Ints
    elements: Ints
    degree: Ints
    flag: Ints
    following: Ints
    before: Ints
    head: Ints
    bucket: Ints
    waits: Ints
    freed_from: Ints
    freed: Ints
    member: Ints
    last_member: Ints
    near: Ints
    order: Ints


@native
def minimum_degree(G: Graph) -> int:
    """Fill ``G.order``; the fields of the nodes but ``weight start length waits freed*`` need not
    be set.  Returns how many nodes were placed.
    """
    prepare(G)
    while G.left > 0:
        k = next_node(G)
        take_off(G, k)
        place(G, k)
        if G.elements[k] > 0 and G.free + G.least >= G.near.size:
            compress(G)
        elements, weight, first = G.elements[k], G.weight[k], G.free
        if elements == 0:
            first = G.start[k]
        gather(G, k, first)
        note_overlaps(G, k)
        weight += update_neighbours(G, k)
        merge_alike(G, k)
        G.left -= weight
        finish(G, k)
        if elements > 0:
            G.free = first + G.length[k]
    return G.placed


@native
def prepare(G: Graph) -> None:
    """Degrees of all nodes, and their lists."""
    n = G.weight.size
    G.left, G.least, G.mark, G.largest, G.placed = 0, 0, 2, 0, 0
    for k in range(G.head.size):
        G.head[k] = NONE
    for k in range(n):
        G.left += G.weight[k]
        G.elements[k], G.flag[k], G.bucket[k] = 0, 1, NONE
        G.following[k], G.before[k], G.member[k], G.last_member[k] = NONE, NONE, NONE, k
        G.degree[k] = 0
        for p in range(G.start[k], G.start[k] + G.length[k]):
            G.degree[k] += G.weight[G.near[p]]
        if G.length[k] == 0:
            G.start[k] = NONE
    for k in range(n):
        if G.waits[k] == 0:
            put_on(G, k)


@native
def put_on(G: Graph, k: int) -> None:
    """Node k onto the list of its degree."""
    d = G.degree[k]
    first = G.head[d]
    if first != NONE:
        G.before[first] = k
    G.following[k], G.before[k], G.head[d] = first, NONE, k
    G.least = min(G.least, d)


@native
def take_off(G: Graph, k: int) -> None:
    """Node k off the list of its degree, on which it is unless it waits."""
    if G.waits[k] > 0:
        return
    after, before = G.following[k], G.before[k]
    if after != NONE:
        G.before[after] = before
    if before != NONE:
        G.following[before] = after
    else:
        G.head[G.degree[k]] = after


@native
def next_node(G: Graph) -> int:
    """A node of least degree; when all wait in a circle, the least coupled of those."""
    while G.least < G.head.size:
        if G.head[G.least] != NONE:
            return G.head[G.least]
        G.least += 1
    best = NONE
    for k in range(G.weight.size):
        if G.weight[k] > 0 and (best == NONE or G.degree[k] < G.degree[best]):
            best = k
    G.waits[best], G.least = 0, G.degree[best]
    put_on(G, best)
    return best


@native
def place(G: Graph, k: int) -> None:
    """Node k and those merged into it are next in the order; what waited for them may follow."""
    j = k
    while j != NONE:
        G.order[G.placed] = j
        G.placed += 1
        for p in range(G.freed_from[j], G.freed_from[j + 1]):
            i = G.freed[p]
            if G.waits[i] > 0:
                G.waits[i] -= 1
                if G.waits[i] == 0 and G.weight[i] > 0:
                    put_on(G, i)
        j = G.member[j]


@native
def compress(G: Graph) -> None:
    """Move what is left of ``near`` together: the first neighbour of each list stands in for the
    number of its node meanwhile.
    """
    near, start = G.near, G.start
    for j in range(G.weight.size):
        p = start[j]
        if p != NONE:
            start[j], near[p] = near[p], -j - 2
    p, q = 0, 0
    while p < G.free:
        j = -near[p] - 2
        p += 1
        if j >= 0:
            near[q], start[j] = start[j], q
            q += 1
            for _ in range(G.length[j] - 1):
                near[q] = near[p]
                p += 1
                q += 1
    G.free = q


@native
def gather(G: Graph, k: int, first: int) -> None:
    """The element of k: its neighbours and those of its elements, written from ``first`` on."""
    near, own, at, size = G.near, G.start[k], first, 0
    G.weight[k] = -G.weight[k]
    for turn in range(G.elements[k] + 1):
        e, p, count = k, own, G.length[k] - G.elements[k]
        if turn < G.elements[k]:
            e = near[own]
            own += 1
            p, count = G.start[e], G.length[e]
        for q in range(p, p + count):
            i = near[q]
            if G.weight[i] > 0:
                take_off(G, i)
                size += G.weight[i]
                G.weight[i] = -G.weight[i]
                near[at] = i
                at += 1
        if e != k:
            G.start[e], G.flag[e] = NONE, 0
    G.degree[k], G.start[k], G.length[k], G.elements[k] = size, first, at - first, 0


@native
def note_overlaps(G: Graph, k: int) -> None:
    """Flags of the elements around: ``mark`` and their unknowns outside of the element of k."""
    for p in range(G.start[k], G.start[k] + G.length[k]):
        i = G.near[p]
        for q in range(G.start[i], G.start[i] + G.elements[i]):
            e = G.near[q]
            if G.flag[e] >= G.mark:
                G.flag[e] += G.weight[i]
            elif G.flag[e] != 0:
                G.flag[e] = G.degree[e] + G.mark + G.weight[i]


@native
def update_neighbours(G: Graph, k: int) -> int:
    """Neighbours in the element of k take it for the elements that it covers; those with nothing
    else are eliminated with it.  Returns the unknowns of these.
    """
    with_it = 0
    for p in range(G.start[k], G.start[k] + G.length[k]):
        i = G.near[p]
        outside = shorten(G, i, k)
        if outside == 0 and G.waits[i] == 0:
            with_it -= G.weight[i]
            G.degree[k] += G.weight[i]
            G.weight[i], G.start[i] = 0, NONE
            place(G, i)
        else:
            G.degree[i] = min(G.degree[i], outside)
    G.largest = max(G.largest, G.degree[k])
    G.mark += G.largest
    return with_it


@native
def shorten(G: Graph, i: int, k: int) -> int:
    """The list of a neighbour i: element k, other elements that reach out of it, nodes outside.

    Returns a bound of the unknowns outside; i goes to the bucket of those that may be like it.
    """
    near, first = G.near, G.start[i]
    at, outside, key, beyond = first, 0, 0, first + G.elements[i]
    for p in range(first, beyond):
        e = near[p]
        if G.flag[e] > G.mark:
            outside += G.flag[e] - G.mark
            near[at] = e
            at += 1
            key += e
        elif G.flag[e] == G.mark:
            G.start[e], G.flag[e] = NONE, 0
    nodes = at
    G.elements[i] = at - first + 1
    for p in range(beyond, first + G.length[i]):
        j = near[p]
        if G.weight[j] > 0:
            outside += G.weight[j]
            near[at] = j
            at += 1
            key += j
    if outside > 0 or G.waits[i] > 0:
        # The place is there: k itself, or an element that it has absorbed, was on the list.
        near[at] = near[nodes]
        near[nodes] = near[first]
        near[first] = k
        G.length[i] = at - first + 1
        G.before[i] = NONE
        if G.waits[i] == 0:
            key = key % G.weight.size
            G.following[i], G.bucket[key], G.before[i] = G.bucket[key], i, key
    return outside


@native
def merge_alike(G: Graph, k: int) -> None:
    """Merge the nodes of the element of k that have the same neighbours."""
    for p in range(G.start[k], G.start[k] + G.length[k]):
        i = G.near[p]
        key = G.before[i]
        if G.weight[i] < 0 and key != NONE:
            i = G.bucket[key]
            G.bucket[key] = NONE
            while i != NONE:
                for q in range(G.start[i] + 1, G.start[i] + G.length[i]):
                    G.flag[G.near[q]] = G.mark
                absorb_alike(G, i)
                G.mark += 1
                i = G.following[i]


@native
def absorb_alike(G: Graph, i: int) -> None:
    """Merge into i what is behind it in its bucket and has the neighbours that are marked."""
    last, j = i, G.following[i]
    while j != NONE:
        after = G.following[j]
        if is_alike(G, i, j):
            G.weight[i] += G.weight[j]
            G.weight[j], G.start[j] = 0, NONE
            G.member[G.last_member[i]] = j
            G.last_member[i] = G.last_member[j]
            G.following[last] = after
        else:
            last = j
        j = after


@native
def is_alike(G: Graph, i: int, j: int) -> bool:
    """Whether all neighbours of j are marked, and as many as those of i."""
    if G.length[j] != G.length[i] or G.elements[j] != G.elements[i]:
        return False
    for q in range(G.start[j] + 1, G.start[j] + G.length[j]):
        if G.flag[G.near[q]] != G.mark:
            return False
    return True


@native
def finish(G: Graph, k: int) -> None:
    """The nodes left in the element of k back onto lists, with their new degrees."""
    at, size = G.start[k], G.degree[k]
    for p in range(G.start[k], G.start[k] + G.length[k]):
        i = G.near[p]
        own = -G.weight[i]
        if own > 0:
            G.weight[i] = own
            G.degree[i] = min(G.degree[i] + size - own, G.left - own)
            if G.waits[i] == 0:
                put_on(G, i)
            G.near[at] = i
            at += 1
    G.length[k], G.weight[k] = at - G.start[k], 0
    if G.length[k] == 0:
        G.start[k], G.flag[k] = NONE, 0
