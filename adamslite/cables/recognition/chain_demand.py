"""The :class:`Demand` of a cable that was found in a deck."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass, replace
from math import inf, pi, sqrt
from statistics import mean
from typing import Any

import numpy as np

from adamslite.cables.description.payout_law import Unknown
from adamslite.cables.model.demand import SMALL_SLOPE, Demand
from adamslite.cables.model.network import Bar, Network
from adamslite.cables.model.response import Machine, String, instants, is_usable
from adamslite.cables.recognition.chain_finder import Chain, damper
from adamslite.cables.recognition.chain_payout import form_of, travel_of
from adamslite.cables.recognition.posture import GROUND, Body, Posture
from adamslite.cables.vectors import ZERO, Vector, add, dot, norm, part_across, unit
from adamslite.deck.deck import Deck
from adamslite.elements.bases.constraint import Constraint
from adamslite.elements.diff import Diff
from adamslite.elements.gcon import Gcon
from adamslite.elements.joint import Joint
from adamslite.elements.motion import Motion
from adamslite.elements.part import Part
from adamslite.elements.request import COMPONENTS, Request
from adamslite.elements.vforce import Vforce
from adamslite.language.expression import Node, Ref, calls, walk
from adamslite.language.statement import Statement

# Share of a speed, or of a pull, from which a difference counts.
FELT = 0.01
# Directions of neighbours in a cable that lies on a line but for its sag.
BENT = 0.05
# Of a tension's distance from that of any section: a value so near that of an end is it.
ALIKE = 0.01


@dataclass(frozen=True)
class ChainDemand:
    """A chain, the demand on it, and its construction.

    `form` is "fixed" without payout, "paper" or "ale"; `gained` is the range of dm/m0 of an inner
    node; `loaded`: other forces act on its nodes, which the demand leaves out.
    """

    chain: Chain
    demand: Demand
    form: str
    gained: tuple[float, float]
    loaded: bool = False


def demand_on(
    chain: Chain, posture: Posture, end: float, results: int = 0, linear: bool = True
) -> ChainDemand:
    """The figures of a chain in a run from 0 to `end`; `linear`: with its linear model."""
    deck, ucf = posture.deck, posture.deck.ucf
    n = len(chain.links)
    free = sum(link.free for link in chain.links)
    stiffness = mean(link.stiffness * link.free for link in chain.links)
    masses = [deck.find(*node).mass / ucf for node in chain.inner]
    shape = ChainShape(chain, posture)
    tips = [deck.find(*node).mass / ucf for node in _tips(chain)]
    rope = _Rope(
        stiffness, mean(masses) * n / free, free, sum(tips) - mean(masses) / 2, end,
        mean(damper(link, posture) / link.stiffness for link in chain.links),
    )  # fmt: skip
    travel, gained, law = travel_of(chain, posture, end, rope.instants)
    weight = mean(masses) * n * abs(shape.pull)
    drawn = mean(max(link.pull, 0.0) for link in chain.links)
    hung = (max(tips, default=0.0) + mean(masses) * n / 2) * norm(deck.gravity)
    carried = drawn if drawn > ASIDE * stiffness else hung
    jump, across = shape.jumps()
    if travel.jump:
        jump = abs(travel.jump - shape.leaves(chain))
        jump = jump if jump > FELT * travel.speed else 0.0
    demand = Demand(
        stiffness=stiffness, density=mean(masses) * n / free, length=free, tension=carried,
        moved=sum(tips), pull=abs(shape.pull), least=travel.least, most=travel.most,
        speed=travel.speed, acceleration=travel.acceleration, known=travel.known, jump=jump,
        across=across, straight=shape.straight, wave=shape.wave(across, free),
        bounces=abs(drawn - hung) > 0.5 * weight + FELT * hung and not chain.is_ring, end=end,
        tied=is_tied(deck), results=results,
    )  # fmt: skip
    slight = not across or across < SMALL_SLOPE * demand.struck_wave
    loaded = linear and _is_loaded(chain, posture)
    linear = linear and travel.known and end > 0 and slight and not loaded
    if linear and _is_plain(chain, shape):
        found = _machine(chain, shape, rope, law)
        if rope.tip > 0 and is_usable(found):
            halves = not corrects(chain, posture, found.rests)
            demand = replace(demand, machines=(found,), half_read=halves)
    return ChainDemand(chain, demand, form_of(chain, posture), gained, loaded)


def _is_loaded(chain: Chain, posture: Posture) -> bool:
    """Whether its nodes carry more than its tension, gravity and what payout does to them."""
    try:
        acting([chain], posture)
    except Unknown:
        return True
    return False


@dataclass(frozen=True)
class _Rope:
    """EA, rho, free length of a chain, the mass at its tip, the time of the run, and that of its
    damping: of a rate of the strain."""

    stiffness: float
    density: float
    length: float
    tip: float
    end: float
    damping_time: float

    @property
    def instants(self) -> int:
        """Of its linear model."""
        if not self.end > 0:
            return 1
        carried = max(self.tip, 0.0) + self.density * self.length / 3
        bounce = 2 * pi * sqrt(carried * self.length / self.stiffness)
        return instants(self.end, self.length * sqrt(self.density / self.stiffness), bounce)


def _is_plain(chain: Chain, shape: ChainShape) -> bool:
    """Whether it hangs from the ground along a line, at rest but for the weight at its tip."""
    ends = chain.nodes[0][0] == "MARKER", chain.nodes[-1][0] == "MARKER"
    if chain.is_ring or ends[0] == ends[1]:
        return False
    fastest = max(map(norm, shape.speeds))
    still = all(norm(v) <= ASIDE * fastest for v in shape.speeds[1:-1])
    line = all(norm(part_across(a, shape.line)) < BENT for a in shape.along)
    aside = norm(part_across(shape.gravity, shape.line)) <= ASIDE * norm(shape.gravity)
    return still and line and aside


def _machine(chain: Chain, shape: ChainShape, rope: _Rope, law: np.ndarray | None) -> Machine:
    """Its linear model: the payout, coordinate 0, and the tip, coordinate 1, along the line from
    root to tip; across it a string with the tip alone."""
    back = chain.nodes[0][0] != "MARKER"
    links = chain.links[::-1] if back else chain.links
    line = add(ZERO, shape.line, -1.0 if back else 1.0)
    speed = shape.speeds[0] if back else shape.speeds[-1]
    pull, h = dot(shape.gravity, line), rope.length / len(links)
    # Tensions at the ends, half a section beyond the middles of the outer ones.
    drop = (links[0].pull - links[-1].pull) / (len(links) - 1)
    rests = links[0].pull + drop / 2, links[-1].pull - drop / 2
    falls = pull - drop / (rope.density * h)
    way = law if law is not None else np.zeros(rope.instants + 1)
    bar = Bar(((0, 1.0),), ((1, 1.0),), rope.length, (rope.stiffness,) * 2,
              points=(False, True), falls=falls)  # fmt: skip
    network = Network(
        (1.0, rope.tip), (bar,), rope.density, rope.end, len(way) - 1, (0.0, dot(speed, line)),
        damping_time=rope.damping_time, ways={0: way}, forces={1: rope.tip * pull - rests[1]},
    )  # fmt: skip
    aside = norm(part_across(speed, line))
    strings: tuple[String, ...] = ()
    if aside > ASIDE * norm(speed):
        across = replace(bar, start=(), finish=((0, 1.0),), pull=rests, falls=0.0)
        string = Network((rope.tip,), (across,), rope.density, rope.end, len(way) - 1, (aside,))
        strings = (String(string, (0,), 0),)
    transit = rope.length * sqrt(rope.density / rope.stiffness)
    return Machine(network, strings, np.array(rests), ((1,),), transit)


def corrects(chain: Chain, posture: Posture, rests: np.ndarray) -> bool:
    """Whether a REQUEST gives the tension at an end of the chain, with the half section there, and
    not that of the middle of a section."""
    middles = [link.pull for link in chain.links]
    for request in posture.deck.of(Request):
        for name in COMPONENTS:
            node = getattr(request, name)
            try:
                value = posture.value(node) if node is not None else inf
            except Unknown:
                continue
            near = min(abs(value - rest) for rest in rests)
            if near < ALIKE * min(abs(value - middle) for middle in middles):
                return True
    return False


def _tips(chain: Chain) -> list[Body]:
    """Ends that are bodies."""
    ends = () if chain.is_ring else dict.fromkeys((chain.nodes[0], chain.nodes[-1]))
    return [end for end in ends if end[0] != "MARKER"]


def is_tied(deck: Deck) -> bool:
    """Whether anything keeps accelerations from following mass by mass."""
    return any(
        isinstance(each, Constraint | Diff | Vforce) or (isinstance(each, Part) and not each.ground)
        for each in deck.statements
    )


# Directions that differ by less are the same.
ASIDE = 1e-6


class ChainShape:
    """How a chain lies and moves at the start."""

    def __init__(self, chain: Chain, posture: Posture) -> None:
        self.places = [_place(chain, posture, k) for k in range(len(chain.nodes))]
        self.speeds = [
            ZERO if node[0] == "MARKER" else posture.velocity(node) for node in chain.nodes
        ]
        steps = [add(b, a, -1.0) for a, b in zip(self.places, self.places[1:], strict=False)]
        self.along = [unit(step) for step in steps]
        across_ends = add(self.places[-1], self.places[0], -1.0)
        self.line = unit(across_ends)
        self.pull = dot(posture.deck.gravity, self.line)
        self.gravity = posture.deck.gravity

    @property
    def straight(self) -> bool:
        """Whether gravity and all places and speeds are along one line."""
        fastest = max(map(norm, self.speeds))
        return (
            norm(self.line) > 0
            and all(norm(part_across(a, self.line)) < ASIDE for a in self.along)
            and all(norm(part_across(v, self.line)) <= ASIDE * fastest for v in self.speeds)
            and norm(part_across(self.gravity, self.line)) <= ASIDE * norm(self.gravity)
        )

    def jumps(self) -> tuple[float, float]:
        """Differences of speed along and across that stand between two neighbours, not spread over
        the chain.
        """
        steps = [add(b, a, -1.0) for a, b in zip(self.speeds, self.speeds[1:], strict=False)]
        along = [abs(dot(d, t)) for d, t in zip(steps, self.along, strict=True)]
        across = [norm(part_across(d, t)) for d, t in zip(steps, self.along, strict=True)]
        return _standing(along), _standing(across)

    def leaves(self, chain: Chain) -> float:
        """Speed at which the far end moves away along the cable; cable comes in at the other."""
        if chain.nodes[0][0] == "MARKER" or chain.nodes[-1][0] != "MARKER":
            return dot(self.speeds[-1], self.along[-1])
        return -dot(self.speeds[0], self.along[0])

    def wave(self, across: float, free: float) -> float:
        """Wave number of the drawn shape and speeds, by the free length: sqrt of sum y"^2 over sum
        y'^2, across the line.
        """
        if across or self.straight:
            return 0.0
        h = free / len(self.along)
        numbers = [_wave_number(values, h, self.line) for values in (self.places, self.speeds)]
        return max(numbers)


def _wave_number(values: list[Vector], h: float, line: Vector) -> float:
    ys = [part_across(v, line) for v in values]
    slopes = [add(b, a, -1.0) for a, b in zip(ys, ys[1:], strict=False)]
    bends = [add(b, a, -1.0) for a, b in zip(slopes, slopes[1:], strict=False)]
    first = sum(dot(s, s) for s in slopes)
    if first <= (ASIDE * max(map(norm, values))) ** 2:
        return 0.0
    return sqrt(sum(dot(b, b) for b in bends) / first) / h


def _place(chain: Chain, posture: Posture, k: int) -> Vector:
    """Of node k: its marker in the link before or after it."""
    link = chain.links[min(k, len(chain.links) - 1)]
    i_first = link.ends[0] == chain.nodes[min(k, len(chain.links) - 1)]
    first, second = (link.i, link.j) if i_first else (link.j, link.i)
    return posture.place(first if k < len(chain.links) else second)


def _standing(steps: list[float]) -> float:
    """The largest of some differences if it stands between two neighbours, else 0."""
    return max(steps) if max(steps) > 0.5 * sum(steps) else 0.0


def acting(chains: Iterable[Chain], posture: Posture) -> dict[Body, list[Statement]]:
    """What acts on bodies besides the springs of some chains and what payout does to their nodes;
    raises :class:`Unknown` where that is more on the nodes themselves."""
    chains = [*chains]
    own = {id(link.statement) for chain in chains for link in chain.links}
    inner = {node for chain in chains for node in chain.inner}
    found: dict[Body, list[Statement]] = {}
    for each in posture.deck.statements:
        if id(each) in own or not (hasattr(each, "loads") or isinstance(each, Constraint | Motion)):
            continue
        if isinstance(each, Vforce) and _grows(each):
            continue
        for body in {posture.body(key) for key in _markers(each, posture)} - {GROUND}:
            if body in inner:
                raise Unknown
            found.setdefault(body, []).append(each)
    return found


def _grows(force: Vforce) -> bool:
    """Whether a force is what the payout does to a node."""
    nodes = force.fx, force.fy, force.fz
    return any(call.name.startswith("ACC") for node in nodes for call in calls(node))


def _markers(each: Statement, posture: Posture) -> Iterator[Any]:
    """Markers that a force or constraint names."""
    if isinstance(each, Motion) and each.joint is not None:
        each = posture.deck.get(Joint, each.joint)
    if isinstance(each, Gcon):
        refs: Iterable[Node] = walk(each.function)
        yield from (n.id for n in refs if isinstance(n, Ref) and n.kind == "MARKER" and n.id != 0)
        return
    for name, argument in each.arguments.items():
        value = getattr(each, name)
        if argument.kind == "reference" and argument.to == "MARKER" and value is not None:
            yield value
