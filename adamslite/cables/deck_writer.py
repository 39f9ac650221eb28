"""Writes the deck of a cable scene: head, wheels, cable, run."""

from adamslite.cables.around import constants
from adamslite.cables.estimate import Moves
from adamslite.cables.geometry import FreeSpan
from adamslite.cables.graphics import route_line, solids
from adamslite.cables.lumps import start_speed, write_lumps
from adamslite.cables.model_choice import CableModel
from adamslite.cables.requests import write_requests
from adamslite.cables.span_statements import write_pieces
from adamslite.cables.statements import cable_variables, head, number, tail
from adamslite.cables.vectors import norm
from adamslite.cables.vocabulary import Spec
from adamslite.cables.wheels import wheel

NOTES = {
    1: "Level 1: the cable is rigid and has no mass; GCON/p.f is the force in span p.",
    2: "Level 2: sections of fixed length; the section at a wheel takes what comes over it.",
    3: "Level 3: all sections of a span grow with the payout.",
}
# Of what the cable carries: forces that are left in a static equilibrium.
BALANCED = 1e-9
# Strain of a cable that hardly carries anything.
LEAST_STRAIN = 1e-6
BRUTE = "Brute force: sections of fixed length run over the rims and off the winches."


def write(
    spec: Spec, spans: list[FreeSpan], moves: Moves, model: CableModel, comments: str = ""
) -> str:
    """The deck.

    Parameters
    ----------
    spec : Spec
        With the turn of every wheel.
    spans : list of FreeSpan
        One between every two stations.
    moves : Moves
    model : CableModel
    comments : str
        Lines for its head.

    Returns
    -------
    str
    """
    brute = model.form == "brute"
    notes = f"{BRUTE if brute else NOTES[model.level]} Chosen: {'; '.join(model.reasons.told)}."
    notes += f" Figures: {'; '.join(model.figures)}."
    gravity = ", ".join(
        f"{n}={number(g)}" for n, g in zip(("IGRAV", "JGRAV", "KGRAV"), spec.gravity, strict=True)
        if g
    )  # fmt: skip
    lines = ["", "PART/1, GROUND", *([f"ACCGRAV/{gravity}"] if gravity else [])]
    text = head(spec.title, notes, *lines, author="adamslite cable", comments=comments)
    if model.level > 1:
        text += cable_variables(spec.cable, spec.cable.damping) + constants(spec)
    speed = start_speed(spec, moves)
    for i, each in enumerate(spec.route):
        text += wheel(spec, i, speed) if each.is_wheel else ""
    if brute or spec.bends:
        text += write_lumps(spec, spans, model, moves)
    else:
        text += write_pieces(spec, spans, model) + write_requests(spec, spans, model)
        text += solids(spec) + route_line(spec, spans, model)
    return text + _statics(spec) + tail(model.integrator, spec.end, spec.steps)


def _statics(spec: Spec) -> str:
    """The search for the equilibrium that a run starts from."""
    if not spec.statics:
        return ""
    carried = spec.cable.density + sum(each.mass for each in spec.route)
    strained = LEAST_STRAIN * spec.cable.stiffness
    least = number(BALANCED * max(carried * norm(spec.gravity), spec.cable.pretension, strained))
    return f"\nEQUILIBRIUM/ERROR=1.0E-10, IMBALANCE={least}, MAXIT=2000\nSIMULATE/STATICS\n"
