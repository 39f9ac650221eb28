"""The supports of the ends of a cable, and the weights on it."""

from adamslite.cables.statements import AXES, number, point
from adamslite.cables.vocabulary import Spec
from adamslite.cables.wheels import marker, moved, triple


def end(spec: Spec, i: int, cable: float) -> str:
    """Station i, not a wheel, with the mass of `cable` at it."""
    each, n = spec.route[i], marker(i)
    if each.kind in ("mass", "free"):
        return point(n, each.mass + cable, each.at, each.velocity)
    if each.kind == "body":
        speed = "".join(
            f", V{a}={number(v)}" for a, v in zip(AXES, each.velocity, strict=True) if v
        )
        inertia = ",".join([number(each.inertia)] * 3)
        return (
            f"PART/{n}, MASS={number(each.mass + cable)}, CM={n}, IP={inertia}"
            f", QG={triple(each.at)}{speed}\nMARKER/{n}, PART={n}\n"
        )
    if each.is_moved:
        start = f"MARKER/{n + 3}, PART=1, QP={triple(each.at)}\n"
        return start + point(n, 1.0, each.at) + moved(n, n + 3, each)
    return f"MARKER/{n}, PART=1, QP={triple(each.at)}\n" if each.kind == "fixed" else ""
