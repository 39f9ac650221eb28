"""Weights that slide along their cable without a wheel.

S is the cable that has come through along the route, a state of its own. On either side, e points
along the cable away from the weight at x_0, H is a section, x_S = (x_1 - x_0)/H and S grows into
the side or out of it:

    rho (H1 + H2)/2 S" = T2 - T1,      T = EA (|x_1 - x_0|/H - 1) + rho H/2 e.(g - x_0")
    force on the weight, per side      T_section e - rho H/2 (x_0" + 2 S' x'_S + S" x_S - g)
                                       - rho S'^2 x_S

the half section there has the acceleration of the cable, and the cable that comes through changes
its direction. At level 1 the cable on both sides has one length, DM + DM = l; where it is straight
the weight is a bead on a wire.
"""

from math import dist

from adamslite.cables.description.vocabulary import Spec
from adamslite.cables.statements.forms import AXES, gravity, number, vforce
from adamslite.cables.statements.wheels import triple
from adamslite.cables.vectors import ZERO, add, dot, unit

# Directions whose cosine is closer to 1 are one.
STRAIGHT = 1e-12


def opening(spec: Spec, i: int, m: int) -> str:
    """MARKER/m, where the cable leaves the weight of station i."""
    owner = "PART" if spec.route[i].kind == "body" else "POINT_MASS"
    return f"MARKER/{m}, {owner}={spec.marker(i)}  ! cable leaves\n"


def is_straight(spec: Spec, i: int) -> bool:
    """Whether the cable goes straight through station i."""
    before, at, behind = (spec.route[k].at for k in (i - 1, i, i + 1))
    return dot(unit(add(at, before, -1)), unit(add(behind, at, -1))) > 1 - STRAIGHT


def is_wire(spec: Spec, i: int) -> bool:
    """Whether its cable is straight and held by points that do not move."""
    ends = [spec.route[k] for k in (i - 1, i + 1)]
    held = all(each.kind == "fixed" and not each.is_moved for each in ends)
    return is_straight(spec, i) and held


def rigid(spec: Spec, i: int) -> str:
    """Level 1: a bead on a straight wire, or both sides of one length."""
    a, n, b = (spec.marker(k) for k in (i - 1, i, i + 1))
    first, at, last = (spec.route[k].at for k in (i - 1, i, i + 1))
    if is_wire(spec, i):
        return (
            f"MARKER/{n + 4}, PART=1, QP={triple(first)}, ZP={triple(last)}  ! the wire\n"
            f"JPRIM/{i + spec.numbers.spans}, INLINE, I={n}, J={n + 4}\n"
        )
    length = number(dist(first, at) + dist(at, last))
    return f"GCON/{i + spec.numbers.spans}, FUNCTION=DM({n},{a})+DM({n},{b})-{length}\n"


def lean(i: int, j: int) -> str:
    """e.(g - x_0") of the side that goes from MARKER/i on the weight to MARKER/j [m/s^2]."""
    parts = "+".join(f"({gravity(a)}-ACC{a}({i}))*D{a}({j},{i})" for a in AXES)
    return f"({parts})/DM({j},{i})"


def flow(spec: Spec, i: int, tension: float) -> str:
    """Cable that comes through station i: a state, as rho (H1 + H2)/2 S" = T2 - T1."""
    n, p = spec.marker(i), i + spec.numbers.spans
    before, at, behind = (spec.route[k].at for k in (i - 1, i, i + 1))
    both = add(unit(add(behind, at, -1)), unit(add(before, at, -1)), -1)
    start = -dot(spec.route[i].velocity, both) / 2 / (1 + tension / spec.cable.stiffness)
    return (
        f"\n! Cable that comes through the weight of station {spec.station(i)}; the cable starts"
        " at rest.\n"
        f"DIFF/paid_{n}, FUNCTION=DIF(run_{n})\n"
        f"DIFF/run_{n}, IC={number(start)}, FUNCTION=VARVAL(A_{n})\n"
        f"VARIABLE/A_{n}, FUNCTION=2*(T{p + 1}-T{p})/(rho*(H{p}+H{p + 1}))\n"
    )


def through(p: int, i: int, j: int, axes: str) -> str:
    """What the cable of span p, from MARKER/i on the weight to MARKER/j, does to it by its mass."""
    components = [
        f"-rho*(H{p}/2*(ACC{a}({i})-{gravity(a)})+SD{p}*(V{a}({j},{i})-SD{p}/LT{p}*D{a}({j},{i}))\n"
        f",  +(SDD{p}/2+SD{p}**2/H{p})*D{a}({j},{i}))"
        for a in axes
    ]
    return vforce(i, i, axes, components)


def slider(spec: Spec, i: int) -> str:
    """What keeps the part of station i upright, and what hauls it along the line between its
    neighbours."""
    each, n = spec.route[i], spec.marker(i)
    along = unit(add(spec.route[i + 1].at, spec.route[i - 1].at, -1))
    if along == ZERO or not (each.haul or each.kind == "body"):
        return ""
    text = f"MARKER/{n + 3}, PART=1, QP={triple(each.at)}, ZP={triple(add(each.at, along))}\n"
    if each.kind == "body":
        text += f"MARKER/{n + 5}, PART={n}, ZP={triple(along)}\n"
        text += f"JPRIM/{n}, ORIENTATION, I={n + 5}, J={n + 3}\n"
    if each.haul:
        text += f"GCON/{n}, FUNCTION=DZ({n},{n + 3},{n + 3})\n, -({each.haul})\n"
    return text
