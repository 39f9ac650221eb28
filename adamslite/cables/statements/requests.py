"""The requests in the decks of levels 1 to 3."""

from math import inf

from adamslite.cables.description.surroundings import height
from adamslite.cables.description.vocabulary import Spec
from adamslite.cables.layout.geometry import FreeSpan, wrap
from adamslite.cables.model.model_choice import CableModel
from adamslite.cables.statements import sliders
from adamslite.cables.statements.around import bending_shares, wet_share
from adamslite.cables.statements.capstan import at_wheel, half_section
from adamslite.cables.statements.forms import AXES, number
from adamslite.cables.statements.links import wrapped
from adamslite.cables.statements.pieces import Piece, is_between, pieces, root_marker
from adamslite.cables.statements.span_statements import row_of, side_of, spring
from adamslite.cables.statements.wheel_spans import tension_at
from adamslite.cables.statements.wheels import is_rim, mount_request, travel, turning

# A tension below this strain is none, and no ratio is taken with it.
SLACK = 1e-12


def write_requests(spec: Spec, spans: list[FreeSpan], model: CableModel) -> str:
    """Tension of every span; travel over every wheel and through every weight that slides, how
    the cable lies on a wheel and loads it."""
    found = pieces(spec, spans, model.elements)
    text = "\n! ---- results ----\n"
    if model.level > 1:
        text += "".join(_tensions(spec, model, piece) for piece in found)
    for i, each in enumerate(spec.route):
        if each.is_wheel:
            text += _over(spec, spans, model, found, i) + mount_request(spec, i)
        elif each.kind == "fixed" and spec.is_surrounded and model.level > 1:
            text += support_request(spec, model, found, i)
        elif each.slides and model.level > 1:
            text += _over(spec, spans, model, found, i)
    return text


def _tensions(spec: Spec, model: CableModel, piece: Piece) -> str:
    """F2, F3: tension at the root and at the tip of a piece.

    A section has the tension of its middle; at an end of the cable half a section more, or less,
    hangs and is accelerated: T = T_section + rho H/2 e.(g - x"), e along the cable from the end.
    """
    p, n = piece.number, model.elements
    root, tip = spec.route[piece.root], spec.route[piece.tip]
    parts = [f"F2={at_wheel(spec, model, piece, piece.root)}"]
    if is_between(spec, piece):
        parts.append(f"F3={tension_at(spec, piece, piece.tip)}")
    elif tip.kind != "run":
        side = side_of(spec, piece, model)
        if not root.feeds and root.kind != "run":
            i, j = root_marker(spec, piece), side.node(1)
            parts[0] += hanging_half(spec, piece.root, half_section(model, piece, spec), (i, j))
        if tip.kind != "free":
            grows = model.level == 3 and root.feeds
            free = f"H{p}" if grows else f"L{p}_0" if n == 1 else f"L{p}"
            i, j = side.node(n), side.node(n - 1) if n > 1 else root_marker(spec, piece)
            pull = spring(spec, piece, i, j, free)
            parts.append(f"F3={pull}{hanging_half(spec, piece.tip, f'{free}/2', (i, j))}")
    ends = " to ".join(x.name or x.kind for x in (root, tip))
    title = f"span {p}" + f" ({ends})" * bool(root.name or tip.name)
    words = "tension at its root and tip" if len(parts) > 1 else "tension"
    return (
        f"REQUEST/{piece.label}, " + "\\\n, ".join(parts)
        + f'\\, COMMENT={title}: {words}, CUNITS="","N"' + ',"N"' * (len(parts) > 1) + "\n"
    )  # fmt: skip


def _over(spec: Spec, spans: list[FreeSpan], model: CableModel, found: list[Piece], i: int) -> str:
    each, n = spec.route[i], spec.marker(i)
    title = f"cable over {spec.label(i)}"
    parts = [f"F2={travel(i, spec)}", f"F3={travel(i, spec, 1)}"]
    if each.leans:
        parts.append(f"F4=JOINT({n},0,1,0)")
        title += ", load on the axle"
    if is_rim(i, spec):
        parts += [f"F4={turning(i, spec)}", f"F6={turning(i, spec, 1)}"]
        title += ", angle of the wheel and its rate"
    if each.payout:
        parts.append(f"F6=-GCON({n})")
        title += ", pull of the winch"
    if each.leans and not spec.is_end(i):
        before, behind = (_touch(found[p], i) for p in spec.beside(i))
        parts.append(f"F7={wrapped(spec, i, before, behind, wrap(spec, spans, i))}")
        title += ", wrap angle"
    if spec.slips_at(i) and not spec.closed:
        t1, t2 = (at_wheel(spec, model, found[p], i) for p in spec.beside(i))
        parts.append(f"F8=({t2})/MAX({t1},{number(SLACK * spec.cable.stiffness)})")
        title += ", ratio of its tensions"
    text = "\\ ".join(parts)
    if each.name:
        text += f"\\, COMMENT={each.name}: travel of the cable"
    if len(parts) > 3:
        return f"! {title[0].upper()}{title[1:]}.\nREQUEST/{n}, {text}\n"
    return f"REQUEST/{n}, {text}  ! {title}\n"


def _touch(piece: Piece, i: int) -> int:
    """The marker where a piece touches wheel i."""
    return piece.first if piece.root == i else piece.first + 1


def hanging_half(spec: Spec, i: int, half: str, pair: tuple[int, int]) -> str:
    """Tension that the half section of length `half` adds at station i, from `pair[0]` there to
    `pair[1]`: rho H/2 e.(g - x") less what the water carries."""
    at, to = pair
    if spec.route[i].kind == "fixed" and _on_bed(spec, i):
        return ""
    text = f"\n, +rho*{half}*{sliders.lean(at, to)}"
    carried = _displaced(spec, i, pair, half)
    if not carried:
        return text
    parts = [f"{g:+.11g}*D{x}({to},{at})" for x, g in zip(AXES, spec.gravity, strict=True) if g]
    return f"{text}\n, -{carried}*{half}*({''.join(parts).lstrip('+')})/DM({to},{at})"


def _displaced(spec: Spec, i: int, pair: tuple[int, int], half: str) -> str:
    """Mass of water, per length, that the half section at station i displaces; "" where none is.
    A station that moves may leave the water.
    """
    water, station = spec.water, spec.route[i]
    if water and water.buoyancy and water.level < inf and (station.is_moved or station.is_free):
        return f"displaced*{wet_share(spec, pair[0], pair, half)}"
    return "displaced" if spec.lightness(station.at) < 1 else ""


def support_request(spec: Spec, model: CableModel, found: list[Piece], i: int) -> str:
    """F2 to F4: load of the cable on the fixed station i along x, y, z; F6: its magnitude."""
    n = spec.marker(i)
    loads = dict.fromkeys(AXES, "")
    for p in spec.beside(i):
        if p >= 0:
            for x, load in _load(spec, model, found[p], i).items():
                loads[x] += load
    names = {x: f"load{x}_{n}" for x in AXES}
    text = f"! Load of the cable on {spec.label(i)}: along x, y and z, and its magnitude.\n"
    for x, load in loads.items():
        text += f"VARIABLE/{names[x]}, FUNCTION={load}\n"
    squares = "+".join(f"{name}**2" for name in names.values())
    parts = [f"F{k}={name}" for k, name in enumerate(names.values(), 2)]
    return text + f"REQUEST/{n}, " + "\\ ".join([*parts, f"F6=SQRT({squares})"]) + "\n"


def _load(spec: Spec, model: CableModel, piece: Piece, i: int) -> dict[str, str]:
    """Tension and bending force of one span on station i, and weight of the half section there."""
    row = row_of(spec, model, piece)
    at_root = piece.root == i
    k = 0 if at_root else len(row.nodes) - 1
    at, to = (row.nodes[0], row.nodes[1]) if at_root else (row.nodes[-1], row.nodes[-2])
    free = row.length
    pull = spring(spec, piece, min(at, to, key=row.nodes.index),
                  max(at, to, key=row.nodes.index), free)  # fmt: skip
    carried = _displaced(spec, i, (at, to), f"{free}/2")
    varies = carried not in ("", "displaced")
    light = 1.0 if varies else spec.lightness(spec.route[i].at)
    weight = spec.cable.density * light * (not _on_bed(spec, i))
    loads = {}
    for x, g in zip(AXES, spec.gravity, strict=True):
        load = f"+({pull})*D{x}({to},{at})/DM({to},{at})"
        if g and weight:
            load += f"{weight * g / 2:+.11g}*{free}"
            load += f"{-g / 2:+.11g}*{carried}*{free}" if varies else ""
        if spec.cable.bending:
            load += _bent(spec, row.nodes, k, free, x)
        if any(spec.route[i].clamped):
            load += f"-VFORCE(clamp_{spec.marker(i)},0,{AXES.index(x) + 2},0)"
        loads[x] = load
    return loads


def _on_bed(spec: Spec, i: int) -> bool:
    """Whether a station lies on the bed, which carries the cable there."""
    if not spec.bed:
        return False
    return height(spec.gravity, spec.route[i].at) < spec.bed.level + spec.cable.diameter


def _bent(spec: Spec, nodes: tuple[int, ...], k: int, free: str, x: str) -> str:
    """Bending force on the node of an end."""
    shares = bending_shares(len(nodes), k)
    if not shares:
        return ""
    parts = "".join(f"{c:+d}*D{x}({nodes[j]})" for j, c in shares)
    return f"-EI/{free}**3*({parts.lstrip('+')})"
