"""Writes the deck of a cable scene: head, wheels, cable, run."""

import re
from collections import Counter, defaultdict
from collections.abc import Sequence
from dataclasses import dataclass, replace

from adamslite.cables.description.components import Load
from adamslite.cables.description.vocabulary import Spec
from adamslite.cables.layout.geometry import FreeSpan
from adamslite.cables.model.estimate import Moves
from adamslite.cables.model.model_choice import CableModel
from adamslite.cables.statements.around import constants
from adamslite.cables.statements.forms import cable_variables, head, number, tail
from adamslite.cables.statements.graphics import route_line, solids
from adamslite.cables.statements.load_statements import drawn_loads, load_requests, write_loads
from adamslite.cables.statements.lumps import start_speed, write_lumps
from adamslite.cables.statements.requests import write_requests
from adamslite.cables.statements.span_statements import write_pieces
from adamslite.cables.statements.wheels import wheel
from adamslite.cables.vectors import Vector, norm

NOTES = {
    1: "Level 1: the cable is rigid and has no mass; GCON/p.f is the force in span p.",
    2: "Level 2: sections of fixed length; the section at a wheel takes what comes over it.",
    3: "Level 3: all sections of a span grow with the payout.",
}
# Of several cables the first method that one of them needs.
METHODS = ("RADAU", "HHT", "GSTIFF, SI2")
# Of what the cable carries: forces that are left in a static equilibrium.
BALANCED = 1e-9
# Strain of a cable that hardly carries anything.
LEAST_STRAIN = 1e-6
# A VARIABLE on one line that calls nothing; comments.
CONSTANT = re.compile(r"^VARIABLE/(\w+), FUNCTION=(?!.*(?:\(|\bTIME\b)).*\n(?!,)", re.MULTILINE)
COMMENT = re.compile(r"!.*")
BRUTE = "Brute force: sections of fixed length run over the rims and off the winches."


@dataclass(frozen=True)
class Modelled:
    """A cable with the turn of every wheel, one span between every two stations, what is known of
    its motion, and its model."""

    spec: Spec
    spans: list[FreeSpan]
    moves: Moves
    model: CableModel


def write(cables: list[Modelled], loads: Sequence[Load] = (), comments: str = "") -> str:
    """The deck of cables, and of loads that hang on several, with `comments` in its head."""
    spec = cables[0].spec
    gravity = ", ".join(
        f"{n}={number(g)}" for n, g in zip(("IGRAV", "JGRAV", "KGRAV"), spec.gravity, strict=True)
        if g
    )  # fmt: skip
    lines = ["", "PART/1, GROUND", *([f"ACCGRAV/{gravity}"] if gravity else [])]
    notes = " ".join(map(_notes, cables))
    text = head(spec.title, notes, *lines, author="adamslite cable", comments=comments)
    if loads:
        text += write_loads(loads, _places(cables))
    text += "".join(map(_cable, cables))
    if loads:
        text += load_requests(loads) + drawn_loads(loads, _places(cables))
    ends = _statics(cables, loads) + tail(_integrator(cables), spec.end, spec.steps)
    return _without_idle(text + ends)


def _without_idle(text: str) -> str:
    """The deck without constants that no statement needs, as the length of a single section."""
    while True:
        words = Counter(re.findall(r"\w+", COMMENT.sub("", text).upper()))
        found = [m for m in CONSTANT.finditer(text) if words[m[1].upper()] == 1]
        if not found:
            return text
        for match in reversed(found):
            text = text[: match.start()] + text[match.end() :]


def _notes(each: Modelled) -> str:
    """The model, and why."""
    model, name = each.model, f"{each.spec.numbers.name} {each.spec.cable.name}".strip()
    kind = BRUTE if model.form == "brute" else NOTES[model.level]
    reasons, figures = "; ".join(model.reasons.sentences), "; ".join(model.figures)
    notes = f"{kind} Chosen: {reasons}. Figures: {figures}."
    return f"Cable {name}. {notes}" if name else notes


def _cable(each: Modelled) -> str:
    """All statements of one cable."""
    spec, spans, model = each.spec, each.spans, each.model
    own, text = "", ""
    if model.level > 1:
        own = cable_variables(spec.cable, spec.cable.damping_time) + constants(spec)
    speed = start_speed(spec, each.moves)
    for i, station in enumerate(spec.route):
        text += wheel(spec, i, speed) if station.is_wheel else ""
    if model.form == "brute" or spec.bends:
        text += write_lumps(spec, spans, model, each.moves)
    else:
        text += write_pieces(spec, spans, model) + write_requests(spec, spans, model)
        text += solids(spec) + route_line(spec, spans, model)
    if not spec.numbers.name:
        return own + text
    # What every cable has a value of gets its number.
    names = "|".join(re.findall(r"^VARIABLE/(\w+)", own, re.MULTILINE)) or "EA"
    text = re.sub(rf"\b({names})\b", rf"\1_{spec.numbers.name}", own + text)
    name = f"{spec.numbers.name} {spec.cable.name}".strip()
    return f"\n! ==== cable {name} ====\n{text}"


def _places(cables: list[Modelled]) -> dict[int, list[tuple[int, Vector]]]:
    """Markers and places of what is on each load."""
    found: dict[int, list[tuple[int, Vector]]] = defaultdict(list)
    for each in cables:
        for i, station in enumerate(each.spec.route):
            found[station.on].append((each.spec.marker(i), station.at))
    return found


def _integrator(cables: list[Modelled]) -> str:
    """The method that all cables can do with, and the least of their bounds of errors."""
    first = cables[0].model
    if len(cables) == 1:
        return first.integrator
    methods = {each.model.method for each in cables}
    best = next((name for name in METHODS if name in methods), "HHT")
    return replace(first, method=best, error=min(each.model.error for each in cables)).integrator


def _statics(cables: list[Modelled], loads: Sequence[Load]) -> str:
    """The search for the equilibrium that a run starts from."""
    if not cables[0].spec.statics:
        return ""
    least = sum(each.mass for each in loads) * norm(cables[0].spec.gravity)
    for spec in (each.spec for each in cables):
        carried = spec.cable.density + sum(each.mass for each in spec.route)
        strained = LEAST_STRAIN * spec.cable.stiffness
        least = max(least, carried * norm(spec.gravity), spec.cable.pretension, strained)
    least *= BALANCED
    return f"\nEQUILIBRIUM/ERROR=1.0E-10, IMBALANCE={number(least)}, MAXIT=2000\nSIMULATE/STATICS\n"
