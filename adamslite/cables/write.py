"""The deck of a cable scene: head, wheels, ends, then span after span.

Station i of the route is MARKER/10 i (a wheel PART/10 i with its bearing MARKER/10 i + 1), node k
of span p is MARKER/1000 p + k, counted from the wheel, from the start of the route without one.
"""

from dataclasses import dataclass

from adamslite.cables.choose import Choice, tensions
from adamslite.cables.geometry import Span, add, dot
from adamslite.cables.spec import Spec, Station, Vector
from adamslite.cables.statements import (
    AXES,
    Side,
    cable_variables,
    grown,
    grown_tip,
    head,
    number,
    payout_variables,
    point,
    section,
    tail,
)

NOTES = {
    1: "Level 1: the cable is rigid and has no mass; GCON/p.f is the force in span p.",
    2: "Level 2: sections of fixed length; the section at a wheel takes what comes over it.",
    3: "Level 3: all sections of a span grow with the payout.",
}


@dataclass(frozen=True)
class Piece:
    """A span as it is written: from its root, the wheel if there is one, to its tip.

    `gain` [m] of cable comes in at the root for a radian of the root's wheel; `mass` is what hangs
    at the tip.
    """

    number: int
    span: Span
    root: int
    tip: int
    place: Vector
    along: Vector
    gain: float
    tension: float

    @property
    def first(self) -> int:
        """Marker of node 0."""
        return 1000 * self.number


def write(spec: Spec, spans: list[Span], choice: Choice) -> str:
    """The deck.

    Parameters
    ----------
    spec : Spec
        With the turn of every wheel.
    spans : list of Span
        One between every two stations.
    choice : Choice

    Returns
    -------
    str
    """
    pulls = tensions(spec, spans)
    pieces = [_piece(spec, p, span, pulls[p]) for p, span in enumerate(spans)]
    notes = f"{NOTES[choice.level]} " + "; ".join(choice.figures) + "."
    if choice.level == 3:
        notes += f" Element: {choice.form}, {choice.elements} sections of a span."
    gravity = ", ".join(
        f"{n}={number(g)}" for n, g in zip(("IGRAV", "JGRAV", "KGRAV"), spec.gravity, strict=True)
        if g
    )  # fmt: skip
    lines = ["", "PART/1, GROUND", *([f"ACCGRAV/{gravity}"] if gravity else [])]
    text = head(spec.title, notes, *lines, author="adamslite cable")
    if choice.level > 1:
        text += cable_variables(spec.cable, spec.cable.damping)
    for i, station in enumerate(spec.route):
        text += _wheel(i, station) if station.is_wheel else ""
    for piece in pieces:
        text += _span(spec, choice, piece)
    text += _ends(spec, choice, pieces) + _drives(spec, choice, pieces)
    return text + _requests(spec, choice, pieces) + _run(spec, choice)


def _run(spec: Spec, choice: Choice) -> str:
    return tail(f"GSTIFF, SI2, ERROR={spec.error:.1E}", spec.end, spec.steps)


def _piece(spec: Spec, p: int, span: Span, tension: float) -> Piece:
    a, b = spec.route[p], spec.route[p + 1]
    backwards = b.is_wheel and not a.is_wheel
    root, tip = (p + 1, p) if backwards else (p, p + 1)
    wheel = spec.route[root]
    sense = -1 if backwards else 1
    return Piece(
        p + 1, span, root, tip, span.finish if backwards else span.start,
        add((0.0, 0.0, 0.0), span.along, sense), sense * wheel.turn * wheel.radius, tension,
    )  # fmt: skip


def _triple(a: Vector) -> str:
    return ",".join(number(x) for x in a)


def _wheel(i: int, wheel: Station) -> str:
    """A wheel on its bearing; both markers have the axis as z."""
    n, axis = 10 * (i + 1), wheel.axis
    level = axis == (0.0, 0.0, 1.0)
    ground = "" if level else f", ZP={_triple(add(wheel.at, axis))}"
    own = "" if level else f", ZP={_triple(axis)}"
    name = f"{wheel.kind} of station {i + 1}, R = {number(wheel.radius)} m"
    inertia = ",".join([number(wheel.inertia)] * 3)
    mass = number(wheel.inertia / wheel.radius**2)
    return (
        f"\n! The {name}.\n"
        f"MARKER/{n + 1}, PART=1, QP={_triple(wheel.at)}{ground}\n"
        f"PART/{n}, MASS={mass}, CM={n}, IP={inertia}, QG={_triple(wheel.at)}\n"
        f"MARKER/{n}, PART={n}{own}\n"
        f"JOINT/{n}, REVOLUTE, I={n}, J={n + 1}\n"
    )


def _turn(i: int, spec: Spec, function: str = "AZ") -> str:
    """Cable that the wheel of station i moves along the route [m], or its rate."""
    wheel, n = spec.route[i], 10 * (i + 1)
    return f"{number(wheel.turn * wheel.radius)}*{function}({n},{n + 1})"


def _between(spec: Spec, piece: Piece) -> bool:
    return spec.route[piece.root].is_wheel and spec.route[piece.tip].is_wheel


def _tip_marker(piece: Piece) -> int:
    return 10 * (piece.tip + 1)


def _root_marker(spec: Spec, piece: Piece) -> int:
    return piece.first if spec.route[piece.root].is_wheel else 10 * (piece.root + 1)


def _span(spec: Spec, choice: Choice, piece: Piece) -> str:
    """One span in the form of its level."""
    a, b = piece.number, piece.number + 1
    text = f"\n! ---- span {a}, from station {a} to {b} ----\n"
    if not _between(spec, piece) and spec.route[piece.root].is_wheel:
        text += f"MARKER/{piece.first}, PART=1, QP={_triple(piece.place)}  ! cable leaves\n"
    if choice.level == 1:
        return text + _rigid(spec, piece)
    if _between(spec, piece):
        return text + _link(spec, piece)
    return text + _chain(spec, choice, piece)


def _rigid(spec: Spec, piece: Piece) -> str:
    p = piece.number
    if _between(spec, piece):
        i, j = _turn(piece.root, spec), _turn(piece.tip, spec)
        return f"GCON/{p}, FUNCTION={i}-({j})\n"
    comes = ""
    if spec.route[piece.root].is_wheel:
        n = 10 * (piece.root + 1)
        comes = f"-({number(piece.gain)})*AZ({n},{n + 1})"
    elif not any(spec.route[i].is_free for i in (piece.root, piece.tip)):
        return "! Held at both ends: nothing moves.\n"
    i, j = _tip_marker(piece), _root_marker(spec, piece)
    return f"GCON/{p}, FUNCTION=DM({i},{j})-{number(piece.span.length)}{comes}\n"


def _link(spec: Spec, piece: Piece) -> str:
    """A span between two wheels: one spring; its mass is small beside what they turn."""
    p, long = piece.number, piece.span.length
    free = long / (1 + piece.tension / spec.cable.stiffness)
    comes = f"{number(free)}+{_turn(piece.root, spec)}-({_turn(piece.tip, spec)})"
    return (
        "! One massless spring from wheel to wheel.\n"
        f"VARIABLE/LT{p}, FUNCTION={comes}\n"
        f"VARIABLE/T{p}, FUNCTION=EA*({number(long)}/LT{p}-1)\n"
    )


def _hanging(spec: Spec, choice: Choice, piece: Piece) -> tuple[float, list[float]]:
    """Free length at rest [m], and where the nodes are on the way from root to tip."""
    n, cable = choice.elements, spec.cable
    weight = dot(spec.gravity, piece.along) if not spec.route[piece.tip].kind == "fixed" else 0.0
    free = piece.span.length
    for _ in range(20):
        node = cable.density * free / n * weight
        pulls = [piece.tension + node * (n - k + 0.5) for k in range(1, n + 1)]
        steps = [free / n * (1 + pull / cable.stiffness) for pull in pulls]
        free *= piece.span.length / sum(steps)
    return free, [sum(steps[:k]) for k in range(1, n + 1)]


def _axes(spec: Spec) -> str:
    """The axes along which anything lies, moves or pulls."""
    vectors = [spec.gravity, *(each.velocity for each in spec.route)]
    vectors += [add(each.at, spec.route[0].at, -1) for each in spec.route]
    return "".join(a for i, a in enumerate(AXES) if any(abs(v[i]) > 0 for v in vectors))


def _side(piece: Piece, choice: Choice) -> Side:
    return Side(
        str(piece.number), piece.first, 10 * (piece.root + 1),
        (choice.elements, _tip_marker(piece)),
    )  # fmt: skip


def _chain(spec: Spec, choice: Choice, piece: Piece) -> str:
    """Nodes and sections."""
    n, p = choice.elements, piece.number
    free, ways = _hanging(spec, choice, piece)
    side, axes = _side(piece, choice), _axes(spec)
    grows = choice.level == 3 and spec.route[piece.root].is_wheel
    mass = spec.cable.density * free / n
    text = _lengths(spec, choice, piece, free)
    for k in range(1, n):
        text += point(side.node(k), mass, add(piece.place, piece.along, ways[k - 1]))
        text += grown(choice.form, k, n, axes, side) if grows else ""
    if grows and spec.route[piece.tip].is_free:
        text += grown_tip(choice.form, side.first + n, n, axes, side)
    for k in range(1, n + 1):
        i = _root_marker(spec, piece) if k == 1 else side.node(k - 1)
        free_name = f"H{p}" if grows else f"L{p}_0" if k == 1 else f"L{p}"
        text += section(side.first + k, i, side.node(k), free_name, spec.cable.damping)
    return text + _pull(spec, choice, piece, grows)


def _lengths(spec: Spec, choice: Choice, piece: Piece, free: float) -> str:
    """Names for the free length of the sections."""
    p, n = piece.number, choice.elements
    wheel = spec.route[piece.root].is_wheel
    if choice.level == 3 and wheel:
        text = payout_variables(spec.cable, n, free, _side(piece, choice), piece.gain)
        return text + "\n"
    m = 10 * (piece.root + 1)
    comes = f"+({number(piece.gain)})*AZ({m},{m + 1})" if wheel else ""
    return (
        "! Free length of a section, and of the one at the root.\n"
        f"VARIABLE/L{p}, FUNCTION={number(free / n)}\n"
        f"VARIABLE/L{p}_0, FUNCTION={number(free / n)}{comes}\n"
    )


def _pull(spec: Spec, choice: Choice, piece: Piece, grows: bool) -> str:
    """Tension at the root, with the half section that lies there."""
    p = piece.number
    i, j = _root_marker(spec, piece), _side(piece, choice).node(1)
    free = f"H{p}" if grows else f"L{p}_0"
    text = f"VARIABLE/T{p}, FUNCTION=EA*(DM({i},{j})/{free}-1)"
    if spec.cable.damping:
        rate = f"-SD{p}*DM({i},{j})/LT{p}" if grows else ""
        text += f"+damper*(VR({i},{j}){rate})"
    weight = dot(spec.gravity, piece.along)
    if spec.route[piece.root].is_wheel:
        m = 10 * (piece.root + 1)
        feeds = f"-({number(piece.gain)})*WDTZ({m},{m + 1})"
        feeds = "" if grows and choice.form == "paper" else feeds
        if weight or feeds:
            text += f"\n, +rho*{free}/2*({number(weight)}{feeds})"
    return f"! Tension at the {'wheel' if spec.route[piece.root].is_wheel else 'start'}.\n{text}\n"


def _ends(spec: Spec, choice: Choice, pieces: list[Piece]) -> str:
    """What the first and the last piece are held by or carry."""
    text = "\n! ---- ends ----\n"
    for i, piece in ((0, pieces[0]), (len(spec.route) - 1, pieces[-1])):
        end, n = spec.route[i], 10 * (i + 1)
        half = 0.0
        if choice.level > 1 and not end.is_wheel:
            half = spec.cable.density * _hanging(spec, choice, piece)[0] / choice.elements / 2
        if end.kind == "fixed":
            text += f"MARKER/{n}, PART=1, QP={_triple(end.at)}\n"
        elif end.kind == "mass":
            text += point(n, end.mass + half, end.at, end.velocity)
        elif end.kind == "body":
            text += _body(n, end, half)
    return text


def _body(n: int, end: Station, half: float) -> str:
    speed = "".join(f", V{a}={number(v)}" for a, v in zip(AXES, end.velocity, strict=True) if v)
    inertia = ",".join([number(end.inertia)] * 3)
    return (
        f"PART/{n}, MASS={number(end.mass + half)}, CM={n}, IP={inertia}"
        f", QG={_triple(end.at)}{speed}\nMARKER/{n}, PART={n}\n"
    )


def _drives(spec: Spec, choice: Choice, pieces: list[Piece]) -> str:
    """What turns the wheels: the cable, friction, an engine, a payout law."""
    text = ""
    for i, wheel in enumerate(spec.route):
        if not wheel.is_wheel:
            continue
        n, torque = 10 * (i + 1), []
        if choice.level > 1:
            sides = ("-", i - 1), ("+", i)
            pulls = "".join(f"{s}T{pieces[p].number}" for s, p in sides if 0 <= p < len(pieces))
            torque.append(f"{number(wheel.turn * wheel.radius)}*({pulls})")
        # Payout is cable that leaves the winch, to whichever side the route goes.
        out = wheel.turn * wheel.radius * (1 if i == 0 else -1)
        if wheel.friction:
            torque.append(f"-{number(wheel.friction)}*STEP(WZ({n},{n + 1}),-0.01,-1,0.01,1)")
        if wheel.force:
            turn = f"{number(out)}*{{}}({n},{n + 1})"
            text += (
                f"\n! Payout of the winch and its speed.\nVARIABLE/S, FUNCTION={turn.format('AZ')}"
            )
            text += f"\nVARIABLE/SD, FUNCTION={turn.format('WZ')}\n"
            torque.append(f"-({number(out)})*({wheel.force})")
        if torque:
            text += f"SFORCE/{n}, ROTATIONAL, ACTIONONLY, I={n}, J={n + 1}\n, FUNCTION="
            text += "\n, +".join(torque) + "\n"
        if wheel.payout:
            text += f"GCON/{n}, FUNCTION={number(out)}*AZ({n},{n + 1})\n, -({wheel.payout})\n"
    return text


def _requests(spec: Spec, choice: Choice, pieces: list[Piece]) -> str:
    """Tension of every span, travel of every wheel."""
    text = "\n! ---- results ----\n"
    if choice.level > 1:
        text += "".join(
            f"REQUEST/{p.number}, F2=T{p.number}             ! tension of span {p.number}\n"
            for p in pieces
        )
    for i, wheel in enumerate(spec.route):
        if wheel.is_wheel:
            text += f"REQUEST/{10 * (i + 1)}, F2={_turn(i, spec)}\\ F3={_turn(i, spec, 'WZ')}"
            text += f"  ! cable over station {i + 1}\n"
    return text
