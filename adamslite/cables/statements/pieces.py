"""The spans of a route as they are written: root, tip, numbers, and the cable that comes in."""

from dataclasses import dataclass
from math import ceil

from adamslite.cables.description.vocabulary import Spec
from adamslite.cables.layout.geometry import FreeSpan
from adamslite.cables.model.machine import at_height
from adamslite.cables.model.model_choice import tensions
from adamslite.cables.statements.forms import number
from adamslite.cables.statements.links import comes
from adamslite.cables.vectors import ZERO, Vector, add

# Strain over which a span becomes slack; part of a section that needs none.
SOFT, WHOLE = 1e-7, 1e-6
# Number of the first station; as many spans would have numbers of stations.
FIRST_STATION = 10


@dataclass(frozen=True)
class Piece:
    """A span as it is written: from its root, the wheel if there is one, to its tip.

    `sense` is 1 when it runs with the route; cable that the wheel at its root moves along the route
    then comes in.
    """

    number: int
    first: int
    label: int
    span: FreeSpan
    root: int
    tip: int
    place: Vector
    along: Vector
    sense: int
    tension: float
    sections: int = 1

    @property
    def ends(self) -> tuple[int, int]:
        """Its stations in the order of the route."""
        return (self.root, self.tip) if self.sense > 0 else (self.tip, self.root)


def pieces(spec: Spec, spans: list[FreeSpan], elements: int = 1) -> list[Piece]:
    """One for every span; between two wheels its sections are as long as those of the longest."""
    pulls = spec.rests or tensions(spec, spans)
    longest = max(span.length for span in spans) or 1.0  # a ring is all bend
    return [
        _piece(spec, p, span, pulls[p], max(ceil(elements * span.length / longest - WHOLE), 1))
        for p, span in enumerate(spans)
    ]


def _piece(spec: Spec, p: int, span: FreeSpan, tension: float, sections: int) -> Piece:
    i, j = spec.pairs[p]
    a, b = spec.route[i], spec.route[j]
    backwards = b.feeds and not a.feeds or a.kind == "run"
    backwards = backwards or a.kind == "hook" and b.kind == "fixed"
    root, tip = (j, i) if backwards else (i, j)
    sense = -1 if backwards else 1
    place = span.finish if backwards else span.start
    number = p + 1 + spec.numbers.spans
    first = 1000 * (number + spec.thousands)
    label = first if (spec.numbers.all_spans or len(spec.pairs)) >= FIRST_STATION else number
    if a.is_wheel and b.is_wheel:
        tension = at_height(spec, tension, add(span.start, span.along, span.length / 2))
    along = add(ZERO, span.along, sense)
    return Piece(number, first, label, span, root, tip, place, along, sense, tension, sections)


def feed(spec: Spec, piece: Piece, order: int = 0) -> str:
    """Cable that comes in at the wheel at the root of a piece, with its sign."""
    moved = comes(spec, piece.root, piece.first, order)
    return f"+{moved}" if piece.sense > 0 else f"-({moved})"


def is_between(spec: Spec, piece: Piece) -> bool:
    """Whether a piece lies between two wheels."""
    return spec.route[piece.root].is_wheel and spec.route[piece.tip].is_wheel


def root_marker(spec: Spec, piece: Piece) -> int:
    """The marker that the piece leaves."""
    return piece.first if spec.route[piece.root].feeds else spec.marker(piece.root)


def is_moving(spec: Spec, piece: Piece) -> bool:
    """Whether the piece lies between two wheels that do not both stay, or carry its pull on."""
    ends = [spec.route[i] for i in (piece.root, piece.tip)]
    return is_between(spec, piece) and any(each.is_mobile or each.leans for each in ends)


def inflow(spec: Spec, piece: Piece, order: int = 0) -> str:
    """Cable that comes onto a piece between two wheels, or its rate."""
    root = comes(spec, piece.root, piece.first, order)
    return f"{root}-({comes(spec, piece.tip, piece.first + 1, order)})"


def pulled(spec: Spec, pull: str) -> str:
    """A tension as the cable has it: a slack one may carry nothing."""
    return at_least_nothing(spec, pull) if spec.cable.pulls_only else pull


def parts_at(spec: Spec, piece: Piece) -> str:
    """VARIABLE/broken_p, 1 once a cable that parts has done so at the root of a piece."""
    p, m = piece.number, piece.first
    if not spec.cable.parts:
        return ""
    most = number(spec.cable.breaking)
    return (
        "! The cable parts there, for the rest of the run, where it carries so much.\n"
        f"SENSOR/{m}, FUNCTION=T{p}\\, VALUE={most}, ERROR=0, GE, EVALUATE=1\n"
        f"VARIABLE/broken_{p}, FUNCTION=SENVAL({m})\n"
    )


def parting(spec: Spec, piece: Piece, statement: str) -> str:
    """A force that is none once the piece has parted."""
    if not spec.cable.parts:
        return statement
    head, _, force = statement.partition("FUNCTION=")
    return f"{head}FUNCTION=(1-broken_{piece.number})*({force.rstrip()})\n"


def at_least_nothing(spec: Spec, force: str) -> str:
    """max(0, force): with a corner; beside wheels that grip, whose friction is smooth, as
    (f + sqrt(f^2 + d^2))/2, d a strain of SOFT, for many spans would stop at many corners."""
    if not spec.grips:
        return f"MAX(0,{force})"
    soft = number((SOFT * spec.cable.stiffness) ** 2)
    return f"({force}+SQRT(({force})**2+{soft}))/2"
