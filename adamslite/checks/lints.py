"""Rules about what is legal and probably not meant; they run in :func:`check` only."""

from __future__ import annotations

import re
from collections.abc import Container, Iterator, Sequence
from math import degrees, hypot, isfinite, pi
from typing import TYPE_CHECKING

from adamslite.checks.constraints import not_of_time, variables_not_of_time
from adamslite.checks.rule import Rule, needs
from adamslite.deck.deck import Deck
from adamslite.deck.statement_diagnostics import diagnose, diagnose_all, diagnose_inside
from adamslite.elements.accgrav import Accgrav
from adamslite.elements.gcon import Gcon
from adamslite.elements.marker import Marker
from adamslite.elements.motion import Motion
from adamslite.elements.part import Part
from adamslite.elements.point_mass import PointMass
from adamslite.elements.simulate import Simulate
from adamslite.elements.units import Units
from adamslite.elements.variable import Variable
from adamslite.language.diagnostics import Diagnostic
from adamslite.language.expression import Call, Mode, Node, Ref, Time, calls, walk
from adamslite.language.function import FUNCTIONS
from adamslite.language.interfaces import Key
from adamslite.language.statement import Statement
from adamslite.language.units import G0, INCH, LENGTH, TIME

if TYPE_CHECKING:
    from adamslite.assembly.corners import Corners
    from adamslite.model.model import Model

# What is written as a plain number, without D for degrees.
PLAIN = re.compile(r"[-+]?(\d+\.?\d*|\.\d+)([EeDd][-+]?\d+)?")
# Of a full turn, and of the value of gravity.
ROUNDED, ALIKE = 1e-9, 0.005
# Metres in the units of length in which gravity is commonly written, and seconds.
LENGTHS = (1.0, 1e-2, 1e-3, 1e3, INCH, 12 * INCH)
TIMES = (1.0, 1e-3)
INTEGER = re.compile(r"\b\d{1,18}\b")
Fields = tuple[list[tuple[str, str]], list[str]]
"""Fields that refer to markers or variables, with the keyword, and those with expressions."""


# ---- numbers -----------------------------------------------------------------------------------


def angles_in_degrees(deck: Deck) -> Iterator[Diagnostic]:
    """Angles above a full turn that are written without D."""
    placed: list[Part | PointMass | Marker]
    placed = [*deck.of(Part), *deck.of(PointMass), *deck.of(Marker)]
    for each in placed:
        if not each.given("reuler") or max(map(abs, each.reuler)) <= 2 * pi * (1 + ROUNDED):
            continue
        written = each.spans.home("reuler").text("reuler").partition("=")[2].strip("() \t")
        for value, text in zip(each.reuler, written.split(","), strict=False):
            if abs(value) > 2 * pi * (1 + ROUNDED) and PLAIN.fullmatch(text.strip()):
                turns, text = f"{degrees(value):.4g}", text.strip()
                words = {"text": text, "turns": turns}
                yield diagnose_inside(each, text, "angle-in-radians", "reuler", **words)
                break


def gravity_in_other_units(deck: Deck) -> Iterator[Diagnostic]:
    """Gravity that has the value of the earth's in other units than those of the deck."""
    names = deck.single(Units).names
    size = hypot(*deck.gravity)
    if names is None or not size or not isfinite(size):
        return
    length, time = LENGTH[names[2]], TIME[names[3]]
    here = G0 * time**2 / length
    if _alike(size, here) or not any(_alike(size, G0 * t**2 / m) for m in LENGTHS for t in TIMES):
        return
    for each in deck.of(Accgrav):
        unit = f"{names[2].lower()}/{names[3].lower()}^2"
        yield diagnose(each, "gravity-units", size=f"{size:.6g}", unit=unit, here=f"{here:.6g}")


def _alike(value: float, gravity: float) -> bool:
    return abs(value / gravity - 1.0) < ALIKE


# ---- what nothing uses -------------------------------------------------------------------------


@needs("MARKER", "PART", "POINT_MASS")
def unused(deck: Deck) -> Iterator[Diagnostic]:
    """Markers and constants to which no statement refers.

    A marker at the origin of its body may be there as its frame, a VARIABLE that changes in order
    to be written.  Routines of the user may ask for any of them.
    """
    if deck.user.called:
        return
    markers = [each for each in deck.of(Marker) if _is_placed(each)]
    constants = [each for each in deck.of(Variable) if _is_constant(each.function)]
    if not (markers or constants):
        return
    used = set(_used(deck))
    idle: list[Statement] = [m for m in markers if ("MARKER", m.key) not in used]
    idle += [v for v in constants if ("VARIABLE", v.key) not in used]
    if idle:
        yield diagnose_all(idle, "unused")


def _is_placed(marker: Marker) -> bool:
    return not marker.floating and any(map(marker.given, ("qp", "reuler", "zp", "xp")))


def _is_constant(node: Node) -> bool:
    return not any(isinstance(each, Call | Time | Mode) for each in walk(node))


def _used(deck: Deck) -> Iterator[tuple[str, Key]]:
    """Keyword and id of the markers and variables to which statements refer."""
    known: dict[type[Statement], Fields] = {}
    for statement in deck.statements:
        cls = type(statement)
        if cls not in known:
            known[cls] = _fields(cls)
        references, formulas = known[cls]
        for field, keyword in references:
            yield from ((keyword, key) for key in _several(getattr(statement, field)))
        for field in formulas:
            node = getattr(statement, field)
            if node is not None:
                yield from ((r.kind, r.id) for r in walk(node) if type(r) is Ref)
        if statement.inert:  # its text alone is kept, and may name any of them
            for number in INTEGER.findall(getattr(statement, "written", "")):
                yield "MARKER", int(number)
                yield "VARIABLE", int(number)


def _fields(cls: type[Statement]) -> Fields:
    to = [
        (name, each.to) for name, each in cls.arguments.items() if each.to in ("MARKER", "VARIABLE")
    ]
    return to, [name for name, each in cls.arguments.items() if each.kind == "expression"]


def _several(value: Key | Sequence[Key] | None) -> Sequence[Key]:
    if value is None:
        return ()
    return value if isinstance(value, tuple) else (value,)


# ---- motions that jump -------------------------------------------------------------------------

# Least derivative of FUNCTION that has to be continuous so that velocities are.
SMOOTH = {"DISPLACEMENT": 1, "VELOCITY": 0, "ACCELERATION": -1}


def kinks(deck: Deck) -> Iterator[Diagnostic]:
    """Functions with corners in what a constraint prescribes: velocities jump there."""
    held: list[Motion | Gcon] = [*deck.of(Motion), *deck.of(Gcon)]
    if not any(_may_jump(each.function) for each in held):
        return
    from adamslite.assembly.corners import Corners
    from adamslite.model.model import Model

    search, until, varying = Corners(Model(deck)), run_end(deck), variables_not_of_time(deck)
    for each in held:
        least = SMOOTH[each.level] if isinstance(each, Motion) else SMOOTH["DISPLACEMENT"]
        for part in _parts(search.model, each, least, varying):
            found, when = _corner(search, part, least, until, varying)
            if found:
                yield diagnose_inside(each, found, "kink", "function", word=found, when=when)
                break


def _parts(
    model: Model, statement: Motion | Gcon, least: int, varying: Container[Key]
) -> Iterator[Node]:
    """Expressions in which a corner counts: the FUNCTION of a MOTION; calls in that of a GCON, but
    for those inside of another one that TIME alone determines.
    """
    from adamslite.assembly.corners import suspects

    if isinstance(statement, Motion):
        yield statement.function
        return
    inside: set[int] = set()
    for call in suspects(model, statement.function, least):
        if id(call) in inside:
            continue
        if not not_of_time(model.deck, call, varying):
            inside |= {id(each) for each in suspects(model, call, least)}
        yield call


def _corner(
    search: Corners, node: Node, least: int, until: float, varying: Container[Key]
) -> tuple[str, str]:
    """The function by which an expression may have a corner, with the time where it is known."""
    from adamslite.assembly.corners import TooManyOperations, suspects

    found = next((call.name for call in suspects(search.model, node, least)), "")
    if not found or not until or not_of_time(search.model.deck, node, varying):
        return found, ""
    try:
        at = search.first(node, least, until)
    except TooManyOperations:
        return "", ""  # no warning is better than a false one
    return (at[0], f" at {at[1]:.4g}") if at else ("", "")


def _may_jump(node: Node) -> bool:
    """Whether it has, or VARIABLEs may have, a function that is not smooth."""
    return any(call.name == "VARVAL" or not FUNCTIONS[call.name].smooth for call in calls(node))


def run_end(deck: Deck) -> float:
    """When the deck stops its last run; 0 where commands decide."""
    time = 0.0
    for each in deck.of(Simulate):
        if each.end is not None or each.duration is not None:
            time = max(time, each.until(time))
    return time


LINT_RULES: list[Rule] = [angles_in_degrees, gravity_in_other_units, unused, kinks]
