"""Where the cable touches its wheels, and whether it gets in its own way.

A wheel of radius R about C with the axis a turns with the cable, in the direction of the route
positively (turn = 1) or negatively (-1). Where the cable has the direction d it touches at

    P = C + turn R d x a,

so along a span from wheel i to wheel j, with D = C_j - C_i, k = turn_j R_j - turn_i R_i and d at
the angle q to D:  sin q = -k/|D|.
"""

from dataclasses import dataclass, replace
from math import sqrt

from adamslite.cables.messages import Faults
from adamslite.cables.spec import Spec, Station, Vector


@dataclass(frozen=True)
class Span:
    """A free piece of cable: its ends [m] and direction in the sense of the route."""

    start: Vector
    finish: Vector
    along: Vector
    length: float


def add(a: Vector, b: Vector, factor: float = 1.0) -> Vector:
    """a + factor b."""
    x, y, z = (p + factor * q for p, q in zip(a, b, strict=True))
    return x, y, z


def dot(a: Vector, b: Vector) -> float:
    """Scalar product."""
    return sum(p * q for p, q in zip(a, b, strict=True))


def cross(a: Vector, b: Vector) -> Vector:
    """Vector product."""
    return a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]


def unit(a: Vector) -> Vector:
    """a/|a|; a zero vector stays."""
    size = sqrt(dot(a, a))
    return add((0.0, 0.0, 0.0), a, 1 / size if size else 0.0)


def turned(spec: Spec) -> Spec:
    """The description with unit axes, and with the turn of every wheel."""
    route = list(spec.route)
    for i, each in enumerate(route):
        axis = unit(each.axis)
        before, behind = route[max(i - 1, 0)].at, route[min(i + 1, len(route) - 1)].at
        side = dot(cross(add(each.at, before, -1), add(behind, each.at, -1)), axis)
        route[i] = replace(each, axis=axis, turn=each.turn or (-1 if side < 0 else 1))
    return replace(spec, route=tuple(route))


def spans(spec: Spec, faults: Faults) -> list[Span]:
    """All free pieces of the cable; says which cannot be."""
    found = []
    for i, (a, b) in enumerate(zip(spec.route, spec.route[1:], strict=False)):
        span = _span(a, b, i, faults)
        if span:
            found.append(span)
    if not faults.errors:
        _crossings(spec, found, faults)
    return found


def _span(a: Station, b: Station, i: int, faults: Faults) -> Span | None:
    between = add(b.at, a.at, -1)
    spacing = sqrt(dot(between, between))
    place = ("route", i + 1, "at")
    if spacing == 0:
        faults.add("zero-span", place, i=i + 1, j=i + 2)
        return None
    axis = a.axis if a.is_wheel else b.axis
    e = unit(between)
    m = unit(cross(axis, e))
    if (a.is_wheel or b.is_wheel) and dot(m, m) < 0.5:
        faults.add("axis-along-cable", ("route", i if a.is_wheel else i + 1, "axis"))
        return None
    k = b.turn * b.radius - a.turn * a.radius
    reach = a.radius + b.radius
    if reach >= spacing:
        faults.add("radius-over-spacing", place, i=i + 1, j=i + 2, spacing=spacing)
        return None
    sine = -k / spacing
    along = add(add((0.0, 0.0, 0.0), e, sqrt(1 - sine**2)), m, sine)
    start = add(a.at, cross(along, a.axis), a.turn * a.radius)
    finish = add(b.at, cross(along, b.axis), b.turn * b.radius)
    way = add(finish, start, -1)
    return Span(start, finish, unit(way), sqrt(dot(way, way)))


def _crossings(spec: Spec, found: list[Span], faults: Faults) -> None:
    """Two pieces that meet, or a piece that runs through a wheel it does not touch."""
    for i, span in enumerate(found):
        for j in range(i + 1, len(found)):
            # Neighbours meet at a point of no size only by turning back onto each other.
            if apart(span, found[j]) < 1e-9 * (span.length + found[j].length) and (
                j > i + 1 or dot(span.along, found[j].along) < -1 + 1e-12
            ):
                what = f"spans {i + 1}-{i + 2} and {j + 1}-{j + 2} meet"
                faults.add("crossing", ("route", j, "at"), what=what)
        for j, wheel in enumerate(spec.route):
            if wheel.is_wheel and j not in (i, i + 1):
                centre = Span(wheel.at, wheel.at, (0.0, 0.0, 0.0), 0.0)
                if apart(span, centre) < wheel.radius * (1 - 1e-9):
                    what = f"span {i + 1}-{i + 2} runs through the wheel of station {j + 1}"
                    faults.add("crossing", ("route", j, "at"), what=what)


def apart(p: Span, q: Span) -> float:
    """Least distance of two straight pieces [m]."""
    between, b = add(p.start, q.start, -1), dot(p.along, q.along)
    d, e, wide = dot(p.along, between), dot(q.along, between), 1 - b * b
    s = (b * e - d) / wide if wide > 1e-12 and q.length else 0.0
    s = min(max(s, 0.0), p.length)
    t = min(max(e + b * s, 0.0), q.length)
    s = min(max(b * t - d, 0.0), p.length)
    way = add(add(between, p.along, s), q.along, -t)
    return sqrt(dot(way, way))
