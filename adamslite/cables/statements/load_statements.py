"""The statements of loads that several cables carry: bodies, hinges, tilt, drawing."""

from collections.abc import Sequence

import numpy as np

from adamslite.cables.description.components import Load
from adamslite.cables.model.loads import ROUND_OFF
from adamslite.cables.statements.forms import AXES, number
from adamslite.cables.statements.wheels import triple
from adamslite.cables.vectors import ZERO, Vector, add, cross, dot, norm, unit


def write_loads(loads: Sequence[Load], places: dict[int, list[tuple[int, Vector]]]) -> str:
    """Bodies, hinges, what keeps them from turning about the line of their hooks, their tilt.

    `places` has the markers and places of what is on each load, by its number.
    """
    numbers = {each.name: each.part for each in loads}
    text = ""
    for each in loads:
        n = each.part
        speed = "".join(
            f", V{a}={number(v)}" for a, v in zip(AXES, each.velocity, strict=True) if v
        )
        text += f"\n! The load{' ' if each.name else ''}{each.name}.\n"
        if not each.turns:
            text += (
                f"POINT_MASS/{n}, MASS={number(each.mass)}, CM={n}, QG={triple(each.at)}{speed}\n"
            )
            text += f"MARKER/{n}, POINT_MASS={n}\n"
            continue
        text += f"PART/{n}, MASS={number(each.mass)}, CM={n}, IP={triple(each.inertia)}"
        text += f", QG={triple(each.at)}{speed}\nMARKER/{n}, PART={n}\n"
        text += _hinge(each, loads, numbers) if each.pivot else ""
        text += _held(each, [place for _, place in places[n]])
    return text


def _hinge(each: Load, loads: Sequence[Load], numbers: dict[str, int]) -> str:
    """REVOLUTE of a load, on ground or another load."""
    own, n = each.pivot, each.part
    assert own
    base = next((x for x in loads if own.on and x.part == numbers[own.on]), None)
    text = ""
    under = (base.part, base.at) if base else (1, ZERO)
    for m, (part, origin) in ((n + 1, (n, each.at)), (n + 2, under)):
        place = add(own.at, origin, -1)
        text += f"MARKER/{m}, PART={part}, QP={triple(place)}, ZP={triple(add(place, own.axis))}\n"
    return text + f"JOINT/{n}, REVOLUTE, I={n + 1}, J={n + 2}\n"


def _held(each: Load, places: list[Vector]) -> str:
    """What keeps a load from turning about the line through its mass centre and all of its hooks,
    about which nothing turns it."""
    arms = [add(place, each.at, -1) for place in places]
    line = max(arms, key=norm, default=ZERO)
    if (
        each.pivot
        or not any(line)
        or any(norm(cross(line, arm)) > ROUND_OFF * dot(line, line) for arm in arms)
    ):
        return ""
    n, d = each.part, unit(line)
    aside = min(np.eye(3), key=lambda axis: abs(np.dot(axis, d)))
    across = unit(cross(d, (float(aside[0]), float(aside[1]), float(aside[2]))))
    level = cross(d, across)
    return (
        "! Nothing turns it about the line of its hooks.\n"
        f"MARKER/{n + 3}, PART={n}, ZP={triple(across)}\n"
        f"MARKER/{n + 4}, PART=1, ZP={triple(level)}\n"
        f"JPRIM/{n}, PERPENDICULAR, I={n + 3}, J={n + 4}\n"
    )


def load_requests(loads: Sequence[Load]) -> str:
    """Angles about x, y and z of every load that turns."""
    return "".join(
        f"REQUEST/{each.part}, F2=AX({each.part})\\ F3=AY({each.part})\\ F4=AZ({each.part})"
        f"  ! tilt of the load{' ' if each.name else ''}{each.name}\n"
        for each in loads if each.turns
    )  # fmt: skip


def drawn_loads(loads: Sequence[Load], places: dict[int, list[tuple[int, Vector]]]) -> str:
    """A line from hook to hook, through the mass centre."""
    text = ""
    for each in loads:
        markers = [m for m, _ in places[each.part]]
        apart = any(norm(add(place, each.at, -1)) > 0 for _, place in places[each.part])
        if apart:
            way = ",".join(str(m) for k in markers for m in (each.part, k))
            text += f"GRAPHICS/{each.part}, OUTLINE={way}\n"
    return text
