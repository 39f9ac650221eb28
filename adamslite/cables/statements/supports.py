"""What the ends of a cable feel of it: the half section that lies there, and the load on a fixed
point in water, on a bed, or at which the cable bends."""

from math import inf

from adamslite.cables.description.surroundings import height
from adamslite.cables.description.vocabulary import Spec
from adamslite.cables.model.model_choice import CableModel
from adamslite.cables.statements import sliders
from adamslite.cables.statements.around import bending_shares, wet_share
from adamslite.cables.statements.forms import AXES
from adamslite.cables.statements.pieces import Piece
from adamslite.cables.statements.span_statements import row_of, spring


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
    text = (
        f"! Load of the cable on station {spec.station(i)}: along x, y and z, and its magnitude.\n"
    )
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
