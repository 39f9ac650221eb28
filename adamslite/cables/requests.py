"""The requests in the decks of levels 1 to 3."""

from adamslite.cables.geometry import FreeSpan, wrap
from adamslite.cables.links import wrapped
from adamslite.cables.model_choice import CableModel
from adamslite.cables.span_statements import Piece, pieces
from adamslite.cables.vocabulary import Spec
from adamslite.cables.wheels import marker, mount_request, travel


def write_requests(spec: Spec, spans: list[FreeSpan], model: CableModel) -> str:
    """Tension of every span; travel over every wheel and through every weight that slides, how
    the cable lies on a wheel and loads it."""
    found = pieces(spec, spans)
    text = "\n! ---- results ----\n"
    if model.level > 1:
        text += "".join(
            f"REQUEST/{p.number}, F2=T{p.number}\\, COMMENT=tension of span {p.number}, "
            'CUNITS="","N"\n'
            for p in found
        )
    for i, each in enumerate(spec.route):
        if each.is_wheel:
            text += _over(spec, spans, found, i) + mount_request(spec, i)
        elif each.slides and model.level > 1:
            text += _over(spec, spans, found, i)
    return text


def _over(spec: Spec, spans: list[FreeSpan], found: list[Piece], i: int) -> str:
    each, n = spec.route[i], marker(i)
    title = f"cable over station {i + 1}"
    parts = [f"F2={travel(i, spec)}", f"F3={travel(i, spec, 1)}"]
    if each.leans:
        parts.append(f"F4=JOINT({n},0,1,0)")
        title += ", load on the axle"
    if each.payout:
        parts.append(f"F6=-GCON({n})")
        title += ", pull of the winch"
    if each.leans and not spec.is_end(i):
        before, behind = (_touch(found[p], i) for p in spec.beside(i))
        parts.append(f"F7={wrapped(spec, i, before, behind, wrap(spec, spans, i))}")
        title += ", wrap angle"
    text = "\\ ".join(parts)
    if len(parts) > 3:
        return f"! {title[0].upper()}{title[1:]}.\nREQUEST/{n}, {text}\n"
    return f"REQUEST/{n}, {text}  ! {title}\n"


def _touch(piece: Piece, i: int) -> int:
    """The marker where a piece touches wheel i."""
    return piece.first if piece.root == i else piece.first + 1
