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

With MAX_STICTION_DEFORMATION = D a TRANSLATIONAL or REVOLUTE joint holds a load below the static
friction, by a bristle between the surfaces whose deflection b (-1 ... 1) is a state,
``DIFF/FRICTION_id``::

    friction = -(mu(|v|) N + preload) (b + (1 - |b|) p(v)),    mu = MU_STATIC below vs

    p = u (3 - u^2)/2 with u = v/vs below vs, sign(v) beyond
    db/dt = v/D                        as long as |b| < 0.9, and whenever v lowers |b|
    db/dt = v/D (1 - |b|)/0.1          from there to 1, where the bristle slips

At rest under a load F the joint has yielded b D, b = F/(MU_STATIC N + preload), up to |b| = 0.9; it
breaks away at b = 1.  In sliding b = sign(v) and the friction is that of the table above.  A joint
that stops springs back by D at most.  The term with p damps the bristle.

The reaction is that of the joint at the same time, solved for with all other unknowns.
INPUTS leaves out terms of N or the preload: REACTION_FORCE F, BENDING_MOMENT T_n, TORSIONAL_MOMENT
T_a.  EFFECT=SLIDING takes MU_DYNAMIC for both coefficients, EFFECT=STICTION has no friction beyond
1.5 vs.  A preload is a friction force (or torque) of its own, ramped below vs like mu.

Sign: against the slip of I relative to J; the opposite acts on J.

What differs from ADAMS, or is not documented: that friction at rest follows from deformation,
velocity and MU_STATIC is documented, the formula is not; the bristle is the elasto-plastic one of
Dupont.  Without MAX_STICTION_DEFORMATION, and always in CYLINDRICAL and SPHERICAL joints, a joint
under a load that friction can hold creeps, slower than vs.  In a static analysis nothing slips and
there is no friction, as with INACTIVE=STATIC; the bristle is then straight, b = 0.  The overlap of
the sliding parts stays INITIAL_OVERLAP.  The defaults of the coefficients and arms are those that
Adams/View writes.  The weights of N in revolute, cylindrical and spherical joints follow the
descriptions of their arguments; for the two axes of Hooke and universal joints there is no such
description, and these joints are rejected.
Source: Adams/Solver statement FRICTION; Adams/View help "Translational Joint" and "Friction Regime
Determination"; P. Dupont, V. Hayward, B. Armstrong, F. Altpeter, IEEE Trans. Automatic Control 47
(2002) 787, section III.
"""

from __future__ import annotations

from typing import ClassVar

from adamslite.elements.bases.joint_coordinates import relative_velocity, spin
from adamslite.elements.bases.wrench import Wrench
from adamslite.elements.joint import Joint
from adamslite.language.expression import COMPONENTS, MODE, Call, Node, Num, Op, Ref, measure
from adamslite.language.interfaces import DrawnModel, Lookup
from adamslite.language.statement import (
    STATEMENTS,
    Statement,
    choice,
    number,
    reference,
    statement,
    words,
)
from adamslite.symbolic.scope import ZERO, Load, Scope, Vector, dot, minus, scale
from adamslite.symbolic.sympy_nodes import magnitude, norm, piecewise, root
from adamslite.symbolic.types import Expr, Seen

BLEND = 1.5
# Share of the bristle's deflection over which it begins to slip.
YIELDING = 0.1
STATICS = 5
INPUTS = ("PRELOAD", "REACTION_FORCE", "BENDING_MOMENT", "TORSIONAL_MOMENT")


def _arm(key: str, default: float, help: str) -> float:
    return number(key, unit="length", default=default, help=help)


@statement("FRICTION", planned=("FORMULATION", "OVERLAP_DELTA", "TRANSITION_VELOCITY_COEFFICIENT"))
class Friction(Wrench, Statement):
    """Friction of a translational, revolute, cylindrical or spherical joint."""

    joint: int | str = reference(
        "JOINT", to="JOINT", required=True, help="the joint that has friction"
    )
    mu_static: float = number("MU_STATIC", unit="1", default=0.5, help="coefficient at rest")
    mu_dynamic: float = number("MU_DYNAMIC", unit="1", default=0.3, help="coefficient in motion")
    stiction_transition_velocity: float = number(
        "STICTION_TRANSITION_VELOCITY", unit="length/time", default=0.1,
        help="slip at which friction is greatest",
    )  # fmt: skip
    max_stiction_deformation: float | None = number(
        "MAX_STICTION_DEFORMATION",
        unit="length",
        help="TRANSLATIONAL, REVOLUTE: deformation of the surface at which it slips",
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
        "INACTIVE", "INACTIVE_DURING", options=("STATIC",), help="no friction in statics: always so"
    )

    held: ClassVar[tuple[str, ...]] = ("REVOLUTE", "TRANSLATIONAL")
    joints: ClassVar[tuple[str, ...]] = ("CYLINDRICAL", "REVOLUTE", "SPHERICAL", "TRANSLATIONAL")

    @property
    def state(self) -> str:
        """Name of the DIFF that is the bristle's deflection."""
        return f"FRICTION_{self.key}".upper()

    @property
    def deflection(self) -> Node:
        """The bristle's deflection as an expression."""
        return Call("DIF", (Ref("DIFF", self.state),))

    def sticks(self, joint: Joint | None) -> bool:
        """Whether a bristle holds the joint at rest."""
        wanted = self.max_stiction_deformation is not None and self.effect != "SLIDING"
        return wanted and joint is not None and joint.kind in self.held

    def companions(self, deck: Lookup) -> tuple[Statement, ...]:
        """The bristle's deflection over MAX_STICTION_DEFORMATION."""
        joint = deck.find("JOINT", self.joint)
        if not self.sticks(joint):
            return ()
        rate = bristle_rate(self, joint)
        return (STATEMENTS["DIFF"](id=self.state, function=rate, spans=self.spans),)

    def derived(self, model: DrawnModel) -> dict[str, object]:
        """Force and torque of the joint on I, and which of them count."""
        joint = Ref("JOINT", self.joint)
        joint_found = model.element("JOINT", self.joint)
        reaction = tuple(measure("JOINT", joint, component) for component in COMPONENTS)
        counted = set(self.inputs) or {"ALL"}
        used = {name: bool(counted & {name, "ALL"}) for name in INPUTS}
        return {
            "reaction": reaction,
            "used": tuple(name for name in INPUTS if used[name]),
            "bristle": self.deflection if self.sticks(joint_found) else None,
        }

    def loads(self: Seen, scope: Scope) -> list[Load]:
        """Friction on I and its reaction on J."""
        joint = self.joint
        if self.bristle is not None:
            return [held(scope, self)]
        force, torque = slip(scope, self)
        square = dot(force, force) + dot(torque, torque)
        grip = friction_by_speed(self, square, normal_load(scope, self))
        radius = self.ball_radius if joint.kind == "SPHERICAL" else self.pin_radius
        return [
            Load(joint.i, scale(-grip, force), scale(-grip * radius, torque), joint.j, follows=True)
        ]


def slip(scope: Scope, friction: Seen) -> tuple[Vector, Vector]:
    """Slip as two vectors: of the sliding, and of the turning, both speeds of the surface."""
    i, j, kind = friction.joint.i, friction.joint.j, friction.joint.kind
    axis = scope.axes(j)[2]
    if kind == "SPHERICAL":
        return ZERO, scale(friction.ball_radius, scope.omega(i, j))
    along = scale(relative_velocity(scope, i, j, 2), axis)
    around = scale(friction.pin_radius * spin(scope, i, j), axis)
    return (ZERO if kind == "REVOLUTE" else along), (ZERO if kind == "TRANSLATIONAL" else around)


def normal_load(scope: Scope, friction: Seen) -> Expr:
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


def bristle_rate(friction: Friction, joint: Joint) -> Node:
    """db/dt as an expression; in statics the bristle straightens."""
    i, j = Ref("MARKER", joint.i), Ref("MARKER", joint.j)
    if joint.kind == "REVOLUTE":
        slip: Node = Op("*", (Num(friction.pin_radius), Call("WZ", (i, j, j))))
    else:
        slip = Call("VZ", (i, j, j, j))
    b = friction.deflection
    ahead = _product(Call("MAX", (slip, Num(0.0))), _yield(Op("-", (Num(1.0), b))))
    back = _product(Call("MIN", (slip, Num(0.0))), _yield(Op("+", (Num(1.0), b))))
    assert friction.max_stiction_deformation is not None
    rate = Op("/", (Op("+", (ahead, back)), Num(friction.max_stiction_deformation)))
    return Call("IF", (Op("-", (MODE, Num(STATICS))), rate, Op("neg", (b,)), rate))


def _product(a: Node, b: Node) -> Node:
    return Op("*", (a, b))


def _yield(left: Node) -> Node:
    """1 while ``left``, the deflection that is left, is large; falls to 0 with it."""
    share = Op("/", (left, Num(YIELDING)))
    return Call("MIN", (Call("MAX", (share, Num(0.0))), Num(1.0)))


def held(scope: Scope, friction: Seen) -> Load:
    """Friction of a joint with a bristle."""
    i, j = friction.joint.i, friction.joint.j
    axis = scope.axes(j)[2]
    load = normal_load(scope, friction)
    if friction.joint.kind == "TRANSLATIONAL":
        push = friction_by_bristle(friction, relative_velocity(scope, i, j, 2), load)
        return Load(i, scale(-push, axis), ZERO, j, follows=True)
    push = friction_by_bristle(friction, friction.pin_radius * spin(scope, i, j), load)
    return Load(i, ZERO, scale(-push * friction.pin_radius, axis), j, follows=True)


def friction_by_bristle(friction: Seen, speed: Expr, load: Expr) -> Expr:
    """Friction at the surface against a slip of ``speed``."""
    rest, moving = coefficients(friction)
    edge, b = friction.stiction_transition_velocity, friction.bristle
    # Below the edge nothing depends on the size: friction is smooth where the slip turns round.
    size = magnitude(speed, None)
    share = piecewise(
        (speed * (3 - speed**2 / edge**2) / (2 * edge), size <= edge),
        (1, speed > 0),
        otherwise=-1,
        order=1,
    )
    mu = piecewise(
        (rest, size <= edge),
        (blended(friction, size), size <= BLEND * edge),
        otherwise=moving,
        order=1,
    )
    return (mu * load + preload(friction)) * (b + (1 - magnitude(b, None)) * share)


def friction_by_speed(friction: Seen, square: Expr, load: Expr) -> Expr:
    """Friction over slip at the surface, by the slip's square: even and smooth."""
    rest, moving = coefficients(friction)
    own = preload(friction)
    edge, speed = friction.stiction_transition_velocity, root(square)
    creeping = (rest * load + own) * (3 - square / edge**2) / (2 * edge)
    return piecewise(
        (creeping, square <= edge**2),
        ((blended(friction, speed) * load + own) / speed, square <= (BLEND * edge) ** 2),
        otherwise=(moving * load + own) / speed,
        order=1,
    )


def coefficients(friction: Seen) -> tuple[Expr, Expr]:
    """At rest and in motion, by EFFECT."""
    return {
        "ALL": (friction.mu_static, friction.mu_dynamic),
        "SLIDING": (friction.mu_dynamic, friction.mu_dynamic),
        "STICTION": (friction.mu_static, 0),
    }[friction.effect]


def blended(friction: Seen, speed: Expr) -> Expr:
    """The coefficient between vs and 1.5 vs."""
    rest, moving = coefficients(friction)
    passed = (speed / friction.stiction_transition_velocity - 1) / (BLEND - 1)
    return rest + (moving - rest) * passed**2 * (3 - 2 * passed)


def preload(friction: Seen) -> Expr:
    """Friction force without load at the surface."""
    if "PRELOAD" not in friction.used:
        return 0
    if friction.joint.kind == "REVOLUTE":
        return friction.friction_torque_preload / friction.pin_radius
    if friction.joint.kind == "SPHERICAL":
        return friction.friction_torque_preload / friction.ball_radius
    return friction.friction_force_preload
