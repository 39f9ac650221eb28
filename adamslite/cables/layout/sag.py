"""The initial shape of a sagging span, and its unstretched length."""

from itertools import accumulate, pairwise
from math import sqrt

from adamslite.cables.description.vocabulary import Spec
from adamslite.cables.layout.brute_force_layout import Overstretched
from adamslite.cables.vectors import ZERO, Vector, add, dot, norm, part_across

# A fixed point that comes nearer by the strain of the cable in each.
ITERATIONS = 20


def hanging(
    spec: Spec, n: int, length: float, line: tuple[Vector, Vector], tension: float
) -> tuple[float, list[Vector]]:
    """A span of n sections at rest.

    Parameters
    ----------
    length : float
        From end to end [m].
    line : (Vector, Vector)
        Where the span begins, and its direction.
    tension : float
        At its lower end [N].

    Returns
    -------
    float
        Free length [m].
    list of Vector, n
        Places of the nodes, the far end included.
    """
    (place, along), cable = line, spec.cable
    weight = dot(spec.gravity, along)
    falls = _sag(spec, n, length, along, tension)
    drops = [norm(d) for d in (add(b, a, -1) for a, b in pairwise([ZERO, *falls]))]
    free = length
    for _ in range(ITERATIONS):
        node = cable.density * free / n * weight
        below = n + 0.5 if weight > 0 else 0.5
        pulls = [tension + node * (below - k) for k in range(1, n + 1)]
        steps = [free / n * (1 + pull / cable.stiffness) for pull in pulls]
        steps = [sqrt(max(h * h - d * d, 0.0)) for h, d in zip(steps, drops, strict=True)]
        if not any(steps):  # it sags by more than its length
            raise Overstretched
        free *= length / sum(steps)
    ways = zip(accumulate(steps), falls, strict=True)
    return free, [add(add(place, along, way), fall) for way, fall in ways]


def _sag(spec: Spec, n: int, length: float, along: Vector, tension: float) -> list[Vector]:
    """How far nodes 1 to n hang below the line: T (2 y_k - y_(k-1) - y_(k+1)) = rho h^2 g across,
    rho of the stretched cable.

    A cable that its tension hardly carries, T < rho g l/2, has no shape near a line: it is drawn
    as one.
    """
    h, density = length / n, spec.cable.density / (1 + tension / spec.cable.stiffness)
    across = part_across(spec.gravity, along)
    if tension < density * length * norm(across) / 2 or not tension:
        return [ZERO] * n
    share = density * h * h / (2 * tension)
    return [add(ZERO, across, share * k * (n - k)) for k in range(1, n + 1)]
