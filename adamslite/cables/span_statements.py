"""Levels 1 to 3: every span of the route as a rigid cable, or as nodes and sections.

Node k of span p is MARKER/1000 p + k, counted from the wheel, from the start of the route without
one. A span between two wheels is one massless spring; a run that continues pulls with T0 + rho c v.
"""

from dataclasses import dataclass

from adamslite.cables import sliders
from adamslite.cables.ends import end
from adamslite.cables.geometry import FreeSpan, wrap
from adamslite.cables.links import borne, comes, link, spun
from adamslite.cables.model_choice import CableModel, tensions
from adamslite.cables.sag import hanging
from adamslite.cables.statements import (
    AXES,
    Side,
    grown,
    grown_tip,
    length_variables,
    number,
    point,
    section,
)
from adamslite.cables.vectors import ZERO, Vector, add, dot
from adamslite.cables.vocabulary import Spec
from adamslite.cables.wheels import (
    arm,
    carrier,
    drive,
    marker,
    rolled,
    slipping,
    travel,
    triple,
)

# Sliding speed at which friction is full [m/s].
CREEP = 1e-3


@dataclass(frozen=True)
class Piece:
    """A span as it is written: from its root, the wheel if there is one, to its tip.

    `sense` is 1 when it runs with the route; cable that the wheel at its root moves along the route
    then comes in.
    """

    number: int
    span: FreeSpan
    root: int
    tip: int
    place: Vector
    along: Vector
    sense: int
    tension: float

    @property
    def first(self) -> int:
        """Marker of node 0."""
        return 1000 * self.number


def pieces(spec: Spec, spans: list[FreeSpan]) -> list[Piece]:
    """One for every span."""
    pulls = tensions(spec, spans)
    return [_piece(spec, p, span, pulls[p]) for p, span in enumerate(spans)]


def _piece(spec: Spec, p: int, span: FreeSpan, tension: float) -> Piece:
    i, j = spec.pairs[p]
    a, b = spec.route[i], spec.route[j]
    backwards = b.feeds and not a.feeds or a.kind == "run"
    root, tip = (j, i) if backwards else (i, j)
    sense = -1 if backwards else 1
    place = span.finish if backwards else span.start
    return Piece(p + 1, span, root, tip, place, add(ZERO, span.along, sense), sense, tension)


def write_pieces(spec: Spec, spans: list[FreeSpan], model: CableModel) -> str:
    """Spans, ends, what turns the wheels."""
    found = pieces(spec, spans)
    text = "".join(_span(spec, model, piece) for piece in found)
    text += _ends(spec, model, found)
    for i, each in enumerate(spec.route):
        if each.is_wheel:
            text += _turned(spec, spans, model, i)
        elif each.slides and model.level > 1:
            text += sliders.flow(spec, i, found[i].tension)
    return text


def _feed(spec: Spec, piece: Piece, order: int = 0) -> str:
    """Cable that comes in at the wheel at the root of a piece, with its sign."""
    moves = comes(spec, piece.root, piece.first, order)
    return f"+{moves}" if piece.sense > 0 else f"-({moves})"


def is_between(spec: Spec, piece: Piece) -> bool:
    """Whether a piece lies between two wheels."""
    return spec.route[piece.root].is_wheel and spec.route[piece.tip].is_wheel


def root_marker(spec: Spec, piece: Piece) -> int:
    return piece.first if spec.route[piece.root].feeds else marker(piece.root)


def _span(spec: Spec, model: CableModel, piece: Piece) -> str:
    """One span in the form of its level."""
    i, j = spec.pairs[piece.number - 1]
    text = f"\n! ---- span {piece.number}, from station {i + 1} to {j + 1} ----\n"
    root = spec.route[piece.root]
    if root.is_wheel and (_moves(spec, piece) or not is_between(spec, piece)):
        to = _next(spec, model, piece)
        text += _touches(spec, piece, piece.first, to)
    if root.slides and model.level == 1:
        return text + (sliders.rigid(spec, piece.root) if piece.sense < 0 else "! With the last.\n")
    if root.slides:
        text += sliders.opening(spec, piece.root, piece.first)
    if model.level == 1:
        return text + _rigid(spec, piece)
    if spec.route[piece.tip].kind == "run":
        return text + _run(spec, piece)
    if is_between(spec, piece):
        return text + _link(spec, piece)
    return text + _chain(spec, model, piece)


def _next(spec: Spec, model: CableModel, piece: Piece) -> int:
    """The marker that the cable goes to from the root."""
    if is_between(spec, piece):
        return piece.first + 1
    whole = model.level == 1 or spec.route[piece.tip].kind == "run"
    return marker(piece.tip) if whole else side_of(piece, model).node(1)


def _touches(spec: Spec, piece: Piece, m: int, to: int) -> str:
    """MARKER/m where the piece touches the wheel at its root or, the second one, at its tip."""
    i, place, word = piece.root, piece.place, "leaves"
    if m > piece.first:
        i, place, word = piece.tip, piece.span.finish, "arrives"
    each = spec.route[i]
    if each.leans:
        tip = spec.route[piece.tip]
        # Between nodes the cable is at rest; alone it turns with its end.
        velocity = tip.velocity if to == marker(piece.tip) else ZERO
        spin = spun(spec, i, piece.along, piece.span.length, velocity)
        return link(spec, i, m, place, to, spin)
    part = carrier(spec, i)
    place = add(place, each.at, -1) if part > 1 else place
    return f"MARKER/{m}, PART={part}, QP={triple(place)}  ! cable {word}\n"


def _moves(spec: Spec, piece: Piece) -> bool:
    """Whether the piece lies between two wheels that do not both stay, or carry its pull on."""
    ends = [spec.route[i] for i in (piece.root, piece.tip)]
    return is_between(spec, piece) and any(each.is_mobile or each.leans for each in ends)


def _way(spec: Spec, piece: Piece, order: int = 0) -> str:
    """Cable that comes onto a piece between two wheels, or its rate."""
    root = comes(spec, piece.root, piece.first, order)
    return f"{root}-({comes(spec, piece.tip, piece.first + 1, order)})"


def is_kept(spec: Spec, piece: Piece) -> bool:
    """Whether a GCON keeps the length of a rigid piece: something moves at one of its ends."""
    ends = [spec.route[i] for i in (piece.root, piece.tip)]
    return ends[0].is_wheel or any(each.is_free for each in ends)


def _rigid(spec: Spec, piece: Piece) -> str:
    p = piece.number
    if is_between(spec, piece):
        text, apart = _apart(spec, piece)
        way = f"{apart}-{number(piece.span.length)}-({_way(spec, piece)})"
        return text + f"GCON/{p}, FUNCTION={way}\n"
    if not is_kept(spec, piece):
        return "! Held at both ends: nothing moves.\n"
    feed = f"-({_feed(spec, piece)})" if spec.route[piece.root].is_wheel else ""
    i, j = marker(piece.tip), root_marker(spec, piece)
    return f"GCON/{p}, FUNCTION=DM({i},{j})-{number(piece.span.length)}{feed}\n"


def _link(spec: Spec, piece: Piece) -> str:
    """A span between two wheels: one spring; its mass is small beside what they turn."""
    p, long = piece.number, piece.span.length
    text, apart = _apart(spec, piece)
    free = long / (1 + piece.tension / spec.cable.stiffness)
    pull = f"EA*({apart}/LT{p}-1)"
    if spec.cable.damping:
        rate = f"({_way(spec, piece, 1)})"
        own = f"VR({piece.first},{piece.first + 1})" if _moves(spec, piece) else ""
        pull += f"+damper*({own}-{rate}*{apart}/LT{p})"
    pull = _law(spec, pull)
    if _moves(spec, piece):
        text += f"SFORCE/{piece.first}, I={piece.first}, J={piece.first + 1}, FUNCTION=-T{p}\n"
        a, b = piece.first, piece.first + 1
        text += borne(spec, piece.root, a, b, 1, f"T{p}")
        text += borne(spec, piece.tip, b, a, -1, f"T{p}")
    return text + (
        "! One massless spring from wheel to wheel.\n"
        f"VARIABLE/LT{p}, FUNCTION={number(free)}+{_way(spec, piece)}\n"
        f"VARIABLE/T{p}, FUNCTION={pull}\n"
    )


def _apart(spec: Spec, piece: Piece) -> tuple[str, str]:
    """Statements for, and the expression of the length of a span between two wheels."""
    if not _moves(spec, piece):
        return "", number(piece.span.length)
    i, j = piece.first, piece.first + 1
    return _touches(spec, piece, j, i), f"DM({i},{j})"


def _law(spec: Spec, pull: str) -> str:
    return f"MAX(0,{pull})" if spec.cable.pulls_only else pull


def _run(spec: Spec, piece: Piece) -> str:
    """A long straight run of the cable: T0 + rho c times the speed of the cable out of it."""
    p, root = piece.number, spec.route[piece.root]
    speed = f"-({_feed(spec, piece, 1)})*(1+{number(piece.tension / spec.cable.stiffness)})"
    text = "! A long run goes on from here: it pulls with T0 + rho c times the speed out of it.\n"
    if not root.is_wheel:
        end = marker(piece.tip)
        text += f"MARKER/{end}, PART=1, QP={triple(piece.place)}, ZP="
        text += f"{triple(add(piece.place, piece.along))}\n"
        speed = f"-VZ({marker(piece.root)},{end},{end})"
        text += f"SFORCE/{end}, ACTIONONLY, I={marker(piece.root)}, J={end}, FUNCTION=T{p}\n"
    elif root.leans or root.mount:
        text += _on_axle(spec, piece)
    return text + f"VARIABLE/T{p}, FUNCTION={number(piece.tension)}+SQRT(EA*rho)*({speed})\n"


def _on_axle(spec: Spec, piece: Piece) -> str:
    """The pull of a long run on the link or mount of the wheel."""
    i, end, m = piece.root, marker(piece.tip), piece.first
    text = f"MARKER/{end}, PART=1, QP={triple(spec.route[piece.tip].at)}\n"
    text += f"SFORCE/{m}, I={m}, J={end}, FUNCTION=-T{piece.number}\n"
    return text + borne(spec, i, m, end, piece.sense, f"T{piece.number}")


def _hanging(spec: Spec, model: CableModel, piece: Piece) -> tuple[float, list[Vector]]:
    """Free length at rest [m], and the places of the nodes from root to tip."""
    held = spec.route[piece.tip].kind == "fixed"
    return hanging(spec, model.elements, piece.span.length, (piece.place, piece.along),
                   piece.tension, held)  # fmt: skip


def _axes(spec: Spec) -> str:
    """The axes along which anything lies, moves or pulls."""
    vectors = [spec.gravity, *(each.velocity for each in spec.route)]
    vectors += [add(each.at, spec.route[0].at, -1) for each in spec.route]
    laws = [any(each.motion[i] for each in spec.route) for i in range(3)]
    return "".join(a for i, a in enumerate(AXES) if laws[i] or any(abs(v[i]) > 0 for v in vectors))


def side_of(piece: Piece, model: CableModel) -> Side:
    return Side(
        str(piece.number), piece.first, marker(piece.root), (model.elements, marker(piece.tip))
    )


def _chain(spec: Spec, model: CableModel, piece: Piece) -> str:
    """Nodes and sections."""
    n, p, cable = model.elements, piece.number, spec.cable
    free, places = _hanging(spec, model, piece)
    side, axes = side_of(piece, model), _axes(spec)
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
        text += section(side.first + k, i, side.node(k), name, cable.damping, cable.pulls_only)
    if spec.route[piece.root].slides:
        text += sliders.through(p, side.node(0), side.node(1), axes)
    return text + _pull(spec, model, piece, grows)


def _lengths(spec: Spec, model: CableModel, piece: Piece, free: float) -> str:
    """Names for the free length of the sections."""
    p, n = piece.number, model.elements
    feeds = spec.route[piece.root].feeds
    if model.level == 3 and feeds:
        ways = [_feed(spec, piece, order) for order in range(3)]
        return length_variables(str(p), n, free, ways) + "\n"
    feed = _feed(spec, piece) if feeds else ""
    return (
        "! Free length of a section, and of the one at the root.\n"
        f"VARIABLE/L{p}, FUNCTION={number(free / n)}\n"
        f"VARIABLE/L{p}_0, FUNCTION={number(free / n)}{feed}\n"
    )


def half_section(model: CableModel, piece: Piece, spec: Spec) -> str:
    """Free length of the half section at the root."""
    grows = model.level == 3 and spec.route[piece.root].feeds
    return f"H{piece.number}/2" if grows else f"L{piece.number}_0/2"


def _pull(spec: Spec, model: CableModel, piece: Piece, grows: bool) -> str:
    """Tension at the root, with the half section that lies there."""
    p = piece.number
    i, j = root_marker(spec, piece), side_of(piece, model).node(1)
    pull = spring(spec, p, i, j, f"H{p}" if grows else f"L{p}_0")
    text, root = f"VARIABLE/T{p}, FUNCTION={pull}", spec.route[piece.root]
    if root.leans or root.mount:
        text = f"VARIABLE/P{p}, FUNCTION={pull}\n"
        text += borne(spec, piece.root, i, j, piece.sense, f"P{p}", f"T{p}-P{p}")
        text += f"VARIABLE/T{p}, FUNCTION=P{p}"
    weight = dot(spec.gravity, piece.along)
    if spec.route[piece.root].is_wheel:
        # A cable that slips has the half section among the mass on its wheel instead.
        feeds = f"-({_feed(spec, piece, 2)})"
        feeds = "" if slipping(piece.root, spec) or grows and model.form == "paper" else feeds
        if weight or feeds:
            text += f"\n, +rho*{half_section(model, piece, spec)}*({number(weight)}{feeds})"
    elif spec.route[piece.root].slides:
        text += f"\n, +rho*{half_section(model, piece, spec)}*{sliders.lean(i, j)}"
    return f"! Tension at the {'wheel' if spec.route[piece.root].is_wheel else 'start'}.\n{text}\n"


def spring(spec: Spec, p: int, i: int, j: int, free: str) -> str:
    """Tension of a section between two markers, of the free length H or L of its span."""
    pull = f"EA*(DM({i},{j})/{free}-1)"
    if spec.cable.damping:
        rate = f"-SD{p}*DM({i},{j})/LT{p}" if free[0] == "H" else ""
        pull += f"+damper*(VR({i},{j}){rate})"
    return _law(spec, pull)


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


def _turned(spec: Spec, spans: list[FreeSpan], model: CableModel, i: int) -> str:
    """What the cable, or its friction, and the drive do to wheel i."""
    each, n = spec.route[i], marker(i)
    before, behind = (f"T{p + 1}" if p >= 0 else "" for p in spec.beside(i))
    radius = arm(i, spec)
    if slipping(i, spec):
        angle = wrap(spec, spans, i)
        found = pieces(spec, spans)
        rim = number(spec.cable.density * each.radius * angle)
        for p in spec.beside(i):
            if found[p].root == i and not is_between(spec, found[p]):
                if spec.route[found[p].tip].kind != "run":
                    rim += f"+rho*{half_section(model, found[p], spec)}"
        text = (
            f"\n! Friction of the cable on the wheel of station {i + 1}, mu times wrap"
            f" {each.mu * angle:.4g}: at most a ratio of {2.718281828 ** (each.mu * angle):.4g}.\n"
            f"VARIABLE/slide_{n}, FUNCTION={travel(i, spec, 1)}-{rolled(i, spec, 1)}\n"
            f"VARIABLE/F_{n}, FUNCTION=({before}+{behind})*TANH({number(each.mu * angle / 2)}\n"
            f", *STEP(slide_{n},-{CREEP:g},-1,{CREEP:g},1))\n"
            f"DIFF/paid_{n}, FUNCTION=DIF(run_{n})\n"
            f"DIFF/run_{n}, FUNCTION=VARVAL(A_{n})\n"
            f"VARIABLE/A_{n}, FUNCTION=({behind}-{before}-F_{n})/({rim})\n"
        )
        return text + drive(spec, i, [f"{radius}*F_{n}"])
    pulls = (f"+{behind}" if behind else "") + (f"-{before}" if before else "")
    return drive(spec, i, [f"{radius}*({pulls})"] if model.level > 1 else [])
