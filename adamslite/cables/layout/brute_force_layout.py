"""The initial positions of the sections of a cable that runs over wheels.

The way of the cable is made of lines and arcs. A section is a chord: the next node is the point of
the way at the distance h = L (1 + T/EA) from the last one, with the tension T there; the free
length L is that with which a whole number of sections reaches the end. On a wheel of radius R nodes
lie at R - T h/(R K), where a contact of stiffness K [N/m] carries them.
"""

from collections.abc import Callable
from dataclasses import dataclass
from math import acos, asin, atan2, cos, hypot, inf, pi, sin, sqrt

from scipy.optimize import brentq

from adamslite.cables.description.vocabulary import Spec
from adamslite.cables.layout.geometry import FreeSpan, wrap
from adamslite.cables.vectors import Vector, add, aside, cross, dot, part_across, unit

# A root to the last digits.
EXACTLY = {"xtol": 1e-15, "rtol": 1e-14}
Point = tuple[float, float]


@dataclass(frozen=True)
class Straight:
    """From `start` in the direction `along`."""

    start: Point
    along: Point
    length: float
    span: int

    def reach(self, p: Point, h: float, sunk: float, way: float) -> float:
        """How far on the point lies that is the distance h from p."""
        x, y = p[0] - self.start[0], p[1] - self.start[1]
        b = x * self.along[0] + y * self.along[1]
        return b + sqrt(max(b * b + h * h - x * x - y * y, 0.0))

    def point(self, way: float, sunk: float) -> Point:
        """The point so far on."""
        return self.start[0] + way * self.along[0], self.start[1] + way * self.along[1]

    def direction(self, way: float) -> Point:
        """Of the cable there."""
        return self.along


@dataclass(frozen=True)
class Arc:
    """Round a station, from an angle on, turning with `turn`; `held` by a wheel, or by nothing."""

    centre: Point
    radius: float
    start: float
    turn: int
    length: float
    station: int
    spans: tuple[int, int]
    held: bool = True

    def reach(self, p: Point, h: float, sunk: float, way: float) -> float:
        """How far on, along the rim, the point lies that is the distance h from p; without end
        where all of the rim is nearer."""
        r, x, y = self.radius - sunk, p[0] - self.centre[0], p[1] - self.centre[1]
        d = hypot(x, y)
        turned = acos(min(max((r * r + d * d - h * h) / (2 * r * d), -1.0), 1.0))
        if h > r + d:
            return inf
        come = self.turn * (atan2(y, x) - self.start) - way / self.radius
        # Whole turns do not count for where p is.
        come = (come + pi) % (2 * pi) - pi + way / self.radius
        return self.radius * (come + turned)

    def angle(self, way: float) -> float:
        """That the point has, about the centre."""
        return self.start + self.turn * way / self.radius

    def point(self, way: float, sunk: float) -> Point:
        """The point so far on."""
        a, r = self.angle(way), self.radius - sunk
        return self.centre[0] + r * cos(a), self.centre[1] + r * sin(a)

    def direction(self, way: float) -> Point:
        """Of the cable there."""
        a = self.angle(way)
        return -self.turn * sin(a), self.turn * cos(a)


Tension = Callable[[Straight | Arc, float, Vector], float]
"""Of a part, the way along it, and the place there."""


@dataclass(frozen=True)
class Plane:
    """Coordinates in the plane of the cable: x along `ahead`, y along `across`."""

    origin: Vector
    ahead: Vector
    across: Vector

    def seen(self, place: Vector) -> Point:
        """Coordinates of a place."""
        d = add(place, self.origin, -1)
        return dot(d, self.ahead), dot(d, self.across)

    def place(self, p: Point) -> Vector:
        """The place with these coordinates."""
        return add(add(self.origin, self.ahead, p[0]), self.across, p[1])

    def vector(self, p: Point) -> Vector:
        """The same for a direction."""
        return add(self.place(p), self.origin, -1)


@dataclass(frozen=True)
class CableNode:
    """A node at the start: its place, the direction of the cable, its way from the beginning."""

    place: Vector
    along: Vector
    way: float


@dataclass(frozen=True)
class Layout:
    """Nodes of a stretch of cable, the free length of its sections, and where its wheels are.

    `wheels` has, for every station whose rim the stretch lies on, the ways where it begins and
    ends to lie there.
    """

    nodes: list[CableNode]
    free: float
    wheels: dict[int, tuple[float, float]]


def plane(spec: Spec) -> Plane:
    """The plane across the axles."""
    axis = next(each.axis for each in spec.route if each.is_round)
    ahead = unit(part_across(aside(axis), axis))
    return Plane(spec.route[0].at, ahead, cross(axis, ahead))


def stretches(spec: Spec) -> list[list[int]]:
    """Spans, in groups between ends and weights; a loop is one group."""
    groups: list[list[int]] = []
    for p, (i, _) in enumerate(spec.pairs):
        if not groups or not (spec.route[i].is_round or spec.closed):
            groups.append([])
        groups[-1].append(p)
    return groups


def way(
    spec: Spec, spans: list[FreeSpan], group: list[int], stored: dict[int, float]
) -> list[Straight | Arc]:
    """Lines and arcs of a stretch; `stored` [m] is what winches at its ends hold."""
    flat = plane(spec)
    parts: list[Straight | Arc] = []
    first, last = spec.pairs[group[0]][0], spec.pairs[group[-1]][1]
    if not spec.closed and stored.get(first):
        span, rim = spans[group[0]], spec.route[first]
        back = stored[first] / rim.radius
        arc = _arc(spec, flat, first, span.start, stored[first], (group[0], group[0]))
        parts.append(Arc(arc.centre, arc.radius, arc.start - arc.turn * back, arc.turn,
                         arc.length, first, arc.spans))  # fmt: skip
    for p in group:
        span, j = spans[p], spec.pairs[p][1]
        along = dot(span.along, flat.ahead), dot(span.along, flat.across)
        parts.append(Straight(flat.seen(span.start), along, span.length, p))
        if spec.route[j].is_round and (spec.closed or j != last):
            length = spec.route[j].radius * wrap(spec, spans, j)
            parts.append(_arc(spec, flat, j, span.finish, length, (p, (p + 1) % len(spans))))
    if spec.closed:
        return _from_the_middle(parts)
    if not spec.closed and stored.get(last):
        at = spans[group[-1]].finish
        parts.append(_arc(spec, flat, last, at, stored[last], (group[-1], group[-1])))
    return parts


def _from_the_middle(parts: list[Straight | Arc]) -> list[Straight | Arc]:
    """A loop that begins in the middle of its first line, where no node is about to touch a rim."""
    line = parts[0]
    assert isinstance(line, Straight)
    half = line.length / 2
    return [
        Straight(line.point(half, 0.0), line.along, half, line.span), *parts[1:],
        Straight(line.start, line.along, half, line.span),
    ]  # fmt: skip


def _arc(spec: Spec, flat: Plane, i: int, at: Vector, length: float, spans: tuple[int, int]) -> Arc:
    each = spec.route[i]
    centre, (x, y) = flat.seen(each.at), flat.seen(at)
    angle = atan2(y - centre[1], x - centre[0])
    return Arc(centre, each.radius, angle, each.turn, length, i, spans, each.is_wheel)


def length(parts: list[Straight | Arc], pitch: float) -> float:
    """Of a stretch along lines and, for a chain of that pitch, the chords of its links [m]."""
    total = sum(part.length for part in parts)
    for part in parts:
        if pitch and isinstance(part, Arc):
            links = part.length / part.radius / 2 / asin(pitch / 2 / part.radius)
            total += links * pitch - part.length
    return total


def supply(spec: Spec, pieces: list[FreeSpan], i: int) -> float:
    """Cable that the winch at an end can wind in [m].

    Over wheels cable comes on: the span at the weight runs out; what is held stretches as a whole,
    and a block takes cable from all its falls.
    """
    group = stretches(spec)[0 if i == 0 else -1]
    last = group[-1] if i == 0 else group[0]
    blocks = any(each.is_wheel and each.gives_way for each in spec.route)
    if not blocks and any(spec.route[j].is_free for j in spec.pairs[last]):
        return pieces[last].length
    return sum(pieces[p].length for p in group)


class Overstretched(Exception):
    """A stretch of cable that its tension at rest makes longer by half, or more, or whose sections
    of that length [m] are too long for its wheels."""


def lay(
    spec: Spec,
    parts: list[Straight | Arc],
    count: int,
    tension: Tension,
    contact: float,
) -> Layout:
    """A stretch laid out as `count` sections.

    Parameters
    ----------
    parts : list of Straight and Arc
    count : int
    tension : callable
        Of the part, the way on it and the place: tension at rest [N].
    contact : float
        Stiffness of the contact of a node with a wheel [N/m].

    Raises
    ------
    Overstretched
    """
    total = sum(part.length for part in parts)
    walk = _Walk(spec, parts, tension, contact)
    # Tension stretches, arcs shorten: far less than by half.
    guess = total / count
    low, high = 0.5 * guess, 1.5 * guess
    try:
        brackets = walk(low, count)[1] < 0 < walk(high, count)[1]
    except (ArithmeticError, ValueError):  # stretched beyond all numbers
        brackets = False
    if not brackets:
        raise Overstretched(guess)
    free = brentq(lambda x: walk(x, count)[1], low, high, **EXACTLY)
    nodes, _ = walk(free, count)
    begins, at = {}, 0.0
    for part in parts:
        if isinstance(part, Arc) and part.held:
            begins[part.station] = at, at + part.length
        at += part.length
    return Layout(nodes, free, begins)


@dataclass(frozen=True)
class _Walk:
    """Goes along the parts section by section."""

    spec: Spec
    parts: list[Straight | Arc]
    tension: Callable[[Straight | Arc, float, Vector], float]
    contact: float

    def __call__(self, free: float, count: int) -> tuple[list[CableNode], float]:
        """The nodes for sections of the free length `free`, and how far beyond the end they go."""
        flat, parts = plane(self.spec), self.parts
        index, on, before = 0, 0.0, 0.0
        pull = self._pull(flat, parts[0], 0.0)
        p = parts[0].point(0.0, self._sunk(parts[0], pull, free))
        nodes = [self._node(flat, parts[0], p, 0.0, 0.0)]
        for _ in range(count):
            pull = self._pull(flat, parts[index], on + free / 2)
            h = free * (1 + pull / self.spec.cable.stiffness)
            while True:
                part = parts[index]
                sunk = self._sunk(part, pull, h)
                at = part.reach(p, h, sunk, on)
                if at <= part.length or index == len(parts) - 1:
                    break
                before, index, on = before + part.length, index + 1, 0.0
            p, on = part.point(at, sunk), at
            nodes.append(self._node(flat, part, p, at, before + at))
        return nodes, before + on - sum(part.length for part in parts)

    def _pull(self, flat: Plane, part: Straight | Arc, at: float) -> float:
        return self.tension(part, at, flat.place(part.point(at, 0.0)))

    def _sunk(self, part: Straight | Arc, pull: float, h: float) -> float:
        if isinstance(part, Arc) and part.held:
            return pull * h / part.radius / self.contact
        return 0.0

    def _node(
        self, flat: Plane, part: Straight | Arc, p: Point, at: float, way: float
    ) -> CableNode:
        return CableNode(flat.place(p), flat.vector(part.direction(at)), way)
