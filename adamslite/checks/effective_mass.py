"""Forces that depend on the acceleration of their own body: its effective mass.

A component F = e(..., A) with A the acceleration of the loaded body along that component gives

    m0 A = F + ...   hence   (m0 - de/dA) A = ...

so de/dA > 0 takes inertia away: the body runs off where m0 - de/dA reaches zero.  The d'Alembert
force of an added mass has de/dA = -(added mass).  The slope is formed on the expression itself;
reading a deck does not wait for an algebra system.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

from adamslite.deck.deck import Deck
from adamslite.elements.marker import Marker
from adamslite.elements.part import Part
from adamslite.elements.point_mass import PointMass
from adamslite.elements.vforce import Vforce
from adamslite.language.diagnostics import Diagnostic, Edit, Fix
from adamslite.language.expression import (
    NEGATE,
    Call,
    Node,
    Num,
    Op,
    Ref,
    Time,
    calls,
    operate,
    to_text,
    walk,
)
from adamslite.language.interfaces import Key
from adamslite.language.messages import compose

AXES = {"fx": "ACCX", "fy": "ACCY", "fz": "ACCZ"}
ZERO, ONE = Num(0.0), Num(1.0)
# Times at which time-only variables are evaluated to see whether the slope is ever positive.
SAMPLES = (0.0, 1e-3, 0.1, 1.0, 10.0)


def effective_masses(deck: Deck) -> Iterator[Diagnostic]:
    """A warning for each VFORCE that takes inertia away from its own body."""
    for force in deck.of(Vforce):
        body = _body(deck, force.i)
        if body is None or force.rm != 0:
            continue
        for field, name in AXES.items():
            slope = _own_slope(deck, getattr(force, field), name, body)
            if slope != ZERO and _can_be_positive(deck, slope):
                yield _warning(force, field, body.label, (body.mass or 0.0) / deck.ucf, slope)
                break


def _body(deck: Deck, marker_id: Key) -> Part | PointMass | None:
    marker = deck.find(Marker, marker_id)
    owner = marker.owner if marker else None
    body = deck.find(*owner) if owner else None
    return None if body is None or getattr(body, "ground", False) else body


def _own_slope(deck: Deck, component: Node, name: str, body: Part | PointMass) -> Node:
    """Sum of d(component)/d(acceleration) over the calls that measure this body against ground."""
    total: Node = ZERO
    for call in set(calls(component, name)):
        moving, against = call.args[0], call.args[1]
        if not isinstance(moving, Ref) or not moving.id or against != Ref("MARKER", 0):
            continue
        if _body(deck, moving.id) is body:
            total = _plus(total, slope_of(component, call))
    return total


def slope_of(node: Node, unknown: Call) -> Node:
    """Derivative of an expression with respect to one of its calls; zero where it is inside
    others.
    """
    if node == unknown:
        return ONE
    if not isinstance(node, Op):
        return ZERO
    slopes = [slope_of(arg, unknown) for arg in node.args]
    match node.op, node.args:
        case "+", _:
            return _plus(*slopes)
        case "-", _:
            return _plus(slopes[0], _negative(slopes[1]))
        case "neg", _:
            return _negative(slopes[0])
        case "*", (a, b):
            return _plus(_times(slopes[0], b), _times(a, slopes[1]))
        case "/", (_, b) if slopes[1] == ZERO:
            return slopes[0] if slopes[0] == ZERO or b == ONE else Op("/", (slopes[0], b))
    return ZERO


def _plus(a: Node, b: Node) -> Node:
    return b if a == ZERO else a if b == ZERO else Op("+", (a, b))


def _negative(a: Node) -> Node:
    if isinstance(a, Op) and a.op == NEGATE:
        return a.args[0]
    return a if a == ZERO else Op(NEGATE, (a,))


def _times(a: Node, b: Node) -> Node:
    if ZERO in (a, b):
        return ZERO
    return b if a == ONE else a if b == ONE else Op("*", (_plain(a), _plain(b)))


def _plain(a: Node) -> Node:
    return a.args[0] if isinstance(a, Op) and a.op == "/" and a.args[1] == ONE else a


def _can_be_positive(deck: Deck, slope: Node) -> bool:
    """Whether the slope is above zero at some sample time; unknown quantities count as one."""
    return any(_value(deck, slope, time) > 0.0 for time in SAMPLES)


def _value(deck: Deck, node: Node, time: float) -> float:
    match node:
        case Num(value):
            return value
        case Time():
            return time
        case Call("VARVAL", (Ref(kind, id),)):
            function = deck.find(kind, id).function
            own = any(isinstance(each, Ref) for each in walk(function))
            return 1.0 if own else _value(deck, function, time)
        case Op(op, args):
            return operate(op, [_value(deck, arg, time) for arg in args]) or 0.0
    return 1.0


def _warning(force: Vforce, field: str, body: str, mass: float, slope: Node) -> Diagnostic:
    """``mass`` is in units of force per acceleration, as the slope is."""
    fields = [each for each in AXES if force.given(each)]
    added = {each: f"{each.upper()}= -( {_source(force, each)} )" for each in fields}
    lines = " \\\n      ".join(f", {each}" for each in added.values())
    spans = force.spans.home(field)
    span = spans[field]
    edits = tuple(Edit(force.spans.home(each)[each], text) for each, text in added.items())
    warning = compose(
        "effective-mass",
        span,
        spans.quote(span),
        label=force.label,
        body=body,
        axis=field[1],
        mass=f"{mass:g} - {_in_product(_plain(slope))}",
        hint="as printed this removes inertia and the run stops where the effective mass reaches"
        f" zero; for a mass that is added write\n      {lines}",
    )
    return replace(warning, fixes=(Fix("turn the force round: a mass that is added", edits),))


def _in_product(slope: Node) -> str:
    text = to_text(slope)
    return f"({text})" if isinstance(slope, Op) and slope.op in "+-" else text


def _source(force: Vforce, field: str) -> str:
    """The expression as the deck has it, on one line."""
    text = force.spans.home(field).text(field)
    pieces = [piece.strip().removeprefix(",").strip() for piece in text.splitlines()]
    joined = " ".join(piece for piece in pieces if piece)
    return joined.partition("=")[2].strip().rstrip("\\/").strip()
