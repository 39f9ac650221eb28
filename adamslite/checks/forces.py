"""Rules about the forces of NFORCE, the function that measures it, and FRICTION."""

from __future__ import annotations

from collections.abc import Iterator

from adamslite.checks.rule import Rule, positive
from adamslite.deck.deck import Deck
from adamslite.deck.statement_diagnostics import diagnose
from adamslite.elements.friction import Friction
from adamslite.elements.joint import Joint
from adamslite.elements.matrix import Matrix
from adamslite.elements.nforce import WIDTH, Nforce
from adamslite.language.diagnostics import Diagnostic
from adamslite.language.expression import Call, Ref, calls
from adamslite.language.statement import Statement


def connected_markers(deck: Deck) -> Iterator[Diagnostic]:
    """Markers of an NFORCE, J among them, that are given twice."""
    for each in deck.of(Nforce):
        markers = [*each.imarkers, each.j]
        twice = next((m for n, m in enumerate(markers) if m in markers[:n]), None)
        if twice is not None:
            yield diagnose(each, "marker-twice", "imarkers", key=twice)


def sizes(deck: Deck) -> Iterator[Diagnostic]:
    """Whether the matrices have six rows, or columns, for each marker."""
    for each in deck.of(Nforce):
        n = WIDTH * len(each.imarkers)
        needed = {"kmatrix": (n, n), "cmatrix": (n, n), "length": (n, 1), "force": (n, 1)}
        for field, (rows, columns) in needed.items():
            key = getattr(each, field)
            matrix = None if key is None else deck.find(Matrix, key)
            if matrix and matrix.complete and (matrix.rows, matrix.columns) != (rows, columns):
                yield diagnose(
                    each, "nforce-matrix", field, word=field.upper(), matrix=matrix.label,
                    size=f"{matrix.rows} x {matrix.columns}", needed=f"{rows} x {columns}",
                )  # fmt: skip
        if each.given("cmatrix") and each.cratio is not None:
            reason = "CRATIO gives the damping"
            yield diagnose(each, "no-effect", "cmatrix", word="CMATRIX", reason=reason)


def measured_markers(deck: Deck) -> Iterator[Diagnostic]:
    """Whether NFORCE(id, marker, ...) measures at one of its markers."""
    for statement in deck.statements if deck.of(Nforce) else ():
        for field, argument in statement.arguments.items():
            node = getattr(statement, field) if argument.kind == "expression" else None
            for call in calls(node, "NFORCE") if node is not None else ():
                yield from _foreign(deck, statement, field, call)


def _foreign(deck: Deck, statement: Statement, field: str, call: Call) -> Iterator[Diagnostic]:
    own, at, *_ = call.args
    assert isinstance(own, Ref) and isinstance(at, Ref)
    nforce = deck.find(Nforce, own.id)
    if nforce and at.id not in (*nforce.imarkers, nforce.j):
        listed = ", ".join(map(str, (*nforce.imarkers, nforce.j)))
        words = {"nforce": nforce.label, "key": str(at.id), "listed": listed}
        yield diagnose(statement, "nforce-marker", field, **words)


SIZES = (
    "stiction_transition_velocity", "max_stiction_deformation", "pin_radius", "ball_radius",
    "friction_arm", "bending_reaction_arm", "reaction_arm", "initial_overlap",
    "max_friction_force", "max_friction_torque",
)  # fmt: skip
STICK_SLIP = (
    "stiction_transition_velocity", "transition_velocity_coefficient", "max_stiction_deformation",
)  # fmt: skip
STRIBECK = (
    "bristle_stiffness_coefficient", "velocity_threshold_stribeck", "decay_exponent_stribeck",
)  # fmt: skip
DAMPINGS = ("damping_coefficient", "viscous_friction_coefficient")


def frictions(deck: Deck) -> Iterator[Diagnostic]:
    """Numbers of the laws of friction, and whether the joint can have it."""
    for each in deck.of(Friction):
        yield from positive(each, *SIZES)
        if each.transition_velocity_coefficient <= 1.0:
            yield diagnose(each, "friction-transition", "transition_velocity_coefficient")
        joint = deck.find(Joint, each.joint)
        if joint and joint.kind not in each.joints:
            yield diagnose(each, "friction-not-there", "joint", joint=joint.label, kind=joint.kind)
        if each.formulation == "LUGRE":
            yield from _bristles(each)
        for field, reason in _idle(each):
            yield diagnose(each, "no-effect", field, word=field.upper(), reason=reason)


def _bristles(friction: Friction) -> Iterator[Diagnostic]:
    """What FORMULATION=LUGRE needs; no defaults are known."""
    missing = [field for field in (*STRIBECK, *DAMPINGS) if not friction.given(field)]
    if missing:
        listed = ", ".join(field.upper() for field in missing)
        yield diagnose(friction, "shape-incomplete", "formulation", kind="LUGRE", listed=listed)
    yield from positive(friction, "mu_static", "mu_dynamic", *STRIBECK)
    for field in DAMPINGS:
        if (getattr(friction, field) or 0.0) < 0.0:
            yield diagnose(friction, "negative", field, word=field.upper())
    if friction.effect != "ALL":
        yield diagnose(friction, "not-with-bristles", "effect", word="EFFECT")
    if friction.given("smooth"):
        hint = "its meaning is not published: delete it"
        words = {"word": "SMOOTH", "keyword": "FRICTION", "times": ""}
        yield diagnose(friction, "planned-argument", "smooth", hint=hint, **words)


def _idle(friction: Friction) -> Iterator[tuple[str, str]]:
    """Fields that are given in vain, and why."""
    reasons = dict.fromkeys((*STRIBECK, *DAMPINGS), "the law is that of FORMULATION=ORIGINAL")
    if friction.formulation == "LUGRE":
        reasons = dict.fromkeys(STICK_SLIP, "the law is that of FORMULATION=LUGRE")
    elif friction.effect == "SLIDING":
        reasons["max_stiction_deformation"] = "EFFECT=SLIDING leaves stiction out"
    return (item for item in reasons.items() if friction.given(item[0]))


NFORCE_RULES: list[Rule] = [connected_markers, sizes, measured_markers]
