"""The spanning tree of a mechanism, and the constraints that close its loops.

A multiplier's pivot block is -G X G^T with X what the bodies eliminated so far can move.  It is
regular when the constraint carries its child in the tree, or, for a constraint that closes a loop,
when all of the loop has been eliminated.  Hence the elimination order must respect

    tree constraint   after its child body
    closing one       after every body and tree constraint on its loop
"""

from __future__ import annotations

from collections.abc import Sequence

GROUND = -1


def prerequisites(
    constraints: Sequence[tuple[int, frozenset[int], int]], widths: Sequence[int]
) -> dict[int, set[int]]:
    """What must be eliminated before each constraint.

    Parameters
    ----------
    constraints : sequence of (node, bodies, rows)
        Nodes of the constraints, the moving bodies each acts on, and its number of rows; a
        constraint that acts on one body holds it to the ground.
    widths : sequence of int
        Unknowns of each body.
    """
    parent = _spanning_tree(constraints, widths)
    held_by = {node: child for child, (node, _) in parent.items()}
    needed: dict[int, set[int]] = {}
    for node, bodies, _ in constraints:
        if node in held_by:
            needed[node] = {held_by[node]}
        else:
            needed[node] = _loop(sorted(bodies), parent)
    return needed


def _spanning_tree(
    constraints: Sequence[tuple[int, frozenset[int], int]], widths: Sequence[int]
) -> dict[int, tuple[int, int]]:
    """For each held body: (constraint node, body it is held to), found outwards from the ground."""
    at: dict[int, list[tuple[int, frozenset[int], int]]] = {}
    for constraint in sorted(constraints, key=lambda c: -c[2]):
        bodies = constraint[1]
        if len(bodies) <= 2:
            for body in bodies if len(bodies) == 2 else (*bodies, GROUND):
                at.setdefault(body, []).append(constraint)
    parent: dict[int, tuple[int, int]] = {}
    for root in (GROUND, *sorted(at)):
        if root in parent:
            continue
        front = [root]
        seen = {GROUND, root, *parent}
        while front:
            body = front.pop(0)
            for node, bodies, rows in at.get(body, ()):
                for child in bodies - seen:
                    if body != GROUND and len(bodies) == 1 or rows > widths[child]:
                        continue
                    parent[child] = (node, body)
                    seen.add(child)
                    front.append(child)
    return parent


def _loop(bodies: Sequence[int], parent: dict[int, tuple[int, int]]) -> set[int]:
    """Bodies and tree constraints between ``bodies`` and where their paths meet."""
    paths = [_path(body, parent) for body in bodies]
    together = set.intersection(*(set(path) for path in paths)) if len(paths) > 1 else set()
    needed: set[int] = set()
    for path in paths:
        for body in path:
            if body in together:
                break
            needed.add(body)
            if body in parent:
                needed.add(parent[body][0])
    return needed


def _path(body: int, parent: dict[int, tuple[int, int]]) -> list[int]:
    path = []
    while body != GROUND:
        path.append(body)
        body = parent[body][1] if body in parent else GROUND
    return path
