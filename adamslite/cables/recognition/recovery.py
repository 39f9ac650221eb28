"""The description that the statements of a deck amount to, for straight cables from end to end.

Chains that meet at a weight or on a wheel are one route.  Its stations are fixed points, points
that GCONs move, weights, and wheels on bearings in the ground whose angle a feeds the chains,

    dL = g a,   R = |g|     with the free length L of a chain.

What a description does not say is :class:`Unknown`: other forces on the cable or its weights, arcs,
engines, branches.  Units are those of the deck.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field, replace
from functools import partial
from math import isclose
from statistics import mean
from typing import NamedTuple

import numpy as np

from adamslite.cables.description.components import Cable
from adamslite.cables.description.messages import Faults
from adamslite.cables.description.payout_law import Unknown
from adamslite.cables.description.toml_places import Places
from adamslite.cables.description.vocabulary import Spec, Station
from adamslite.cables.layout.geometry import FreeSpan
from adamslite.cables.model.demand import Demand
from adamslite.cables.model.estimate import INSTANTS, Laws, Moves, Travel, estimate_moves, from_ways
from adamslite.cables.model.model_choice import CableModel, choose_model, demand_of, tensions
from adamslite.cables.recognition.chain_demand import BENT, acting, corrects, is_tied
from adamslite.cables.recognition.chain_finder import Chain, damper, free_length
from adamslite.cables.recognition.chain_payout import SHORT, drivers, gained_mass
from adamslite.cables.recognition.chain_routes import WHEEL, Route, wheel_of
from adamslite.cables.recognition.posture import Body, Posture
from adamslite.cables.vectors import Vector, add, dot, norm, part_across, unit
from adamslite.elements.bases.constraint import Constraint
from adamslite.elements.gcon import Gcon
from adamslite.elements.joint import Joint
from adamslite.elements.motion import Motion
from adamslite.elements.part import Part
from adamslite.elements.sforce import Sforce
from adamslite.language.diagnostics import Source
from adamslite.language.expression import Call, Num, calls
from adamslite.language.statement import Statement

# What a free wheel's torque may differ from that of its tensions, as a share; the same of cables
# that are one, and of a length that is not drawn.
ALIKE = 0.02
# Length of a straight cable over the distance of its ends.
LOOSE = 1.05
# Tensions that differ by less than this share are those of what hangs on a cable.
AS_HUNG = 2e-3
# Measures of other wheels, and states.
TURNS = ("AX", "AY", "AZ", "DIF")
ROUND_OFF = 1e-9
# An accuracy, where none is asked for.
ANY = 0.01


class Recovered(NamedTuple):
    """What a description says, as it is written by one model or another, and its demand."""

    spec: Spec
    pieces: list[FreeSpan]
    moves: Moves
    demand: Demand

    def chosen(self, p: float) -> CableModel:
        """What `adamslite cable` chooses for an accuracy."""
        spec, none = replace(self.spec, accuracy=p), Faults(Places(Source("", "")))
        return choose_model(spec, self.pieces, self.moves, self.demand, none)


def recovered(route: Route, posture: Posture, end: float, steps: int) -> Recovered | None:
    """The description of a route; None where there is none."""
    if not end > 0 or any(chain.is_ring for chain, _ in route.chains):
        return None
    try:
        found = _Recovery(route, posture, end).found(steps)
        if not (found.demand.machines or found.demand.across) or found.moves.jump:
            return None  # what it starts as, which only the statements say, decides
    except (Unknown, ArithmeticError, ValueError):
        return None
    finally:
        posture.at(0.0)
    halves = not any(
        corrects(chain, posture, each.rests)
        for chain, _ in route.chains for each in found.demand.machines
    )  # fmt: skip
    tied = found.demand.tied or is_tied(posture.deck)
    return found._replace(demand=replace(found.demand, half_read=halves, tied=tied))


@dataclass
class _Recovery:
    """A description in the making."""

    route: Route
    posture: Posture
    end: float
    laws: Laws = field(default_factory=lambda: Laws({}, [], []))

    def found(self, steps: int) -> Recovered:
        cable = self._cable()
        pieces = [self._piece(*each) for each in self.route.chains]
        others = acting([chain for chain, _ in self.route.chains], self.posture)
        stations = [self._station(i, body, others) for i, body in enumerate(self.route.stations)]
        spec = Spec(
            title="", gravity=self.posture.deck.gravity, end=self.end, steps=max(steps, 1),
            error=0.0, closed=False, speed=0.0, cable=cable, route=tuple(stations), level=0,
            form="auto", elements=0, accuracy=ANY,
        )  # fmt: skip
        spec = self._drawn(spec, pieces)
        moves = estimate_moves(spec, pieces, self.laws)
        return Recovered(spec, pieces, moves, demand_of(spec, pieces, moves, self.laws))

    def _cable(self) -> Cable:
        """Of all chains, if they are of one cable."""
        kinds = []
        for chain, _ in self.route.chains:
            stiffness = mean(link.stiffness * link.free for link in chain.links)
            density = self._lump(chain) / mean(link.free for link in chain.links)
            times = (damper(link, self.posture) / link.stiffness for link in chain.links)
            kinds.append((stiffness, density, mean(times)))
        stiffness, density, damping_time = (float(value) for value in np.mean(kinds, axis=0))
        for values in zip(*kinds, strict=True):
            if max(values) - min(values) > ALIKE * max(values):
                raise Unknown
        links = (link for chain, _ in self.route.chains for link in chain.links)
        pulls_only = any(any(calls(node, "MAX")) for link in links for node in link.components)
        return Cable(
            stiffness=stiffness, density=density, damping_time=damping_time, pulls_only=pulls_only,
        )  # fmt: skip

    def _lump(self, chain: Chain) -> float:
        """Mass of a section: that of a node in between or, without one, what payout adds to the
        body at its end, half of a section."""
        deck = self.posture.deck
        if chain.inner:
            return mean(deck.find(*node).mass for node in chain.inner) / deck.ucf
        call = _only(drivers(chain.links[0], self.posture))
        self.posture.follow(call)
        self.posture.at(0.0)
        before, fed = self.posture.given[call], self._fed(chain, call)
        gains = []
        # Far enough for a difference of masses, and as far in the sense in which cable comes in.
        step = chain.links[0].free / fed if fed else 0.0
        tip = next(node for node in chain.nodes if node[0] != "MARKER")
        for self.posture.given[call] in (before, before + step):
            self.posture.forget()
            gains.append(gained_mass(tip, self.posture))
        self.posture.given[call] = before
        self.posture.forget()
        if not gains[1] > gains[0]:
            raise Unknown
        return 2 * (gains[1] - gains[0])

    def _beyond(self, chain: Chain) -> float:
        """How much larger the tension at the upper end is than in the middle of its section."""
        if len(chain.links) == 1:
            line = add(_place(chain, self.posture, -1), _place(chain, self.posture, 0), -1.0)
            return self._lump(chain) * abs(dot(self.posture.deck.gravity, unit(line))) / 2
        pulls = chain.links[0].pull, chain.links[-1].pull
        return abs(pulls[1] - pulls[0]) / (len(chain.links) - 1) / 2

    def _piece(self, chain: Chain, forwards: bool) -> FreeSpan:
        """A chain that lies on a line, at rest between its ends."""
        posture = self.posture
        places = [_place(chain, posture, k) for k in range(len(chain.nodes))]
        line = add(places[-1], places[0], -1.0)
        free = sum(link.free for link in chain.links)
        along = [unit(add(b, a, -1.0)) for a, b in zip(places, places[1:], strict=False)]
        bent = any(norm(part_across(each, unit(line))) > BENT for each in along)
        moving = any(any(posture.velocity(node)) for node in chain.inner)
        if bent or moving or free > LOOSE * norm(line):
            raise Unknown
        start, finish = (places[0], places[-1]) if forwards else (places[-1], places[0])
        return FreeSpan(start, finish, unit(add(finish, start, -1.0)), norm(line))

    def _pull(self, chain: Chain, forwards: bool) -> float:
        """Tension at the lower end, half a section below the middle of the last one."""
        return float(min(chain.links[0].pull, chain.links[-1].pull) - self._beyond(chain))

    def _drawn(self, spec: Spec, pieces: list[FreeSpan]) -> Spec:
        """With the tension at which it is drawn, where that is not what hangs on it."""
        pulls, cable = [self._pull(*each) for each in self.route.chains], spec.cable
        hung = tensions(spec, pieces)
        if max(pulls) > (1 + AS_HUNG) * max(hung):
            spec = replace(spec, cable=replace(cable, pretension=max(pulls)))
            hung = tensions(spec, pieces)
        if all(isclose(a, b, rel_tol=AS_HUNG) for a, b in zip(pulls, hung, strict=True)):
            return spec
        return replace(spec, strains=tuple(pull / cable.stiffness for pull in pulls))

    # ---- stations ----------------------------------------------------------------------------

    def _station(self, i: int, body: Body, others: dict[Body, list[Statement]]) -> Station:
        if body[0] == WHEEL:
            return self._wheel(i, body, others)
        near = [chain for chain, _ in self._beside(i)]
        at = next(_place(c, self.posture, k) for c in near for k in (0, -1) if c.nodes[k] == body)
        if body[0] == "MARKER":
            return Station("fixed", at)
        acting = others.get(body, [])
        if acting:
            return self._moved(i, body, at, acting)
        deck = self.posture.deck
        mass = deck.find(*body).mass / deck.ucf - sum(map(self._lump, near)) / 2
        if not mass > 0:
            raise Unknown
        return Station("mass", at, mass=mass, velocity=self.posture.velocity(body))

    def _beside(self, i: int) -> tuple[tuple[Chain, bool], ...]:
        """Chains at station i."""
        return self.route.chains[max(i - 1, 0) : i + 1]

    def _moved(self, i: int, body: Body, at: Vector, acting: list[Statement]) -> Station:
        """A point that three GCONs hold in ground."""
        posture, found = self.posture, {}
        for each in acting:
            drives = posture.measures(each.function) if isinstance(each, Gcon) else set()
            if len(drives) != 1 or not posture.follow(call := next(iter(drives))):
                raise Unknown
            found[call.name] = call
        if sorted(found) != ["DX", "DY", "DZ"] or len(acting) != 3:
            raise Unknown
        for axis, call in enumerate(found[name] for name in sorted(found)):
            law = partial(self._sampled, partial(self._given, call))
            self.laws.nodes[i, "motion", axis] = law
            self.laws.moved.append(self._travel(law))
        return Station("fixed", at, motion=("law", "law", "law"))

    def _given(self, call: Call) -> float:
        return self.posture.given[call]

    def _sampled(self, value: Callable[[], float], times: np.ndarray) -> np.ndarray:
        """What has been added to a value at instants."""
        posture, found = self.posture, []
        for time in times:
            posture.at(float(time))
            found.append(value())
        posture.at(0.0)
        ways = np.array(found) - found[0]
        # Lengths come from differences of forces.
        return np.where(np.abs(ways) > ROUND_OFF * np.abs(ways).max(), ways, 0.0)

    def _travel(self, law: Callable[[np.ndarray], np.ndarray]) -> Travel:
        ways = law(np.linspace(0.0, self.end, INSTANTS + 1))
        return from_ways([float(way) for way in ways], self.end / INSTANTS)

    def _wheel(self, i: int, body: Body, others: dict[Body, list[Statement]]) -> Station:
        """A wheel whose angle is prescribed, or free but for the tensions of its cable."""
        posture, part = self.posture, ("PART", body[1])
        beside = self._beside(i)
        call = _only({c for chain, _ in beside for k in chain.links for c in drivers(k, posture)})
        if wheel_of(call, posture) != part:
            raise Unknown
        known = posture.follow(call)
        posture.at(self.end)
        spun = posture.given[call]
        posture.at(0.0)
        if not known and posture.given[call] != spun:
            raise Unknown  # it turns at the start
        fed = [self._fed(chain, call) for chain, _ in beside]
        joints = [s for s in others.get(part, []) if isinstance(s, Constraint | Motion)]
        hinges = [s for s in joints if isinstance(s, Joint) and s.kind == "REVOLUTE"]
        if len(hinges) != 1 or len(joints) - 1 > known or not all(fed):
            raise Unknown
        if len(fed) > 1 and abs(sum(fed)) > ALIKE * abs(fed[0]):
            raise Unknown
        radius = abs(fed[0])
        inertia = (posture.deck.get(Part, part[1]).ip or (0.0, 0.0, 0.0))[2] / posture.deck.ucf
        ends = i in (0, len(self.route.stations) - 1)
        if known:
            law = partial(self._sampled, partial(self._length, beside[0][0]))
            self.laws.nodes[i, "payout", 0] = law
            self.laws.paid[i] = self._travel(law)
        force = 0.0 if known else self._engine(call, part, others, [*zip(beside, fed, strict=True)])
        if force:
            self.laws.nodes[i, "force", 0] = Num(force)
            self.laws.engines.append(Num(force))
        return Station(
            "winch" if ends or known else "pulley", posture.place(hinges[0].i), radius=radius,
            inertia=inertia, payout="law" if known else "", turn=1,
            force=repr(force) if force else "",
        )  # fmt: skip

    def _length(self, chain: Chain) -> float:
        """Free length of a chain, all of whose sections are alike."""
        return len(chain.links) * free_length(chain.links[0], self.posture)

    def _fed(self, chain: Chain, call: Call) -> float:
        """dL/da of a chain."""
        posture = self.posture
        before = posture.given[call]
        lengths = []
        for posture.given[call] in (before, before + SHORT):
            posture.forget()
            lengths.append(self._length(chain))
        posture.given[call] = before
        posture.forget()
        return (lengths[1] - lengths[0]) / SHORT

    def _engine(
        self, call: Call, part: Body, others: dict[Body, list[Statement]],
        fed: list[tuple[tuple[Chain, bool], float]],
    ) -> float:  # fmt: skip
        """The constant force at the rim that holds a wheel back against its cable, at an end of the
        route; 0 where nothing but tensions turns it."""
        torques = [s for s in others.get(part, []) if not isinstance(s, Constraint | Motion)]
        pulls = [self._at_wheel(chain) for (chain, _), _ in fed]
        left = sum(g * pull for (_, g), pull in zip(fed, pulls, strict=True))
        for each in torques:
            if not isinstance(each, Sforce) or each.kind != "ROTATIONAL":
                raise Unknown
            turning = any(calls(each.function, "AZ", "WZ"))
            rates = {c for c in self.posture.measures(each.function) if c.name in TURNS}
            if turning or not rates <= {call} or self.posture.depends_on_time(each.function):
                raise Unknown
            left -= self.posture.value(each.function)
        force = left / fed[0][1]
        if abs(force) < ALIKE * max(pulls):
            return 0.0
        if len(fed) > 1:
            raise Unknown
        return force

    def _at_wheel(self, chain: Chain) -> float:
        """Tension at the upper end of a chain."""
        pulls = chain.links[0].pull, chain.links[-1].pull
        at_start = chain.nodes[0][0] == "MARKER"
        mine, other = pulls if at_start else pulls[::-1]
        return mine + (self._beyond(chain) if mine >= other else -self._beyond(chain))


def _only(found: set[Call]) -> Call:
    if len(found) != 1:
        raise Unknown
    return next(iter(found))


def _place(chain: Chain, posture: Posture, k: int) -> Vector:
    """Of node k of a chain, at its marker in the link before or behind it."""
    k %= len(chain.nodes)
    link, node = chain.links[min(k, len(chain.links) - 1)], chain.nodes[k]
    return posture.place(link.i if link.ends[0] == node else link.j)
