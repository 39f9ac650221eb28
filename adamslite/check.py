"""What the statements of a deck must mean together: a list of small rules.

A rule takes a deck and yields diagnostics; statements with mistakes of their own are not in the
deck it gets.  :data:`RULES` are quick and run whenever a deck is read; :data:`ADVICE` may take its
time and runs in :func:`check` only.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from typing import TYPE_CHECKING, Any

from adamslite.diagnostics import Diagnostic, sort_by_place
from adamslite.effective_mass import effective_masses
from adamslite.expression import Ref, walk
from adamslite.messages import compose
from adamslite.resolve import RESERVED
from adamslite.statement import Statement

if TYPE_CHECKING:
    from adamslite.deck import Deck

Key = int | str
Body = tuple[str, Key]
Rule = Callable[["Deck"], Iterator[Diagnostic]]

POINT = "POINT_MASS"


def check(deck: Deck) -> list[Diagnostic]:
    """Everything to say about a deck that could be read: warnings and advice, in deck order."""
    return sort_by_place([*deck.warnings, *apply(ADVICE, deck)])


def apply(rules: Sequence[Rule], deck: Deck) -> Iterator[Diagnostic]:
    """What the rules say; those that need statements which could not be read are left out."""
    for rule in rules:
        if not deck.incomplete.intersection(getattr(rule, "needs", ())):
            yield from rule(deck)


def needs(*keywords: str) -> Callable[[Rule], Rule]:
    """Mark a rule that draws conclusions from what is absent."""

    def mark(rule: Rule) -> Rule:
        rule.needs = keywords
        return rule

    return mark


def say(statement: Statement, code: str, field: str = "", **words: Any) -> Diagnostic:
    """A message about a statement, or about one of its arguments."""
    spans = statement.spans
    span = spans[field] if field in spans else spans.whole
    source_line = spans.source.line(span.line) if spans.source else ""
    return compose(code, span, source_line, label=statement.label, **words)


# ---- bodies -----------------------------------------------------------------------------------


def body_of(deck: Deck, marker: Key | None) -> Body | None:
    """Keyword and id of the body a marker is on; None when that cannot be told."""
    found = deck.find("MARKER", marker) if marker is not None else None
    return found.owner if found else None


def _label(body: Body) -> str:
    return f"{body[0]}/{body[1]}"


def _is_ground(deck: Deck, body: Body | None) -> bool:
    part = deck.find(*body) if body and body[0] == "PART" else None
    return bool(part) and part.ground


@needs("PART")
def one_ground(deck: Deck) -> Iterator[Diagnostic]:
    grounds = [part for part in deck.of("PART") if part.ground]
    if not grounds:
        source = deck.source
        yield compose("no-ground", source.span(0, len(source.line(1))), source.line(1))
    for part in grounds[1:]:
        yield say(part, "two-grounds", "ground")


def ground_without_data(deck: Deck) -> Iterator[Diagnostic]:
    ignored = ("mass", "cm", "im", "ip", "vx", "vy", "vz", "wx", "wy", "wz")
    for part in deck.of("PART"):
        for field in ignored if part.ground else ():
            if part.given(field):
                yield say(part, "ground-with-data", field, word=field.upper())


def masses(deck: Deck) -> Iterator[Diagnostic]:
    for part in deck.of("PART"):
        if part.ground:
            continue
        if part.mass is None or part.mass <= 0:
            yield say(part, "no-mass", "mass")
        elif part.cm is None:
            yield say(part, "no-cm")
    for point in deck.of(POINT):
        if point.mass <= 0:
            yield say(point, "no-mass", "mass")


def inertia(deck: Deck) -> Iterator[Diagnostic]:
    for part in deck.of("PART"):
        if part.ground or part.cm is None:
            continue
        if part.ip is None:
            yield say(part, "no-inertia")
            continue
        smallest, middle, largest = sorted(part.ip[:3])
        if smallest < 0 or largest > (smallest + middle) * (1 + 1e-6):
            yield say(part, "bad-inertia", "ip")


def markers_of_bodies(deck: Deck) -> Iterator[Diagnostic]:
    for keyword in ("PART", POINT):
        for body in deck.of(keyword):
            for field in ("cm", "im"):
                marker = getattr(body, field, None)
                owner = body_of(deck, marker)
                if owner and owner != (keyword, body.key):
                    words = {"word": field.upper(), "key": marker, "owner": _label(owner)}
                    yield say(body, "foreign-marker", field, **words)


# ---- markers ----------------------------------------------------------------------------------


def owners(deck: Deck) -> Iterator[Diagnostic]:
    for marker in deck.of("MARKER"):
        if marker.part is not None and marker.point_mass is not None:
            yield say(marker, "two-owners", "point_mass")
        elif marker.owner is None and not deck.incomplete & {"PART", POINT, "FLEX_BODY"}:
            yield say(marker, "no-owner")


def orientations(deck: Deck) -> Iterator[Diagnostic]:
    pairs = {"MARKER": ("zp", "xp"), "PART": ("zg", "xg"), POINT: ("zg", "xg")}
    for keyword, (along, plane) in pairs.items():
        for each in deck.of(keyword):
            points = [field for field in (along, plane) if each.given(field)]
            if points and each.given("reuler"):
                yield say(each, "orientation-twice", points[0])
                continue
            first = plane if getattr(each, "usexp", False) else along
            if (points or first == "xp") and not each.given(first):
                yield say(each, "orientation-incomplete", word=f"add {first.upper()}=")


def floating_alone(deck: Deck) -> Iterator[Diagnostic]:
    for marker in deck.of("MARKER"):
        placed = [f for f in ("qp", "reuler", "zp", "xp", "usexp") if marker.given(f)]
        if marker.floating and placed:
            yield say(marker, "floating-placed", placed[0])


def _uses(statement: Statement) -> Iterator[tuple[str, Key]]:
    """The markers a statement refers to, with the field."""
    for field, argument in statement.arguments.items():
        value = getattr(statement, field)
        if argument.kind == "reference" and argument.to == "MARKER" and value not in (None, 0):
            yield field, value
        elif argument.kind == "expression" and value is not None:
            for node in walk(value):
                if type(node) is Ref and node.kind == "MARKER":
                    yield field, node.id


def floating_use(deck: Deck) -> Iterator[Diagnostic]:
    floating = {marker.key for marker in deck.of("MARKER") if marker.floating}
    for force in deck.of("VFORCE"):
        if force.jfloat is not None and force.jfloat not in floating:
            if deck.find("MARKER", force.jfloat):
                yield say(force, "not-floating", "jfloat", key=force.jfloat)
    for statement in deck.statements if floating else ():
        for field, key in _uses(statement):
            if key in floating and field != "jfloat":
                word = statement.arguments[field].key
                yield say(statement, "floating-misused", field, word=word, key=key)


@needs("VFORCE", "VTORQUE", "GFORCE", "PTCV", "CVCV")
def floating_unused(deck: Deck) -> Iterator[Diagnostic]:
    used = {force.jfloat for force in deck.of("VFORCE")}
    for marker in deck.of("MARKER"):
        if marker.floating and marker.key not in used:
            yield say(marker, "floating-unused")


# ---- forces and constraints -------------------------------------------------------------------


def reactions(deck: Deck) -> Iterator[Diagnostic]:
    for force in deck.of("VFORCE"):
        if force.jfloat is None and force.j_part is None:
            yield say(force, "no-reaction")
        elif force.jfloat is not None and force.j_part is not None:
            yield say(force, "two-reactions", "j_part")
    for force in deck.of("SFORCE"):
        target = None if force.j_part is None else ("PART", force.j_part)
        owner = body_of(deck, force.j)
        if target and owner and owner != target and not _is_ground(deck, target):
            words = {"word": _label(target), "owner": _label(owner)}
            yield say(force, "reaction-on-other-part", "j_part", **words)


def distinct_ends(deck: Deck) -> Iterator[Diagnostic]:
    for keyword in ("SFORCE", "SPRINGDAMPER", "JOINT", "VFORCE"):
        for each in deck.of(keyword):
            if getattr(each, "actiononly", False):
                continue
            j = each.jfloat if keyword == "VFORCE" else each.j
            here, there = body_of(deck, each.i), body_of(deck, j)
            if j is None:
                there = None if each.j_part is None else ("PART", each.j_part)
            if each.i == j and keyword != "JOINT":
                yield say(each, "same-marker", "j")
            elif here and here == there:
                code = "same-body" if keyword in ("JOINT", "VFORCE") else "internal-force"
                yield say(each, code, "j", owner=_label(here))


def torques_on_points(deck: Deck) -> Iterator[Diagnostic]:
    for keyword in ("SFORCE", "SPRINGDAMPER", "JOINT"):
        for each in deck.of(keyword):
            ends = [each.i] if getattr(each, "actiononly", False) else [each.i, each.j]
            if each.kind in ("TRANSLATIONAL", "SPHERICAL") and keyword != "JOINT":
                continue
            for owner in (body_of(deck, end) for end in ends):
                if each.kind != "SPHERICAL" and owner and owner[0] == POINT:
                    yield say(each, "torque-on-point", owner=_label(owner))


def idle_arguments(deck: Deck) -> Iterator[Diagnostic]:
    fields = {
        "TRANSLATIONAL": ("kt", "ct", "torque", "angle"),
        "ROTATIONAL": ("k", "c", "force", "length"),
    }
    for spring in deck.of("SPRINGDAMPER"):
        for field in fields[spring.kind]:
            if spring.given(field):
                word, reason = field.upper(), f"the spring is {spring.kind}"
                yield say(spring, "no-effect", field, word=word, reason=reason)


def reserved_names(deck: Deck) -> Iterator[Diagnostic]:
    for variable in deck.of("VARIABLE"):
        names = {str(variable.key), (variable.name or "").upper()}
        for word in names & set(RESERVED):
            yield say(variable, "reserved-name", word=word)


def requests(deck: Deck) -> Iterator[Diagnostic]:
    for request in deck.of("REQUEST"):
        expressions = any(function is not None for function in request.functions)
        if request.kind and expressions:
            yield say(request, "two-requests", "kind", word=request.kind)
        elif not expressions and (request.kind is None or request.i is None):
            yield say(request, "empty-request")


# ---- units and runs ---------------------------------------------------------------------------


def _positive(statement: Statement, *fields: str) -> Iterator[Diagnostic]:
    for field in fields:
        value = getattr(statement, field)
        if value is not None and value <= 0:
            yield say(statement, "not-positive", field, word=field.upper())


def unit_system(deck: Deck) -> Iterator[Diagnostic]:
    for units in deck.of("UNITS"):
        named = [f for f in ("force", "mass", "length", "time") if units.given(f)]
        ways = [bool(named), units.given("system"), units.given("ucf")]
        if sum(ways) > 1:
            yield say(units, "units-twice")
        elif 0 < len(named) < 4:
            yield say(units, "units-incomplete", word=", ".join(named).upper())
        yield from _positive(units, "ucf")


def integrator_values(deck: Deck) -> Iterator[Diagnostic]:
    for each in deck.of("INTEGRATOR"):
        yield from _positive(each, "error", "hmax", "hmin", "hinit", "kmax", "maxit")
        if each.alpha is not None and not -1 / 3 - 1e-9 <= each.alpha <= 0:
            yield say(each, "out-of-range", "alpha", word="ALPHA", low="-1/3", high="0")
        if each.hmin is not None and each.hmax is not None and each.hmin > each.hmax:
            yield say(each, "steps-disordered", "hmin")


def simulation_times(deck: Deck) -> Iterator[Diagnostic]:
    for each in deck.of("SIMULATE"):
        yield from _positive(each, "duration", "dtout", "steps")
        if each.end is None and each.duration is None:
            yield say(each, "no-end")
        elif each.end is not None and each.duration is not None:
            yield say(each, "two-ends", "duration")
        elif each.steps is None and each.dtout is None:
            yield say(each, "no-output-step")
        elif each.steps is not None and each.dtout is not None:
            yield say(each, "two-output-steps", "dtout")


RUN_RULES: list[Rule] = [integrator_values, simulation_times]
RULES: list[Rule] = [
    one_ground,
    ground_without_data,
    masses,
    inertia,
    markers_of_bodies,
    owners,
    orientations,
    floating_alone,
    floating_use,
    floating_unused,
    reactions,
    distinct_ends,
    torques_on_points,
    idle_arguments,
    reserved_names,
    requests,
    unit_system,
    *RUN_RULES,
]
ADVICE: list[Rule] = [effective_masses]
