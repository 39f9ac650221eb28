"""A span between two wheels: sections of equal length that the cable runs through, on a line.

Cable comes in with the rate u and goes out with v. H = LT/N is a section, y_k = k D/N + w_k the
place of node k on the line, D from wheel to wheel, e along it, U_k = u + (v - u) k/N, d the central
difference over two sections, c_k the speed of the material there past a point that goes with both
wheels:

    w_k' = c_k - U d y/(2 H)
    c_k' = (T_k+1 - T_k)/(rho H) + e.(g - a_k) - U (d y' - LT'/LT d y)/(2 H) - U^2 d2 y/H^2
    T_k  = EA ((y_k - y_(k-1))/H - 1),       a_k = (1 - k/N) a_0 + k/N a_N  of the axles

(the form ale of :mod:`adamslite.cables.statements.forms` where both ends feed). With the half
section beside a wheel, e' away from it and s" the cable that leaves it, the tension at its rim is

    T + rho H/2 (e'.(g - a) - s")

A bearing that moves has that half section to carry, the momentum of what passes, and across the
line the mass of half of the span.
"""

from adamslite.cables.description.vocabulary import Spec
from adamslite.cables.statements.forms import AXES, gravity, number, vforce
from adamslite.cables.statements.links import borne, comes, link, spun
from adamslite.cables.statements.pieces import (
    Piece,
    inflow,
    is_between,
    is_moving,
    parts_at,
    pulled,
)
from adamslite.cables.statements.wheels import carrier, triple
from adamslite.cables.vectors import ZERO, add, dot


def half(piece: Piece) -> str:
    """Mass of half of a section between two wheels."""
    return f"rho*LT{piece.number}/{2 * piece.sections}"


def pull(piece: Piece, i: int) -> str:
    """Tension of the section of a span between two wheels that lies at wheel i."""
    p, n = piece.number, piece.sections
    return f"T{p}" if i == piece.root or n == 1 else f"T{p}_{n}"


def at_rest(spec: Spec, piece: Piece, i: int) -> str:
    """Tension of a span at wheel i, but for the acceleration of the cable."""
    if not is_between(spec, piece):
        return f"T{piece.number}"
    lean = _lean(spec, piece, i)
    return pull(piece, i) + (f"+{half(piece)}*({lean})" if lean else "")


def tension_at(spec: Spec, piece: Piece, i: int) -> str:
    """The same, with the acceleration."""
    if not is_between(spec, piece):
        return f"T{piece.number}"
    sign, m = ("-", piece.first) if i == piece.root else ("+", piece.first + 1)
    return f"{at_rest(spec, piece, i)}{sign}{half(piece)}*({comes(spec, i, m, 2)})"


def _lean(spec: Spec, piece: Piece, i: int) -> str:
    """e'.(g - a) of wheel i of a span between two wheels; "" for none."""
    sense = 1 if i == piece.root else -1
    if not is_moving(spec, piece):
        weight = sense * dot(spec.gravity, piece.along)
        return number(weight) if weight else ""
    a, b = (piece.first, piece.first + 1)[::sense]
    return _along(spec, (a, b), {i: 1.0})


def _along(spec: Spec, ends: tuple[int, int], shares: dict[int, float]) -> str:
    """e.(g - a), e from MARKER/a to MARKER/b, with a these shares of what axles have."""
    a, b = ends
    parts = []
    for axis, g in zip(AXES, spec.gravity, strict=True):
        part = gravity(axis) if g else ""
        for i, share in shares.items():
            if spec.route[i].is_mobile:
                own = "" if share == 1 else f"{number(share)}*"
                part += f"-{own}ACC{axis}({spec.marker(i) + 1})"
        parts += [f"({part})*D{axis}({b},{a})"] if part else []
    return f"({'+'.join(parts)})/DM({b},{a})" if parts else ""


def touches(spec: Spec, piece: Piece, m: int, to: int) -> str:
    """MARKER/m where the piece touches the wheel at its root or, the second one, at its tip."""
    i, place, word = piece.root, piece.place, "leaves"
    if m > piece.first:
        i, place, word = piece.tip, piece.span.finish, "arrives"
    each = spec.route[i]
    if each.leans:
        tip = spec.route[piece.tip]
        # Between nodes the cable is at rest; alone it turns with its end.
        velocity = tip.velocity if to == spec.marker(piece.tip) else ZERO
        spin = spun(spec, i, piece.along, piece.span.length, velocity)
        return link(spec, i, m, place, to, spin)
    part = carrier(spec, i)
    place = add(place, each.origin if each.on else each.at, -1) if part > 1 else place
    return f"MARKER/{m}, PART={part}, QP={triple(place)}  ! cable {word}\n"


def write_link(spec: Spec, piece: Piece) -> str:
    """A span between two wheels."""
    p, n = piece.number, piece.sections
    text, spacing = apart(spec, piece)
    free = piece.span.length / (1 + piece.tension / spec.cable.stiffness)
    free = spec.frees[p - 1 - spec.numbers.spans] if spec.frees else free
    text += f"! {f'{n} sections' if n > 1 else 'One spring'} from wheel to wheel.\n"
    text += f"VARIABLE/LT{p}, FUNCTION={number(free)}+{inflow(spec, piece)}\n"
    text += _flow(spec, piece, free, spacing) if n > 1 else ""
    for k in range(1, n + 1):
        text += _section(spec, piece, k, spacing, f"({inflow(spec, piece, 1)})")
    if is_moving(spec, piece):
        text += _on_bearings(spec, piece)
    return text + parts_at(spec, piece)


def _differences(piece: Piece, name: str, *shares: tuple[int, int]) -> str:
    """Sum of the states `name`, w or v, of nodes with their shares; both ends have none."""
    found = ""
    for k, c in shares:
        if 0 < k < piece.sections:
            state = f"{name}{piece.number}_{k}"
            state = f"DIF({state})" if name == "w" else state
            found += f"{c:+d}*".replace("1*", "") + state
    return found


def _section(spec: Spec, piece: Piece, k: int, spacing: str, rate: str) -> str:
    """VARIABLE of the tension of section k."""
    p, n = piece.number, piece.sections
    length, free = spacing, f"LT{p}"
    if n > 1:
        length = f"({spacing}/{n}{_differences(piece, 'w', (k, 1), (k - 1, -1))})"
        free = f"(LT{p}/{n})"
    force, rates = f"{length}/{free}-1", ""
    if spec.cable.damping_time:
        ends = f"VR({piece.first},{piece.first + 1})" if is_moving(spec, piece) else ""
        ends += f"/{n}" if ends and n > 1 else ""
        faster = _differences(piece, "v", (k, 1), (k - 1, -1))
        rates = f"+tau*({ends}{faster}-{rate}*{length}/LT{p})/{free}"
    force = f"EA*({force}{rates})"
    text, tag = "", f"{p}" if k == 1 else f"{p}_{k}"
    if spec.cable.pulls_only and spec.grips:
        text = f"VARIABLE/pull_{tag}, FUNCTION={force}\n"
        force = f"pull_{tag}"
    force = pulled(spec, force)
    force = f"(1-broken_{p})*({force})" if spec.cable.parts and k == 1 else force
    return text + f"VARIABLE/T{tag}, FUNCTION={force}\n"


def _flow(spec: Spec, piece: Piece, free: float, spacing: str) -> str:
    """The nodes between the sections: places and speeds on the line, from rest in balance."""
    p, n, a, b = piece.number, piece.sections, piece.first, piece.first + 1
    heavy = dot(spec.gravity, piece.along)
    sag = spec.cable.density * heavy * (free / n) ** 2 / spec.cable.stiffness / 2
    faster = f"+2*VR({a},{b})/{n}" if is_moving(spec, piece) else ""
    text = (
        "! Cable that comes in and goes out; nodes: w from even places, c speed of the cable.\n"
        f"VARIABLE/U{p}_0, FUNCTION={comes(spec, piece.root, a, 1)}\n"
        f"VARIABLE/U{p}_{n}, FUNCTION={comes(spec, piece.tip, b, 1)}\n"
        f"VARIABLE/R{p}, FUNCTION=(U{p}_0-U{p}_{n})/LT{p}\n"
    )
    for k in range(1, n):
        both, own = ((k + 1, 1), (k - 1, -1)), f"{p}_{k}"
        lean = number(heavy) if heavy else ""
        if is_moving(spec, piece):
            lean = _along(spec, (a, b), {piece.root: 1 - k / n, piece.tip: k / n})
        after, before = (f"T{p}" if i == 1 else f"T{p}_{i}" for i in (k + 1, k))
        text += (
            f"VARIABLE/f{own}, FUNCTION={number(n / 2)}/LT{p}"
            f"*(U{p}_0+{number(k / n)}*(U{p}_{n}-U{p}_0))\n"
            f"VARIABLE/d{own}, FUNCTION=2*{spacing}/{n}{_differences(piece, 'w', *both)}\n"
            f"VARIABLE/v{own}, FUNCTION=DIF(c{own})-f{own}*d{own}\n"
            f"DIFF/w{own}, IC={number(sag * k * (n - k))}, FUNCTION=v{own}\n"
            f"DIFF/c{own}, FUNCTION={n}/LT{p}*({after}-{before})/rho{'+' if lean else ''}{lean}\n"
            f", -f{own}*({_differences(piece, 'v', *both)}{faster}-R{p}*d{own})"
            f"-4*f{own}**2*({_differences(piece, 'w', (k + 1, 1), (k, -2), (k - 1, 1))})\n"
        )
    return text


def _on_bearings(spec: Spec, piece: Piece) -> str:
    """What the ends of a span do to bearings that move."""
    a, b, p = piece.first, piece.first + 1, piece.number
    ends = ((piece.root, a, b, 1), (piece.tip, b, a, -1))
    text = f"SFORCE/{a}, I={a}, J={b}, FUNCTION=-T{p}\n" if piece.sections == 1 else ""
    for i, m, to, sense in ends:
        each, own = spec.route[i], pull(piece, i)
        if piece.sections > 1 and (each.is_mobile or each.leans):
            components = [f"{own}*D{x}({to},{m})/DM({to},{m})" for x in AXES]
            text += vforce(m + 4, m, AXES, components)
        more = f"{tension_at(spec, piece, i)}-{own}"
        text += borne(spec, i, m, to, sense, own, more)
        if each.is_mobile:
            text += _carried(spec, piece, i, (m, to))
    return text


def _carried(spec: Spec, piece: Piece, i: int, ends: tuple[int, int]) -> str:
    """The mass of half of a span on the bearing of wheel i, and the momentum that passes."""
    p, n, (m, to), bearing = piece.number, piece.sections, ends, spec.marker(i) + 1
    each, sign = spec.route[i], "-" if i == piece.root else "+"
    lean = _lean(spec, piece, i) or "0"
    rests = each.leans or each.mount is not None
    # Along the line a link or mount has it already; else one half section goes with the bearing.
    share = number(0.0 if rests else 1 / n)
    flow = "" if rests else f"-rho*({comes(spec, i, m, 1)})**2"
    if not rests:
        flow += f"{sign}{half(piece)}*({comes(spec, i, m, 2)})"
    along = f"(rho*LT{p}/2*({share}-1)*({lean}){flow})"
    components = []
    for axis, g in zip(AXES, spec.gravity, strict=True):
        weight = f"({gravity(axis) if g else ''}-ACC{axis}({bearing}))"
        components.append(f"rho*LT{p}/2*{weight}+{along}*D{axis}({to},{m})/DM({to},{m})")
    comment = "! Mass of half of the span.\n"
    return comment + vforce(m + 2, bearing, AXES, components)


def apart(spec: Spec, piece: Piece) -> tuple[str, str]:
    """Statements for, and the expression of the length of a span between two wheels."""
    if not is_moving(spec, piece):
        return "", number(piece.span.length)
    i, j = piece.first, piece.first + 1
    return touches(spec, piece, j, i), f"DM({i},{j})"
