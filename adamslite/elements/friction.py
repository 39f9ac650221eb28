"""FRICTION: dry friction in a joint, from the joint's own reaction.

Equations (F, T: force and torque of the joint on I; a: axis; ``_n`` across a, ``_a`` along it)::

    joint            axis a            slip v             normal load N
    TRANSLATIONAL    z of J            speed along a      |F_n| + |T_n|/X + |T_a|/REACTION_ARM
    REVOLUTE         z of J            w PIN_RADIUS       |F_n| + |F_a| FRICTION_ARM/PIN_RADIUS
                                                          + |T_n|/BENDING_REACTION_ARM
    HOOKE            x of I or y of J  as REVOLUTE, by YOKE
    UNIVERSAL        z of I or z of J  as REVOLUTE, by YOKE
    CYLINDRICAL      z of J            (speed along a,    |F_n| + |T_n|/X
                                       w PIN_RADIUS)
    SPHERICAL        (axes of I)       w BALL_RADIUS      |F|

    X = INITIAL_OVERLAP + s (DZ(I,J,J) - its value as drawn, or IC)
        s = 1, -1, 0 for OVERLAP_DELTA = INCREASE, DECREASE, CONSTANT

    force on I   -(mu N + FRICTION_FORCE_PRELOAD d)
    torque on I  -(radius mu N + FRICTION_TORQUE_PRELOAD d)

The vector mu and d, its direction, follow from the slip v and the creep D of the surfaces::

    |v| < vs      d = beta v/|v| + (1 - beta) s(|D|/Dm) D/|D|,   mu = MU_STATIC d
    vs ... vd     d = v/|v|,   mu = STEP5(|v|, vs, MU_STATIC, vd, MU_DYNAMIC) d
    beyond vd     d = v/|v|,   mu = MU_DYNAMIC d

    beta = s(|v|/vs),   s(x) = STEP5(x, -1, -1, 1, 1) = (15 x - 10 x^3 + 3 x^5)/8
    dD/dt = v below vs, from D = 0 when |v| falls below it
            what lengthens D fades out between Dm and 1.01 Dm, where friction is the same

    vs = STICTION_TRANSITION_VELOCITY,  vd = TRANSITION_VELOCITY_COEFFICIENT vs
    Dm = MAX_STICTION_DEFORMATION

FORMULATION=LUGRE has a law without regimes instead, z being the deformation of bristles in place of
the creep (results beta = 0, mu1 = k |z|)::

    mu = k z + c dz/dt + f v,    d = k z/g
    dz/dt = v - k |v| z/g,       g = MU_DYNAMIC + (MU_STATIC - MU_DYNAMIC) exp(-(|v|/w)^p)

    k = BRISTLE_STIFFNESS_COEFFICIENT,  c = DAMPING_COEFFICIENT,  f = VISCOUS_FRICTION_COEFFICIENT
    w = VELOCITY_THRESHOLD_STRIBECK,    p = DECAY_EXPONENT_STRIBECK

MAX_FRICTION_FORCE and MAX_FRICTION_TORQUE shorten the force and the torque of either law.

By the stick-slip law a joint at rest under a load yields by D, s(|D|/Dm) = load/(MU_STATIC N), and
stays; it breaks away where that share is 1.  Creep, bristles and slip of a SPHERICAL joint have
components along the axes of I.

The reaction is that of the joint at the same time, solved for with all other unknowns.
INPUTS leaves out terms of N or the preload: REACTION_FORCE F, BENDING_MOMENT T_n, TORSIONAL_MOMENT
T_a.  EFFECT=SLIDING has no creep and takes MU_DYNAMIC for both coefficients; EFFECT=STICTION has no
friction beyond vd.

Sign: against the slip of I relative to J; the opposite acts on J.

Results: fx ... tz along the axes of J; the coefficient mux muy muz (slides) murx mury murz (turns),
negative along the slip; mu1 = MU_STATIC s(|D|/Dm); the slip of the surface vx ... wz, its creep
creep_x ... creep_az, and beta.  Those of a HOOKE joint are called x (YOKE of I) and y (of J), of
all other joints but the SPHERICAL one z.  FRICTION(id, jflag, comp, rm) gives them too.

In a static analysis nothing slips, and creep stays as it is: an equilibrium that friction holds is
one.  With INACTIVE=STATIC there is no friction there.

Source: Adams/Solver statement FRICTION; Adams/View help "Translational Joint" and "Friction Regime
Determination".  The law below vs and its STEP5 were fitted to results of Adams for spherical
joints; that creep ends at Dm is documented.  The weights of N in the other joints follow the
descriptions of their arguments.  LUGRE: Canudas de Wit, Olsson, Astrom, Lischinsky, A New Model for
Control of Systems with Friction, IEEE Transactions on Automatic Control 40 (1995).
"""

from __future__ import annotations

from collections.abc import Sequence
from types import ModuleType
from typing import TYPE_CHECKING, ClassVar, NamedTuple

from adamslite.elements.bases import lugre, stick_slip
from adamslite.elements.bases.joint_coordinates import built_slide, relative_velocity, slide
from adamslite.elements.bases.wrench import Wrench
from adamslite.language.expression import COMPONENTS, Call, Num, Ref, measure
from adamslite.language.statement import (
    STATEMENTS,
    Statement,
    choice,
    number,
    reference,
    statement,
    words,
)
from adamslite.symbolic.formulas import fn, norm, piecewise
from adamslite.symbolic.scope import ZERO, Load, dot, minus, scale

if TYPE_CHECKING:
    from adamslite.elements.joint import Joint
    from adamslite.language.expression import Node
    from adamslite.language.interfaces import DrawnModel, Lookup
    from adamslite.symbolic.scope import Scope, Vector
    from adamslite.symbolic.types import Expr, Seen, Symbol

STATICS = 5
INPUTS = ("PRELOAD", "REACTION_FORCE", "BENDING_MOMENT", "TORSIONAL_MOMENT")
TURNS = ("HOOKE", "REVOLUTE", "UNIVERSAL")
SLIDES = ("CYLINDRICAL", "TRANSLATIONAL")
STATES: dict[str, tuple[str, ...]] = {
    "CYLINDRICAL": ("_Z", "_AZ"), "SPHERICAL": ("_X", "_Y", "_Z"),
}  # fmt: skip
CHANNELS = (
    "mux", "muy", "muz", "murx", "mury", "murz", "mu1", "vx", "vy", "vz", "wx", "wy", "wz",
    "creep_x", "creep_y", "creep_z", "creep_ax", "creep_ay", "creep_az", "beta",
)  # fmt: skip


def _arm(key: str, default: float, help: str) -> float:
    return number(key, unit="length", default=default, help=help)


def _of_lugre(key: str, unit: str, help: str) -> float | None:
    return number(key, unit=unit, help=f"LUGRE: {help}")


class Freedom(NamedTuple):
    """One way in which the surfaces slip: along (``radius`` None) or about an axis.

    ``channel``: number of its component among x y z of slides, then of turns.
    """

    axis: Vector
    speed: Expr
    radius: Expr | None
    channel: int


@statement("FRICTION")
class Friction(Wrench, Statement):
    """Friction of a translational, revolute, cylindrical, spherical, Hooke or universal joint."""

    joint: int | str = reference(
        "JOINT", to="JOINT", required=True, help="the joint that has friction"
    )
    formulation: str = choice(
        "FORMULATION", options=("ORIGINAL", "LUGRE"), default="ORIGINAL",
        help="the law: stick-slip, or that of bristles",
    )  # fmt: skip
    mu_static: float = number("MU_STATIC", unit="1", default=0.5, help="coefficient at rest")
    mu_dynamic: float = number("MU_DYNAMIC", unit="1", default=0.3, help="coefficient in motion")
    stiction_transition_velocity: float = number(
        "STICTION_TRANSITION_VELOCITY", unit="length/time", default=0.1,
        help="slip below which the joint can stick",
    )  # fmt: skip
    transition_velocity_coefficient: float = number(
        "TRANSITION_VELOCITY_COEFFICIENT", unit="1", default=1.5,
        help="times STICTION_TRANSITION_VELOCITY: slip from which MU_DYNAMIC applies",
    )  # fmt: skip
    max_stiction_deformation: float = number(
        "MAX_STICTION_DEFORMATION", unit="length", default=0.01,
        help="creep at which the surfaces break away",
    )  # fmt: skip
    pin_radius: float = _arm(
        "PIN_RADIUS", 1.0, "REVOLUTE, CYLINDRICAL, HOOKE, UNIVERSAL: radius of the pin"
    )
    ball_radius: float = _arm("BALL_RADIUS", 1.0, "SPHERICAL: radius of the ball")
    friction_arm: float = _arm(
        "FRICTION_ARM", 1.0, "REVOLUTE, HOOKE, UNIVERSAL: arm of the axial force's friction"
    )
    bending_reaction_arm: float = _arm(
        "BENDING_REACTION_ARM", 1.0,
        "REVOLUTE, HOOKE, UNIVERSAL: arm that turns a bending moment into a force",
    )  # fmt: skip
    reaction_arm: float = _arm(
        "REACTION_ARM", 1.0, "TRANSLATIONAL: arm that turns a torque about z into a force"
    )
    initial_overlap: float = _arm(
        "INITIAL_OVERLAP", 1000.0, "TRANSLATIONAL, CYLINDRICAL: length over which the parts overlap"
    )
    overlap_delta: str = choice(
        "OVERLAP_DELTA", options=("CONSTANT", "INCREASE", "DECREASE"), default="CONSTANT",
        help="what the overlap does when I moves along +z of J",
    )  # fmt: skip
    yoke: str = choice(
        "YOKE", options=("I_YOKE", "J_YOKE"), default="I_YOKE",
        help="HOOKE, UNIVERSAL: the arm of the cross that rubs, in the yoke of I or of J",
    )  # fmt: skip
    friction_force_preload: float = number(
        "FRICTION_FORCE_PRELOAD", unit="force", default=0.0,
        help="friction without load: TRANSLATIONAL, CYLINDRICAL",
    )  # fmt: skip
    friction_torque_preload: float = number(
        "FRICTION_TORQUE_PRELOAD", unit="torque", default=0.0,
        help="friction torque without load: all but TRANSLATIONAL",
    )  # fmt: skip
    max_friction_force: float | None = number(
        "MAX_FRICTION_FORCE",
        unit="force",
        help="largest friction force: TRANSLATIONAL, CYLINDRICAL",
    )
    max_friction_torque: float | None = number(
        "MAX_FRICTION_TORQUE", unit="torque", help="largest friction torque: all but TRANSLATIONAL"
    )
    bristle_stiffness_coefficient: float | None = _of_lugre(
        "BRISTLE_STIFFNESS_COEFFICIENT",
        "1/length",
        "k: coefficient per deformation of the bristles",
    )
    damping_coefficient: float | None = _of_lugre(
        "DAMPING_COEFFICIENT", "time/length", "c: coefficient per rate of their deformation"
    )
    viscous_friction_coefficient: float | None = _of_lugre(
        "VISCOUS_FRICTION_COEFFICIENT", "time/length", "f: coefficient per slip"
    )
    velocity_threshold_stribeck: float | None = _of_lugre(
        "VELOCITY_THRESHOLD_STRIBECK", "length/time", "w: slip at which MU_STATIC has decayed"
    )
    decay_exponent_stribeck: float | None = _of_lugre(
        "DECAY_EXPONENT_STRIBECK", "1", "p: exponent of the decay, often 2"
    )
    effect: str = choice(
        "EFFECT", options=("ALL", "STICTION", "SLIDING"), default="ALL", help="regimes that act"
    )
    inputs: tuple[str, ...] = words(
        "INPUTS", options=("ALL", "NONE", *INPUTS), help="loads that cause friction; default ALL"
    )
    inactive: str | None = choice(
        "INACTIVE", "INACTIVE_DURING", options=("STATIC",), help="no friction in statics"
    )

    smooth: float | None = number(
        "SMOOTH", unit="1", inert=True, help="LUGRE: its meaning is not published"
    )

    joints: ClassVar[tuple[str, ...]] = (*SLIDES, *TURNS, "SPHERICAL")
    acts_with: ClassVar[str] = "joint"
    beyond = "moved until its parts no longer overlap"

    def states(self, joint: Joint | None) -> list[str]:
        """Names of the DIFFs that are its creep, made dimensionless by its law."""
        if joint is None or joint.kind not in self.joints or self.effect == "SLIDING":
            return []
        return [f"FRICTION_{self.key}{end}".upper() for end in STATES.get(joint.kind, ("",))]

    def companions(self, deck: Lookup) -> tuple[Statement, ...]:
        """The states of creep."""
        own = Ref("FRICTION", self.key)
        return tuple(
            STATEMENTS["DIFF"](id=id, owner=own, number=n, static_hold=True, spans=self.spans)
            for n, id in enumerate(self.states(deck.find("JOINT", self.joint)))
        )

    def derived(self, model: DrawnModel) -> dict[str, object]:
        """The joint's force and torque on I, which of them count, creep, where the slide began."""
        ref, joint = Ref("JOINT", self.joint), model.element("JOINT", self.joint)
        reaction = tuple(measure("JOINT", ref, component) for component in COMPONENTS)
        counted = set(self.inputs) or {"ALL"}
        began = joint.ictran if joint.kind == "CYLINDRICAL" else joint.ic
        overlaps = joint.kind in SLIDES and self.overlap_delta != "CONSTANT"
        drawn = built_slide(model, joint.i, joint.j) if overlaps else 0.0
        return {
            "reaction": reaction,
            "used": tuple(name for name in INPUTS if counted & {name, "ALL"}),
            "creep": tuple(Call("DIF", (Ref("DIFF", state),)) for state in self.states(joint)),
            "began": float(began[0]) if began and overlaps else drawn,
        }

    def loads(self: Seen, scope: Scope) -> list[Load]:
        """Friction on I and its reaction on J."""
        i, j = self.joint.i, self.joint.j
        freedoms, load = slips(scope, self), normal_load(scope, self)
        found = law(self).regime(scope, self, [each.speed for each in freedoms])
        force, torque = ZERO, ZERO
        for freedom, d, mu in zip(freedoms, found.direction, found.coefficient, strict=True):
            if freedom.radius is None:
                own = preload(self, self.friction_force_preload)
                force = minus(force, scale(mu * load + own * d, freedom.axis))
            else:
                own = preload(self, self.friction_torque_preload)
                torque = minus(torque, scale(freedom.radius * mu * load + own * d, freedom.axis))
        force, torque = (
            capped(force, self.max_friction_force),
            capped(torque, self.max_friction_torque),
        )
        if self.inactive == "STATIC":
            acts = piecewise((0, fn.Eq(scope.mode, STATICS)), otherwise=1)
            force, torque = scale(acts, force), scale(acts, torque)
        return [Load(i, force, torque, j, follows=True)]

    def state_rate(self: Seen, scope: Scope, number: int, state: Symbol) -> Expr:
        """Rate of a component of what its law keeps of creep."""
        slip = [each.speed for each in slips(scope, self)]
        return law(self).creep_rate(scope, self, slip, number, state)

    def values(self: Seen, scope: Scope) -> list[Expr]:
        """Values of ``CHANNELS``."""
        freedoms = slips(scope, self)
        found = law(self).regime(scope, self, [each.speed for each in freedoms])
        at = [each.channel for each in freedoms]
        return [
            *_spread(at, [-mu for mu in found.coefficient]), found.creep_term,
            *_spread(at, [each.speed for each in freedoms]), *_spread(at, found.deformation),
            found.beta,
        ]  # fmt: skip

    @property
    def result_names(self) -> tuple[str, ...]:
        """Force and torque on I along the axes of J, then what the law makes of the slip."""
        return (*super().result_names, *CHANNELS)

    def outputs(self, model: DrawnModel) -> list[Node]:
        """Values of ``result_names``."""
        own, rm = Ref("FRICTION", self.key), Ref("MARKER", model.element("JOINT", self.joint).j)
        numbers = [*COMPONENTS, *range(9, 9 + len(CHANNELS))]
        return [Call("FRICTION", (own, Num(0.0), Num(float(n)), rm)) for n in numbers]


def law(friction: Seen) -> ModuleType:
    """The module of its law, which has ``regime`` and ``creep_rate``."""
    return lugre if friction.formulation == "LUGRE" else stick_slip


def capped(load: Vector, most: Expr | None) -> Vector:
    """A force or torque, shortened to the size ``most`` where it is larger."""
    if most is None:
        return load
    size = norm(load)
    return scale(piecewise((most / size, size > most), otherwise=1, order=0), load)


def _spread(at: Sequence[int], values: Sequence[Expr]) -> list[Expr]:
    """Six values: those of some components, zeros in between."""
    found = dict(zip(at, values, strict=False))
    return [found.get(n, 0) for n in range(6)]


def slips(scope: Scope, friction: Seen) -> list[Freedom]:
    """The ways in which the surfaces slip, with the speed of the surface."""
    i, j, kind = friction.joint.i, friction.joint.j, friction.joint.kind
    w, pin = scope.omega(i, j), friction.pin_radius
    if kind == "SPHERICAL":
        ball = friction.ball_radius
        return [
            Freedom(axis, ball * dot(w, axis), ball, 3 + n) for n, axis in enumerate(scope.axes(i))
        ]
    found = []
    if kind in SLIDES:
        found.append(Freedom(scope.axes(j)[2], relative_velocity(scope, i, j, 2), None, 2))
    if kind != "TRANSLATIONAL":
        axis, number = pin_axis(scope, friction)
        found.append(Freedom(axis, pin * dot(w, axis), pin, 3 + number))
    return found


def pin_axis(scope: Scope, friction: Seen) -> tuple[Vector, int]:
    """Axis of the pin, and which of x y z it is."""
    i, j, kind = friction.joint.i, friction.joint.j, friction.joint.kind
    of_i = friction.yoke == "I_YOKE"
    if kind == "HOOKE":
        return (scope.axes(i)[0], 0) if of_i else (scope.axes(j)[1], 1)
    return scope.axes(i if kind == "UNIVERSAL" and of_i else j)[2], 2


def normal_load(scope: Scope, friction: Seen) -> Expr:
    """N of the table above."""
    kind, used = friction.joint.kind, friction.used
    force = friction.reaction[:3] if "REACTION_FORCE" in used else ZERO
    if kind == "SPHERICAL":
        return norm(force)
    torque, axis = friction.reaction[3:], pin_axis(scope, friction)[0]
    axial, twist = dot(force, axis), dot(torque, axis)
    across = norm(minus(force, scale(axial, axis)))
    bending = norm(minus(torque, scale(twist, axis))) if "BENDING_MOMENT" in used else 0
    if kind in TURNS:
        pressed = across + norm((axial, 0, 0)) * friction.friction_arm / friction.pin_radius
        return pressed + bending / friction.bending_reaction_arm
    if kind == "TRANSLATIONAL" and "TORSIONAL_MOMENT" in used:
        across = across + norm((twist, 0, 0)) / friction.reaction_arm
    return across + bending / overlap(scope, friction)


def overlap(scope: Scope, friction: Seen) -> Expr:
    """X of the table above."""
    sense = {"CONSTANT": 0, "INCREASE": 1, "DECREASE": -1}[friction.overlap_delta]
    if not sense:
        return friction.initial_overlap
    travel = slide(scope, friction.joint.i, friction.joint.j) - friction.began
    left = friction.initial_overlap + sense * travel
    scope.limit(left)
    return left


def preload(friction: Seen, own: Expr) -> Expr:
    """Friction without load."""
    return own if "PRELOAD" in friction.used else 0
