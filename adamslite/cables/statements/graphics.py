"""GRAPHICS of a cable scene: wheels, weights, and the cable as one line through its markers.

A comment after the OUTLINE of a cable gives `adamslite view` what the statement has no words for::

    GRAPHICS/1, OUTLINE=20,1002,1001,10
    ! adamslite: cable, wheel 10 -0.3
    ! adamslite: cable, tension -SFORCE/1003..1001.f

`wheel MARKER R`: the line goes round a wheel of the radius R about z of that marker; it turns
negatively about z along the line where R is negative.  `tension`: the result columns of the spans
between the markers, in their order, with a minus sign where pulling is negative, `..` between the
first and the last number of statements in a row, `none` where there is no column.
"""

from math import pi

from adamslite.cables.description.vocabulary import Spec
from adamslite.cables.layout.geometry import FreeSpan
from adamslite.cables.model.model_choice import CableModel
from adamslite.cables.statements.forms import number
from adamslite.cables.statements.pieces import Piece, is_between, pieces
from adamslite.cables.statements.sliders import is_wire
from adamslite.cables.statements.span_statements import is_kept, is_still
from adamslite.cables.statements.wheels import triple

STEEL = 7850.0
"""Density of the balls that are drawn for weights [kg/m^3]."""
WIDTH = 0.2
"""Of a wheel, over its radius."""
ROW = 68
"""Characters of a row, besides what introduces it."""


def solids(spec: Spec) -> str:
    """Wheels and weights."""
    text = "\n! ---- drawing ----\n"
    for i, each in enumerate(spec.route):
        n = spec.marker(i)
        if each.is_wheel:
            half, radius = number(WIDTH * each.radius / 2), number(each.radius)
            text += f"GRAPHICS/{n}, CYLINDER, CM={n}, LENGTH={half}, RADIUS={radius}\n"
            text += f"GRAPHICS/{n + 1}, CYLINDER, CM={n}, LENGTH=-{half}, RADIUS={radius}\n"
        elif each.mass > 0 and not each.on:
            d = f"{(6 * each.mass / (pi * STEEL)) ** (1 / 3):.3g}"
            text += f"GRAPHICS/{n}, ELLIPSOID, CM={n}, XSCALE={d}, YSCALE={d}, ZSCALE={d}\n"
    return text


def route_line(spec: Spec, spans: list[FreeSpan], model: CableModel) -> str:
    """The cable of levels 1 to 3, from station to station."""
    found = pieces(spec, spans)
    markers, tensions = [spec.marker(0)], []
    for piece in found:
        markers += [*_inner(spec, model, piece), spec.marker(piece.ends[1])]
        tensions.append(_tension(spec, model, piece))
    words = [
        f"wheel {spec.marker(i)} {number(each.turn * each.radius)}"
        for i, each in enumerate(spec.route)
        if each.is_wheel
    ]
    own = found[0].first if spec.numbers.name else 1
    return _far_ends(spec, found) + line(own, markers, words, tensions)


def line(s: int, markers: list[int], words: list[str], tensions: list[str]) -> str:
    """GRAPHICS/s through markers, with the comments that complete it."""
    first, *more = _rows([str(n) for n in markers], ",")
    text = f"GRAPHICS/{s}, OUTLINE={first}\n" + "".join(f", {row}\n" for row in more)
    text += "".join(f"! adamslite: cable, {row}\n" for row in _rows(words, ", "))
    return text + "".join(f"! adamslite: cable, tension {row}\n" for row in _rows(tensions, " "))


def _rows(items: list[str], between: str) -> list[str]:
    """Items in rows of limited length."""
    rows: list[str] = []
    for item in items:
        if rows and len(rows[-1] + between + item) <= ROW:
            rows[-1] += between + item
        else:
            rows.append(item)
    return rows


def _inner(spec: Spec, model: CableModel, piece: Piece) -> list[int]:
    """Markers of the nodes between the ends of a piece, along the route."""
    if model.level == 1 or not _is_chain(spec, piece):
        return []
    nodes = [piece.first + k for k in range(1, model.elements)]
    return nodes if piece.sense > 0 else nodes[::-1]


def _is_chain(spec: Spec, piece: Piece) -> bool:
    return spec.route[piece.tip].kind != "run" and not is_between(spec, piece)


def _tension(spec: Spec, model: CableModel, piece: Piece) -> str:
    """Result columns of a piece, along the route."""
    p, first = piece.number, piece.first
    if model.level == 1:
        if spec.route[piece.root].slides:
            return (
                "none"
                if is_wire(spec, piece.root)
                else f"-GCON/{piece.root + spec.numbers.spans}.f"
            )
        return f"-GCON/{piece.label}.f" if is_kept(spec, piece) else "none"
    if not _is_chain(spec, piece) or is_still(spec, model, piece):
        return f"VARIABLE/T{p}"
    ends = (first + 1, first + model.elements)
    start, end = ends if piece.sense > 0 else ends[::-1]
    return f"-SFORCE/{start}..{end}.f"


def _far_ends(spec: Spec, found: list[Piece]) -> str:
    """Markers of long runs that have none for their pull."""
    text = ""
    for piece in found:
        root = spec.route[piece.root]
        if spec.route[piece.tip].kind == "run" and root.is_wheel:
            if not (root.leans or root.mount):
                n, at = spec.marker(piece.tip), spec.route[piece.tip].at
                text += f"MARKER/{n}, PART=1, QP={triple(at)}  ! where the long run goes on\n"
    return text
