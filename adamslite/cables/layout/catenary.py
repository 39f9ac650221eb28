"""The start of a cable of given length between two points: a catenary that does not stretch.

With half the angle u between its ends, sinh(u)/u = sqrt(L^2 - v^2)/x, where x is the distance level
and v upright; the tension is w a cosh t, a = x/(2 u). From a bed, where it starts level, z up:
lifted length s = sqrt(z^2 + 2 a z) over a asinh(s/a), the rest lies.

H. M. Irvine, Cable Structures, 1981, section 1.2.
"""

from collections.abc import Callable
from dataclasses import dataclass
from math import acosh, asinh, atanh, cosh, exp, log, sinh, sqrt

from adamslite.cables.description.surroundings import height
from adamslite.cables.description.vocabulary import Spec
from adamslite.cables.vectors import ZERO, Vector, add, dot, norm, part_across, unit

# Of the length: ends that are less far apart level are drawn so far apart, and pushed together.
NARROW = 1e-3
HALVINGS = 200


@dataclass(frozen=True)
class Start:
    """Places of n + 1 nodes, and a tension in the middle [N]."""

    places: list[Vector]
    tension: float


def start(spec: Spec, n: int) -> Start:
    """Of the cable from the first to the last station."""
    a, b = (spec.route[i].at for i in (0, -1))
    between, length = add(b, a, -1), spec.cable.length
    spacing = norm(between)
    if length <= spacing:
        strain = spacing / length - 1
        places = [add(a, between, k / n) for k in range(n + 1)]
        return Start(places, spec.cable.stiffness * strain)
    up = add(ZERO, unit(spec.gravity), -1)
    weight = spec.cable.density * norm(spec.gravity) * spec.lightness(b)
    way = part_across(between, up)
    level, rise = norm(way), dot(between, up)
    x = max(level, NARROW * length)
    found, pull = _lying(spec, n, x, (a, b)) or _free(n, length, x, rise)
    along = add(ZERO, unit(way), level / x)
    places = [add(add(a, along, s), up, z) for s, z in found]
    return Start([_on_bed(spec, place, up) for place in places], abs(weight) * pull)


def _free(n: int, length: float, x: float, rise: float) -> tuple[list[tuple[float, float]], float]:
    """Places (level, upright) from the first end, and the tension over the weight per length."""
    ratio = sqrt(length**2 - rise**2) / x
    u = _root(lambda u: sinh(u) / u - ratio, 1e-9, acosh(ratio) + log(4 * ratio) + 1)
    a, first = x / (2 * u), atanh(rise / length) - u
    turns = [asinh(sinh(first) + length * k / n / a) for k in range(n + 1)]
    return [(a * (t - first), a * (cosh(t) - cosh(first))) for t in turns], a


def _lying(
    spec: Spec, n: int, x: float, ends: tuple[Vector, Vector]
) -> tuple[list[tuple[float, float]], float] | None:
    """The same where one end is on the bed and a part of the cable lies on it; else None."""
    if not spec.bed:
        return None
    levels = [height(spec.gravity, end) - spec.bed.level for end in ends]
    low, z, length = min(levels), max(levels) - min(levels), spec.cable.length
    if abs(low) > spec.cable.diameter or z <= 0 or length - z > x + z:
        return None

    def lies(a: float) -> float:
        return length - sqrt(z * z + 2 * a * z)

    def misses(log_a: float) -> float:
        a = exp(log_a)
        return lies(a) + a * asinh((length - lies(a)) / a) - x

    last = log((length**2 - z**2) / (2 * z))
    if misses(last) < 0:
        return None
    a = exp(_root(misses, log(1e-9 * length), last))
    rest = lies(a)
    found = []
    for k in range(n + 1):
        s = max(length * k / n - rest, 0.0)
        found.append((length * k / n - s + a * asinh(s / a), sqrt(a * a + s * s) - a))
    if levels[0] > levels[1]:
        found = [(x - far, up - z) for far, up in reversed(found)]
    return found, a


def _root(of: Callable[[float], float], low: float, high: float) -> float:
    """Where a growing function is 0."""
    for _ in range(HALVINGS):
        middle = (low + high) / 2
        low, high = (low, middle) if of(middle) > 0 else (middle, high)
    return (low + high) / 2


def _on_bed(spec: Spec, place: Vector, up: Vector) -> Vector:
    """A place, raised to the bed where it is below."""
    if not spec.bed:
        return place
    below = spec.bed.level + spec.cable.diameter / 2 - height(spec.gravity, place)
    return add(place, up, max(below, 0.0))
