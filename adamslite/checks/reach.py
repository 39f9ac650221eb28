"""Notes about contacts and stops that a mechanism is too short to reach."""

from __future__ import annotations

from collections.abc import Iterator
from math import hypot, inf
from typing import TYPE_CHECKING

from adamslite.checks.lints import run_end
from adamslite.deck.deck import Deck
from adamslite.deck.statement_diagnostics import diagnose
from adamslite.elements.bases.contact_point import POINT, ContactPoint
from adamslite.language.diagnostics import Diagnostic
from adamslite.language.expression import Call, Num, Op, Ref, walk
from adamslite.language.statement import expressions

if TYPE_CHECKING:
    import numpy as np

    from adamslite.assembly.reach import Reach
    from adamslite.elements.bases.contact_forms import Form
    from adamslite.language.expression import Node
    from adamslite.language.interfaces import Key
    from adamslite.language.statement import Statement

#: Of the lengths that are compared: joints are closed to less.
SURE = 1e-6
STOPS = {"IMPACT": (2, None), "BISTOP": (2, 3)}
SWITCHES = ("ACTIVATE", "DEACTIVATE")


def out_of_reach(deck: Deck) -> Iterator[Diagnostic]:
    """Contacts and stops whose two sides the joints keep apart."""
    if not run_end(deck) or deck.user.called or any(map(deck.of, SWITCHES)):
        return
    stopped = [each for each in deck.statements if hasattr(each, "loads") and _stops(each)]
    if not (deck.of("CONTACT") or stopped):
        return
    from adamslite.assembly.reach import Reach
    from adamslite.model.model import Model

    model = Model(deck)
    reach = Reach(model)
    found: dict[tuple[str, Key], float] = {}
    for each in deck.of(POINT) if deck.of("CONTACT") else ():
        key = ("CONTACT", each.contact)
        found[key] = min(found.get(key, inf), _gap(reach, each))
    for force in stopped:
        found[force.keyword, force.key] = min(_least(reach, call) for call in _stops(force))
    for key, gap in found.items():
        if 0.0 < gap < inf and deck.is_active(deck.find(*key)):
            statement = deck.find(*key)
            what = statement.label if key[0] == "CONTACT" else f"the stop in {statement.label}"
            yield diagnose(statement, "out-of-reach", what=what, gap=f"{gap:.3g}")


def _stops(statement: Statement) -> list[Call]:
    nodes = (each for node in expressions(statement) for each in walk(node))
    return [each for each in nodes if isinstance(each, Call) and each.name in STOPS]


# ---- contacts -----------------------------------------------------------------------------------


def _gap(reach: Reach, point: ContactPoint) -> float:
    """The least distance of two forms that the joints allow; below 0 where none is known."""
    first, second = point.first, point.second
    if first.kind == "PLANE":
        first, second = second, first
    radius = _radius(first)
    if second.kind != "PLANE":
        return _sure(*_apart(reach, first.marker, second.marker), radius + _radius(second))
    place = reach.model.marker(second.marker)
    if place.kind != "ground":
        return -inf
    normal = place.axes[:, 2]
    heights = ((float(normal @ (a - place.p)), far) for a, far in reach.anchors(first.marker))
    return max((_sure(height, far, radius) for height, far in heights), default=-inf)


def _radius(form: Form) -> float:
    """Of a ball about the marker that holds a form."""
    sizes = form.sizes
    match form.kind:
        case "BALL":
            return float(sizes[0])
        case "CYLINDER" | "RIM":
            return abs(float(sizes[0])) + hypot(*map(float, sizes[1:3]))
        case "BOX" | "CORNER":
            return hypot(*map(float, sizes[:3])) + hypot(*map(float, sizes[3:]))
    return inf


def _apart(reach: Reach, i: Key, j: Key) -> tuple[float, float]:
    """Of the anchors of two markers those that keep them apart most: their distance, and how far
    the markers may be from them together.
    """
    import numpy as np

    best = (0.0, inf)
    ends = list(reach.anchors(j))
    for a, far in reach.anchors(i):
        for b, other in ends:
            apart = float(np.linalg.norm(a - b))
            if apart - far - other > best[0] - best[1]:
                best = apart, far + other
    return best


def _sure(apart: float, far: float, taken: float) -> float:
    """What is left of a distance, if it is more than the round-off of joints."""
    left = apart - far - taken
    return left if left > SURE * (abs(apart) + far + taken) else -inf


# ---- stops --------------------------------------------------------------------------------------


def _least(reach: Reach, call: Call) -> float:
    """How far a stop is out of reach of what it is a stop of; below 0 where that is not known."""
    low, high = _range(reach, call.args[0])
    first, last = STOPS[call.name]
    below, above = call.args[first], None if last is None else call.args[last]
    if not isinstance(below, Num) or not (above is None or isinstance(above, Num)):
        return -inf
    left = low - below.value
    if isinstance(above, Num):
        left = min(left, above.value - high)
    return left if left > SURE * (abs(below.value) + abs(low)) else -inf


def _range(reach: Reach, node: Node) -> tuple[float, float]:
    """The least and the largest value of a distance, with numbers added or taken away."""
    match node:
        case Num(value):
            return value, value
        case Op("neg", (each,)):
            low, high = _range(reach, each)
            return -high, -low
        case Op(("+" | "-") as op, (a, b)):
            low, high = _range(reach, a)
            least, most = _range(reach, b)
            return (low + least, high + most) if op == "+" else (low - most, high - least)
        case Call(("DM" | "DX" | "DY" | "DZ") as name, args):
            keys = [ref.id if isinstance(ref, Ref) else 0 for ref in args]
            return _measured(reach, name, *(*keys, 0, 0)[:3])
    return -inf, inf


def _measured(reach: Reach, name: str, i: Key, j: Key, k: Key) -> tuple[float, float]:
    import numpy as np

    if name == "DM":
        apart, far = _apart(reach, i, j) if j else _apart_from_origin(reach, i)
        return max(apart - far, 0.0), apart + far if far < inf else inf
    axis = np.eye(3)["XYZ".index(name[1])]
    if k:
        frame = reach.model.marker(k)
        if frame.kind != "ground":
            return -inf, inf
        axis = frame.axes @ axis
    origin = np.zeros(3)
    if j:
        place = reach.model.marker(j)
        if place.kind != "ground":
            return -inf, inf
        origin = place.p
    return _along(reach, i, axis, origin)


def _along(reach: Reach, i: Key, axis: np.ndarray, origin: np.ndarray) -> tuple[float, float]:
    low, high = -inf, inf
    for a, far in reach.anchors(i) if i else ():
        height = float(axis @ (a - origin))
        low, high = max(low, height - far), min(high, height + far)
    return low, high


def _apart_from_origin(reach: Reach, i: Key) -> tuple[float, float]:
    import numpy as np

    found = ((float(np.linalg.norm(a)), far) for a, far in reach.anchors(i))
    return max(found, key=lambda each: each[0] - each[1], default=(0.0, inf))
