"""Rules about GRAPHICS, and about CONTACT: its laws, the shapes that meet, their parts."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import product

from adamslite.checks.rule import positive
from adamslite.deck.deck import Deck
from adamslite.deck.statement_diagnostics import diagnose
from adamslite.elements.bases.contact_forms import meetings, solid
from adamslite.elements.contact import Contact
from adamslite.elements.graphics import Graphics
from adamslite.elements.marker import Marker
from adamslite.language.diagnostics import Diagnostic
from adamslite.language.interfaces import Key

Body = tuple[str, Key]
POSITIVE = (
    "stiffness", "exponent", "dmax", "penalty", "mu_static", "stiction_transition_velocity",
    "friction_transition_velocity", "max_stiction_deformation",
)  # fmt: skip
CURVED = "curves have no inside; PTCV holds a point on a curve"
DRAWN = "it only draws something"
SIMPLE = {
    "ARC": CURVED,
    "CIRCLE": CURVED,
    "CURVE": CURVED,
    "CYLINDER": "give its RADIUS as a number",
    "ELLIPSOID": "equal scales make it a ball, the only one that is computed",
    "EXTERNAL": "write what touches as ELLIPSOID with equal scales, BOX, CYLINDER or PLANE",
    "FORCE": DRAWN,
    "FUNCTION": DRAWN,
    "OUTLINE": CURVED,
    "SPRINGDAMPER": DRAWN,
    "TORUS": "write ELLIPSOIDs with equal scales along it",
}
"""What to write instead of a shape that cannot touch."""
BALLS = "put POINTs, or ELLIPSOIDs with equal scales, where they touch"
APART = {
    ("BALL", "BALL"): "two POINTs never overlap; one of them needs a radius",
    ("PLANE", "PLANE"): "neither has corners; make one of them a BOX",
}
"""What to do about pairs that are not computed; for others BALLS."""


def contact_laws(deck: Deck) -> Iterator[Diagnostic]:
    """Numbers of the normal force and of friction."""
    for each in deck.of(Contact):
        if each.missing:
            listed = ", ".join(field.upper() for field in each.missing)
            yield diagnose(each, "shape-incomplete", "law", kind=each.law, listed=listed)
        yield from positive(each, *(field for field in POSITIVE if each.given(field)))
        for field in ("damping", "mu_dynamic"):
            if (getattr(each, field) or 0.0) < 0.0:
                yield diagnose(each, "negative", field, word=field.upper())
        if not 0.0 <= (each.restitution_coefficient or 0.0) <= 1.0:
            word = "RESTITUTION_COEFFICIENT"
            yield diagnose(each, "out-of-range", word.lower(), word=word, low=0, high=1)
        yield from _slip(each)
        for field, reason in _idle(each):
            yield diagnose(each, "no-effect", field, word=field.upper(), reason=reason)


def _slip(contact: Contact) -> Iterator[Diagnostic]:
    """Whether friction falls, and between two different speeds."""
    rest, moving = contact.mu_static, contact.mu_dynamic
    if rest is not None and moving is not None and moving > rest:
        yield diagnose(contact, "contact-friction", "mu_dynamic", low="MU_DYNAMIC",
                       high="MU_STATIC")  # fmt: skip
    slow, fast = contact.stiction_transition_velocity, contact.friction_transition_velocity
    if slow is not None and fast is not None and fast <= slow:
        yield diagnose(contact, "contact-friction", "friction_transition_velocity",
                       low="STICTION_TRANSITION_VELOCITY",
                       high="FRICTION_TRANSITION_VELOCITY")  # fmt: skip


def _idle(contact: Contact) -> Iterator[tuple[str, str]]:
    """Fields that are given in vain, and why."""
    reasons = dict.fromkeys(contact.laws["POISSON"], "the law is IMPACT")
    if contact.law == "POISSON":
        reasons = dict.fromkeys(contact.laws["IMPACT"], "the law is POISSON")
    if not contact.rubs:
        idle = (*contact.rubbing, "stiction", "max_stiction_deformation")
        reasons |= dict.fromkeys(idle, "COULOMB_FRICTION is OFF")
    elif contact.stiction == "OFF":
        reasons["max_stiction_deformation"] = "STICTION is OFF"
    given = (item for item in reasons.items() if contact.given(item[0]))
    return ((field, why) for field, why in given if getattr(contact, field) != "OFF")


def contact_shapes(deck: Deck) -> Iterator[Diagnostic]:
    for each in deck.of(Contact):
        if each in deck.overfull:
            continue  # its pairs are too many to look at
        faults = [*_not_simple(deck, each), *_parts(deck, each)]
        yield from faults or _pairs(deck, each)


def _sides(deck: Deck, contact: Contact) -> list[tuple[str, list[Graphics]]]:
    """Both lists of shapes that are complete, with their fields."""
    return [
        (field, [g for key in getattr(contact, field) if (g := deck.find(Graphics, key))])
        for field in ("igeom", "jgeom")
    ]


def _not_simple(deck: Deck, contact: Contact) -> Iterator[Diagnostic]:
    """Shapes that no contact is known of."""
    for field, found in _sides(deck, contact):
        for shape in found:
            if shape.shape and not shape.missing and not solid(shape):
                yield diagnose(
                    contact, "contact-shape", field, hint=SIMPLE[shape.shape],
                    shape=shape.label, kind=shape.shape,
                )  # fmt: skip


def _parts(deck: Deck, contact: Contact) -> Iterator[Diagnostic]:
    """Both sides are on one part each, and these can take the force."""
    bodies: list[Body] = []
    for field, found in _sides(deck, contact):
        owners = [body for shape in found if (body := _body(deck, shape))]
        for owner in owners[1:]:
            if owner != owners[0]:
                yield diagnose(
                    contact, "contact-parts", field,
                    word=field.upper(), first=_name(owners[0]), other=_name(owner),
                )  # fmt: skip
        bodies += owners[:1]
        if owners:
            if owners[0][0] == "POINT_MASS" and not _is_central(contact, found):
                yield diagnose(
                    contact, "torque-on-point", field, owner="/".join(map(str, owners[0]))
                )
    if len(bodies) == 2 and bodies[0] == bodies[1]:
        yield diagnose(contact, "contact-same-part", "jgeom", owner=_name(bodies[0]))


def _name(body: Body) -> str:
    return f"{body[0]}/{body[1]}"


def _is_central(contact: Contact, shapes: list[Graphics]) -> bool:
    """Whether no torque arises about the markers of the shapes."""
    return not contact.rubs and all(solid(shape) == "BALL" for shape in shapes)


def _body(deck: Deck, shape: Graphics) -> Body | None:
    if shape.shape is None or shape.missing or shape.marker is None:
        return None
    marker = deck.find(Marker, shape.marker)
    return marker.owner if marker else None


def _pairs(deck: Deck, contact: Contact) -> Iterator[Diagnostic]:
    """Pairs of shapes whose contact is not computed."""
    (_, first), (_, second) = _sides(deck, contact)
    for i, j in product(first, second):
        complete = i.shape and j.shape and not (i.missing or j.missing)
        if complete and not meetings(i, j):
            hint = APART.get((solid(i), solid(j)), BALLS)
            yield diagnose(
                contact, "contact-pair", "jgeom", hint=hint,
                first=f"{i.label} ({i.shape})", second=f"{j.label} ({j.shape})",
            )  # fmt: skip


# Lengths that have no direction.
SIZES = (
    "radius", "xscale", "yscale", "zscale", "major_radius", "minor_radius", "seg", "sides",
)  # fmt: skip


def shapes(deck: Deck) -> Iterator[Diagnostic]:
    for each in deck.of(Graphics):
        shape = each.shape
        if shape is None:
            yield diagnose(each, "no-shape", listed=", ".join(sorted(Graphics.needs)))
            continue
        if each.missing:
            listed = ", ".join(each.missing)
            yield diagnose(each, "shape-incomplete", "kind", kind=shape, listed=listed)
        for field in _idle_fields(each, shape):
            word, reason = Graphics.arguments[field].key, f"the shape is {shape}"
            yield diagnose(each, "no-effect", field, word=word, reason=reason)
        yield from positive(each, *SIZES)
        yield from _radii(each)


def _idle_fields(graphics: Graphics, shape: str) -> Iterator[str]:
    """Fields that are given and do not belong to the shape."""
    taken = {"kind", *Graphics.needs[shape], *Graphics.takes.get(shape, ())}
    return (field for field in Graphics.arguments if graphics.given(field) and field not in taken)


def _radii(graphics: Graphics) -> Iterator[Diagnostic]:
    """The radii of a FRUSTUM: one of them may be zero."""
    for field in ("bottom", "top"):
        if (getattr(graphics, field) or 0.0) < 0.0:
            yield diagnose(graphics, "not-positive", field, word=field.upper())
