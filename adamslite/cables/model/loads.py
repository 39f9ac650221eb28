"""Loads that several cables carry: which cable is on which, what each bears at rest, statements.

The tensions T at rest hold every load in balance, with reactions R of its hinge,

    A T + B R = -(m g, 0),      A: directions of the cable at its places on the load, and moments

and among several that do so have the least strain energy, sum T^2 l/(2 EA) (Menabrea): those of
cables that just reach the load unloaded. A cable with a pretension, a length or a weight has its
own: T = EA (l/length - 1).
"""

from dataclasses import dataclass, replace

import numpy as np

from adamslite.cables.description.components import Load
from adamslite.cables.description.messages import Faults
from adamslite.cables.description.vocabulary import Numbers, Spec, Station
from adamslite.cables.layout.geometry import FreeSpan, wrap
from adamslite.cables.model.estimate import Laws
from adamslite.cables.vectors import ZERO, Vector, add, cross, dot, norm, unit

# A reaction of a hinge counts as that of a rope as much stiffer.
HINGE = 1e6
# Share with which torques count that nothing balances: forces come first.
TORQUE = 1e-4
# Of the weight, and of it on an arm of a metre: what may be left of a balance.
BALANCED = 1e-6
# Of lengths, and of the cosine of directions on a line.
ROUND_OFF = 1e-9
# Of the mass of a load, on a cable that does not carry it.
LEAST = 1e-6
# Strains that a length of a cable may give it.
MOST_SLACK, MOST_STRAIN = 0.2, 0.5


@dataclass(frozen=True)
class Rope:
    """A cable as it is drawn, with its laws."""

    spec: Spec
    spans: list[FreeSpan]
    faults: Faults
    laws: Laws


def on_loads(
    cables: list[tuple[Spec, Faults]], loads: tuple[Load, ...], faults: Faults
) -> tuple[list[Spec], tuple[Load, ...]]:
    """The cables with their numbers in the deck and their places on loads, which have parts."""
    stations, spans = (sum(len(getattr(spec, x)) for spec, _ in cables) for x in ("route", "pairs"))
    loads = tuple(replace(each, part=10 * (stations + 1 + k)) for k, each in enumerate(loads))
    _check_loads(cables, loads, faults)
    found, before = [], Numbers(0, 0, stations, spans)
    for k, (spec, own) in enumerate(cables):
        route = tuple(_on(each, i, loads, own) for i, each in enumerate(spec.route))
        found.append(replace(spec, route=route, numbers=replace(before, name=str(k + 1))))
        before = replace(before, stations=before.stations + len(route),
                         spans=before.spans + len(spec.pairs))  # fmt: skip
    return found, loads


def _check_loads(
    cables: list[tuple[Spec, Faults]], loads: tuple[Load, ...], faults: Faults
) -> None:
    """Names that are there, one for each; something that holds every load."""
    names = [each.name for each in loads]
    used = {each.load for spec, _ in cables for each in spec.route if each.load}
    used |= {names[0]} if len(loads) == 1 else set()
    for k, each in enumerate(loads):
        if names.index(each.name) < k:
            faults.add("same-load", ("load", k), i=names.index(each.name) + 1, name=each.name)
        elif each.name not in used and not each.pivot:
            faults.add("no-hook", ("load", k))
        if not each.pivot:
            continue
        if each.pivot.on and (each.pivot.on not in names or each.pivot.on == each.name):
            faults.add(
                "no-such-load", ("load", k, "pivot"), word=each.pivot.on, known=_known(names)
            )
        if not each.turns:
            faults.add("load-point", ("load", k, "pivot"), why="this one turns about a hinge")


def _known(names: list[str]) -> str:
    return ", ".join(filter(None, names)) or "missing: [[load]] with a name"


def _on(each: Station, i: int, loads: tuple[Load, ...], faults: Faults) -> Station:
    """The station with the number and place of the load that it is on."""
    if each.kind != "hook" and not each.load:
        return each
    names, path, label = [load.name for load in loads], ("route", i), f"station {i + 1}"
    if not loads:
        faults.add("no-load", path, label=label)
        return each
    if not each.load and len(loads) != 1:
        faults.add("which-load", path, label=label, count=len(loads))
        return each
    if each.load and each.load not in names:
        faults.add("no-such-load", (*path, "load"), word=each.load, known=_known(names))
        return each
    load = loads[names.index(each.load) if each.load else 0]
    away = norm(add(each.at, load.at, -1))
    if not load.turns and (each.is_wheel or away > ROUND_OFF * (1 + norm(load.at))):
        what = "is a wheel on it" if each.is_wheel else f"is {away:.4g} m from there"
        faults.add("load-point", (*path, "at"), why=f"{label} {what}")
    for word in ("mass", "slide", "pull", "motion", "mount", "block"):
        value = getattr(each, word)
        if each.is_wheel and (any(value) if isinstance(value, tuple) else value):
            faults.add("load-alone", (*path, word), label=label, word=word)
    own = replace(each, on=load.part, origin=load.at, mass=load.mass, velocity=load.velocity)
    return own if each.is_wheel else replace(own, inertia=max(load.inertia))


def shared(ropes: list[Rope], loads: tuple[Load, ...], faults: Faults) -> list[Spec]:
    """The cables with the tensions that they have at the start, and what each bears as its weight:
    of cables with lengths that which they would have if they just reached the load."""
    given = [_own_tension(rope) for rope in ropes]
    for rope, tension in zip(ropes, given, strict=True):
        _check_strain(rope, tension)
    if faults.errors:
        return [rope.spec for rope in ropes]
    lengths = [bool(rope.spec.cable.length) for rope in ropes]
    loose = [None if has else own for has, own in zip(lengths, given, strict=True)]
    bears, left = _balanced(ropes, loads, loose)
    if not (ropes[0].spec.statics or any(lengths)):
        _tell_balance(ropes[0].spec, loads, left, faults)
    pulls = _balanced(ropes, loads, given)[0] if any(lengths) else bears
    return [
        _bearing(rope, pull, bear) for rope, pull, bear in zip(ropes, pulls, bears, strict=True)
    ]


def _balanced(
    ropes: list[Rope], loads: tuple[Load, ...], given: list[float | None]
) -> tuple[list[float], np.ndarray]:
    """The tension of every cable, and the forces and torques on all loads that are left."""
    columns = np.array([_column(rope, loads) for rope in ropes]).T
    lengths = np.array([sum(span.length for span in rope.spans) for rope in ropes])
    soft = lengths / [rope.spec.cable.stiffness for rope in ropes]
    wanted, hinges = -_weights(ropes, loads), _hinges(loads)
    scale = np.tile([1.0] * 3 + [TORQUE / lengths.max()] * 3, len(loads))
    pulls = np.array([value or 0.0 for value in given])
    free = np.array([value is None for value in given]) & columns.any(axis=0)
    while True:
        left = (wanted - columns[:, ~free] @ pulls[~free]) * scale
        stiff = 1 / np.sqrt(soft[free] / soft.mean())
        matrix = np.hstack([columns[:, free] * stiff, HINGE * hinges]) * scale[:, None]
        found = np.linalg.lstsq(matrix, left, rcond=1e-12)[0] if matrix.size else np.zeros(0)
        own = stiff * found[: free.sum()]
        if (own >= 0).all():
            break
        free[np.flatnonzero(free)[own < 0]] = False
    pulls[free] = own
    return [float(pull) for pull in pulls], (matrix @ found - left) / scale


def _check_strain(rope: Rope, tension: float | None) -> None:
    """Whether a given length is one that the cable can have."""
    length, strain = rope.spec.cable.length, (tension or 0.0) / rope.spec.cable.stiffness
    if length and not -MOST_SLACK < strain < MOST_STRAIN:
        rope.faults.add("length-too-short" if strain > 0 else "length-too-long",
                        ("cable", "length"), length=length,
                        spacing=length * (1 + strain))  # fmt: skip


def are_determined(ropes: list[Rope], loads: tuple[Load, ...]) -> bool:
    """Whether statics alone determines the tensions of all cables on loads."""
    columns = np.array([_column(rope, loads) for rope in ropes]).T
    columns = columns[:, columns.any(axis=0)]
    matrix = np.hstack([columns, _hinges(loads)])
    return bool(np.linalg.matrix_rank(matrix, tol=1e-6) == matrix.shape[1])


def _own_tension(rope: Rope) -> float | None:
    """The tension that a cable has whatever a load weighs; None where it follows from that."""
    spec, cable = rope.spec, rope.spec.cable
    if cable.length:
        arcs = (each.radius * wrap(spec, rope.spans, i) for i, each in enumerate(spec.route))
        drawn = sum(span.length for span in rope.spans) + sum(arcs)
        return cable.stiffness * (drawn / cable.length - 1)
    ends = (spec.route[0], rope.spans[0], -1), (spec.route[-1], rope.spans[-1], 1)
    hung = [each.mass * max(0.0, sense * dot(spec.gravity, span.along))
            for each, span, sense in ends if each.kind in ("mass", "body")]  # fmt: skip
    return max([cable.pretension, *hung]) or None


def _pulls(rope: Rope, i: int) -> list[tuple[Vector, Vector]]:
    """Place and direction of the cable at station i, for each span there."""
    found = []
    before, behind = rope.spec.beside(i)
    if before >= 0:
        span = rope.spans[before]
        found.append((span.finish, add(ZERO, span.along, -1)))
    if behind >= 0:
        found.append((rope.spans[behind].start, rope.spans[behind].along))
    return found


def _column(rope: Rope, loads: tuple[Load, ...]) -> list[float]:
    """Forces and moments on all loads of a tension of 1."""
    found: list[float] = []
    for load in loads:
        force, moment = ZERO, ZERO
        for i, each in enumerate(rope.spec.route):
            for place, along in _pulls(rope, i) if each.on == load.part else []:
                force = add(force, along)
                moment = add(moment, cross(add(place, load.at, -1), along))
        found += [*force, *(moment if load.turns else ZERO)]
    return found


def _hung(rope: Rope, load: Load) -> list[tuple[Vector, np.ndarray]]:
    """Places and weights of the wheels on a load, and of the cable that hangs from it."""
    spec, found = rope.spec, []
    gravity = np.array(spec.gravity)
    for i, each in enumerate(spec.route):
        if each.on != load.part:
            continue
        if each.is_wheel:
            found.append((each.at, each.inertia / each.radius**2 * gravity))
        for p in spec.beside(i):
            if p >= 0:
                span = rope.spans[p]
                sense = 1 if spec.pairs[p][0] == i else -1
                down = max(sense * dot(spec.gravity, span.along), 0.0)
                pull = spec.cable.density * span.length * down * sense
                found.append(
                    (span.start if sense > 0 else span.finish, pull * np.array(span.along))
                )
    return found


def _weights(ropes: list[Rope], loads: tuple[Load, ...]) -> np.ndarray:
    """Forces and moments of gravity on all loads, with the wheels on them."""
    gravity, found = np.array(ropes[0].spec.gravity), []
    for load in loads:
        force, moment = load.mass * gravity, np.zeros(3)
        for place, weight in (each for rope in ropes for each in _hung(rope, load)):
            force = force + weight
            moment = moment + np.cross(np.subtract(place, load.at), weight)
        found += [*force, *moment]
    return np.array(found)


def _hinges(loads: tuple[Load, ...]) -> np.ndarray:
    """Columns of the reactions of hinges: three forces, and two moments across the axle."""
    columns, names = [], [each.name for each in loads]
    for k, load in enumerate(loads):
        if not load.pivot:
            continue
        bodies = [(k, load, 1)]
        if load.pivot.on in names:
            other = names.index(load.pivot.on)
            bodies.append((other, loads[other], -1))
        axle = np.array(unit(load.pivot.axis))
        for force in np.eye(3):
            column = np.zeros(6 * len(loads))
            for i, body, sign in bodies:
                arm = np.subtract(load.pivot.at, body.at)
                column[6 * i : 6 * i + 6] = sign * np.array([*force, *np.cross(arm, force)])
            columns.append(column)
        for moment in np.linalg.svd(axle[None])[2][1:]:
            column = np.zeros(6 * len(loads))
            for i, _, sign in bodies:
                column[6 * i + 3 : 6 * i + 6] = sign * moment
            columns.append(column)
    return np.array(columns).T.reshape(6 * len(loads), -1)


def _tell_balance(spec: Spec, loads: tuple[Load, ...], rest: np.ndarray, faults: Faults) -> None:
    """Say which load does not start at rest."""
    for k, load in enumerate(loads):
        force, torque = rest[6 * k : 6 * k + 3], rest[6 * k + 3 : 6 * k + 6]
        weight = load.mass * norm(spec.gravity)
        if max(*abs(force), *abs(torque)) > BALANCED * weight:
            left = float(np.linalg.norm(force)), float(np.linalg.norm(torque))
            faults.add("unbalanced", ("load", k), name=load.name or "the load", force=left[0],
                       torque=left[1])  # fmt: skip


def _bearing(rope: Rope, pull: float, bear: float) -> Spec:
    """The cable with its tension, and stations on loads that weigh as much as it bears of them."""
    spec, route = rope.spec, list(rope.spec.route)
    if not any(each.on for each in route):
        return spec
    for i, each in enumerate(route):
        if not each.on:
            continue
        ways = [along for _, along in _pulls(rope, i)]
        total = ZERO
        for along in ways:
            total = add(total, along)
        # Where its falls are parallel a wheel moves along them.
        parallel = each.is_wheel and norm(cross(ways[0], ways[-1])) < ROUND_OFF
        up = -dot(spec.gravity, total)
        size = dot(total, total)
        mass = 0.0
        if up > ROUND_OFF * norm(spec.gravity):
            own = each.inertia / each.radius**2 if each.is_wheel else 0.0
            mass = max(max(bear, 0.0) * size / up - own, LEAST * each.mass)
        slide = unit(total) if parallel else ZERO
        route[i] = replace(each, mass=mass, slide=slide)
    rests, stretch = tuple([pull] * len(rope.spans)), 1 + pull / spec.cable.stiffness
    frees = tuple(span.length / stretch for span in rope.spans) if spec.cable.length else ()
    cable = replace(spec.cable, length=0.0, pretension=max(bear, 0.0))
    return replace(spec, cable=cable, route=tuple(route), rests=rests, frees=frees)


def as_borne(spec: Spec) -> Spec:
    """The cable alone, for the choice of its model: what it does not carry holds it."""
    route = (
        replace(each, kind="fixed") if each.kind == "hook" and not each.mass else each
        for each in spec.route
    )
    return replace(spec, route=tuple(route))
