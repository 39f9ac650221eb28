"""A span between two wheels: one spring, whose mass lies half at either wheel.

    T       in the middle, EA (l/L - 1),  L = L0 + the cable that comes in less that which goes out
    T_i     = T +- rho L/2 (g.e - s"_i) at the wheels, e along the route, s_i the cable over wheel i

A span that moves with its wheels, or leaves one of them on a link, has no mass.
"""

from adamslite.cables.description.vocabulary import Spec
from adamslite.cables.statements.forms import number
from adamslite.cables.statements.links import borne, link, spun
from adamslite.cables.statements.pieces import (
    Piece,
    inflow,
    is_between,
    is_moving,
    parts_at,
    pulled,
)
from adamslite.cables.statements.wheels import carrier, travel, triple
from adamslite.cables.vectors import ZERO, add, dot


def is_heavy(spec: Spec, piece: Piece) -> bool:
    """Whether the piece is a span between two wheels that has its mass."""
    return is_between(spec, piece) and not is_moving(spec, piece)


def half(piece: Piece) -> str:
    """Mass of half of a span between two wheels."""
    return f"rho*LT{piece.number}/2"


def at_rest(spec: Spec, piece: Piece, i: int) -> str:
    """Tension of a span between two wheels at wheel i, but for the acceleration of the cable."""
    weight = dot(spec.gravity, piece.along)
    if not (weight and is_heavy(spec, piece)):
        return f"T{piece.number}"
    return f"T{piece.number}{'+' if i == piece.root else '-'}{half(piece)}*({number(weight)})"


def tension_at(spec: Spec, piece: Piece, i: int) -> str:
    """The same, with the acceleration."""
    if not is_heavy(spec, piece):
        return f"T{piece.number}"
    sign = "-" if i == piece.root else "+"
    return f"{at_rest(spec, piece, i)}{sign}{half(piece)}*({travel(i, spec, 2)})"


def touches(spec: Spec, piece: Piece, m: int, to: int) -> str:
    """MARKER/m where the piece touches the wheel at its root or, the second one, at its tip."""
    i, place, word = piece.root, piece.place, "leaves"
    if m > piece.first:
        i, place, word = piece.tip, piece.span.finish, "arrives"
    each = spec.route[i]
    if each.leans:
        tip = spec.route[piece.tip]
        # Between nodes the cable is at rest; alone it turns with its end.
        velocity = tip.velocity if to == spec.marker(piece.tip) else ZERO
        spin = spun(spec, i, piece.along, piece.span.length, velocity)
        return link(spec, i, m, place, to, spin)
    part = carrier(spec, i)
    place = add(place, each.origin if each.on else each.at, -1) if part > 1 else place
    return f"MARKER/{m}, PART={part}, QP={triple(place)}  ! cable {word}\n"


def write_link(spec: Spec, piece: Piece) -> str:
    """A span between two wheels: one spring."""
    p = piece.number
    text, spacing = apart(spec, piece)
    free = piece.span.length / (1 + piece.tension / spec.cable.stiffness)
    free = spec.frees[p - 1 - spec.numbers.spans] if spec.frees else free
    pull = f"EA*({spacing}/LT{p}-1)"
    if spec.cable.damping:
        rate = f"({inflow(spec, piece, 1)})"
        own = f"VR({piece.first},{piece.first + 1})" if is_moving(spec, piece) else ""
        pull += f"+damper*({own}-{rate}*{spacing}/LT{p})"
    if spec.cable.pulls_only and spec.grips:
        text += f"VARIABLE/pull_{p}, FUNCTION={pull}\n"
        pull = f"pull_{p}"
    pull = pulled(spec, pull)
    if is_moving(spec, piece):
        text += f"SFORCE/{piece.first}, I={piece.first}, J={piece.first + 1}, FUNCTION=-T{p}\n"
        a, b = piece.first, piece.first + 1
        text += borne(spec, piece.root, a, b, 1, f"T{p}")
        text += borne(spec, piece.tip, b, a, -1, f"T{p}")
    pull = f"(1-broken_{p})*({pull})" if spec.cable.parts else pull
    return (
        text
        + (
            "! One spring from wheel to wheel.\n"
            f"VARIABLE/LT{p}, FUNCTION={number(free)}+{inflow(spec, piece)}\n"
            f"VARIABLE/T{p}, FUNCTION={pull}\n"
        )
        + parts_at(spec, piece)
    )


def apart(spec: Spec, piece: Piece) -> tuple[str, str]:
    """Statements for, and the expression of the length of a span between two wheels."""
    if not is_moving(spec, piece):
        return "", number(piece.span.length)
    i, j = piece.first, piece.first + 1
    return touches(spec, piece, j, i), f"DM({i},{j})"
