"""Rules about the posture of the deck: axes, moments of inertia, directions of markers."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from math import hypot

from adamslite.deck.deck import Deck
from adamslite.deck.statement_diagnostics import diagnose
from adamslite.elements.joint import Joint
from adamslite.elements.jprim import Jprim
from adamslite.elements.marker import Marker
from adamslite.elements.part import Part
from adamslite.language.diagnostics import Diagnostic
from adamslite.language.statement import Statement

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
