"""Estimates of travel, speed and load of a cable, as if it were rigid.

Payout by a law is what the law says.  Else one coordinate q, the travel of the cable along the
route, payout where an engine holds it back:

    (sum m + sum J/R**2 + rho L) q" = sum m g . d - engine force,       q' = v . d at the start

with d the direction of the route at each free end.
"""

from collections.abc import Callable
from dataclasses import dataclass, field, replace
from math import dist, inf

import numpy as np

from adamslite.cables.description.messages import Faults
from adamslite.cables.description.payout_law import NoValue, Unknown, parse, value
from adamslite.cables.description.toml_places import Path
from adamslite.cables.description.vocabulary import Spec
from adamslite.cables.layout.geometry import FreeSpan
from adamslite.cables.vectors import add, dot
from adamslite.language.expression import Node, Num, Op

#: Ways [m] at instants.
Ways = Callable[[np.ndarray], np.ndarray]
INSTANTS = 400
# Of laws in the order of motions along x, y and z.
HAUL = 3
# A law that starts within this is at zero [m].
AT_ZERO = 1e-9
# Accelerations that differ by less than this share are equally large.
ALIKE = 1e-6
# Share of the greatest speed from which a speed at the start is more than that of differences.
SUDDEN = 0.05


@dataclass(frozen=True)
class Travel:
    """Least and greatest way [m] and when the least is reached; greatest speed, acceleration.

    `start` and `jump` are the speeds it starts with, and those that are there at once, `gain` the
    greatest acceleration forwards [m/s^2], at `gain_at` [s]; `known` is false where it depends on
    what only the run knows. `ways` are those at the ends of equal steps, first 0.
    """

    least: float = 0.0
    most: float = 0.0
    least_at: float = 0.0
    speed: float = 0.0
    acceleration: float = 0.0
    jump: float = 0.0
    across: float = 0.0
    known: bool = True
    start: float = 0.0
    gain: float = 0.0
    gain_at: float = 0.0
    ways: tuple[float, ...] = ()


@dataclass(frozen=True)
class Moves:
    """What is known before the run of how the cable moves over its wheels.

    `paid` has the ways of winches with laws, by station; `unknown` says what is not known; `across`
    is the greatest speed of a weight across the cable [m/s], `along` that along a cable which no
    wheel lets go, `shaken` the greatest acceleration of
    a station with a law of motion.
    """

    ways: tuple[Travel, ...] = ()
    paid: dict[int, Travel] = field(default_factory=dict)
    across: float = 0.0
    along: float = 0.0
    shaken: float = 0.0
    unknown: str = ""

    @property
    def known(self) -> bool:
        """Whether the ways are all there is."""
        return not self.unknown

    @property
    def least(self) -> float:
        """Of all ways [m]."""
        return min((each.least for each in self.ways), default=0.0)

    @property
    def most(self) -> float:
        """Of all ways [m]."""
        return max((each.most for each in self.ways), default=0.0)

    @property
    def way(self) -> float:
        """Of the cable over its wheels [m]."""
        return max((each.most - each.least for each in self.ways), default=0.0)

    @property
    def speed(self) -> float:
        """Greatest [m/s]."""
        return max((each.speed for each in self.ways), default=0.0)

    @property
    def acceleration(self) -> float:
        """Greatest [m/s^2]."""
        return max((self.shaken, *(each.acceleration for each in self.ways)))

    @property
    def jump(self) -> float:
        """Greatest speed that is there at once [m/s]."""
        return max((each.jump for each in self.ways), default=0.0)


@dataclass(frozen=True)
class Laws:
    """The expressions of a description: travel prescribed by laws, by station, and engines.

    A way is None where it depends on what only the run knows. `nodes` has them as they are read, or
    as ways at instants, by station and key, with the axis of a motion.
    """

    paid: dict[int, Travel | None]
    moved: list[Travel | None]
    engines: list[Node]
    nodes: dict[tuple[int, str, int], Node | Ways] = field(default_factory=dict)


def laws(spec: Spec, faults: Faults) -> Laws:
    """All expressions, read; says which cannot be, and which do not begin at 0."""
    found = Laws({}, [], [])
    for i, each in enumerate(spec.route):
        for key in ("payout", "force", "torque", "pull"):
            if getattr(each, key):
                law = parse(getattr(each, key), ("route", i, key), faults)
                if law:
                    found.nodes[i, key, 0] = law
                if law and key == "payout":
                    found.paid[i] = _prescribed(spec, law, ("route", i, key), faults)
                elif law and key == "force":
                    found.engines.append(law)
                elif law and key == "torque":
                    found.engines.append(Op("/", (law, Num(each.radius))))
        _speeds(spec, i, found, faults)
        for axis, text in enumerate([*each.motion, each.haul]):
            key = "haul" if axis == HAUL else "motion"
            law = parse(text, ("route", i, key), faults) if text else None
            if law:
                found.nodes[i, key, axis] = law
                found.moved.append(_prescribed(spec, law, ("route", i, key), faults))
    return found


def _speeds(spec: Spec, i: int, found: Laws, faults: Faults) -> None:
    """The law of the speed of a winch, and that of its brake: read, and the travel by the speed."""
    each = spec.route[i]
    if each.brake and each.brake.applied:
        parse(each.brake.applied, ("route", i, "brake"), faults)
    law = parse(each.speed, ("route", i, "speed"), faults) if each.speed else None
    if not law:
        return
    h, ways = spec.end / INSTANTS, [0.0]
    low, high = each.limit or (-inf, inf)
    try:
        for k in range(INSTANTS):
            step = h * value(law, (k + 0.5) * h, {})
            ways.append(ways[-1] + step)
    except NoValue:
        faults.add("law-no-value", ("route", i, "speed"), word="speed", time=h * len(ways))
    except Unknown:
        found.paid[i] = None
        return
    if len(ways) > INSTANTS:
        way = from_ways(ways, h)
        found.paid[i] = replace(way, least=max(way.least, low), most=min(way.most, high))


def estimate_moves(spec: Spec, spans: list[FreeSpan], prescribed: Laws) -> Moves:
    """The travel of the rigid cable over the whole run."""
    ways = {i: way for i, way in prescribed.paid.items() if way}
    if spec.closed:  # all of it starts at that speed
        ways = {i: replace(way, jump=0.0) for i, way in ways.items()}
    free = _free(spec, spans, prescribed.engines)
    unknown = free if isinstance(free, str) else ""
    if len(ways) < len(prescribed.paid):
        unknown = "the payout is not known before the run"
    found = (*ways.values(), *([free] if isinstance(free, Travel) else []))
    shaken = max((way.acceleration for way in prescribed.moved if way), default=0.0)
    return Moves(found, ways, _across(spec, spans), _along(spec, spans), shaken, unknown)


def _prescribed(spec: Spec, law: Node, path: Path, faults: Faults) -> Travel | None:
    """The travel that a law prescribes; None when it depends on the run."""
    ways = []
    try:
        for i in range(INSTANTS + 1):
            ways.append(value(law, spec.end * i / INSTANTS, {}))
    except NoValue:
        faults.add("law-no-value", path, word=path[2], time=spec.end * len(ways) / INSTANTS)
        return None
    except Unknown:
        return None
    if abs(ways[0]) > AT_ZERO:
        faults.add("law-start", path, word=path[2], value=ways[0])
    return from_ways(ways, spec.end / INSTANTS)


def _free(spec: Spec, spans: list[FreeSpan], engines: list[Node]) -> Travel | str | None:
    """The way of a cable that weights and an engine move, or why it is not known."""
    if any(each.slides for each in spec.route):
        return "a weight slides along the cable"
    if not any(each.is_wheel for each in spec.route):
        return None
    inside = spec.route if spec.closed else spec.route[1:-1]
    if any(each.is_free for each in inside) or any(each.is_carried for each in spec.route):
        return "weights or wheels on the cable move by themselves"
    if spec.closed or any(each.slips for each in inside):
        return "the cable may slip on its wheels"
    if any(each.kind == "run" for each in spec.route):
        return "a long run feeds the cable"
    if not engines:
        held = [each for each in spec.route if each.kind in ("fixed", "winch")]
        return None if held else _ways(spec, spans, None)
    if len(spec.winches) > 1 or any(each.reel for each in spec.route):
        return "the payout is not known before the run"
    try:
        return _ways(spec, spans, engines[0])
    except Unknown:
        return "the payout is not known before the run"


def _across(spec: Spec, spans: list[FreeSpan]) -> float:
    """Greatest speed of a weight across the cable [m/s]."""
    found = [0.0]
    for i, each in enumerate(spec.route):
        for p in spec.beside(i):
            if p >= 0 and any(each.velocity):
                along = spans[p].along
                found.append(dist(each.velocity, add((0, 0, 0), along, dot(each.velocity, along))))
    return max(found)


def _along(spec: Spec, spans: list[FreeSpan]) -> float:
    """Greatest speed of a weight along a cable that nothing lets go [m/s]."""
    if spec.closed or any(each.feeds for each in spec.route):
        return 0.0
    return max(
        (abs(dot(spec.route[i].velocity, span.along))
         for span, pair in zip(spans, spec.pairs, strict=True) for i in pair), default=0.0,
    )  # fmt: skip


def moving_mass(spec: Spec) -> float:
    """Masses and pulleys that go with the cable [kg]."""
    rho, found = spec.cable.density, [each for each in spec.route if each.is_wheel]
    wheels = sum(each.turned_inertia(rho) / each.radius**2 for each in found)
    return wheels + sum(each.mass for each in spec.route)


def _ways(spec: Spec, spans: list[FreeSpan], law: Node | None) -> Travel:
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
    return from_ways(ways, h)


def from_ways(ways: list[float], h: float, across: float = 0.0) -> Travel:
    """Rates from the ways at the ends of equal steps `h`, the first at time 0."""

    def rates(x: list[float]) -> list[float]:
        return [(b - a) / h for a, b in zip(x, x[1:], strict=False)]

    speeds, changes = rates(ways), rates(rates(ways))
    least, fastest, gain = min(ways), max(map(abs, speeds)), max(changes)
    first = next(k for k, change in enumerate(changes) if change >= gain - ALIKE * abs(gain))
    start = speeds[0] - changes[0] * h / 2
    # A speed that is there from the first instant on, and not by the acceleration that follows.
    jump = abs(start) if abs(start) > SUDDEN * fastest else 0.0
    return Travel(
        least, max(ways), ways.index(least) * h, fastest, max(map(abs, changes)), jump, across,
        start=start, gain=gain, gain_at=(first + 1) * h, ways=tuple(ways),
    )  # fmt: skip
