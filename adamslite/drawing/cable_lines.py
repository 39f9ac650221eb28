"""Cables as continuous lines: those that a comment describes, chains of line forces, and spans
whose length a GCON keeps.

Along a line that pulls, the tension is -f of an SFORCE, SPRINGDAMPER or GCON.

With FUNCTION = c DM(i, j) + ... of a GCON, its strength f pushes the markers apart by c f: the
tension of the span is -c f.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, field
from math import inf
from statistics import median
from typing import Any

import numpy as np

from adamslite.cables.recognition.chain_finder import (
    ALIKE,
    FEWEST,
    Chain,
    Link,
    along_lines,
    chains,
    rows,
)
from adamslite.cables.recognition.posture import Posture
from adamslite.drawing.cable_comments import CableComment, cable_comment
from adamslite.drawing.drawing import Drawing
from adamslite.drawing.pulley_ropes import Pulleys, Rope
from adamslite.drawing.winding import rim, wound
from adamslite.elements.gcon import Gcon
from adamslite.elements.graphics import Graphics
from adamslite.elements.vforce import Vforce
from adamslite.language.expression import NEGATE, Call, Node, Op, Ref, walk
from adamslite.language.interfaces import Key

Cable = dict[str, Any]
Tension = np.ndarray | None


@dataclass
class Cables:
    """All cables of a scene.

    ``taken``: labels of the statements that they are made of or drawn by; ``inner``: numbers of
    the bodies that are their masses; ``ropes``: of those that are pieces of them; ``wheels``:
    markers and radii of what they go round.
    """

    lines: list[Cable] = field(default_factory=list)
    taken: set[str] = field(default_factory=set)
    inner: set[int] = field(default_factory=set)
    ropes: set[int] = field(default_factory=set)
    wheels: dict[Key, float] = field(default_factory=dict)


def cables(drawing: Drawing, statements: list[Graphics]) -> Cables:
    """Those of comments first; what they are made of is drawn once."""
    found = Cables(wheels=wound(drawing))
    for statement in statements:
        enough = len(statement.outline) > 1
        comment = cable_comment(drawing.deck, statement) if enough else None
        if comment:
            _described(drawing, found, statement, comment)
    for chain in _chains(drawing):
        if not any(link.statement.label in found.taken for link in chain.links):
            _chained(drawing, found, chain)
    pulleys = Pulleys(drawing)
    for rope in pulleys.ropes():
        _over_pulleys(drawing, found, pulleys, rope)
    found.lines += _rigid(drawing, found)
    return found


def _line(drawing: Drawing, name: str, nodes: list[Cable], tensions: Sequence[Tension]) -> Cable:
    """A cable through nodes, with the tension of each span where it is known."""
    known = [each for each in tensions if each is not None and np.isfinite(each).any()]
    blank = np.full(len(drawing.motion.time), np.nan)
    values = np.stack([blank if each is None else each for each in tensions], axis=1)
    numbers = values[np.isfinite(values)]
    bounds = [float(numbers.min()), float(numbers.max())] if known else [0.0, 0.0]
    tension = drawing.history(values) if known else None
    return {"name": name, "nodes": nodes, "tension": tension, "range": bounds}


# ---- of comments -----------------------------------------------------------------------------


def _described(drawing: Drawing, found: Cables, statement: Graphics, comment: CableComment) -> None:
    """The cable of an OUTLINE whose comments say more."""
    keys = list(statement.outline)
    nodes = [_node(drawing, key, comment.wheels.get(key)) for key in keys]
    tensions = [_column(drawing, each) for each in comment.tensions]
    _note(drawing, statement, comment, len(keys))
    tensions = (tensions + [None] * len(keys))[: len(keys) - 1]
    if keys[0] == keys[-1] and keys[0] in comment.wheels and len(keys) > 2:
        nodes.append(nodes[1])  # once more along the first span: round the wheel between them
        tensions.append(tensions[0])
    found.lines.append(_line(drawing, statement.name or statement.label, nodes, tensions))
    found.taken |= {statement.label}
    found.taken |= {name.partition(".")[0] for _, name in comment.tensions if name}
    found.wheels |= {key: abs(r) for key, r in comment.wheels.items()}
    ends = () if keys[0] == keys[-1] else (keys[0], keys[-1])
    drawn = {each.marker for each in drawing.deck.of(Graphics) if not each.outline}
    between = [key for key in keys if key not in (*ends, *comment.wheels, *drawn)]
    found.inner |= _light(drawing, between)


def _note(drawing: Drawing, statement: Graphics, comment: CableComment, nodes: int) -> None:
    """Notes on words of a comment that have no meaning here."""
    where = f"comment of {statement.label}"
    away = [str(key) for key in comment.wheels if key not in statement.outline]
    missing = [n for _, n in comment.tensions if n and n not in drawing.results]
    if comment.unknown:
        drawing.notes.append(f"{where}: '{comment.unknown[0]}' means nothing")
    if away:
        drawing.notes.append(f"{where}: the line does not go through MARKER/{away[0]}")
    if missing and len(drawing.results.time):
        more = f" and {len(missing) - 1} more" if len(missing) > 1 else ""
        drawing.notes.append(f"{where}: the results have no {missing[0]}{more}")
    if comment.tensions and len(comment.tensions) != nodes - 1:
        drawing.notes.append(f"{where}: {len(comment.tensions)} tensions for {nodes - 1} spans")


def _column(drawing: Drawing, signed: tuple[float, str]) -> Tension:
    sign, name = signed
    values = drawing.motion.column(name) if name else None
    return None if values is None else sign * values


def _node(drawing: Drawing, marker: Key, radius: float | None = None) -> Cable:
    """A point that the line goes through, or a wheel that it goes round."""
    if radius is None:
        return {"point": drawing.frames.point(marker)}
    sense = 1 if radius > 0 else -1
    return {"wheel": drawing.frames.frame(marker), "radius": abs(radius), "sense": sense}


def _between_rims(
    drawing: Drawing, found: Cables, markers: list[Key], is_ring: bool = False
) -> list[Cable]:
    """Nodes of a line whose ends may be where it leaves a wheel."""
    nodes = [_node(drawing, key) for key in markers]
    for end, after in () if is_ring else ((0, 1), (-1, -2)):
        touched = rim(drawing, found.wheels, markers[end], markers[after])
        if touched:
            marker, radius = touched
            nodes[end] = _node(drawing, marker, radius if end == 0 else -radius)
    return nodes


# ---- chains of line forces -------------------------------------------------------------------


def _chained(drawing: Drawing, found: Cables, chain: Chain) -> None:
    markers = list(_markers(chain))
    name = f"{_name(chain.nodes[0])} to {_name(chain.nodes[-1])}"
    tensions = [_tension(drawing, link) for link in chain.links]
    nodes = _between_rims(drawing, found, markers, chain.is_ring)
    found.lines.append(_line(drawing, name, nodes, tensions))
    found.taken |= {link.statement.label for link in chain.links}
    found.inner |= _light(drawing, list(_inner(chain, markers)))


def _chains(drawing: Drawing) -> list[Chain]:
    """Those that `check` finds, and rows of line forces whatever their law; the longest first."""
    posture = Posture(drawing.deck)
    found = rows(drawing.deck, along_lines(drawing.deck, posture), alike=inf)
    found = [*chains(drawing.deck, posture), *(row for row in found if len(row.links) >= FEWEST)]
    return sorted(found, key=lambda chain: -len(chain.links))


def _markers(chain: Chain) -> Iterator[Key]:
    """The marker of each node, on the link before it."""
    first = chain.links[0]
    yield first.i if first.ends[0] == chain.nodes[0] else first.j
    for link, node in zip(chain.links, chain.nodes[1:], strict=True):
        yield link.i if link.ends[0] == node else link.j


def _inner(chain: Chain, markers: list[Key]) -> Iterable[Key]:
    return markers if chain.is_ring else markers[1:-1]


def _light(drawing: Drawing, markers: list[Key]) -> set[int]:
    """Of the moving bodies of markers those that are pieces of a cable: no weights on it."""
    numbers = {drawing.frames.body(key) for key in markers} - {0}
    masses = {number: drawing.model.bodies[number - 1].mass for number in numbers}
    most = ALIKE * median(masses.values()) if masses else 0.0
    return {number for number, mass in masses.items() if mass < most}


def _name(node: tuple[str, Key]) -> str:
    return f"{node[0]}/{node[1]}"


def _tension(drawing: Drawing, link: Link) -> Tension:
    """Of one section, (nt,)."""
    label = link.statement.label
    if not isinstance(link.statement, Vforce):
        return _column(drawing, (-1.0, f"{label}.f"))
    force = drawing.motion.columns(label, ("fx", "fy", "fz"))
    if force is None:
        return None
    along = drawing.motion.places(link.i) - drawing.motion.places(link.j)
    length = np.linalg.norm(along, axis=1)
    tension: np.ndarray = -(force * along).sum(axis=1) / np.where(length > 0, length, 1.0)
    return tension


# ---- guided ropes of pulleys -----------------------------------------------------------------


def _over_pulleys(drawing: Drawing, found: Cables, pulleys: Pulleys, rope: Rope) -> None:
    """From an end, or the first wheel, round each wheel to the other end.

    A rope between two wheels is one span: two sides, of which the first has its tension.
    """
    first, last = rope.sides[0][0], rope.sides[-1]
    nodes = [_node(drawing, pulleys.end(first.rope, first.joint.i))]
    tensions: list[Tension] = []
    for k, (side, leaves) in enumerate(rope.sides):
        if not leaves:
            sense = -side.leaving if last[0] is side else rope.sides[k + 1][0].leaving
            nodes.append(_node(drawing, side.joint.i, sense * side.radius))
        if not leaves and k == 0 or leaves:
            tensions.append(side.tension)
    if last[1]:
        nodes.append(_node(drawing, pulleys.end(last[0].rope, last[0].joint.i)))
    found.lines.append(_line(drawing, f"rope over {first.joint.label}", nodes, tensions))
    found.ropes |= {side.rope for side, _ in rope.sides}
    found.wheels |= {side.joint.i: side.radius for side, _ in rope.sides}


# ---- spans of constant length ----------------------------------------------------------------


def _rigid(drawing: Drawing, found: Cables) -> Iterator[Cable]:
    """The distances that GCONs measure."""
    for gcon in drawing.deck.of(Gcon):
        if gcon.label in found.taken or not drawing.deck.is_active(gcon):
            continue
        for i, j, factor in kept_spans(drawing, gcon):
            tension = _column(drawing, (-factor, f"{gcon.label}.f")) if factor else None
            yield _line(drawing, gcon.label, _between_rims(drawing, found, [i, j]), [tension])


Span = tuple[Key, Key, float | None]
"""Markers and the factor of their distance; None where that is not constant."""


def kept_spans(drawing: Drawing, gcon: Gcon) -> list[Span]:
    """All distances that a GCON measures, each once."""
    found: dict[tuple[Key, Key], float | None] = {}
    for i, j, factor in _terms(drawing, gcon.function, 1.0):
        before = found.get((i, j), 0.0)
        found[i, j] = None if factor is None or before is None else before + factor
    return [(i, j, factor) for (i, j), factor in found.items()]


def _terms(drawing: Drawing, node: Node, factor: float) -> Iterator[Span]:
    """The distances in a sum and their factors."""
    constant = drawing.model.constant
    if isinstance(node, Op) and node.op in ("+", "-", NEGATE):
        signs = {"+": (1.0, 1.0), "-": (1.0, -1.0), NEGATE: (-1.0,)}[node.op]
        for sign, part in zip(signs, node.args, strict=True):
            yield from _terms(drawing, part, sign * factor)
    elif isinstance(node, Op) and node.op == "*" and constant(node.args[0]) is not None:
        yield from _terms(drawing, node.args[1], factor * (constant(node.args[0]) or 0.0))
    elif isinstance(node, Op) and node.op in "*/" and constant(node.args[1]):
        number = constant(node.args[1]) or 1.0
        yield from _terms(
            drawing, node.args[0], factor * (number if node.op == "*" else 1 / number)
        )
    elif isinstance(node, Call) and node.name == "DM":
        yield (*_ends(node), factor)
    else:
        for each in walk(node):
            if isinstance(each, Call) and each.name == "DM":
                yield (*_ends(each), None)


def _ends(call: Call) -> tuple[Key, Key]:
    """Markers I and J; ground for one that is not named."""
    i, j = ((arg.id if isinstance(arg, Ref) else 0) for arg in (*call.args, None)[:2])
    return i, j
