"""The linear model of a description: its wheels, weights and spans, and what drives them."""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import partial
from math import pi, sqrt

import numpy as np

from adamslite.cables.description.payout_law import Unknown, value
from adamslite.cables.description.vocabulary import Spec
from adamslite.cables.layout.geometry import FreeSpan
from adamslite.cables.model.estimate import Laws, Ways
from adamslite.cables.model.network import Bar, Network, Terms
from adamslite.cables.model.response import Machine, String, instants
from adamslite.cables.vectors import AXES, ZERO, Vector, add, dot, norm, part_across, unit
from adamslite.language.expression import Node, Num, Op

# Of the mass beside it: what the cable that comes through a weight has at least.
THROUGH = 1e-4
# Stations whose dense matrices take less than a second.
MANY = 40
# Of speeds: one across is none.
ASIDE = 1e-9


@dataclass
class _Draft:
    """Coordinates in the making."""

    masses: list[float] = field(default_factory=list)
    speeds: list[float] = field(default_factory=list)
    ways: dict[int, Ways] = field(default_factory=dict)
    forces: dict[int, float | Ways] = field(default_factory=dict)

    def add(self, mass: float, speed: float = 0.0) -> int:
        self.masses.append(mass)
        self.speeds.append(speed)
        return len(self.masses) - 1


def machine(
    spec: Spec, spans: list[FreeSpan], rests: list[float], prescribed: Laws
) -> Machine | None:
    """Of a description whose `rests` are the tensions at the lower ends of its spans; None for one
    that no linear model is for: a loop, a run, a bend, wheels that grip, a law that only the run
    knows, nothing free; and for one of many stations, for its matrices are dense.
    """
    if (
        spec.grips
        or len(spec.route) > MANY
        or any(e.held or e.speed or e.has_states or e.floor for e in spec.route)
    ):
        return None
    if spec.closed or spec.bends or spec.has_run or any(e.mount for e in spec.route):
        return None
    try:
        return _machine(spec, spans, rests, Drives(spec, prescribed))
    except Unknown:
        return None


class Drives:
    """What laws say: payouts and forces of winches and pulls of carriages by station, displacements
    of stations.
    """

    def __init__(self, spec: Spec, prescribed: Laws) -> None:
        self.payouts: dict[int, Ways] = {}
        self.forces: dict[int, Ways] = {}
        self.pulls: dict[int, Ways] = {}
        self.motions: dict[tuple[int, int], Ways] = {}
        for (i, key, axis), law in prescribed.nodes.items():
            ways = law if callable(law) else partial(_values, law)
            if key == "payout":
                self.payouts[i] = ways
            elif key == "force":
                self.forces[i] = ways
            elif key == "pull":
                self.pulls[i] = ways
            elif key == "torque" and not callable(law):
                self.forces[i] = partial(_values, Op("/", (law, Num(spec.route[i].radius))))
            elif key == "motion":
                self.motions[i, axis] = ways


def _values(law: Node, times: np.ndarray) -> np.ndarray:
    """Of a law; an engine's where nothing has been paid out."""
    return np.array([value(law, float(t), {"S": 0.0, "SD": 0.0}) for t in times])


def _machine(
    spec: Spec, spans: list[FreeSpan], rests: list[float], drives: Drives
) -> Machine | None:
    draft = _Draft()
    rims, places = _coordinates(spec, draft, drives)
    if len(draft.ways) == len(draft.masses):
        return None
    rho = spec.cable.density
    ends = [_ends(spec, p, spans[p], rest) for p, rest in enumerate(rests)]
    bars = [_bar(spec, p, span, rims, places) for p, span in enumerate(spans)]
    _balance(spec, ends, spans, rims, places, draft, drives)
    transit = max(span.length for span in spans) / spec.cable.speed
    bounce = _bounce(spec, sum(span.length for span in spans))
    count = instants(spec.end, transit, bounce)
    times = np.linspace(0.0, spec.end, count + 1)
    strings = _strings(spec, spans, ends, places, draft, drives, times)
    network = Network(
        tuple(draft.masses), tuple(bars), rho, spec.end, count, tuple(draft.speeds),
        damping_time=spec.cable.damping_time,
        ways={j: way(times) for j, way in draft.ways.items()},
        forces={j: f(times) if callable(f) else f for j, f in draft.forces.items()},
        across=tuple(_held_across(spec, spans, ends, places)),
        carriages=frozenset(
            j for i, own in places.items() if spec.route[i].is_wheel for j in own
        ),
    )  # fmt: skip
    rest = np.array([pull for pair in ends for pull in pair])
    weights = tuple(places[i] for i, each in enumerate(spec.route) if each.is_free)
    return Machine(network, tuple(strings), rest, weights, transit)


def _coordinates(
    spec: Spec, draft: _Draft, drives: Drives
) -> tuple[dict[int, int], dict[int, tuple[int, ...]]]:
    """Coordinates of rims, and of places, by station."""
    rims, places = {}, {}
    rho = spec.cable.density
    for i, each in enumerate(spec.route):
        if each.is_wheel:
            rims[i] = draft.add(each.turned_inertia(rho) / each.radius**2)
            if i in drives.payouts:
                sense, way = spec.outwards(i), drives.payouts[i]
                draft.ways[rims[i]] = lambda t, s=sense, w=way: s * w(t)  # type: ignore[misc]
        if each.slides:
            rims[i] = draft.add(THROUGH * each.mass)
        if each.is_free:
            places[i] = tuple(draft.add(each.mass, v) for v in each.velocity)
        elif each.is_carried and any(each.slide):
            own = each.mass + each.inertia / each.radius**2
            places[i] = (draft.add(own),)
        elif each.is_moved:
            places[i] = tuple(draft.add(1.0) for _ in range(3))
            for axis, j in enumerate(places[i]):
                draft.ways[j] = drives.motions.get((i, axis), np.zeros_like)
    return rims, places


def _terms(
    spec: Spec, i: int, along: Vector, rims: dict[int, int],
    places: dict[int, tuple[int, ...]],
) -> Terms:  # fmt: skip
    """The displacement of the cable at station i along a direction."""
    found = [(rims[i], 1.0)] if i in rims else []
    own = places.get(i, ())
    if len(own) == 3:
        found += [(j, c) for j, c in zip(own, along, strict=True) if abs(c) > ASIDE]
    elif own:
        found.append((own[0], dot(unit(spec.route[i].slide), along)))
    return tuple(found)


def _bar(
    spec: Spec, p: int, span: FreeSpan, rims: dict[int, int], places: dict[int, tuple[int, ...]]
) -> Bar:
    i, j = spec.pairs[p]
    a, b = spec.route[i], spec.route[j]
    start, finish = (_terms(spec, k, span.along, rims, places) for k in (i, j))
    rigidity = spec.cable.stiffness
    return Bar(
        start, finish, span.length, (rigidity, rigidity),
        (a.is_free and not a.slides, b.is_free and not b.slides),
    )  # fmt: skip


def at_height(spec: Spec, tension: float, place: Vector) -> float:
    """Tension at a place of a run between wheels, when it is `tension` at what hangs there: weights
    at the ends, else blocks, else the first station."""
    ends = [each.at for each in (spec.route[0], spec.route[-1]) if each.is_free]
    ends = ends or [each.at for each in spec.route if each.is_carried] or [spec.route[0].at]
    above = [dot(spec.gravity, add(place, end, -1)) for end in ends]
    return max(tension - spec.cable.density * sum(above) / len(above), 0.0)


def _ends(spec: Spec, p: int, span: FreeSpan, rest: float) -> tuple[float, float]:
    """Tensions at rest at the start and finish of a span, the lower of which is `rest`."""
    if all(spec.route[i].is_wheel for i in spec.pairs[p]):
        return at_height(spec, rest, span.start), at_height(spec, rest, span.finish)
    weight = spec.cable.density * span.length * dot(spec.gravity, span.along)
    return rest + max(weight, 0.0), rest + max(-weight, 0.0)


def _balance(
    spec: Spec, ends: list[tuple[float, float]], spans: list[FreeSpan], rims: dict[int, int],
    places: dict[int, tuple[int, ...]], draft: _Draft, drives: Drives,
) -> None:  # fmt: skip
    """What is not in balance at the start, and forces of winches."""
    for i, each in enumerate(spec.route):
        before, behind = spec.beside(i)
        pull = ZERO
        rim = 0.0
        if before >= 0:
            pull = add(pull, spans[before].along, -ends[before][1])
            rim -= ends[before][1]
        if behind >= 0:
            pull = add(pull, spans[behind].along, ends[behind][0])
            rim += ends[behind][0]
        if i in rims and rims[i] not in draft.ways:
            force, sense = drives.forces.get(i), spec.outwards(i)
            if force is not None:
                draft.forces[rims[i]] = lambda t, r=rim, f=force, s=sense: r - s * f(t)  # type: ignore[misc]
            else:
                draft.forces[rims[i]] = rim
        own = places.get(i, ())
        if each.is_moved or not own:
            continue
        total = add(pull, spec.gravity, draft.masses[own[0]])
        if len(own) == 3:
            for j, f in zip(own, total, strict=True):
                draft.forces[j] = f
        else:
            carried, pulled = dot(unit(each.slide), total), drives.pulls.get(i, np.zeros_like)
            draft.forces[own[0]] = lambda t, c=carried, f=pulled: c + f(t)  # type: ignore[misc]


def _bounce(spec: Spec, length: float) -> float:
    """Period of the lightest weight on the cable [s]."""
    weights = [each.mass for each in spec.route if each.is_free and each.mass]
    carried = min(weights, default=0.0) + spec.cable.density * length / 3
    return 2 * pi * sqrt(carried * length / spec.cable.stiffness)


def _held_across(
    spec: Spec, spans: list[FreeSpan], ends: list[tuple[float, float]],
    places: dict[int, tuple[int, ...]],
) -> list[tuple[tuple[int, ...], np.ndarray]]:  # fmt: skip
    """What the tensions of its spans do to a weight that goes aside: T/l (1 - e e')."""
    found = []
    for p, span in enumerate(spans):
        e = np.array(span.along)
        for i, pull in zip(spec.pairs[p], ends[p], strict=True):
            if len(places.get(i, ())) == 3 and spec.route[i].is_free:
                found.append((places[i], pull / span.length * (np.eye(3) - np.outer(e, e))))
    return found


def _strings(
    spec: Spec, spans: list[FreeSpan], ends: list[tuple[float, float]],
    places: dict[int, tuple[int, ...]], draft: _Draft, drives: Drives, times: np.ndarray,
) -> list[String]:  # fmt: skip
    """The motion across of every weight that starts across its cable or hangs on a moved end."""
    found = []
    weights = [i for i, each in enumerate(spec.route) if each.is_free]
    for number, i in enumerate(weights):
        beside = [p for p in spec.beside(i) if p >= 0]
        for way in _directions(spec, spans, i, beside):
            found.append(_string(spec, spans, ends, (i, number, beside), way, drives, times))
            for j, c in zip(places[i], way, strict=True):
                draft.speeds[j] -= c * dot(spec.route[i].velocity, way)
    return found


def _directions(spec: Spec, spans: list[FreeSpan], i: int, beside: list[int]) -> list[Vector]:
    """Directions across the cable in which something moves at station i."""
    line = spans[beside[0]].along
    moves = [spec.route[i].velocity]
    for p in beside:
        for k in spec.pairs[p]:
            if k != i and spec.route[k].is_moved:
                laws = zip(AXES, spec.route[k].motion, strict=True)
                moves += [axis for axis, law in laws if law]
    found: list[Vector] = []
    for move in moves:
        aside = part_across(move, line)
        for own in found:
            aside = add(aside, own, -dot(aside, own))
        if norm(aside) > ASIDE * (1 + norm(move)):
            found.append(unit(aside))
    return found


def _string(
    spec: Spec, spans: list[FreeSpan], ends: list[tuple[float, float]],
    at: tuple[int, int, list[int]], way: Vector, drives: Drives, times: np.ndarray,
) -> String:  # fmt: skip
    i, number, beside = at
    each = spec.route[i]
    masses, speeds, bars = [each.mass], [dot(each.velocity, way)], []
    ways: dict[int, np.ndarray] = {}
    for p in beside:
        a, b = spec.pairs[p]
        other = b if a == i else a
        held: Terms = ()
        if spec.route[other].is_moved:
            j = len(masses)
            masses.append(1.0)
            speeds.append(0.0)
            ways[j] = sum(
                (c * drives.motions[other, axis](times) for axis, c in enumerate(way)
                 if (other, axis) in drives.motions), np.zeros_like(times),
            )  # fmt: skip
            held = ((j, 1.0),)
        own: Terms = ((0, 1.0),)
        start, finish = (own, held) if a == i else (held, own)
        bars.append(Bar(start, finish, spans[p].length, ends[p], points=(a == i, b == i)))
    network = Network(
        tuple(masses), tuple(bars), spec.cable.density, spec.end, len(times) - 1, tuple(speeds),
        ways=ways,
    )  # fmt: skip
    return String(network, tuple(beside), number)
