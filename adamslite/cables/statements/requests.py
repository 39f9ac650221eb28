"""The requests in the decks of levels 1 to 3."""

from adamslite.cables.description.vocabulary import Spec
from adamslite.cables.layout.geometry import FreeSpan, wrap
from adamslite.cables.model.model_choice import CableModel
from adamslite.cables.statements.capstan import at_wheel, half_section
from adamslite.cables.statements.forms import number
from adamslite.cables.statements.links import wrapped
from adamslite.cables.statements.pieces import Piece, is_between, pieces, root_marker
from adamslite.cables.statements.span_statements import side_of, spring
from adamslite.cables.statements.supports import hanging_half, support_request
from adamslite.cables.statements.wheel_spans import is_heavy, tension_at
from adamslite.cables.statements.wheels import is_rim, mount_request, travel, turning

# A tension below this strain is none, and no ratio is taken with it.
SLACK = 1e-12


def write_requests(spec: Spec, spans: list[FreeSpan], model: CableModel) -> str:
    """Tension of every span; travel over every wheel and through every weight that slides, how
    the cable lies on a wheel and loads it."""
    found = pieces(spec, spans)
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
    if is_heavy(spec, piece):
        parts.append(f"F3={tension_at(spec, piece, piece.tip)}")
    elif not (is_between(spec, piece) or tip.kind == "run"):
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
    words = "tension at its root and tip" if len(parts) > 1 else "tension"
    return (
        f"REQUEST/{piece.label}, " + "\\\n, ".join(parts)
        + f'\\, COMMENT=span {p}: {words}, CUNITS="","N"' + ',"N"' * (len(parts) > 1) + "\n"
    )  # fmt: skip


def _over(spec: Spec, spans: list[FreeSpan], model: CableModel, found: list[Piece], i: int) -> str:
    each, n = spec.route[i], spec.marker(i)
    title = f"cable over station {spec.station(i)}"
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
    if len(parts) > 3:
        return f"! {title[0].upper()}{title[1:]}.\nREQUEST/{n}, {text}\n"
    return f"REQUEST/{n}, {text}  ! {title}\n"


def _touch(piece: Piece, i: int) -> int:
    """The marker where a piece touches wheel i."""
    return piece.first if piece.root == i else piece.first + 1
