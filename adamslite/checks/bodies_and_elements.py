"""Rules about bodies, markers and force elements.

A rule takes a deck and yields diagnostics; statements with mistakes of their own are not in the
deck it gets.  :data:`RULES` are quick and run whenever a deck is read; :data:`ADVICE` may take its
time and runs in :func:`check` only.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

from adamslite.checks.markers import (
    is_plain,
    no_body,
)
from adamslite.checks.rule import needs, positive
from adamslite.deck.deck import Deck
from adamslite.deck.names import RESERVED
from adamslite.deck.statement_diagnostics import diagnose, diagnose_all
from adamslite.elements.beam import Beam
from adamslite.elements.bushing import Bushing
from adamslite.elements.field import Field
from adamslite.elements.gforce import Gforce
from adamslite.elements.joint import Joint
from adamslite.elements.marker import Marker
from adamslite.elements.part import Part
from adamslite.elements.sforce import Sforce
from adamslite.elements.springdamper import Springdamper
from adamslite.elements.units import Units
from adamslite.elements.variable import Variable
from adamslite.elements.vforce import Vforce
from adamslite.elements.vtorque import Vtorque
from adamslite.language.diagnostics import Diagnostic, Related
from adamslite.language.interfaces import Key
from adamslite.language.messages import compose
from adamslite.language.statement import Statement

Body = tuple[str, Key]

POINT = "POINT_MASS"
# Forces whose reaction follows I, and all elements between two markers.
Following = Vforce | Vtorque | Gforce
Compliant = Bushing | Field | Beam
Between = Sforce | Springdamper | Joint | Compliant | Following


# ---- bodies -----------------------------------------------------------------------------------


def body_of(deck: Deck, marker: Key | None) -> Body | None:
    """Keyword and id of the body a marker is on; None when that is unknown."""
    found = deck.find(Marker, marker) if marker is not None else None
    return found.owner if found else None


def _label(body: Body) -> str:
    return f"{body[0]}/{body[1]}"


def _is_ground(deck: Deck, body: Body | None) -> bool:
    part = deck.find(*body) if body and body[0] == "PART" else None
    return bool(part and part.ground)


@needs("PART")
def a_ground(deck: Deck) -> Iterator[Diagnostic]:
    if not any(part.ground for part in deck.of(Part)):
        source = deck.source
        span = source.span(0, len(source.line(1)))
        yield compose("no-ground", span, source.quote(span))


def second_grounds(deck: Deck) -> Iterator[Diagnostic]:
    grounds = [part for part in deck.of(Part) if part.ground]
    for part in grounds[1:]:
        first = Related(grounds[0].span, "the first one")
        yield replace(diagnose(part, "two-grounds", "ground"), related=(first,))


def ground_without_data(deck: Deck) -> Iterator[Diagnostic]:
    ignored = ("mass", "cm", "im", "ip", "vx", "vy", "vz", "wx", "wy", "wz", "vm", "wm")
    for part in deck.of(Part):
        for field in ignored if part.ground else ():
            if part.given(field):
                yield diagnose(part, "ground-with-data", field, word=field.upper())


def masses(deck: Deck) -> Iterator[Diagnostic]:
    for part in deck.of(Part):
        if part.ground:
            continue
        if not part.mass:
            if not _is_held(deck, part):
                yield diagnose(part, "no-mass", "mass")
        elif part.mass < 0:
            yield diagnose(part, "negative-mass", "mass", mass=part.mass)
        elif part.cm is None:
            yield diagnose(part, "no-cm")
    for point in deck.of(POINT):
        if point.given("mass") and point.mass < 0:
            yield diagnose(point, "negative-mass", "mass", mass=point.mass)
        elif point.given("mass") and point.mass == 0:
            yield diagnose(point, "no-mass", "mass")


def zero_masses(deck: Deck) -> Iterator[Diagnostic]:
    """Parts whose mass is given as zero rather than left out."""
    zero = [part for part in deck.of(Part) if part.mass == 0 and _is_held(deck, part)]
    if zero:
        yield diagnose_all(zero, "zero-mass")


def _is_held(deck: Deck, part: Statement) -> bool:
    """Whether some constraint acts on a part: only then may it be without mass."""
    own = {m.key for m in deck.of(Marker) if m.owner == ("PART", part.key)}
    return any(
        getattr(s, "i", None) in own or getattr(s, "j", None) in own
        for s in deck.statements
        if hasattr(s, "constraints")
    )


def inertia(deck: Deck) -> Iterator[Diagnostic]:
    for part in deck.of(Part):
        if part.ground or part.cm is None:
            continue
        if part.ip is None:
            yield diagnose(part, "no-inertia")
            continue
        reason = no_body(part.ip[:3]) if is_plain(part) else ""
        if reason:
            yield diagnose(part, "bad-inertia", "ip", reason=reason)


def markers_of_bodies(deck: Deck) -> Iterator[Diagnostic]:
    for keyword in ("PART", POINT):
        for body in deck.of(keyword):
            for field in ("cm", "im"):
                marker = getattr(body, field, None)
                owner = body_of(deck, marker)
                if owner and owner != (keyword, body.key):
                    word, label = field.upper(), _label(owner)
                    yield diagnose(
                        body, "foreign-marker", field, word=word, key=marker, owner=label
                    )


# ---- forces and constraints -------------------------------------------------------------------


def reactions(deck: Deck) -> Iterator[Diagnostic]:
    for force in _following(deck):
        if force.jfloat is None and force.j_part is None:
            yield diagnose(force, "no-reaction")
        elif force.jfloat is not None and force.j_part is not None:
            yield diagnose(force, "two-reactions", "j_part")
    for single in deck.of(Sforce):
        target = None if single.j_part is None else ("PART", single.j_part)
        owner = body_of(deck, single.j)
        if target and owner and owner != target and not _is_ground(deck, target):
            word, label = _label(target), _label(owner)
            yield diagnose(single, "reaction-on-other-part", "j_part", word=word, owner=label)


def _following(deck: Deck) -> Iterator[Following]:
    yield from deck.of(Vforce)
    yield from deck.of(Vtorque)
    yield from deck.of(Gforce)


def _compliant(deck: Deck) -> Iterator[Compliant]:
    yield from deck.of(Bushing)
    yield from deck.of(Field)
    yield from deck.of(Beam)


def _between(deck: Deck) -> Iterator[Between]:
    yield from deck.of(Sforce)
    yield from deck.of(Springdamper)
    yield from deck.of(Joint)
    yield from _compliant(deck)
    yield from _following(deck)


def _ends(deck: Deck, element: Between) -> tuple[Body | None, Body | None]:
    """The bodies an element acts on."""
    here = body_of(deck, element.i)
    if not isinstance(element, Following):
        return here, body_of(deck, element.j)
    if element.jfloat is not None:
        return here, body_of(deck, element.jfloat)
    return here, None if element.j_part is None else ("PART", element.j_part)


def distinct_ends(deck: Deck) -> Iterator[Diagnostic]:
    for each in _between(deck):
        if isinstance(each, Sforce) and each.actiononly:
            continue
        here, there = _ends(deck, each)
        if not isinstance(each, Joint | Following) and each.i == each.j:
            yield diagnose(each, "same-marker", "j")
        elif here and here == there:
            code = "same-body" if isinstance(each, Joint | Following) else "internal-force"
            yield diagnose(each, code, "j", owner=_label(here))


def torques_on_points(deck: Deck) -> Iterator[Diagnostic]:
    found: list[Sforce | Springdamper | Joint]
    found = [*deck.of(Sforce), *deck.of(Springdamper), *deck.of(Joint)]
    for each in found:
        alone = isinstance(each, Sforce) and each.actiononly
        harmless = "SPHERICAL" if isinstance(each, Joint) else "TRANSLATIONAL"
        if each.kind == harmless:
            continue
        for owner in (body_of(deck, end) for end in ([each.i] if alone else [each.i, each.j])):
            if owner and owner[0] == POINT:
                yield diagnose(each, "torque-on-point", owner=_label(owner))


def wrenches_on_points(deck: Deck) -> Iterator[Diagnostic]:
    for each in (*_compliant(deck), *deck.of(Vtorque), *deck.of(Gforce)):
        for owner in _ends(deck, each):
            if owner and owner[0] == POINT:
                yield diagnose(each, "torque-on-point", owner=_label(owner))


def sections(deck: Deck) -> Iterator[Diagnostic]:
    for beam in deck.of(Beam):
        yield from positive(beam, "length", "area", "ixx", "iyy", "izz", "emodulus", "gmodulus")
    for each in (*deck.of(Beam), *deck.of(Field)):
        if each.given("cratio") and each.given("cmatrix"):
            yield diagnose(each, "two-dampings", "cmatrix")
    for field in deck.of(Field):
        yield from _one_law(field)


def _one_law(field: Field) -> Iterator[Diagnostic]:
    """A FIELD has matrices or a FUNCTION."""
    linear = ("by", "kmatrix", "cmatrix", "cratio", "length", "force")
    if field.nonlinear:
        for name in filter(field.given, linear):
            reason = "FUNCTION gives the load"
            yield diagnose(field, "no-effect", name, word=name.upper(), reason=reason)
    elif field.formulation == "NONLINEAR":
        yield diagnose(field, "missing-argument", word="FUNCTION", hint="FUNCTION: the law")


def idle_arguments(deck: Deck) -> Iterator[Diagnostic]:
    fields = {
        "TRANSLATIONAL": ("kt", "ct", "torque", "angle"),
        "ROTATIONAL": ("k", "c", "force", "length"),
    }
    for spring in deck.of(Springdamper):
        for field in fields[spring.kind]:
            if spring.given(field):
                word, reason = field.upper(), f"the spring is {spring.kind}"
                yield diagnose(spring, "no-effect", field, word=word, reason=reason)


def reserved_names(deck: Deck) -> Iterator[Diagnostic]:
    for variable in deck.of(Variable):
        names = {str(variable.key), (variable.name or "").upper()}
        for word in names & set(RESERVED):
            yield diagnose(variable, "reserved-name", word=word)


# ---- units and runs ---------------------------------------------------------------------------


def unit_system(deck: Deck) -> Iterator[Diagnostic]:
    for units in deck.of(Units):
        named = [f for f in ("force", "mass", "length", "time") if units.given(f)]
        ways = [bool(named), units.given("system"), units.given("ucf")]
        if sum(ways) > 1:
            yield diagnose(units, "units-twice")
        elif 0 < len(named) < 4:
            yield diagnose(units, "units-incomplete", word=", ".join(named).upper())
        yield from positive(units, "ucf")
