"""How far, how fast and under what load the cable moves, were it rigid.

One coordinate q, the travel of the cable along the route, payout when a winch drives it:

    (sum m + sum J/R**2 + rho L) q" = sum m g . d - engine force,       q' = v . d at the start

with d the direction of the route at each free end.
"""

from dataclasses import dataclass
from math import sqrt

from adamslite.cables.geometry import Span, add, dot
from adamslite.cables.law import Unknown, parse, value
from adamslite.cables.messages import Faults
from adamslite.cables.spec import Spec

INSTANTS = 400


@dataclass(frozen=True)
class Travel:
    """Payout or travel of the rigid cable: least and greatest way [m], speed, acceleration.

    `known` is false where an expression depends on what only the run knows.
    """

    least: float = 0.0
    most: float = 0.0
    least_at: float = 0.0
    speed: float = 0.0
    acceleration: float = 0.0
    jump: float = 0.0
    across: float = 0.0
    known: bool = True

    @property
    def way(self) -> float:
        """Of the cable over its wheels [m]."""
        return self.most - self.least


def travel(spec: Spec, spans: list[Span], faults: Faults) -> Travel:
    """The travel of the rigid cable over the whole run."""
    number, winch = next(
        ((i, each) for i, each in enumerate(spec.route) if each.kind == "winch"), (0, None)
    )
    across = max(_across(spec, spans))
    if winch:
        key = "payout" if winch.payout else "force"
        law = parse(getattr(winch, key), ("route", number, key), faults)
        if law is None:
            return Travel(across=across, known=False)
        try:
            if key == "payout":
                ways = [value(law, spec.end * i / INSTANTS, {}) for i in range(INSTANTS + 1)]
                if abs(ways[0]) > 1e-9:
                    faults.add("payout-start", ("route", number, key), value=ways[0])
                return from_ways(ways, spec.end / INSTANTS, across)
            return from_ways(_ways(spec, spans, law), spec.end / INSTANTS, across)
        except Unknown:
            return Travel(across=across, known=False)
    if any(each.kind == "fixed" for each in spec.route):
        return Travel(across=across)
    return from_ways(_ways(spec, spans, None), spec.end / INSTANTS, across)


def _across(spec: Spec, spans: list[Span]) -> list[float]:
    """Speed of each end across the cable [m/s]."""
    found = []
    for station, span in ((spec.route[0], spans[0]), (spec.route[-1], spans[-1])):
        v = station.velocity
        along = dot(v, span.along)
        side = add(v, span.along, -along)
        found.append(sqrt(dot(side, side)))
    return found


def moving_mass(spec: Spec) -> float:
    """Masses and pulleys that go with the cable [kg]."""
    wheels = sum(each.inertia / each.radius**2 for each in spec.route if each.is_wheel)
    return wheels + sum(each.mass for each in spec.route)


def _ways(spec: Spec, spans: list[Span], law) -> list[float]:
    """Ways of the rigid cable, at the ends of equal steps; symplectic Euler."""
    cable = spec.cable.density * sum(span.length for span in spans)
    inertia = moving_mass(spec) + cable
    # Payout is travel along the route from a winch at its start, against it to one at its end.
    sense = -1 if spec.route[-1].kind == "winch" else 1
    ends = ((spec.route[0], spans[0]), (spec.route[-1], spans[-1]))
    pull = sense * sum(each.mass * dot(spec.gravity, span.along) for each, span in ends)
    speed = sense * sum(dot(each.velocity, span.along) for each, span in ends)
    h, way, ways = spec.end / INSTANTS, 0.0, [0.0]
    for i in range(INSTANTS):
        held = value(law, i * h, {"S": way, "SD": speed}) if law else 0.0
        speed += h * (pull - held) / inertia
        way += h * speed
        ways.append(way)
    return ways


def from_ways(ways: list[float], h: float, across: float) -> Travel:
    """Rates from the ways at the ends of equal steps `h`, the first at time 0."""
    speeds = [(b - a) / h for a, b in zip(ways, ways[1:], strict=False)]
    changes = [(b - a) / h for a, b in zip(speeds, speeds[1:], strict=False)]
    least = min(ways)
    # A speed that is there from the first instant on, and not by the acceleration that follows.
    jump = abs(speeds[0] - changes[0] * h / 2)
    return Travel(
        least, max(ways), ways.index(least) * h, max(map(abs, speeds)), max(map(abs, changes)),
        jump if jump > 0.05 * max(map(abs, speeds)) else 0.0, across,
    )  # fmt: skip
