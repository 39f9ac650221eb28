"""Cables as continuous lines: chains of line forces, and spans that a GCON keeps.

Along a line that pulls, the tension is -f of an SFORCE, SPRINGDAMPER or GCON, positive when it
pulls its ends together.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import Any

import numpy as np

from adamslite.cables.chain_finder import Chain, Link, chains
from adamslite.cables.posture import Posture
from adamslite.drawing.drawing import Drawing
from adamslite.elements.gcon import Gcon
from adamslite.elements.vforce import Vforce
from adamslite.language.expression import Call, Ref, walk
from adamslite.language.interfaces import Key

Cable = dict[str, Any]


def cable_lines(drawing: Drawing) -> tuple[list[Cable], set[str], set[int]]:
    """All cables; labels of the statements and numbers of the bodies that they are made of."""
    found, taken, inner = [], set(), set()
    for chain in chains(drawing.deck, Posture(drawing.deck)):
        markers = list(_markers(chain))
        tensions = [_tension(drawing, link) for link in chain.links]
        name = f"{_name(chain.nodes[0])} to {_name(chain.nodes[-1])}"
        found.append(line(drawing, name, [_node(drawing, key) for key in markers], tensions))
        taken |= {link.statement.label for link in chain.links}
        inner |= {drawing.frames.body(key) for key in _inner(chain, markers)}
    return [*found, *_rigid(drawing)], taken, inner


def line(
    drawing: Drawing, name: str, nodes: list[dict[str, Any]], tensions: list[np.ndarray | None]
) -> Cable:
    """A cable through nodes, with the tension of each span where it is known."""
    known = [each for each in tensions if each is not None and np.isfinite(each).any()]
    blank = np.full(len(drawing.motion.time), np.nan)
    values = np.stack([blank if each is None else each for each in tensions], axis=1)
    bounds = [float(np.nanmin(known)), float(np.nanmax(known))] if known else [0.0, 0.0]
    tension = drawing.history(values) if known else None
    return {"name": name, "nodes": nodes, "tension": tension, "range": bounds}


def _node(drawing: Drawing, marker: Key) -> dict[str, Any]:
    return {"point": drawing.frames.point(marker)}


def _markers(chain: Chain) -> Iterator[Key]:
    """The marker of each node, on the link that comes to it."""
    first = chain.links[0]
    yield first.i if first.ends[0] == chain.nodes[0] else first.j
    for link, node in zip(chain.links, chain.nodes[1:], strict=True):
        yield link.i if link.ends[0] == node else link.j


def _inner(chain: Chain, markers: list[Key]) -> Iterable[Key]:
    return markers if chain.is_ring else markers[1:-1]


def _name(node: tuple[str, Key]) -> str:
    return f"{node[0]}/{node[1]}"


def _tension(drawing: Drawing, link: Link) -> np.ndarray | None:
    """Of one section, (nt,)."""
    label = link.statement.label
    if not isinstance(link.statement, Vforce):
        found = drawing.motion.column(f"{label}.f")
        return None if found is None else -found
    force = drawing.motion.columns(label, ("fx", "fy", "fz"))
    if force is None:
        return None
    along = drawing.motion.places(link.i) - drawing.motion.places(link.j)
    length = np.linalg.norm(along, axis=1)
    return -(force * along).sum(axis=1) / np.where(length > 0, length, 1.0)


def _rigid(drawing: Drawing) -> Iterator[Cable]:
    """Spans whose length a GCON keeps: the distances that it measures."""
    for gcon in drawing.deck.of(Gcon):
        pairs = _distances(gcon) if drawing.deck.is_active(gcon) else []
        force = drawing.motion.column(f"{gcon.label}.f") if pairs else None
        for i, j in pairs:
            nodes = [_node(drawing, i), _node(drawing, j)]
            yield line(drawing, gcon.label, nodes, [None if force is None else -force])


def _distances(gcon: Gcon) -> list[tuple[Key, Key]]:
    """Pairs of markers whose distance is measured."""
    calls = (each for each in walk(gcon.function) if isinstance(each, Call) and each.name == "DM")
    found = (tuple(arg.id if isinstance(arg, Ref) else 0 for arg in call.args) for call in calls)
    return list(dict.fromkeys((ends[0], ends[1]) for ends in found if len(ends) == 2))
