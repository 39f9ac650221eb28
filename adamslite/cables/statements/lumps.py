"""Form brute: the whole cable as sections of fixed length that run over the rims of the wheels.

A node that meets a wheel is pressed outwards by IMPACT and dragged along by Coulomb friction, mu N
times a STEP of the sliding speed. Nothing prescribes its position: it runs on, leaves the wheel,
and what is stored on a winch comes off it node by node. Node k of stretch s, between two ends or
weights, is MARKER/1000 s + k.

    contact     K = 80 T/h: a node sinks in by h**2/(80 R), a tenth of the sagitta of its section
                damper 0.2 sqrt(K rho h), a tenth of the critical one
"""

from dataclasses import dataclass
from math import atan2, ceil, cos, inf, pi, sin, sqrt

from adamslite.cables.description.vocabulary import Spec
from adamslite.cables.layout.brute_force_layout import (
    Arc,
    Layout,
    Straight,
    Tension,
    lay,
    length,
    plane,
    stretches,
    way,
)
from adamslite.cables.layout.geometry import FreeSpan, reaches
from adamslite.cables.model.demand import loaded
from adamslite.cables.model.estimate import Moves
from adamslite.cables.model.model_choice import SUNK, CableModel, demand_on_longest, tensions
from adamslite.cables.statements import graphics
from adamslite.cables.statements.ends import end
from adamslite.cables.statements.forms import number, point, section
from adamslite.cables.statements.wheels import mount_request, triple, turning
from adamslite.cables.statements.winches import drive
from adamslite.cables.vectors import Vector, add, dot, unit

# What a wheel without mu has: the cable creeps on it by a fifth of what mu = 1 would let it.
GRIP = 5.0
# Height of teeth over the pitch, bluntness of their roots.
TOOTH, ROOT = 0.24, 0.05
# Damper of a contact as a share of sqrt(stiffness mass), and the strain that is expected at least.
DAMPED, LEAST_STRAIN = 0.2, 1e-6
# Nodes that come near a wheel by this multiple of the way can touch it.
MARGIN = 1.1
# Sliding speed at which friction is full: at least this [m/s], or this share of the payout's.
CREEP, CREEP_SHARE = 1e-3, 2.5e-3


@dataclass(frozen=True)
class Stretch:
    """A stretch of cable from station to station."""

    number: int
    laid: Layout
    first: int
    last: int
    closed: bool

    def node(self, k: int, spec: Spec) -> int:
        """Marker of node k; an end has that of its station, or of its wheel."""
        count = len(self.laid.nodes) - 1
        if self.closed:
            return 1000 * self.number + k % count
        if k in (0, count):
            i = self.last if k else self.first
            if spec.route[i].is_wheel:
                return spec.marker(i) + 6
            if spec.route[i].kind != "run":
                return spec.marker(i)
        return 1000 * self.number + k


def stored(spec: Spec, moves: Moves) -> dict[int, float]:
    """Cable on every winch at an end of the route at the start [m]: what is paid out and a half
    turn more, where the description does not say."""
    found = {}
    for i in spec.winches:
        if spec.is_end(i):
            each, paid = spec.route[i], moves.paid.get(i)
            most = paid.most if paid else moves.most
            found[i] = each.stored if each.stored >= 0 else max(most, 0.0) + pi * each.radius
    return found


def stiffness(spec: Spec, spans: list[FreeSpan], moves: Moves, section: float) -> float:
    """Of the contact of a node [N/m], from the greatest tension that is expected."""
    # A front doubles where it is thrown back.
    fronts = (
        2 * loaded(demand_on_longest(spec, spans, moves)) if moves.across or moves.jump else 0.0
    )
    expected = max(*tensions(spec, spans), fronts, LEAST_STRAIN * spec.cable.stiffness)
    return SUNK * expected / section


def write_lumps(spec: Spec, spans: list[FreeSpan], model: CableModel, moves: Moves) -> str:
    """Stretches, ends, contacts, what turns the wheels, results."""
    section = spec.pitch or max(reaches(spec, spans)) / model.elements
    wheels = any(each.is_wheel for each in spec.route)
    contact = stiffness(spec, spans, moves, section) if wheels else inf
    held, found = stored(spec, moves), []
    for s, group in enumerate(stretches(spec), 1):
        parts = way(spec, spans, group, held)
        count = max(ceil(length(parts, spec.pitch) / section - 0.5), 2)
        laid = lay(spec, parts, count, _tension(spec, spans), contact)
        first, last = spec.pairs[group[0]][0], spec.pairs[group[-1]][1]
        found.append(Stretch(s, laid, first, last, spec.closed))
    text = _constants(spec, moves, contact, section) if wheels else ""
    text += "".join(_stretch(spec, each, start_speed(spec, moves)) for each in found)
    text += _ends(spec, found)
    for each in found:
        text += _contacts(spec, each, moves, section)
    for i, station in enumerate(spec.route):
        text += drive(spec, i, []) if station.is_wheel else ""
    return text + _requests(spec, found) + _drawing(spec, found)


def start_speed(spec: Spec, moves: Moves) -> float:
    """A loop starts at its own speed, or at that which the first payout law starts with [m/s]."""
    if spec.speed:
        return spec.speed
    starts = [each.start for each in moves.paid.values()]
    return starts[0] if spec.closed and starts else 0.0


def _tension(spec: Spec, spans: list[FreeSpan]) -> Tension:
    """At rest: that of the span less the weight of the cable above its free end; one with bends
    hangs from both its ends."""
    pulls, last = tensions(spec, spans), len(spans) - 1

    def pull(p: int, place: Vector) -> float:
        free = spec.route[-1 if p == last and spec.route[-1].is_free else 0].at
        free = _lowest(spec) if spec.bends else free
        return pulls[p] - spec.cable.density * dot(spec.gravity, add(place, free, -1))

    def tension(part: Straight | Arc, at: float, place: Vector) -> float:
        if isinstance(part, Straight):
            return pull(part.span, place)
        share = min(max(at / part.length, 0.0), 1.0) if part.length else 0.0
        return (1 - share) * pull(part.spans[0], place) + share * pull(part.spans[1], place)

    return tension


def _lowest(spec: Spec) -> Vector:
    """The lowest place that any station reaches."""
    down = unit(spec.gravity)
    places = [add(each.at, down, each.radius) for each in spec.route]
    return max(places, key=lambda place: dot(place, down))


def _constants(spec: Spec, moves: Moves, contact: float, section: float) -> str:
    damper = DAMPED * sqrt(contact * spec.cable.density * section)
    depth = section**2 / SUNK / max(each.radius for each in spec.route if each.is_wheel)
    return (
        "! A contact: stiffness, damper, and the depth at which the damper is full; sliding speed\n"
        "! at which friction is full.\n"
        f"VARIABLE/KC, FUNCTION={number(contact)}\nVARIABLE/CC, FUNCTION={number(damper)}\n"
        f"VARIABLE/DC, FUNCTION={number(depth)}\n"
        f"VARIABLE/VC, FUNCTION={number(max(CREEP, CREEP_SHARE * moves.speed))}\n"
    )


def _stretch(spec: Spec, s: Stretch, speed: float) -> str:
    """Nodes between the ends, and sections."""
    cable, count = spec.cable, len(s.laid.nodes) - 1
    text = (
        f"\n! ---- cable from station {s.first + 1} to {s.last + 1}: {count} sections ----\n"
        f"VARIABLE/L{s.number}, FUNCTION={number(s.laid.free)}\n"
    )
    mass = cable.density * s.laid.free
    for k, node in enumerate(s.laid.nodes):
        i = s.node(k, spec)
        if i >= 1000 and not (s.closed and k == count):
            half = 0.5 if not s.closed and k in (0, count) else 1.0
            text += point(i, half * mass, node.place, [speed * x for x in node.along])
    for k in range(count):
        i, j = s.node(k, spec), s.node(k + 1, spec)
        damped = cable.damping_time > 0
        text += section(1000 * s.number + k + 1, i, j, f"L{s.number}", damped, cable.pulls_only)
    return text


def _ends(spec: Spec, found: list[Stretch]) -> str:
    """What stretches are held by, carry or end on."""
    text = "\n! ---- ends and weights ----\n"
    half = {i: 0.0 for i in range(len(spec.route))}
    for s in found:
        for i, k in ((s.first, 0), (s.last, -1)):
            half[i] += spec.cable.density * s.laid.free / 2
            each, n, node = spec.route[i], spec.marker(i), s.laid.nodes[k]
            if each.is_wheel and not s.closed:
                place = triple(add(node.place, each.at, -1))
                text += f"MARKER/{n + 6}, PART={n}, QP={place}  ! fixed to it\n"
            if each.kind == "run":
                text += _run(spec, s, i, k)
    for i, each in enumerate(spec.route):
        text += end(spec, i, half[i]) if not each.is_wheel else ""
    return text


def _run(spec: Spec, s: Stretch, i: int, k: int) -> str:
    """A long straight run of the cable: T0 + rho c times the speed away from it."""
    n, node = spec.marker(i), s.laid.nodes[k]
    node_marker = s.node(len(s.laid.nodes) - 1 if k else 0, spec)
    outwards = add(node.place, node.along, 1 if k else -1)
    return (
        "! A long run goes on from here: it pulls with T0 + rho c times the speed out of it.\n"
        f"MARKER/{n}, PART=1, QP={triple(node.place)}, ZP={triple(outwards)}\n"
        f"SFORCE/{n}, ACTIONONLY, I={node_marker}, J={n}\n"
        f", FUNCTION={number(spec.cable.pretension)}-SQRT(EA*rho)*VZ({node_marker},{n},{n})\n"
    )


def _contacts(spec: Spec, s: Stretch, moves: Moves, section: float) -> str:
    """Every node with every wheel it can reach."""
    text, count = "", len(s.laid.nodes) - 1
    reach = MARGIN * moves.way + 3 * section
    for i, (begin, finish) in s.laid.wheels.items():
        each, n = spec.route[i], spec.marker(i)
        text += f"\n! ---- the wheel of station {i + 1} carries what lies on it ----\n"
        text += f"MARKER/{n + 4}, PART={n}, FLOATING\n" if each.mu or each.teeth else ""
        gap = _gap(spec, s, i) if each.teeth else 0.0
        for k, node in enumerate(s.laid.nodes[:count] if s.closed else s.laid.nodes):
            m = s.node(k, spec)
            near = begin - reach <= node.way <= finish + reach
            if m != n + 6 and (near or s.closed or not moves.known):
                text += _tooth(spec, i, m, gap) if each.teeth else _contact(spec, i, m)
    return text


def _contact(spec: Spec, i: int, k: int) -> str:
    """Of MARKER/k with wheel i: N outwards, S sliding speed, F friction along the rim."""
    n, radius, mu = spec.marker(i), spec.route[i].radius, spec.route[i].mu
    mu = mu if mu >= 0 else GRIP
    push = f"IMPACT(DM({k},{n}),VR({k},{n}),{number(radius)},KC,1.0,CC,DC)"
    if not mu:
        return f"SFORCE/C{n}_{k}, I={k}, J={n}, FUNCTION={push}\n"
    b = n + 1
    x, y = f"DX({k},{n},{b})", f"DY({k},{n},{b})"
    return (
        f"VARIABLE/N{n}_{k}, FUNCTION={push}\n"
        f"VARIABLE/S{n}_{k}, FUNCTION=({x}*VY({k},{n},{b})-{y}*VX({k},{n},{b}))/DM({k},{n})\n"
        f", -{turning(i, spec, 1)}*DM({k},{n})\n"
        f"VARIABLE/F{n}_{k}, FUNCTION={number(mu)}*N{n}_{k}*STEP(S{n}_{k},-VC,-1,VC,1)\n"
        f"VFORCE/C{n}_{k}, I={k}, JFLOAT={n + 4}, RM={b}\n"
        f", FX=(N{n}_{k}*{x}+F{n}_{k}*{y})/DM({k},{n})\\\n"
        f", FY=(N{n}_{k}*{y}-F{n}_{k}*{x})/DM({k},{n})\n"
    )


def _gap(spec: Spec, s: Stretch, i: int) -> float:
    """Angle of a gap of sprocket i at the start, times its teeth: where its pins lie [rad]."""
    each, flat = spec.route[i], plane(spec)
    begin, finish = s.laid.wheels[i]
    x, y = flat.seen(each.at)
    seated = [flat.seen(node.place) for node in s.laid.nodes if begin < node.way < finish]
    # Angles in the axes of the bearing, whose x need not be that of the plane.
    turned = [each.teeth * atan2(q - y, p - x) for p, q in seated]
    return atan2(sum(map(sin, turned)), sum(map(cos, turned)))


def _tooth(spec: Spec, i: int, k: int, gap: float) -> str:
    """Of the pin MARKER/k with sprocket i: P outwards, Q along the rim, which stops pins at

    R + H (sqrt(sin(z a/2)^2 + e^2) - e),  a from a gap, H = 0.24 pitches, e = 0.05

    and pushes at right angles to itself.
    """
    each, n = spec.route[i], spec.marker(i)
    b, z, tooth = n + 1, each.teeth, TOOTH * each.pitch
    x, y = f"DX({k},{n},{b})", f"DY({k},{n},{b})"
    return (
        f"VARIABLE/A{n}_{k}, FUNCTION={z}*(ATAN2({y},{x})-{turning(i, spec)})-{number(gap)}\n"
        f"VARIABLE/H{n}_{k}, FUNCTION=SQRT((1-COS(A{n}_{k}))/2+{number(ROOT**2)})\n"
        f"VARIABLE/P{n}_{k}, FUNCTION=IMPACT(DM({k},{n}),VR({k},{n}),\n"
        f", {number(each.radius)}+{number(tooth)}*(H{n}_{k}-{ROOT:g}),KC,1.0,CC,DC)\n"
        f"VARIABLE/Q{n}_{k}, FUNCTION=-P{n}_{k}*{number(tooth * z / 4)}*SIN(A{n}_{k})\n"
        f", /H{n}_{k}/DM({k},{n})\n"
        f"VFORCE/C{n}_{k}, I={k}, JFLOAT={n + 4}, RM={b}\n"
        f", FX=(P{n}_{k}*{x}-Q{n}_{k}*{y})/DM({k},{n})\\\n"
        f", FY=(P{n}_{k}*{y}+Q{n}_{k}*{x})/DM({k},{n})\n"
    )


def _drawing(spec: Spec, found: list[Stretch]) -> str:
    """The cable through its nodes, which lie on the rims."""
    text = graphics.solids(spec)
    for s in found:
        nodes = range(len(s.laid.nodes))
        first, last = 1000 * s.number + 1, 1000 * s.number + len(nodes) - 1
        markers = [s.node(k, spec) for k in nodes]
        text += graphics.line(s.number, markers, [], [f"-SFORCE/{first}..{last}.f"])
    return text


def _requests(spec: Spec, found: list[Stretch]) -> str:
    """Tension at the ends; travel, rim speed, load and driving pull of every wheel."""
    text = "\n! ---- results ----\n"
    for s in found:
        if not s.closed or spec.bends:
            first, last = 1000 * s.number + 1, 1000 * s.number + len(s.laid.nodes) - 1
            ends = f"at station {s.first + 1} and at station {s.last + 1}"
            text += (
                f"! Tension {'of the first and the last section' if s.closed else ends}.\n"
                f"REQUEST/{s.number}, F2=SFORCE({first},0,1)\\ F3=SFORCE({last},0,1)\n"
            )
    for i, each in enumerate(spec.route):
        if each.is_wheel:
            n, rim = spec.marker(i), number(each.turn * each.radius)
            pull = f"\\ F6=-GCON({n})" if each.payout else ""
            addition = ", pull of the winch" if pull else ""
            text += (
                f"! Way and speed of the rim of station {i + 1}, load on its axle{addition}.\n"
                f"REQUEST/{n}, F2={rim}*{turning(i, spec)}\\ F3={rim}*{turning(i, spec, 1)}"
                f"\\ F4=JOINT({n},0,1,0){pull}\n"
            )
        text += mount_request(spec, i)
    return text
