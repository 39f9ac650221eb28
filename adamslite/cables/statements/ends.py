"""The supports of the ends of a cable, and the weights on it."""

from adamslite.cables.description.vocabulary import Spec
from adamslite.cables.statements.forms import AXES, gravity, number, point, vforce
from adamslite.cables.statements.wheels import moved, triple
from adamslite.cables.vectors import add, norm, unit


def end(spec: Spec, i: int, cable: float) -> str:
    """Station i, not a wheel, with the mass of `cable` at it."""
    title = f"! The {spec.route[i].kind} of {spec.label(i)}.\n" * bool(spec.route[i].name)
    return title + _end(spec, i, cable)


def _end(spec: Spec, i: int, cable: float) -> str:
    each, n = spec.route[i], spec.marker(i)
    if each.kind in ("mass", "free"):
        return point(n, each.mass + cable, each.at, each.velocity) + _floor(spec, i)
    if each.kind == "body":
        speed = "".join(
            f", V{a}={number(v)}" for a, v in zip(AXES, each.velocity, strict=True) if v
        )
        inertia = ",".join([number(each.inertia)] * 3)
        return (
            f"PART/{n}, MASS={number(each.mass + cable)}, CM={n}, IP={inertia}"
            f", QG={triple(each.at)}{speed}\nMARKER/{n}, PART={n}\n"
        ) + _floor(spec, i)
    if each.kind == "hook":
        return _hook(spec, i, cable)
    if each.is_moved:
        start = f"MARKER/{n + 3}, PART=1, QP={triple(each.at)}\n"
        return start + point(n, 1.0, each.at) + moved(n, n + 3, each)
    return f"MARKER/{n}, PART=1, QP={triple(each.at)}\n" if each.kind == "fixed" else ""


def _hook(spec: Spec, i: int, cable: float) -> str:
    """The place of a load where a cable ends, and the mass of `cable` there."""
    each, n = spec.route[i], spec.marker(i)
    place = add(each.at, each.origin, -1)
    owner, own = ("PART", f", QP={triple(place)}") if each.inertia else ("POINT_MASS", "")
    text = f"MARKER/{n}, {owner}={each.on}{own}\n"
    if not cable:
        return text
    carried = [f"-{number(cable)}*(ACC{a}({n})-{gravity(a)})" for a in AXES]
    return text + vforce(n, n, AXES, carried)


def _floor(spec: Spec, i: int) -> str:
    """The floor below a weight: it pushes from z = 0 of MARKER/n+5 on, and never pulls."""
    each, n, down = spec.route[i], spec.marker(i), unit(spec.gravity)
    if not each.floor:
        return ""
    own = each.floor
    place = add(each.at, down, own.depth)
    # A tenth of the depth to which the weight sinks in at rest, from which on it damps fully.
    soft = each.mass * norm(spec.gravity) / own.stiffness / 10
    height, speed = f"DZ({n},{n + 5},{n + 5})", f"VZ({n},{n + 5},{n + 5},{n + 5})"
    return (
        f"MARKER/{n + 5}, PART=1, QP={triple(place)}, ZP={triple(add(place, down, -1))}  ! floor\n"
        f"VFORCE/{n + 5}, I={n}, J_PART=1, RM={n + 5}\n"
        f", FZ=IMPACT({height},{speed},0,{number(own.stiffness)},1.0"
        f",{number(own.damping)},{number(soft)})\n"
    )
