"""Rules about FRICTION: the numbers of its laws, the joints that have it."""

from __future__ import annotations

from collections.abc import Iterator

from adamslite.checks.rule import positive
from adamslite.deck.deck import Deck
from adamslite.deck.statement_diagnostics import diagnose
from adamslite.elements.friction import Friction
from adamslite.elements.joint import Joint
from adamslite.language.diagnostics import Diagnostic

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
