"""Rules about markers: whose they are, and what may refer to a FLOATING one."""

from __future__ import annotations

from collections.abc import Iterator

from adamslite.checks.rule import needs
from adamslite.deck.deck import Deck
from adamslite.deck.statement_diagnostics import diagnose, diagnose_all, diagnose_inside
from adamslite.elements.cvcv import Cvcv
from adamslite.elements.gforce import Gforce
from adamslite.elements.marker import Marker
from adamslite.elements.ptcv import Ptcv
from adamslite.elements.vforce import Vforce
from adamslite.elements.vtorque import Vtorque
from adamslite.functions.forces import NET
from adamslite.language.diagnostics import Diagnostic
from adamslite.language.expression import Call, Node, Op, Ref, walk
from adamslite.language.interfaces import Key
from adamslite.language.statement import Statement

BODIES = ("PART", "POINT_MASS", "FLEX_BODY", "FE_PART")


def owners(deck: Deck) -> Iterator[Diagnostic]:
    for marker in deck.of(Marker):
        if marker.part is not None and marker.point_mass is not None:
            yield diagnose(marker, "two-owners", "point_mass")
        elif marker.owner is None and not deck.incomplete.intersection(BODIES):
            yield diagnose(marker, "no-owner")


def frames(deck: Deck) -> Iterator[Diagnostic]:
    """RM of a marker is on the same body, and not placed by the marker itself."""
    for marker in deck.of(Marker):
        base = deck.find(Marker, marker.rm) if marker.rm is not None else None
        if base is None:
            continue
        if base.owner and base.owner != marker.owner:
            owner = f"{base.owner[0]}/{base.owner[1]}"
            yield diagnose(marker, "foreign-marker", "rm", word="RM", key=base.id, owner=owner)
        elif marker.key in _placing(deck, base):
            yield diagnose(marker, "marker-circle", "rm", key=base.id)


def _placing(deck: Deck, marker: Marker | None) -> set[Key]:
    """A marker, its RM, that of its RM and so on."""
    found: set[Key] = set()
    while marker is not None and marker.key not in found:
        found.add(marker.key)
        marker = deck.find(Marker, marker.rm) if marker.rm is not None else None
    return found


def references(statement: Statement) -> Iterator[tuple[str, Key]]:
    """The markers a statement refers to, with the field."""
    for field, argument in statement.arguments.items():
        value = getattr(statement, field)
        if argument.kind == "expression" and value is not None:
            refs = (each for each in walk(value) if isinstance(each, Ref))
            yield from ((field, each.id) for each in refs if each.kind == "MARKER")
        elif argument.to == "MARKER":
            keys = value if argument.kind == "references" else (value,)
            yield from ((field, key) for key in keys if key not in (None, 0))


def floating_alone(deck: Deck) -> Iterator[Diagnostic]:
    for marker in deck.of(Marker):
        placed = [f for f in ("qp", "reuler", "zp", "xp", "usexp") if marker.given(f)]
        if marker.floating and placed:
            yield diagnose(marker, "floating-placed", placed[0])


def _following(deck: Deck) -> list[Vforce | Vtorque | Gforce]:
    return [*deck.of(Vforce), *deck.of(Vtorque), *deck.of(Gforce)]


def _uses(statement: Statement) -> Iterator[tuple[str, Key]]:
    """The markers whose posture a statement needs, with the field.

    What acts between two markers is measured without it: by REQUEST/FORCE and by FX ... TZ.
    """
    measures_force = statement.keyword == "REQUEST" and getattr(statement, "kind", "") == "FORCE"
    for field, argument in statement.arguments.items():
        value = getattr(statement, field)
        if argument.kind == "expression" and value is not None:
            yield from ((field, key) for key in _placed(value))
    for field, key in references(statement):
        argument = statement.arguments[field]
        if argument.kind != "expression" and not (measures_force and field in ("i", "j")):
            yield field, key


def _placed(node: Node) -> Iterator[Key]:
    """The markers whose posture an expression needs."""
    pending = [node]
    while pending:
        top = pending.pop()
        if type(top) is Ref and top.kind == "MARKER":
            yield top.id
        elif isinstance(top, Call | Op):
            pending += top.args[2:] if isinstance(top, Call) and top.name in NET else top.args


def floating_use(deck: Deck) -> Iterator[Diagnostic]:
    floating = {marker.key for marker in deck.of(Marker) if marker.floating}
    for force in _following(deck):
        if force.jfloat is not None and force.jfloat not in floating:
            if deck.find(Marker, force.jfloat):
                yield diagnose(force, "not-floating", "jfloat", key=force.jfloat)
    for statement in deck.own if floating else ():  # delayed expressions are part of them
        for field, key in _uses(statement) if not statement.inert else ():
            if key in floating and field not in ("ifloat", "jfloat"):
                word = statement.arguments[field].key
                yield diagnose_inside(statement, key, "floating-misused", field, word=word, key=key)


@needs("VFORCE", "VTORQUE", "GFORCE", "PTCV", "CVCV")
def floating_unused(deck: Deck) -> Iterator[Diagnostic]:
    used = {each.jfloat for each in (*_following(deck), *deck.of(Ptcv), *deck.of(Cvcv))}
    used |= {each.ifloat for each in deck.of(Cvcv)}
    idle = [each for each in deck.of(Marker) if each.floating and each.key not in used]
    if idle:
        yield diagnose_all(idle, "floating-unused")
