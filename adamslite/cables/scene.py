"""The whole way from the text of a description to the text of a deck."""

from adamslite.cables.choose import Choice, choose, tensions
from adamslite.cables.estimate import Travel, travel
from adamslite.cables.geometry import Span, spans, turned
from adamslite.cables.messages import Faults
from adamslite.cables.spec import Spec, read
from adamslite.cables.write import write
from adamslite.diagnostics import DeckError, Diagnostic, sort_by_place

MOST_ELEMENTS = 900


def deck(text: str, file: str = "<text>") -> tuple[str, list[Diagnostic]]:
    """The deck of a description, and the warnings about it.

    Raises
    ------
    DeckError
        With everything that is wrong with the description.
    """
    spec, faults = read(text, file)
    spec = turned(spec)
    pieces = spans(spec, faults)
    if len(pieces) < len(spec.route) - 1:
        raise DeckError(faults.found)
    moves = travel(spec, pieces, faults)
    choice = choose(spec, pieces, moves, faults)
    _check(spec, pieces, moves, choice, faults)
    if faults.errors:
        raise DeckError(faults.found)
    return write(spec, pieces, choice), sort_by_place(faults.found)


def _check(spec: Spec, pieces: list[Span], moves: Travel, choice: Choice, faults: Faults) -> None:
    """What only the choice and the travel show."""
    if choice.elements > MOST_ELEMENTS:
        faults.add("too-many", ("model", "elements"), word="elements", count=choice.elements)
    winch = next((i for i, each in enumerate(spec.route) if each.kind == "winch"), None)
    if winch is not None:
        length = pieces[0 if winch == 0 else -1].length
        if length + moves.least <= 0:
            key = "payout" if spec.route[winch].payout else "force"
            faults.add("payout-too-far-in", ("route", winch, key),
                       time=moves.least_at, value=moves.least, length=length)  # fmt: skip
    section = max(piece.length for piece in pieces) / choice.elements
    if choice.level == 2 and moves.way > section / 2:
        faults.add("level-2-pays-out", ("model", "level"), section=section, travel=moves.way)
    most = max(tensions(spec, pieces))
    if 0 < spec.cable.breaking < most:
        faults.add("breaking", ("cable", "breaking_load"), tension=most, limit=spec.cable.breaking)
