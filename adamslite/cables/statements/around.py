"""The statements of what acts on the nodes of a cable besides tension and gravity.

A node stands for the length H of cable on either half of it; a node at a free end for H/2. With the
tangent t from node to node, the speed u of the water past it, u_t = t.u and u_n = u - u_t t:

    water   rho_w A H (-g)                                        buoyancy
            + rho_w D/2 H (Cn |u_n| u_n + pi Ct |u_t| u_t t)      drag
            - rho_w A Ca H (a - (t.a) t)                          added mass
    bed     IMPACT(z, z', level + D/2, K H, 1, C H, d) upwards
            - mu N v/sqrt(v^2 + v0^2) along it

Drag and added mass are those of Morison's equation in steady flow, split into its parts across and
along as in M. Hall and A. Goupee, Ocean Eng. 104 (2015) 590, equations 12 to 15; |u_n| is
sqrt(u_n^2 + CALM^2).

Bending is the energy EI/(2 H^3) of |x_(k-1) - 2 x_k + x_(k+1)|^2 at every node between two
sections, EI times the square of the curvature over 2 but for (H curvature)^2/12 of it. Node j is
pushed by minus its derivative, EI/H^3 (x_(j-2) - 4 x_(j-1) + 6 x_j - 4 x_(j+1) + x_(j+2)) inside.
Where nothing clamps it, an end is a hinge.
"""

from dataclasses import dataclass
from math import inf

from adamslite.cables.description.vocabulary import Spec
from adamslite.cables.statements.forms import AXES, number
from adamslite.cables.statements.wheels import triple
from adamslite.cables.vectors import add, unit

# Speed past the water below which drag is linear [m/s].
CALM = 1e-6
# Of the diameter: how deep a cable lies in the bed at least where its damping is full.
SUNK = 1e-3
SECOND = (1, -2, 1)


@dataclass(frozen=True)
class Row:
    """Markers of the nodes of a span from root to tip; name of the length of its sections; whether
    its first and last node are those of free ends, and whether they are held by the ground."""

    nodes: tuple[int, ...]
    length: str
    free: tuple[bool, bool]
    held: tuple[bool, bool]


def constants(spec: Spec) -> str:
    """Names of what is the same for all nodes."""
    text, cable, water, bed = "", spec.cable, spec.water, spec.bed
    if cable.bending:
        text += f"VARIABLE/EI, FUNCTION={number(cable.bending)}\n"
    if water:
        size = number(cable.diameter)
        text += "! Per length of cable: mass of the water it displaces, drag across and along.\n"
        text += f"VARIABLE/displaced, FUNCTION={number(water.density)}*PI/4*{size}**2\n"
        if water.drag:
            dense = f"{number(water.density)}*{size}/2"
            text += f"VARIABLE/drag_n, FUNCTION={number(water.drag.normal)}*{dense}\n"
            text += f"VARIABLE/drag_t, FUNCTION={number(water.drag.tangential)}*PI*{dense}\n"
            for axis, law in zip(AXES, water.current, strict=True):
                text += f"VARIABLE/flow_{axis}, FUNCTION={law}\n" if law else ""
    if bed:
        text += "! Of the bed per length: stiffness, damper; depth at which that is full.\n"
        text += f"VARIABLE/bed_K, FUNCTION={number(bed.stiffness)}\n"
        text += f"VARIABLE/bed_C, FUNCTION={number(bed.damping)}\n"
        text += f"VARIABLE/bed_D, FUNCTION={number(_lies_deep(spec))}\n"
    return text


def _lies_deep(spec: Spec) -> float:
    """Depth of a cable in the bed at rest [m]."""
    assert spec.bed
    weight = spec.cable.density * sum(g * g for g in spec.gravity) ** 0.5
    return max(weight / spec.bed.stiffness, SUNK * spec.cable.diameter)


def write_around(spec: Spec, row: Row, axes: str) -> str:
    """Water, bed and bending on the nodes of one span."""
    if not spec.is_surrounded:
        return ""
    text, last = "! Round the cable.\n", len(row.nodes) - 1
    for k, i in enumerate(row.nodes):
        end = k in (0, last)
        if end and not row.free[k > 0]:
            continue
        length = f"{row.length}/2" if end else row.length
        beside = row.nodes[max(k - 1, 0)], row.nodes[min(k + 1, last)]
        tag = f"{i}_{row.length}" if end else f"{i}"
        if spec.water:
            text += _water(spec, (tag, i), beside, length, axes)
        if spec.bed:
            text += _bed(spec, (tag, i), length, axes)
    return text + (_bending(spec, row, axes) if spec.cable.bending else "")


def _up(spec: Spec, call: str, i: int) -> str:
    """Component of a vector of MARKER/i against gravity: its height or the rate of that."""
    parts = zip(AXES, unit(spec.gravity), strict=True)
    return "".join(f"{-g:+.11g}*{call}{a}({i})" for a, g in parts if g).replace("+1*", "+")


def wet_share(spec: Spec, i: int, beside: tuple[int, int], length: str) -> str:
    """Share of the cable of a node that is below the surface: over the height of its section."""
    assert spec.water
    a, b = beside
    rise = _up(spec, "D", b) + "-(" + _up(spec, "D", a) + ")"
    reach = f"({number(spec.cable.diameter)}+ABS({rise})/DM({b},{a})*{length})/2"
    depth = f"{_up(spec, 'D', i).lstrip('+')}-({number(spec.water.level)})"
    return f"STEP({depth},-{reach},1,{reach},0)"


def _water(spec: Spec, at: tuple[str, int], beside: tuple[int, int], length: str, axes: str) -> str:
    """Buoyancy, drag and added mass of a node."""
    water, (tag, i), (a, b) = spec.water, at, beside
    assert water
    text, share = "", length
    if water.level < inf:
        text += f"VARIABLE/wet_{tag}, FUNCTION={wet_share(spec, i, beside, length)}\n"
        share = f"wet_{tag}*{length}"
    lifts = {x: -g * water.buoyancy for x, g in zip(AXES, spec.gravity, strict=True)}
    forces = {x: f"+displaced*{number(lifts[x])}" if lifts[x] else "" for x in axes}
    if water.drag or water.added_mass:
        for x in axes:
            text += f"VARIABLE/t{x}_{tag}, FUNCTION=D{x}({b},{a})/DM({b},{a})\n"
    for more, lines in (_dragged(spec, tag, i, axes), _accelerated(spec, tag, i, axes)):
        text += lines
        forces = {x: f + more.get(x, "") for x, f in forces.items()}
    whole = {x: f"{share}*({f.lstrip('+')})" for x, f in forces.items() if f}
    return text + _force(f"water_{tag}", i, whole)


def _dragged(spec: Spec, tag: str, i: int, axes: str) -> tuple[dict[str, str], str]:
    """Drag per length, and the speeds that it needs."""
    if not (spec.water and spec.water.drag):
        return {}, ""
    along = f"+drag_t*ABS(u_{tag})*u_{tag}" if spec.water.drag.tangential else ""
    found = {x: f"+drag_n*n_{tag}*n{x}_{tag}" + (along and f"{along}*t{x}_{tag}") for x in axes}
    return found, _past(spec, tag, i, axes)


def _accelerated(spec: Spec, tag: str, i: int, axes: str) -> tuple[dict[str, str], str]:
    """Force of the added mass per length, and the acceleration along the cable."""
    if not (spec.water and spec.water.added_mass):
        return {}, ""
    share = f"-{number(spec.water.added_mass)}*displaced"
    along = "+".join(f"ACC{x}({i})*t{x}_{tag}" for x in axes)
    found = {x: f"{share}*(ACC{x}({i})-a_{tag}*t{x}_{tag})" for x in axes}
    return found, f"VARIABLE/a_{tag}, FUNCTION={along}\n"


def _past(spec: Spec, tag: str, i: int, axes: str) -> str:
    """Speed of the water past MARKER/i: u along the cable, nX, nY, nZ and n across it."""
    assert spec.water
    speeds = {}
    for x, law in zip(AXES, spec.water.current, strict=True):
        if x in axes:
            speeds[x] = f"flow_{x}-V{x}({i})" if law else f"-V{x}({i})"
    along = "+".join(f"({u})*t{x}_{tag}" for x, u in speeds.items())
    text = f"VARIABLE/u_{tag}, FUNCTION={along}\n"
    for x, u in speeds.items():
        text += f"VARIABLE/n{x}_{tag}, FUNCTION={u}-u_{tag}*t{x}_{tag}\n"
    squares = "+".join(f"n{x}_{tag}**2" for x in speeds)
    return text + f"VARIABLE/n_{tag}, FUNCTION=SQRT({squares}+{CALM**2:g})\n"


def _bed(spec: Spec, at: tuple[str, int], length: str, axes: str) -> str:
    """What carries a node that lies on the bed, and holds it there."""
    bed, (tag, i) = spec.bed, at
    assert bed
    z, rate = (_up(spec, call, i).lstrip("+") for call in "DV")
    top = number(bed.level + spec.cable.diameter / 2)
    text = f"VARIABLE/bed_{tag}, FUNCTION=IMPACT({z},{rate},{top},bed_K*{length},1.0,"
    text += f"bed_C*{length},bed_D)\n"
    upwards = dict(zip(AXES, (-g for g in unit(spec.gravity)), strict=True))
    forces = {x: f"{number(upwards[x])}*bed_{tag}" for x in axes if upwards[x]}
    if bed.friction:
        level = {x: f"(V{x}({i})-{number(c)}*({rate}))" if (c := upwards[x]) else f"V{x}({i})"
                 for x in axes if abs(upwards[x]) < 1}  # fmt: skip
        squares = "+".join(f"{v}**2" for v in level.values())
        text += f"VARIABLE/slide_{tag}, FUNCTION=SQRT({squares}+{number(bed.creep**2)})\n"
        for x, v in level.items():
            drag = f"-{number(bed.friction)}*bed_{tag}*{v}/slide_{tag}"
            forces[x] = forces.get(x, "") + drag
    return text + _force(f"bed_{tag}", i, forces)


def _bending(spec: Spec, row: Row, axes: str) -> str:
    """What the curvature of the cable does to its nodes."""
    text, last = "", len(row.nodes) - 1
    for k, i in enumerate(row.nodes):
        if k in (0, last) and row.held[k > 0]:
            continue
        forces = {x: _stiff(spec, row, k, x) for x in axes}
        if last > 1:
            text += _force(f"bend_{i}_{row.length}" if k in (0, last) else f"bend_{i}", i, forces)
    return text


def _stiff(spec: Spec, row: Row, k: int, axis: str) -> str:
    """Component of the bending force on node k."""
    shares = bending_shares(len(row.nodes), k)
    signs = [(f"{c:+g}*" if abs(c) != 1 else "+-"[c < 0], row.nodes[j]) for j, c in shares]
    parts = ["".join(f"{c}{call}{axis}({j})" for c, j in signs) for call in "DV"]
    more = f"+{number(spec.cable.bending_damping)}*({parts[1].lstrip('+')})"
    whole = f"{parts[0].lstrip('+')}" + (more if spec.cable.bending_damping else "")
    return f"-EI/{row.length}**3*({whole})"


def bending_shares(count: int, k: int) -> list[tuple[int, int]]:
    """Factors of the places of nodes in the derivative of the sum of squares of second differences
    of `count` places by that of node k, over 2."""
    found = dict.fromkeys(range(count), 0)
    for c in range(max(k - 1, 1), min(k + 1, count - 2) + 1):
        for j, share in enumerate(SECOND):
            found[c - 1 + j] += SECOND[k - c + 1] * share
    return [(j, share) for j, share in found.items() if share]


def _force(name: str, i: int, forces: dict[str, str]) -> str:
    """A VFORCE on MARKER/i; ground takes the reaction."""
    lines = "\\\n".join(f", F{a}={f}" for a, f in forces.items())
    return f"VFORCE/{name}, I={i}, J_PART=1\n{lines}\n" if lines else ""


def write_clamp(spec: Spec, i: int, node: int, length: str) -> str:
    """What turns the cable at the fixed station i: half a section before it there is a node as far
    on the other side of the direction in which it is held."""
    n, along = spec.marker(i), spec.route[i].clamped
    at = spec.route[i].at
    calls = [f"D{{x}}({node},{n},{n + 1})", f"V{{x}}({node},{n},{n + 1})"]
    part = calls[0]
    if spec.cable.bending_damping:
        part = f"({calls[0]}+{number(spec.cable.bending_damping)}*{calls[1]})"
    forces = {x: f"-2*EI/{length}**3*{part.format(x=x)}" for x in "XY"}
    lines = "\\\n".join(f", F{x}={f}" for x, f in forces.items())
    return (
        "! Clamped: the cable leaves along z of this marker.\n"
        f"MARKER/{n + 1}, PART=1, QP={triple(at)}, ZP={triple(add(at, along))}\n"
        f"VFORCE/clamp_{n}, I={node}, J_PART=1, RM={n + 1}\n{lines}\n"
    )
