"""What is passed over as it does not change the motion, and what cannot be."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterable, Iterator
from dataclasses import replace
from typing import TypeVar

from adamslite.checks.markers import references
from adamslite.deck.deck import Deck
from adamslite.deck.redefinition import Command, Redefinition
from adamslite.deck.statement_diagnostics import diagnose, place_of
from adamslite.elements.contact import Contact
from adamslite.elements.graphics import Graphics
from adamslite.elements.joint import Joint
from adamslite.elements.marker import Marker
from adamslite.elements.request import Request
from adamslite.language.diagnostics import Diagnostic
from adamslite.language.interfaces import Key
from adamslite.language.statement import Argument, Statement

COEFFICIENTS = ("mu_stat_rot", "mu_dyn_rot", "mu_stat_trans", "mu_dyn_trans")
CHANGING = {
    "YPR": "DISPLACEMENT", "DSCALE": "DISPLACEMENT", "VSCALE": "VELOCITY",
    "ASCALE": "ACCELERATION", "FSCALE": "FORCE",
}  # fmt: skip
NOT_DRAWN = ("EXTERNAL", "FUNCTION")
"""Shapes of GRAPHICS that `adamslite view` leaves out."""
WORD = re.compile(r"[A-Za-z]\w*")
Body = tuple[str, Key]
C = TypeVar("C", bound=Command)
INSTEAD = {
    "FLEX_BODY": "write it as a rigid PART, or as PARTs that BEAM or FIELD elements join",
    "FE_PART": "write it as a chain of PARTs that BEAM elements join",
}


def acts_on_flexible(deck: Deck) -> Iterator[Diagnostic]:
    """Flexible bodies are passed over as long as nothing refers to their markers."""
    for statement, field, key, (keyword, id) in _flexible_uses(deck):
        yield diagnose(
            statement, "flexible-body", field,
            key=key, body=f"{keyword}/{id}", instead=INSTEAD[keyword],
        )  # fmt: skip


def _flexible_uses(deck: Deck) -> Iterator[tuple[Statement, str, Key, Body]]:
    """Statements, with the field, that refer to a marker of a flexible body."""
    owner = {marker.key: marker.owner for marker in deck.of(Marker)}
    flexible = {key: body for key, body in owner.items() if body and body[0] in INSTEAD}
    acting = (each for each in deck.statements if not each.inert)
    for statement in acting if flexible else ():
        for field, key in (*references(statement), *_of_shapes(deck, statement)):
            if key in flexible:
                yield statement, field, key, flexible[key]


def _of_shapes(deck: Deck, statement: Statement) -> Iterator[tuple[str, Key]]:
    """The markers of the shapes of a CONTACT, with the field."""
    if isinstance(statement, Contact):
        for field in ("igeom", "jgeom"):
            found = (deck.find(Graphics, key) for key in getattr(statement, field))
            yield from ((field, each.marker) for each in found if each and each.marker is not None)


def joint_friction(deck: Deck) -> Iterator[Diagnostic]:
    """Friction that JOINT itself has acts unless it is off or its coefficients are zero."""
    for joint in deck.of(Joint):
        field = _acting(joint)
        if field:
            yield diagnose(joint, "joint-friction", field, id=joint.id)


def _acting(joint: Joint) -> str:
    """The field by which a joint has friction of its own; empty where it has none."""
    if joint.friction is not None and joint.friction.upper() == "OFF":
        return ""
    given = [field for field in COEFFICIENTS if joint.given(field)]
    alone = "friction" if joint.friction is not None and not given else ""
    return next((field for field in given if getattr(joint, field)), alone)


def changed_requests(deck: Deck) -> Iterator[Diagnostic]:
    """Words of OUTPUT by which ADAMS writes other numbers for REQUESTs of a kind."""
    for output, word, kind in _changing_words(deck):
        yield diagnose(output, "output-form", word=word, kind=kind)


def _changing_words(deck: Deck) -> Iterator[tuple[Statement, str, str]]:
    """An OUTPUT, its word, and the kind of REQUEST that the word changes."""
    kinds = {request.kind for request in deck.of(Request)}
    for output in deck.of("OUTPUT"):
        written = {word.upper() for word in WORD.findall(output.written) if len(word) > 1}
        for word, kind in CHANGING.items():
            if kind in kinds and any(word.startswith(each) for each in written):
                yield output, word, kind


def passed_over(deck: Deck) -> Iterator[Diagnostic]:
    yield from note_of_inert(_without_use(deck))


def _without_use(deck: Deck) -> Iterator[Statement]:
    """Statements of which nothing else has to be said."""
    needed = {body for *_, body in _flexible_uses(deck)}
    needed |= {(joint.keyword, joint.key) for joint in deck.of(Joint) if _acting(joint)}
    needed |= {(output.keyword, output.key) for output, *_ in _changing_words(deck)}
    needed |= {(g.keyword, g.key) for g in deck.of(Graphics) if g.shape is None or g.missing}
    yield from (
        each for each in untouched(deck, deck.own) if (each.keyword, each.key) not in needed
    )


def untouched(deck: Deck, commands: Iterable[C]) -> Iterator[C]:
    """Statements and commands but those of shapes that are drawn, or touch."""
    touching = {key for each in deck.of(Contact) for key in (*each.igeom, *each.jgeom)}
    hidden = {each.key for each in deck.of(Graphics) if each.shape in NOT_DRAWN}
    for each in commands:
        shape = each.keyword == Graphics.keyword
        if not shape or (each.key in hidden and each.key not in touching):
            yield each


def in_one_note(
    diagnostics: Iterable[Diagnostic], deck: Deck, commands: Iterable[Command]
) -> list[Diagnostic]:
    """The messages about a deck and its command file, with one note of what is passed over."""
    found = list(diagnostics)
    notes = [each for each in found if each.code == "passed-over"]
    if len(notes) < 2:
        return found
    (whole,) = note_of_inert([*_without_use(deck), *untouched(deck, commands)])
    places = tuple(place for each in notes for place in each.everywhere)
    note = replace(notes[0], message=whole.message, places=places)
    rest = (each for each in found if each not in notes[1:])
    return [note if each is notes[0] else each for each in rest]


def note_of_inert(statements: Iterable[Command]) -> Iterator[Diagnostic]:
    """One note for everything that does not change the motion, at the first of it."""
    counts: Counter[str] = Counter()
    found: list[tuple[Command, str]] = []
    for each in statements:
        for field, name in _inert(each):
            found.append((each, field))
            counts[name] += 1
    if found:
        places = tuple(place_of(*each) for each in found)
        listed = (f"{name} ({n})" if n > 1 else name for name, n in counts.items())
        note = diagnose(found[0][0], "passed-over", found[0][1], listed=", ".join(listed))
        yield replace(note, places=places)


def _inert(command: Command) -> Iterator[tuple[str, str]]:
    """What of a statement is passed over: itself, or arguments of it, with their fields."""
    cls = type(command) if isinstance(command, Statement) else command.of
    if cls.inert:
        for name in getattr(command, "passed_over", (command.keyword,)):
            yield "", name
    for field in cls.inert_fields:
        if field in command.spans:
            yield field, f"{command.keyword} {_written(command, cls.arguments[field])}"


def _written(command: Command, argument: Argument) -> object:
    """The keyword of an argument; the word itself of one that has none."""
    if argument.keys:
        return argument.key
    changes = command.changes if isinstance(command, Redefinition) else vars(command)
    return changes[argument.name]
