"""The tangent points of the cable on its wheels, and intersections of the route with itself.

A wheel of radius R about C with the axis a turns with the cable, in the direction of the route
positively (turn = 1) or negatively (-1). Where the cable has the direction d it touches at

    P = C + turn R d x a,

so along a span from wheel i to wheel j, with D = C_j - C_i, k = turn_j R_j - turn_i R_i and d at
the angle q to D:  sin q = -k/|D|.
"""

from dataclasses import dataclass, replace
from math import atan2, pi, sqrt

from adamslite.cables.description.messages import Faults
from adamslite.cables.description.vocabulary import Spec, Station
from adamslite.cables.vectors import ZERO, Vector, add, aside, cross, dot, norm, unit

# Of lengths, as a share; of the cosine of two directions that are one.
ROUND_OFF, PARALLEL = 1e-9, 1e-12


@dataclass(frozen=True)
class FreeSpan:
    """A free piece of cable: its ends [m] and direction in the sense of the route."""

    start: Vector
    finish: Vector
    along: Vector
    length: float


def turned(spec: Spec) -> Spec:
    """The description with unit axes, and with the turn of every wheel."""
    route, n = list(spec.route), len(spec.route)
    for i, each in enumerate(route):
        axis = unit(each.axis)
        if spec.closed:
            before, behind = route[i - 1].at, route[(i + 1) % n].at
        else:
            before, behind = route[max(i - 1, 0)].at, route[min(i + 1, n - 1)].at
        side = dot(cross(add(each.at, before, -1), add(behind, each.at, -1)), axis)
        # A loop of two stations has no side: all its wheels turn alike.
        route[i] = replace(each, axis=axis, turn=each.turn or (-1 if side < 0 else 1),
                           leans=each.leans or each.wander is not None)  # fmt: skip
    return replace(spec, route=tuple(route))


def spans(spec: Spec, faults: Faults) -> list[FreeSpan]:
    """All free pieces of the cable; says which cannot be."""
    found = []
    for i, j in spec.pairs:
        a, b = spec.route[i], spec.route[j]
        span = _span(a, b, (i, j), faults) if i != j else _ring(a)
        if span:
            found.append(span)
    if len(found) == len(spec.pairs):
        _crossings(spec, found, faults)
    return found


def wrap(spec: Spec, spans: list[FreeSpan], i: int) -> float:
    """Angle over which the cable goes round station i, 0 to 2 pi; 0 at an end."""
    p, q = spec.beside(i)
    if p < 0 or q < 0:
        return 0.0
    if p == q:
        return 2 * pi
    a, b, axis = spans[p].along, spans[q].along, spec.route[i].axis
    return spec.route[i].turn * atan2(dot(cross(a, b), axis), dot(a, b)) % (2 * pi)


def reaches(spec: Spec, spans: list[FreeSpan]) -> list[float]:
    """Lengths of cable from one support or drive to the next: of spans, joined by the
    bends between them [m].
    """
    found = [span.length for span in spans]
    lengths: list[float] = []
    for p, (i, _) in enumerate(spec.pairs):
        bent = spec.route[i].kind == "bend"
        arc = spec.route[i].radius * wrap(spec, spans, i) if bent else 0.0
        if bent and lengths:
            lengths[-1] += arc + found[p]
        else:
            lengths.append(arc + found[p])
    if spec.closed and len(lengths) > 1 and spec.route[0].kind == "bend":
        lengths[0] += lengths.pop()
    return lengths


def _ring(each: Station) -> FreeSpan:
    """Of a loop that is nothing but a circle: the point where it begins."""
    along = unit(cross(each.axis, aside(each.axis)))
    place = add(each.at, cross(along, each.axis), each.turn * each.radius)
    return FreeSpan(place, place, along, 0.0)


def _span(a: Station, b: Station, at: tuple[int, int], faults: Faults) -> FreeSpan | None:
    between = add(b.at, a.at, -1)
    spacing = norm(between)
    i, j = at[0] + 1, at[1] + 1
    place = ("route", max(at), "at")
    if spacing == 0:
        faults.add("zero-span", place, i=i, j=j)
        return None
    axis = a.axis if a.is_round else b.axis
    e = unit(between)
    m = unit(cross(axis, e))
    if (a.is_round or b.is_round) and dot(m, m) < 0.5:
        faults.add("axis-along-cable", ("route", at[0] if a.is_round else at[1], "axis"))
        return None
    k = b.turn * b.radius - a.turn * a.radius
    reach = a.radius + b.radius
    if reach >= spacing:
        faults.add("radius-over-spacing", place, i=i, j=j, spacing=spacing)
        return None
    sine = -k / spacing
    along = add(add(ZERO, e, sqrt(1 - sine**2)), m, sine)
    start = add(a.at, cross(along, a.axis), a.turn * a.radius)
    finish = add(b.at, cross(along, b.axis), b.turn * b.radius)
    way = add(finish, start, -1)
    return FreeSpan(start, finish, unit(way), norm(way))


def _crossings(spec: Spec, found: list[FreeSpan], faults: Faults) -> None:
    """Two pieces that meet, or a piece that runs through a wheel it does not touch."""
    count = len(found)
    for p, near in enumerate(_neighbours(spec, found)):
        span = found[p]
        for q in near:
            if q < count:
                # Neighbours meet at a point of no size only by turning back onto each other.
                beside = set(spec.pairs[p]) & set(spec.pairs[q])
                if apart(span, found[q]) < ROUND_OFF * (span.length + found[q].length) and (
                    len(beside) != 1 or dot(span.along, found[q].along) < -1 + PARALLEL
                ):
                    what = f"spans {_name(spec, p)} and {_name(spec, q)} meet"
                    faults.add("crossing", ("route", spec.pairs[q][0], "at"), what=what)
            elif q - count not in spec.pairs[p]:
                j = q - count
                wheel = spec.route[j]
                centre = FreeSpan(wheel.at, wheel.at, ZERO, 0.0)
                if apart(span, centre) < wheel.radius * (1 - ROUND_OFF):
                    what = f"span {_name(spec, p)} runs through the wheel of station {j + 1}"
                    faults.add("crossing", ("route", j, "at"), what=what)


def _neighbours(spec: Spec, found: list[FreeSpan]) -> list[list[int]]:
    """Of every span p the spans q > p, and the wheels j as len(found) + j, whose extents along the
    longest axis of the scene overlap with its own: a sweep along that axis."""
    ends = [(span.start, span.finish, 0.0) for span in found]
    ends += [(each.at, each.at, each.radius if each.is_round else -1.0) for each in spec.route]
    sizes = [max(max(a[k], b[k]) for a, b, _ in ends) - min(min(a[k], b[k]) for a, b, _ in ends)
             for k in range(3)]  # fmt: skip
    k, slack = sizes.index(max(sizes)), ROUND_OFF * max(sizes)
    extents = sorted(
        (min(a[k], b[k]) - radius - slack, max(a[k], b[k]) + radius + slack, i)
        for i, (a, b, radius) in enumerate(ends) if radius >= 0
    )  # fmt: skip
    near: list[list[int]] = [[] for _ in found]
    open_ones: list[tuple[float, int]] = []
    for least, most, i in extents:
        open_ones = [each for each in open_ones if each[0] >= least]
        for _, other in open_ones:
            p, q = min(i, other), max(i, other)
            if p < len(found):
                near[p].append(q)
        open_ones.append((most, i))
    return [sorted(each) for each in near]


def _name(spec: Spec, p: int) -> str:
    i, j = spec.pairs[p]
    return f"{i + 1}-{j + 1}"


def apart(p: FreeSpan, q: FreeSpan) -> float:
    """Least distance of two straight pieces [m]."""
    between, b = add(p.start, q.start, -1), dot(p.along, q.along)
    d, e, wide = dot(p.along, between), dot(q.along, between), 1 - b * b
    s = (b * e - d) / wide if wide > PARALLEL and q.length else 0.0
    s = min(max(s, 0.0), p.length)
    t = min(max(e + b * s, 0.0), q.length)
    s = min(max(b * t - d, 0.0), p.length)
    way = add(add(between, p.along, s), q.along, -t)
    return norm(way)
