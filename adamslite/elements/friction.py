"""FRICTION: dry friction in a joint, from the joint's own reaction.

Equations (F, T: force and torque of the joint on I; a: z of J; ``_n`` across a, ``_a`` along it)::

    joint            slip v                    normal load N
    TRANSLATIONAL    speed of I along a        |F_n| + |T_n|/INITIAL_OVERLAP + |T_a|/REACTION_ARM
    REVOLUTE         w PIN_RADIUS              |F_n| + |F_a| FRICTION_ARM/PIN_RADIUS
                                               + |T_n|/BENDING_REACTION_ARM
    CYLINDRICAL      (speed along a,           |F_n| + |T_n|/INITIAL_OVERLAP
                      w PIN_RADIUS)
    SPHERICAL        w BALL_RADIUS (vector)    |F|

    friction = -(mu(|v|) N + preload) v/|v|,  torques times the radius of v

    vs = STICTION_TRANSITION_VELOCITY
    mu = MU_STATIC u (3 - u^2)/2,  u = |v|/vs      |v| < vs
         STEP from MU_STATIC to MU_DYNAMIC         vs ... 1.5 vs
         MU_DYNAMIC                                beyond

The reaction is the joint's multipliers of the same instant, solved together with everything else.
INPUTS leaves out terms of N or the preload: REACTION_FORCE F, BENDING_MOMENT T_n, TORSIONAL_MOMENT
T_a.  EFFECT=SLIDING takes MU_DYNAMIC for both coefficients, EFFECT=STICTION has no friction beyond
1.5 vs.  A preload is a friction force (or torque) of its own, ramped below vs like mu.

Sign: against the slip of I relative to J; the opposite acts on J.

What differs from ADAMS, or is not documented: below vs ADAMS holds the joint by a spring that
yields up to MAX_STICTION_DEFORMATION; here a joint under a load that friction can hold creeps,
slower than vs (check warns when MAX_STICTION_DEFORMATION is given).  In a static analysis
nothing slips and there is no friction, as with INACTIVE=STATIC.  The overlap of the sliding parts
stays INITIAL_OVERLAP.  The defaults of the coefficients and arms are those that Adams/View writes.
The weights of N in revolute, cylindrical and spherical joints follow the descriptions of their
arguments; for the two axes of Hooke and universal joints there is no such description, and the
joints are refused.
Source: Adams/Solver statement FRICTION; Adams/View help "Translational Joint" and "Friction Regime
Determination".
"""

from __future__ import annotations

from typing import Any, ClassVar

from adamslite.algebra import choose, norm, root
from adamslite.coordinates import relative_velocity, spin
from adamslite.expression import COMPONENTS, Ref, measure
from adamslite.statement import Statement, choice, number, reference, statement, words
from adamslite.symbolic import ZERO, Load, Scope, dot, minus, scale
from adamslite.wrench import Wrench

BLEND = 1.5
INPUTS = ("PRELOAD", "REACTION_FORCE", "BENDING_MOMENT", "TORSIONAL_MOMENT")


def _arm(key: str, default: float, help: str) -> float:
    return number(key, unit="length", default=default, help=help)


@statement("FRICTION", planned=("FORMULATION", "OVERLAP_DELTA", "TRANSITION_VELOCITY_COEFFICIENT"))
class Friction(Wrench, Statement):
    """Friction of a translational, revolute, cylindrical or spherical joint."""

    joint: int | str = reference("JOINT", to="JOINT", required=True, help="the joint that rubs")
    mu_static: float = number("MU_STATIC", unit="1", default=0.5, help="coefficient at rest")
    mu_dynamic: float = number("MU_DYNAMIC", unit="1", default=0.3, help="coefficient in motion")
    stiction_transition_velocity: float = number(
        "STICTION_TRANSITION_VELOCITY", unit="length/time", default=0.1,
        help="slip at which friction is greatest",
    )  # fmt: skip
    max_stiction_deformation: float | None = number(
        "MAX_STICTION_DEFORMATION", unit="length", help="not used: the joint creeps instead"
    )
    pin_radius: float = _arm("PIN_RADIUS", 1.0, "REVOLUTE, CYLINDRICAL: radius of the pin")
    ball_radius: float = _arm("BALL_RADIUS", 1.0, "SPHERICAL: radius of the ball")
    friction_arm: float = _arm("FRICTION_ARM", 1.0, "REVOLUTE: arm of the axial force's friction")
    bending_reaction_arm: float = _arm(
        "BENDING_REACTION_ARM", 1.0, "REVOLUTE: arm that turns a bending moment into a force"
    )
    reaction_arm: float = _arm(
        "REACTION_ARM", 1.0, "TRANSLATIONAL: arm that turns a torque about z into a force"
    )
    initial_overlap: float = _arm(
        "INITIAL_OVERLAP", 1000.0, "TRANSLATIONAL, CYLINDRICAL: length over which the parts overlap"
    )
    friction_force_preload: float = number(
        "FRICTION_FORCE_PRELOAD", unit="force", default=0.0,
        help="friction without load: TRANSLATIONAL, CYLINDRICAL",
    )  # fmt: skip
    friction_torque_preload: float = number(
        "FRICTION_TORQUE_PRELOAD", unit="torque", default=0.0,
        help="friction torque without load: REVOLUTE, SPHERICAL",
    )  # fmt: skip
    effect: str = choice(
        "EFFECT", options=("ALL", "STICTION", "SLIDING"), default="ALL", help="coefficients used"
    )
    inputs: tuple[str, ...] = words(
        "INPUTS", options=("ALL", "NONE", *INPUTS), help="loads that cause friction; default ALL"
    )
    inactive: str | None = choice(
        "INACTIVE", options=("STATIC",), help="no friction in statics: always so"
    )

    joints: ClassVar[tuple[str, ...]] = ("CYLINDRICAL", "REVOLUTE", "SPHERICAL", "TRANSLATIONAL")

    def derived(self, model: Any) -> dict[str, Any]:
        """Force and torque of the joint on I, and which of them count."""
        joint = Ref("JOINT", self.joint)
        reaction = tuple(measure("JOINT", joint, component) for component in COMPONENTS)
        counted = set(self.inputs) or {"ALL"}
        used = {name: bool(counted & {name, "ALL"}) for name in INPUTS}
        return {
            "reaction": reaction,
            "used": tuple(name for name in INPUTS if used[name]),
        }

    def loads(self, scope: Scope) -> list[Load]:
        """Friction on I and its reaction on J."""
        joint = self.joint
        force, torque = slip(scope, self)
        square = dot(force, force) + dot(torque, torque)
        grip = friction_by_speed(self, square, normal_load(scope, self))
        radius = self.ball_radius if joint.kind == "SPHERICAL" else self.pin_radius
        return [
            Load(joint.i, scale(-grip, force), scale(-grip * radius, torque), joint.j, follows=True)
        ]


def slip(scope: Scope, friction: Any) -> tuple[Any, Any]:
    """Slip as two vectors: of the sliding, and of the turning, both speeds of the surface."""
    i, j, kind = friction.joint.i, friction.joint.j, friction.joint.kind
    axis = scope.axes(j)[2]
    if kind == "SPHERICAL":
        return ZERO, scale(friction.ball_radius, scope.omega(i, j))
    along = scale(relative_velocity(scope, i, j, 2), axis)
    around = scale(friction.pin_radius * spin(scope, i, j), axis)
    return (ZERO if kind == "REVOLUTE" else along), (ZERO if kind == "TRANSLATIONAL" else around)


def normal_load(scope: Scope, friction: Any) -> Any:
    """N of the table above."""
    kind, used = friction.joint.kind, friction.used
    force = friction.reaction[:3] if "REACTION_FORCE" in used else ZERO
    torque = friction.reaction[3:]
    axis = scope.axes(friction.joint.j)[2]
    axial, twist = dot(force, axis), dot(torque, axis)
    across = norm(minus(force, scale(axial, axis)))
    bending = norm(minus(torque, scale(twist, axis))) if "BENDING_MOMENT" in used else 0
    if kind == "SPHERICAL":
        return norm(force)
    if kind == "REVOLUTE":
        pressed = across + norm((axial, 0, 0)) * friction.friction_arm / friction.pin_radius
        return pressed + bending / friction.bending_reaction_arm
    if kind == "TRANSLATIONAL" and "TORSIONAL_MOMENT" in used:
        across = across + norm((twist, 0, 0)) / friction.reaction_arm
    return across + bending / friction.initial_overlap


def friction_by_speed(friction: Any, square: Any, load: Any) -> Any:
    """Friction over slip at the surface, by the slip's square: even and smooth."""
    rest, moving = {
        "ALL": (friction.mu_static, friction.mu_dynamic),
        "SLIDING": (friction.mu_dynamic, friction.mu_dynamic),
        "STICTION": (friction.mu_static, 0),
    }[friction.effect]
    own = preload(friction)
    edge, speed = friction.stiction_transition_velocity, root(square)
    passed = (speed / edge - 1) / (BLEND - 1)
    between = rest + (moving - rest) * passed**2 * (3 - 2 * passed)
    creeping = (rest * load + own) * (3 - square / edge**2) / (2 * edge)
    return choose(
        (creeping, square <= edge**2),
        ((between * load + own) / speed, square <= (BLEND * edge) ** 2),
        otherwise=(moving * load + own) / speed,
        order=1,
    )


def preload(friction: Any) -> Any:
    """Friction force without load at the surface."""
    if "PRELOAD" not in friction.used:
        return 0
    if friction.joint.kind == "REVOLUTE":
        return friction.friction_torque_preload / friction.pin_radius
    if friction.joint.kind == "SPHERICAL":
        return friction.friction_torque_preload / friction.ball_radius
    return friction.friction_force_preload
