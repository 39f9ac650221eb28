"""Distances of markers whose weighted sum a GCON keeps.

With FUNCTION = c DM(i, j) + ..., the strength f pushes the markers apart by c f: the tension of the
span is -c f.
"""

from __future__ import annotations

from collections.abc import Iterator

from adamslite.drawing.drawing import Drawing
from adamslite.elements.gcon import Gcon
from adamslite.language.expression import NEGATE, Call, Node, Op, Ref, walk
from adamslite.language.interfaces import Key

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
