"""Wheels, their bearings, supports and drives.

Station i of the route is MARKER/n, n = 10 i (from 1); a wheel is PART/n on the bearing MARKER/n+1,
z along the axle. A carriage that moves is PART/n+2 with MARKER/n+2; MARKER/n+3 is where it starts,
on the ground, z along the way it slides, or the foot of a mount that MARKER/n+5 stands on.
MARKER/n+4 floats for contacts.
"""

import re
from math import pi

from adamslite.cables.description.components import Mount
from adamslite.cables.description.vocabulary import Spec, Station
from adamslite.cables.statements.forms import AXES, number, rounded
from adamslite.cables.vectors import Vector, add, unit

# Sliding speed below which what grips does not slip [m/s].
STICKS = 1e-8


def triple(a: Vector) -> str:
    """Three numbers."""
    return ",".join(number(x) for x in rounded(a))


def travel(i: int, spec: Spec, order: int = 0) -> str:
    """Cable that runs over or through station i along the route [m], or its time derivative."""
    n = spec.marker(i)
    if spec.slips_at(i) or spec.route[i].slides:
        return (f"DIF(paid_{n})", f"DIF(run_{n})", f"A_{n}")[order]
    return rolled(i, spec, order)


def arm(i: int, spec: Spec, sense: int = 1) -> str:
    """Radius of wheel i, with the sign of a turn along the route, or against it (`sense` -1)."""
    each = spec.route[i]
    if each.reel:
        return f"{number(sense * each.turn)}*R_{spec.marker(i)}"
    return number(sense * each.turn * each.radius)


def rolled(i: int, spec: Spec, order: int = 0, sense: int = 1) -> str:
    """Way of the rim of wheel i along the route [m], or its time derivative."""
    each, n = spec.route[i], spec.marker(i)
    if is_rim(i, spec):
        return (f"DIF(rolled_{n})", f"DIF(rolls_{n})")[order]
    text = f"{arm(i, spec, sense)}*{turning(i, spec, order)}"
    if not each.reel or order == 1:
        return text
    if order == 0:
        mean = f"{number(sense * each.turn / 2)}*({number(each.radius)}+R_{n})"
        return f"{mean}*{turning(i, spec)}"
    return f"{text}+{number(sense * each.turn * _growth(i, spec))}*{turning(i, spec, 1)}**2"


def _growth(i: int, spec: Spec) -> float:
    """Radius that a reel gains per angle about its axle [m]."""
    each = spec.route[i]
    assert each.reel is not None
    return -spec.outwards(i) * each.turn * each.reel.thickness / (2 * pi)


def turning(i: int, spec: Spec, order: int = 0) -> str:
    """Angle of wheel i about its axle, or its time derivative."""
    n = spec.marker(i)
    if is_rim(i, spec):
        return f"{rolled(i, spec, order)}/({arm(i, spec)})"
    # Rates are along the axes of ground unless a third marker is there.
    seen = "" if _is_upright(spec.route[i]) and not spec.route[i].on else f",{n + 1}"
    return (f"AZ({n},{n + 1})", f"WZ({n},{n + 1}{seen})", f"WDTZ({n},{n + 1}{seen})")[order]


def is_rim(i: int, spec: Spec) -> bool:
    """Whether wheel i is no part, but the way of its rim: nothing but the friction of a cable that
    grips it and that of its bearing on the ground turns it, and rows of such wheels may be long.
    """
    each = spec.route[i]
    fast = not (each.is_mobile or each.leans or each.held)
    return bool(each.grip) and each.kind == "pulley" and spec.slips_at(i) and fast


def wheel(spec: Spec, i: int, speed: float = 0.0) -> str:
    """A wheel whose rim starts with `speed` along the route [m/s]."""
    each, n = spec.route[i], spec.marker(i)
    own = "" if _is_upright(each) else f", ZP={triple(each.axis)}"
    text = f"\n! The {each.kind} of {spec.label(i)}, R = {number(each.radius)} m.\n"
    if is_rim(i, spec):
        return text + _on_bearing(each, n, n)
    if each.is_mobile and not each.on:
        text += _mount(each, each.mount, n) if each.mount else _carriage(spec, i)
    if each.leans or not each.held:
        text += _on_bearing(each, n, n + 1)
    if each.held:
        return text + _on_bearing(each, n, n)
    inertia = ",".join([number(each.inertia)] * 3)
    spin = each.turn * speed / each.radius
    start = "".join(f", W{a}={number(spin * x)}" for a, x in zip(AXES, each.axis, strict=True)
                    if spin * x)  # fmt: skip
    return text + (
        f"PART/{n}, MASS={number(each.inertia / each.radius**2)}, CM={n}, IP={inertia}"
        f", QG={triple(each.at)}{start}\n"
        f"MARKER/{n}, PART={n}{own}\n"
        f"JOINT/{n}, REVOLUTE, I={n}, J={n + 1}\n"
        f"{_pack(spec, i) if each.reel else ''}"
    )


def _is_upright(each: Station) -> bool:
    """Whether its axle lies along z."""
    return each.axis == (0.0, 0.0, 1.0)


def _on_bearing(each: Station, n: int, m: int) -> str:
    """MARKER/m on the axle, z along it, on what wheel n sits on."""
    if each.on:
        place = add(each.at, each.origin, -1)
        own = "" if _is_upright(each) else f", ZP={triple(add(place, each.axis))}"
        return f"MARKER/{m}, PART={each.on}, QP={triple(place)}{own}\n"
    if each.is_mobile:
        own = "" if _is_upright(each) else f", ZP={triple(each.axis)}"
        return f"MARKER/{m}, PART={n + 2}{own}\n"
    ground = "" if _is_upright(each) else f", ZP={triple(add(each.at, each.axis))}"
    return f"MARKER/{m}, PART=1, QP={triple(each.at)}{ground}\n"


def _pack(spec: Spec, i: int) -> str:
    """Radius and inertia of what a reel holds.

    There is no term J' w: cable that leaves takes its angular momentum rho r w r^2 along.
    """
    each, n = spec.route[i], spec.marker(i)
    assert each.reel is not None
    heavy = spec.cable.density * pi / 2 / each.reel.thickness
    return (
        "! Radius and inertia of the cable on it.\n"
        f"VARIABLE/R_{n}, FUNCTION={number(each.radius)}"
        f"+({number(_growth(i, spec))})*{turning(i, spec)}\n"
        f"VARIABLE/J_{n}, FUNCTION={number(heavy)}*(R_{n}**4-{number(each.reel.core**4)})\n"
    )


def carrier(spec: Spec, i: int) -> int:
    """The part the bearing of wheel i sits on."""
    each = spec.route[i]
    return each.on or (spec.marker(i) + 2 if each.is_mobile else 1)


def _mount(each: Station, own: Mount, n: int) -> str:
    """A bracket with its mass centre at the axle, on its foot: MARKER/n+5 on MARKER/n+3."""
    inertia = ",".join([number(own.mass * each.radius**2)] * 3)
    text = (
        f"PART/{n + 2}, MASS={number(own.mass)}, CM={n + 2}, IP={inertia}, QG={triple(each.at)}\n"
        f"MARKER/{n + 2}, PART={n + 2}\n"
        f"MARKER/{n + 3}, PART=1, QP={triple(own.foot)}  ! foot of its mount\n"
        f"MARKER/{n + 5}, PART={n + 2}, QP={triple(add(own.foot, each.at, -1))}\n"
    )
    if not own.stiffness:
        return text + f"JOINT/{n + 2}, FIXED, I={n + 5}, J={n + 3}\n"
    k, c = (",".join([number(x)] * 3) for x in (own.stiffness, own.damping))
    return text + (
        f"JPRIM/{n + 2}, ORIENTATION, I={n + 5}, J={n + 3}\n"
        f"BUSHING/{n + 2}, I={n + 5}, J={n + 3}, K={k}, C={c}\n"
    )


def mount_request(spec: Spec, i: int) -> str:
    """Load and torque on the ground at the foot of a mount."""
    n = spec.marker(i)
    if not spec.route[i].mount:
        return ""
    named = {2: "FX", 3: "FY", 4: "FZ", 6: "TX", 7: "TY", 8: "TZ"}
    parts = [f"F{k}={name}({n + 3},{n + 5})" for k, name in named.items()]
    comment = f"! Load and torque on the ground at the foot of the mount of {spec.label(i)}.\n"
    return f"{comment}REQUEST/{n + 1}, " + "\\ ".join(parts) + "\n"


def _carriage(spec: Spec, i: int) -> str:
    """What the bearing of a wheel sits on, when that moves."""
    each, n, first = spec.route[i], spec.marker(i), spec.on_block(i)[0]
    mass = each.mass or 1.0
    inertia = ",".join([number(mass * each.radius**2)] * 3)
    text = (
        f"PART/{n + 2}, MASS={number(mass)}, CM={n + 2}, IP={inertia}, QG={triple(each.at)}\n"
        f"MARKER/{n + 2}, PART={n + 2}\n"
    )
    if each.is_moved:
        return (
            text
            + f"MARKER/{n + 3}, PART=1, QP={triple(each.at)}\n"
            + (f"JPRIM/{n + 2}, ORIENTATION, I={n + 2}, J={n + 3}\n" + moved(n + 2, n + 3, each))
        )
    if first < i:
        place = add(each.at, spec.route[first].at, -1)
        return text + (
            f"MARKER/{n + 3}, PART={spec.marker(first) + 2}, QP={triple(place)}  ! its block\n"
            f"JOINT/{n + 2}, FIXED, I={n + 2}, J={n + 3}\n"
        )
    way = unit(each.slide)
    if not any(way):
        return text + (
            "! It is free to move across its axle, and does not turn.\n"
            f"MARKER/{n + 3}, PART=1, QP={triple(each.at)}, ZP={triple(add(each.at, each.axis))}\n"
            f"MARKER/{n + 5}, PART={n + 2}, ZP={triple(each.axis)}\n"
            f"JPRIM/{n + 2}, ORIENTATION, I={n + 5}, J={n + 3}\n"
            f"JPRIM/{n + 3}, INPLANE, I={n + 5}, J={n + 3}\n"
        )
    return text + _slide(each, n, way)


def _slide(each: Station, n: int, way: Vector) -> str:
    """The line a carriage slides on, and what pulls it along."""
    text = (
        f"MARKER/{n + 3}, PART=1, QP={triple(each.at)}, ZP={triple(add(each.at, way))}\n"
        f"MARKER/{n + 5}, PART={n + 2}, ZP={triple(way)}\n"
        f"JOINT/{n + 2}, TRANSLATIONAL, I={n + 5}, J={n + 3}\n"
    )
    if each.pull:
        text += (
            f"VARIABLE/S_{n + 2}, FUNCTION=DZ({n + 5},{n + 3},{n + 3})\n"
            f"VARIABLE/SD_{n + 2}, FUNCTION=VZ({n + 5},{n + 3},{n + 3})\n"
            f"SFORCE/{n + 2}, ACTIONONLY, I={n + 2}, J={n + 3}\n"
            f", FUNCTION={own_names(each.pull, n + 2)}\n"
        )
    return text


def moved(i: int, j: int, each: Station) -> str:
    """MARKER/i moves from MARKER/j as the laws of the station prescribe."""
    return "".join(
        f"GCON/{i}{k}, FUNCTION=D{a}({i},{j})" + (f"\n, -({law})\n" if law else "\n")
        for k, (a, law) in enumerate(zip(AXES, each.motion, strict=True), 1)
    )


def own_names(text: str, n: int) -> str:
    """An expression of S and SD with the names these have at station n."""
    return re.sub(r"\b(SD?)\b", rf"\1_{n}", text, flags=re.IGNORECASE)
