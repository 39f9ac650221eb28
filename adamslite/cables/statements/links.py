"""The point of contact on a wheel that the cable leaves in any direction: a link about the axle.

                  o next point of the cable         link m   PART/m about the axle, turned by b;
                 /                                           MARKER/m+900 is on the axle
        b   .-. / T                                 touch    MARKER/m at its tip, z outwards
         --( + o                                    JPRIM/m  keeps the next point in the plane that
            '-'  MARKER/m                                    touches the rim there

A link that turns by b along the route winds up R b of the cable that the rim brings. It has the
torque -R T of the rim, so that the cable loads nothing but the axle, and next to no mass: without
any its block of the matrix is singular, and the whole is eliminated with pivoting, as a dense one.
One that wanders is a guide of some mass, and slides along the axle against a spring and a damper.
"""

from adamslite.cables.description.vocabulary import Spec, Station
from adamslite.cables.statements.forms import AXES, number, rounded
from adamslite.cables.statements.wheels import carrier, travel, triple
from adamslite.cables.vectors import ZERO, Vector, add, cross, dot

AXLE = 900
# Of the cable that is a radius long: the mass of a link.
LIGHT = 1e-6


def comes(spec: Spec, i: int, m: int, order: int = 0) -> str:
    """Cable that wheel i brings to its link m along the route [m], or its time derivative."""
    each, moves = spec.route[i], travel(i, spec, order)
    if not each.leans:
        return moves
    return f"{moves}-({number(each.turn * each.radius)}*{leaning(spec, i, m, order)})"


def leaning(spec: Spec, i: int, m: int, order: int = 0) -> str:
    """Angle of link m about the axle of wheel i, or its time derivative."""
    a, b = m + AXLE, spec.marker(i) + 1
    seen = "" if spec.route[i].axis == (0.0, 0.0, 1.0) else f",{b}"
    return (f"AZ({a},{b})", f"WZ({a},{b}{seen})", f"WDTZ({a},{b}{seen})")[order]


def link(spec: Spec, i: int, m: int, place: Vector, to: int, spin: float) -> str:
    """Link m of wheel i, which starts at `place` and follows MARKER/to with `spin` [rad/s]."""
    each, n = spec.route[i], spec.marker(i)
    out, own = add(place, each.at, -1), _own_axis(each.axis)
    kind = "CYLINDRICAL" if each.wander else "REVOLUTE"
    text = (
        "! The link that the cable leaves on turns with it.\n"
        f"PART/{m}{_mass(spec, each, m)}, QG={triple(each.at)}{_start(each, out, spin)}\n"
        f"MARKER/{m}, PART={m}, QP={triple(out)}, ZP={triple(add(out, out))}\n"
        f"MARKER/{m + AXLE}, PART={m}{own}\n"
        f"JOINT/{m}, {kind}, I={m + AXLE}, J={n}\n"
        f"JPRIM/{m}, INPLANE, I={to}, J={m}\n"
    )
    return text + (_wander(spec, i, m) if each.wander else "")


def _own_axis(axis: Vector) -> str:
    return "" if axis == (0.0, 0.0, 1.0) else f", ZP={triple(axis)}"


def _mass(spec: Spec, each: Station, m: int) -> str:
    if each.wander:
        return f", MASS={number(each.wander.mass)}, CM={m}"
    mass = LIGHT * spec.cable.density * each.radius
    inertia = ",".join([number(mass * each.radius**2)] * 3)
    return f", MASS={number(mass)}, CM={m + AXLE}, IP={inertia}"


def _start(each: Station, out: Vector, spin: float) -> str:
    turn = add(ZERO, each.axis, spin)
    moves = cross(turn, out) if each.wander else ZERO
    return "".join(
        f", {letter}{a}={number(x)}"
        for letter, values in (("V", moves), ("W", turn))
        for a, x in zip(AXES, rounded(values), strict=True) if x
    )  # fmt: skip


def _wander(spec: Spec, i: int, m: int) -> str:
    """Way of a guide along the axle, and what pulls it back."""
    b, own = spec.marker(i) + 1, spec.route[i].wander
    assert own is not None
    a = m + AXLE
    return (
        f"VARIABLE/wander_{m}, FUNCTION=DZ({a},{b},{b})\n"
        f"VFORCE/{m + AXLE}, I={m}, J_PART={carrier(spec, i)}, RM={b}\n"
        f", FZ=-{number(own.stiffness)}*wander_{m}-{number(own.damping)}*VZ({a},{b},{b})\n"
    )


def spun(spec: Spec, i: int, along: Vector, length: float, velocity: Vector) -> float:
    """Spin of a link whose cable leaves `along` and has a weight with `velocity` at its end."""
    return dot(velocity, cross(spec.route[i].axis, along)) / length


def borne(spec: Spec, i: int, m: int, to: int, sense: int, pull: str, more: str = "") -> str:
    """What a side of the cable with tension `pull`, and `more` at the rim, leaves on the axle of
    wheel i.

    Cable that runs turns round with its momentum: rho v^2 of the tension does not press on the
    wheel.  The side leaves along the route (`sense` 1) or comes along it, and goes to MARKER/to.
    """
    each = spec.route[i]
    if not (each.leans or each.mount):
        return ""
    back = [f"F{x}=Q{m}*D{x}({m},{to})/DM({m},{to})" for x in AXES]
    text = (
        "! What of the pull does not press on the wheel: the momentum that passes.\n"
        f"VARIABLE/Q{m}, FUNCTION=rho*({comes(spec, i, m, 1)})**2{f'-({more})' if more else ''}\n"
        f"VFORCE/{m}, I={m}, J_PART=1\n, " + "\\\n, ".join(back) + "\n"
    )
    if each.leans:
        torque = number(-sense * each.turn * each.radius)
        a, b = m + AXLE, spec.marker(i) + 1
        text += f"SFORCE/{a}, ROTATIONAL, I={a}, J={b}, FUNCTION={torque}*({pull}-Q{m})\n"
    return text


def wrapped(spec: Spec, i: int, before: int, behind: int, angle: float) -> str:
    """Angle over which the cable lies on wheel i between its links."""
    turn = "+" if spec.route[i].turn > 0 else "-"
    return f"{number(angle)}{turn}({leaning(spec, i, behind)}-{leaning(spec, i, before)})"
