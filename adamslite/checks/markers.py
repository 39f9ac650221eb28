"""Rules about markers: whose they are, the posture of their axes, the use of FLOATING ones."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from math import hypot

from adamslite.checks.rule import needs
from adamslite.deck.deck import Deck
from adamslite.deck.statement_diagnostics import diagnose, diagnose_all, diagnose_inside
from adamslite.elements.cvcv import Cvcv
from adamslite.elements.gforce import Gforce
from adamslite.elements.joint import Joint
from adamslite.elements.jprim import Jprim
from adamslite.elements.marker import Marker
from adamslite.elements.part import Part
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


# Sines below this are round-off.
ROUND_OFF = 1e-10
# Moments of inertia are taken to be given to so many parts of the largest.
DIGITS = 1e-6
# Axes of I and J that point the same way in joints that hold them parallel.
CO_DIRECTED = {
    "FIXED": "xyz", "TRANSLATIONAL": "xyz", "ORIENTATION": "xyz",
    "REVOLUTE": "z", "CYLINDRICAL": "z",
}  # fmt: skip
# Cosines of less than this are no accident of drawing.
OPPOSED = -1e-6


def orientations(deck: Deck) -> Iterator[Diagnostic]:
    pairs = {"MARKER": ("zp", "xp"), "PART": ("zg", "xg"), "POINT_MASS": ("zg", "xg")}
    for keyword, (along, plane) in pairs.items():
        for each in deck.of(keyword):
            points = [field for field in (along, plane) if each.given(field)]
            if points and each.given("reuler"):
                yield diagnose(each, "orientation-twice", points[0])
                continue
            first = plane if getattr(each, "usexp", False) else along
            if (points or first == "xp") and not each.given(first):
                yield diagnose(each, "orientation-incomplete", word=f"add {first.upper()}=")
            origin = (each.qp if keyword == "MARKER" else each.qg) or (0.0, 0.0, 0.0)
            ways = {f: _minus(getattr(each, f), origin) for f in points}
            nowhere = [field for field in points if not any(ways[field])]
            for field in nowhere:
                yield diagnose(each, "orientation-nowhere", field, word=field.upper())
            if len(points) == 2 and not nowhere and _parallel(*ways.values()):
                field = plane if first == along else along
                words = {"word": field.upper(), "other": first.upper(), "axis": first[0]}
                yield diagnose(each, "orientation-flat", field, **words)


def _minus(a: Sequence[float], b: Sequence[float]) -> tuple[float, ...]:
    return tuple(x - y for x, y in zip(a, b, strict=True))


def _parallel(a: Sequence[float], b: Sequence[float]) -> bool:
    """Whether two vectors span no plane, to the digits that numbers have."""
    (ax, ay, az), (bx, by, bz) = a, b
    across = hypot(ay * bz - az * by, az * bx - ax * bz, ax * by - ay * bx)
    return across <= ROUND_OFF * hypot(*a) * hypot(*b)


def no_body(moments: Sequence[float]) -> str:
    """Why no body has these principal moments; empty when one may."""
    smallest, middle, largest = sorted(moments)
    allowed = DIGITS * max(abs(smallest), largest)
    if smallest < -allowed:
        return f"{_about(smallest)} is below zero"
    if largest > smallest + middle + allowed:
        return f"{_about(largest)} exceeds the sum of the others, {smallest:.6g} and {middle:.6g}"
    return ""


def _about(moment: float) -> str:
    return f"the principal moment {moment:.6g} about its mass centre"


def is_plain(part: Part) -> bool:
    """Whether IP holds the principal moments about the mass centre as they are."""
    return part.im in (None, part.cm) and not any((part.ip or ())[3:])


def inertia_at_mass_centre(deck: Deck) -> Iterator[Diagnostic]:
    """Principal moments where products, or a shift from IM, hide them."""
    hidden = [p for p in deck.of(Part) if p.ip and not p.ground and p.mass and not is_plain(p)]
    if not hidden:
        return
    from numpy import errstate, isfinite
    from numpy.linalg import eigvalsh

    from adamslite.model.model import Model

    with errstate(all="ignore"):
        model = Model(deck)
    for part in hidden:
        body = model.bodies[model.body_index["PART", part.key]]
        if not isfinite(body.inertia).all():
            reason = "its moments about its mass centre are beyond the range of numbers"
        else:
            reason = no_body((eigvalsh(body.inertia) * deck.ucf).tolist())
        if reason:
            yield diagnose(part, "bad-inertia", "ip", reason=reason)


def facing_markers(deck: Deck) -> Iterator[Diagnostic]:
    """Joints whose markers are half a turn apart, which satisfies their conditions too."""
    joints: list[Joint | Jprim] = [*deck.of(Joint), *deck.of(Jprim)]
    turned = [j for j in joints if j.kind in CO_DIRECTED and _is_turned(deck, j)]
    if not turned:
        return
    from adamslite.elements.bases.joint_coordinates import pose
    from adamslite.model.model import Model

    model = Model(deck)
    for joint in turned:
        axes_i, axes_j = (pose(model, end)[1] for end in (joint.i, joint.j))
        found = [
            axis
            for n, axis in enumerate("xyz")
            if axis in CO_DIRECTED[joint.kind] and axes_i[:, n] @ axes_j[:, n] < OPPOSED
        ]
        if found:
            axes, kind = " and ".join(found), joint.kind
            yield diagnose(
                joint, "markers-opposed", "i", kind=kind, i=joint.i, j=joint.j, axes=axes
            )


def _is_turned(deck: Deck, joint: Joint | Jprim) -> bool:
    """Whether a marker, or its body, has axes of its own."""
    for end in (joint.i, joint.j):
        marker = deck.find(Marker, end)
        body = deck.find(*marker.owner) if marker and marker.owner else None
        if _has_axes(marker, "reuler", "zp", "xp", "rm") or _has_axes(body, "reuler", "zg", "xg"):
            return True
    return False


def _has_axes(statement: Statement | None, *fields: str) -> bool:
    return statement is not None and any(statement.given(field) for field in fields)
