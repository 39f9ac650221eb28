"""Levels 1 to 3: every span of the route as a rigid cable, or as nodes and sections.

Node k of span p is MARKER/1000 p + k, counted from the wheel, from the start of the route without
one; between two wheels nodes are states. A run that continues pulls with T0 + rho c v.

The half section beside a wheel whose axle moves, with e from the wheel at x_0 along the cable, H a
section, S the cable that the wheel brings:

    T       = T_section + rho H/2 (e.g - S" - e.x_0")              at the rim
    force   = T_section e - rho H/2 (x_0" + S" e - g) - rho S'^2 e          on the carriage

The paper's form has no S". With form ale the cable also has the accelerations of what flows, as
beside a weight that slides.
"""

from dataclasses import replace

from adamslite.cables.description.vocabulary import Spec
from adamslite.cables.layout.catenary import start
from adamslite.cables.layout.geometry import FreeSpan
from adamslite.cables.layout.sag import hanging
from adamslite.cables.model.model_choice import CableModel
from adamslite.cables.statements import sliders
from adamslite.cables.statements.around import Row, write_around, write_clamp
from adamslite.cables.statements.capstan import half_section, turned
from adamslite.cables.statements.ends import end
from adamslite.cables.statements.forms import (
    AXES,
    Side,
    elastic,
    gravity,
    grown,
    grown_tip,
    length_variables,
    number,
    point,
    section,
    vforce,
)
from adamslite.cables.statements.links import borne
from adamslite.cables.statements.pieces import (
    Piece,
    feed,
    inflow,
    is_between,
    is_moving,
    parting,
    parts_at,
    pieces,
    pulled,
    root_marker,
)
from adamslite.cables.statements.wheel_spans import apart, touches, write_link
from adamslite.cables.statements.wheels import triple
from adamslite.cables.vectors import ZERO, Vector, add, dot


def write_pieces(spec: Spec, spans: list[FreeSpan], model: CableModel) -> str:
    """Spans, ends, what turns the wheels."""
    found = pieces(spec, spans, model.elements)
    text = "".join(_span(spec, model, piece) for piece in found)
    text += _ends(spec, model, found)
    for i, each in enumerate(spec.route):
        if each.is_wheel:
            text += turned(spec, spans, model, found, i)
        elif each.slides and model.level > 1:
            text += sliders.flow(spec, i, found[i].tension)
    return text


def _span(spec: Spec, model: CableModel, piece: Piece) -> str:
    """One span in the form of its level."""
    i, j = piece.ends
    text = (
        f"\n! ---- span {piece.number}, from station {spec.station(i)} to {spec.station(j)} ----\n"
    )
    root = spec.route[piece.root]
    if root.is_wheel and (is_moving(spec, piece) or not is_between(spec, piece)):
        to = _next(spec, model, piece)
        text += touches(spec, piece, piece.first, to)
    if root.slides and model.level == 1:
        return text + (sliders.rigid(spec, piece.root) if piece.sense < 0 else "! With the last.\n")
    if root.slides:
        text += sliders.opening(spec, piece.root, piece.first)
    if model.level == 1:
        return text + _rigid(spec, piece)
    if spec.route[piece.tip].kind == "run":
        return text + _run(spec, piece)
    if is_between(spec, piece):
        return text + write_link(spec, piece)
    return text + _chain(spec, model, piece)


def _next(spec: Spec, model: CableModel, piece: Piece) -> int:
    """The marker that the cable goes to from the root."""
    if is_between(spec, piece):
        return piece.first + 1
    whole = model.level == 1 or spec.route[piece.tip].kind == "run"
    return spec.marker(piece.tip) if whole else side_of(spec, piece, model).node(1)


def is_kept(spec: Spec, piece: Piece) -> bool:
    """Whether a GCON keeps the length of a rigid piece: something moves at one of its ends."""
    ends = [spec.route[i] for i in (piece.root, piece.tip)]
    return ends[0].is_wheel or any(each.is_free for each in ends)


def _rigid(spec: Spec, piece: Piece) -> str:
    if is_between(spec, piece):
        text, spacing = apart(spec, piece)
        more = f"{spacing}-{number(piece.span.length)}-({inflow(spec, piece)})"
        return text + f"GCON/{piece.label}, FUNCTION={more}\n"
    if not is_kept(spec, piece):
        return "! Held at both ends: nothing moves.\n"
    more = f"-({feed(spec, piece)})" if spec.route[piece.root].is_wheel else ""
    i, j = spec.marker(piece.tip), root_marker(spec, piece)
    return f"GCON/{piece.label}, FUNCTION=DM({i},{j})-{number(piece.span.length)}{more}\n"


def _run(spec: Spec, piece: Piece) -> str:
    """A long straight run of the cable: T = T0 + rho c times the speed of the cable out of it, v =
    (1 + T/EA) times the unstretched cable that a wheel takes."""
    p, root = piece.number, spec.route[piece.root]
    text = "! A long run goes on from here: it pulls with T0 + rho c times the speed out of it.\n"
    start = number(piece.tension)
    if root.is_wheel:
        taken = f"({feed(spec, piece, 1)})"
        pull = f"({start}-SQRT(EA*rho)*{taken})/(1+SQRT(rho/EA)*{taken})"
        text += _on_axle(spec, piece) if root.leans or root.mount else ""
    else:
        end = spec.marker(piece.tip)
        text += f"MARKER/{end}, PART=1, QP={triple(piece.place)}, ZP="
        text += f"{triple(add(piece.place, piece.along))}\n"
        pull = f"{start}-SQRT(EA*rho)*VZ({spec.marker(piece.root)},{end},{end})"
        text += f"SFORCE/{end}, ACTIONONLY, I={spec.marker(piece.root)}, J={end}, FUNCTION=T{p}\n"
    return text + f"VARIABLE/T{p}, FUNCTION={pull}\n"


def _on_axle(spec: Spec, piece: Piece) -> str:
    """The pull of a long run on the link or mount of the wheel."""
    i, end, m = piece.root, spec.marker(piece.tip), piece.first
    text = f"MARKER/{end}, PART=1, QP={triple(spec.route[piece.tip].at)}\n"
    text += f"SFORCE/{m}, I={m}, J={end}, FUNCTION=-T{piece.number}\n"
    return text + borne(spec, i, m, end, piece.sense, f"T{piece.number}")


def _hanging(spec: Spec, model: CableModel, piece: Piece) -> tuple[float, list[Vector]]:
    """Free length at rest [m], and the places of the nodes from root to tip."""
    if spec.cable.length:
        places = start(spec, model.elements).places
        return spec.cable.length, places[1:]
    if spec.frees:
        n, between = model.elements, add(ZERO, piece.along, piece.span.length)
        places = [add(piece.place, between, k / n) for k in range(1, n + 1)]
        return spec.frees[piece.number - 1 - spec.numbers.spans], places
    spec = replace(spec, gravity=add(ZERO, spec.gravity, spec.lightness(piece.place)))
    return hanging(spec, model.elements, piece.span.length, (piece.place, piece.along),
                   piece.tension)  # fmt: skip


def _axes(spec: Spec) -> str:
    """The axes along which anything lies, moves or pulls."""
    vectors = [spec.gravity, *(each.velocity for each in spec.route)]
    vectors += [each.clamped for each in spec.route]
    vectors += [add(each.at, spec.route[0].at, -1) for each in spec.route]
    laws = [any(each.motion[i] for each in spec.route) for i in range(3)]
    if spec.water:
        laws = [a or bool(b) for a, b in zip(laws, spec.water.current, strict=True)]
    return "".join(a for i, a in enumerate(AXES) if laws[i] or any(abs(v[i]) > 0 for v in vectors))


def side_of(spec: Spec, piece: Piece, model: CableModel) -> Side:
    return Side(
        str(piece.number),
        piece.first,
        spec.marker(piece.root),
        (model.elements, spec.marker(piece.tip)),
    )


def _chain(spec: Spec, model: CableModel, piece: Piece) -> str:
    """Nodes and sections."""
    n, p, cable = model.elements, piece.number, spec.cable
    damped = cable.damping_time > 0
    free, places = _hanging(spec, model, piece)
    side, axes = side_of(spec, piece, model), _axes(spec)
    grows = model.level == 3 and spec.route[piece.root].feeds
    mass = cable.density * free / n
    # Nodes go with a weight that slides; the cable runs the other way through both.
    speed = spec.route[piece.root].velocity if spec.route[piece.root].slides else ZERO
    text = _lengths(spec, model, piece, free)
    for k in range(1, n):
        text += point(side.node(k), mass, places[k - 1], add(ZERO, speed, 1 - k / n))
        text += grown(model.form, k, n, axes, side) if grows else ""
    if grows and spec.route[piece.tip].is_free:
        text += grown_tip(model.form, side.first + n, n, axes, side)
    for k in range(1, n + 1):
        i = root_marker(spec, piece) if k == 1 else side.node(k - 1)
        name = f"H{p}" if grows else f"L{p}_0" if k == 1 else f"L{p}"
        if not is_still(spec, model, piece):
            own = section(side.first + k, i, side.node(k), name, damped, cable.pulls_only)
            text += parting(spec, piece, own) if k == 1 else own
    text += write_around(spec, row_of(spec, model, piece), axes) + _clamps(spec, model, piece)
    if spec.route[piece.root].slides:
        text += sliders.through(p, side.node(0), side.node(1), axes)
    if spec.route[piece.root].is_carried:
        text += carried_half(spec, model, piece, side.node(1), axes)
    return text + _pull(spec, model, piece, grows)


def row_of(spec: Spec, model: CableModel, piece: Piece) -> Row:
    """The nodes of a span and what they are held by."""
    side, ends = side_of(spec, piece, model), [spec.route[i] for i in (piece.root, piece.tip)]
    grows = model.level == 3 and ends[0].feeds
    nodes = root_marker(spec, piece), *(side.node(k) for k in range(1, model.elements + 1))
    free = [each.is_free and not each.slides for each in ends]
    held = [each.kind == "fixed" or each.is_wheel and not (each.is_mobile or each.leans)
            for each in ends]  # fmt: skip
    length = f"{'H' if grows else 'L'}{piece.number}"
    return Row(nodes, length, (free[0], free[1]), (held[0], held[1]))


def _clamps(spec: Spec, model: CableModel, piece: Piece) -> str:
    """What turns the cable at its ends."""
    row = row_of(spec, model, piece)
    beside = (piece.root, row.nodes[1]), (piece.tip, row.nodes[-2])
    held = [(i, node) for i, node in beside if any(spec.route[i].clamped)]
    return "".join(write_clamp(spec, i, node, row.length) for i, node in held)


def is_still(spec: Spec, model: CableModel, piece: Piece) -> bool:
    """Whether a span is one section between places on the ground, so that nothing feels its pull
    but the cable on a wheel."""
    root, tip = spec.route[piece.root], spec.route[piece.tip]
    held = root.is_wheel and not root.is_mobile and not root.leans
    return model.elements == 1 and held and tip.kind == "fixed" and not tip.is_moved


def _lengths(spec: Spec, model: CableModel, piece: Piece, free: float) -> str:
    """Names for the free length of the sections."""
    p, n = piece.number, model.elements
    feeds = spec.route[piece.root].feeds
    if model.level == 3 and feeds:
        ways = [feed(spec, piece, order) for order in range(3)]
        return length_variables(str(p), n, free, ways) + "\n"
    more = feed(spec, piece) if feeds else ""
    return (
        "! Free length of a section, and of the one at the root.\n"
        f"VARIABLE/L{p}, FUNCTION={number(free / n)}\n"
        f"VARIABLE/L{p}_0, FUNCTION={number(free / n)}{more}\n"
    )


def _pull(spec: Spec, model: CableModel, piece: Piece, grows: bool) -> str:
    """Tension at the root, with the half section that lies there."""
    p = piece.number
    i, j = root_marker(spec, piece), side_of(spec, piece, model).node(1)
    pull = spring(spec, piece, i, j, f"H{p}" if grows else f"L{p}_0")
    text, root = f"VARIABLE/T{p}, FUNCTION={pull}", spec.route[piece.root]
    if root.leans or root.mount:
        text = f"VARIABLE/P{p}, FUNCTION={pull}\n"
        text += borne(spec, piece.root, i, j, piece.sense, f"P{p}", f"T{p}-P{p}")
        text += f"VARIABLE/T{p}, FUNCTION=P{p}"
    weight = dot(spec.gravity, piece.along) * spec.lightness(piece.place)
    if spec.route[piece.root].is_wheel:
        # A cable that slips has the half section among the mass on its wheel instead.
        feeds = f"-({feed(spec, piece, 2)})"
        feeds = "" if spec.slips_at(piece.root) or grows and model.form == "paper" else feeds
        feeds += f"-{along_axle(spec, piece.root, i, j)}" if root.is_mobile else ""
        if weight or feeds:
            text += f"\n, +rho*{half_section(model, piece, spec)}*({number(weight)}{feeds})"
    elif spec.route[piece.root].slides:
        text += f"\n, +rho*{half_section(model, piece, spec)}*{sliders.lean(i, j)}"
    where = "wheel" if spec.route[piece.root].is_wheel else "start"
    return f"! Tension at the {where}.\n{text}\n{parts_at(spec, piece)}"


def spring(spec: Spec, piece: Piece, i: int, j: int, free: str) -> str:
    """Tension of a section between two markers, of the free length H or L of its span."""
    p, pull = piece.number, pulled(spec, elastic(i, j, free, spec.cable.damping_time > 0))
    at_root = root_marker(spec, piece) in (i, j)
    return f"(1-broken_{p})*({pull})" if spec.cable.parts and at_root else pull


def _ends(spec: Spec, model: CableModel, found: list[Piece]) -> str:
    """What the pieces are held by or carry."""
    text = "\n! ---- ends and weights ----\n"
    for i, each in enumerate(spec.route):
        half = 0.0
        for p in spec.beside(i):
            if p >= 0 and model.level > 1 and not each.is_wheel:
                if "run" not in (spec.route[found[p].tip].kind, spec.route[found[p].root].kind):
                    free, _ = _hanging(spec, model, found[p])
                    half += spec.cable.density * free / model.elements / 2
        # What lies at a weight that slides goes with the cable.
        text += end(spec, i, 0.0 if each.slides else half) if not each.is_wheel else ""
        text += sliders.slider(spec, i) if each.slides else ""
    return text


def along_axle(spec: Spec, wheel: int, i: int, j: int) -> str:
    """e.x_0" of the axle of a wheel whose cable goes from MARKER/i to MARKER/j [m/s^2]."""
    axle = spec.marker(wheel)
    parts = "+".join(f"ACC{a}({axle})*D{a}({j},{i})" for a in AXES)
    return f"({parts})/DM({j},{i})"


def carried_half(spec: Spec, model: CableModel, piece: Piece, j: int, axes: str) -> str:
    """VFORCE of the half section of a piece that goes from its wheel to MARKER/j."""
    root, i, p = spec.route[piece.root], piece.first, piece.number
    if root.leans:
        return ""
    comment = "! Mass of the half section beside the wheel.\n"
    if model.level == 3 and model.form != "paper":
        return comment + sliders.through(p, i, j, axes)
    half, flow = half_section(model, piece, spec), f"({feed(spec, piece, 1)})**2"
    if model.level < 3:
        flow += f"+{half}*({feed(spec, piece, 2)})"
    light = spec.lightness(piece.place)
    share = "" if light == 1.0 else f"{number(light)}*"
    components = [
        f"-rho*({half}*(ACC{a}({i})-{share}{gravity(a)})+({flow})*D{a}({j},{i})/DM({j},{i}))"
        for a in axes
    ]
    return comment + vforce(i, i, axes, components)
