"""A point of contact: what CONTACT brings for each place at which two of its shapes may touch.

On I acts ``N n + F`` at the common point, the opposite on J at the same place; n: normal from J to
I, N and F: normal force and friction of :mod:`adamslite.elements.bases.contact_law`.
"""

from __future__ import annotations

from fractions import Fraction
from math import sqrt
from typing import TYPE_CHECKING, NamedTuple

from adamslite.elements.bases.contact_forms import Form
from adamslite.elements.bases.contact_geometry import touch
from adamslite.elements.bases.contact_law import across, bristle_rate, friction, normal_force
from adamslite.language.expression import Call, Num, Ref
from adamslite.language.function import PRODUCTS, function
from adamslite.language.statement import STATEMENTS, Statement, statement
from adamslite.symbolic.formulas import fn, piecewise
from adamslite.symbolic.scope import ZERO, Load, along_axes, cross, dot, minus, plus, scale

if TYPE_CHECKING:
    from adamslite.elements.bases.contact_geometry import Touch
    from adamslite.language.interfaces import DrawnModel, Key, Lookup
    from adamslite.symbolic.scope import Scope, Vector
    from adamslite.symbolic.types import Expr, Seen, Tree

POINT = "CONTACT_POINT"
AXES = ("X", "Y", "Z")
# Damping that joins the branches of POISSON, times e in sqrt(PENALTY mass): the coefficient e of
# restitution is exact but for a share of 1/JOINING^2, as long as it is above LEAST.
JOINING, LEAST = 100.0, 0.1


class Law(NamedTuple):
    """Numbers of the normal force and of friction."""

    kind: str
    stiffness: float
    damping: float = 0.0
    exponent: float = 1.0
    dmax: float = 0.0
    restitution: float = 1.0
    mu_static: float = 0.0
    mu_dynamic: float = 0.0
    vs: float = 0.0
    vd: float = 0.0
    deformation: float = 0.0


@statement(POINT, internal=True)
class ContactPoint(Statement):
    """Two forms that may touch at one point.

    Parameters
    ----------
    contact : int or str
        Key of the CONTACT it belongs to.
    first, second : Form
        The forms on I and J.
    turned : bool
        I is on the side of JGEOM.
    law : Law
    """

    contact: Key = 0
    first: Form = Form("", 0, ())
    second: Form = Form("", 0, ())
    turned: bool = False
    law: Law = Law("", 0.0)

    @property
    def label(self) -> str:
        """What messages call it."""
        return f"CONTACT/{self.contact}"

    @property
    def states(self) -> tuple[str, ...]:
        """Names of the DIFFs that are the bristles' deflection."""
        if not self.law.deformation:
            return ()
        return tuple(f"{self.key}_{axis}" for axis in AXES)

    def companions(self, deck: Lookup) -> tuple[Statement, ...]:
        """The bristles' deflection along the axes of J."""
        own = Ref(POINT, self.key)
        return tuple(
            STATEMENTS["DIFF"](
                id=state, function=Call(RATE, (own, Num(float(n)))), spans=self.spans
            )
            for n, state in enumerate(self.states)
        )

    def derived(self, model: DrawnModel) -> dict[str, object]:
        """Everything the physics needs."""
        law = self.law
        if law.kind == "POISSON":
            law = law._replace(damping=_joining(law, _reduced_mass(self, model)))
        numbers: dict[str, object] = {
            name: value for name, value in law._asdict().items() if name != "kind"
        }
        if law.exponent in PRODUCTS:
            numbers["exponent"] = Fraction(law.exponent)
        return numbers | {
            "law": law.kind,
            "rubs": "yes" if law.vs else None,
            "first": self.first.kind,
            "second": self.second.kind,
            "first_sizes": self.first.sizes,
            "second_sizes": self.second.sizes,
            "i": Ref("MARKER", self.first.marker),
            "j": Ref("MARKER", self.second.marker),
            "turned": "yes" if self.turned else None,
            "bristle": tuple(Call("DIF", (Ref("DIFF", state),)) for state in self.states),
        }

    def depth(self: Seen, scope: Scope) -> Expr:
        """Penetration, negative while there is a gap."""
        return touch(scope, self).depth

    def loads(self: Seen, scope: Scope) -> list[Load]:
        """The force on I at the common point; the opposite on J at the same place."""
        found = touch(scope, self)
        speed = _relative_velocity(scope, self, found)
        scope.touch(found.overlap > 0, found.overlap is found.depth)
        load = normal_force(self, found, -dot(speed, found.normal))
        force, torque = scale(load, found.normal), ZERO
        if self.rubs:
            slip = across(speed, found.normal)
            bristle = _bristle(scope, self, found) if self.bristle else None
            force = plus(force, friction(self, load, slip, bristle))
        if self.rubs or not _is_central(self):
            torque = cross(found.arm, force)
        return [Load(self.i, force, torque, self.j, follows=True)]


def _joining(law: Law, mass: float) -> float:
    """The damping that joins sinking in and coming out."""
    e = law.restitution
    return (1.0 - e * e) * JOINING / max(e, LEAST) * sqrt(law.stiffness * mass)


def _reduced_mass(point: ContactPoint, model: DrawnModel) -> float:
    """1/(1/m_I + 1/m_J) of the parts that have mass."""
    places = (model.marker(point.first.marker), model.marker(point.second.marker))
    masses = (model.bodies[each.body].mass for each in places if each.kind != "ground")
    inverse = sum(1.0 / mass for mass in masses if mass > 0.0)
    return 1.0 / inverse if inverse else 0.0


def _is_central(point: Seen) -> bool:
    """Whether the normal passes through the marker of I: nothing turns it."""
    return bool(point.first == "BALL")


def _relative_velocity(scope: Scope, point: Seen, found: Touch) -> Vector:
    """Of I, less that of J, at the common point."""
    i, j = point.i, point.j
    from_j = plus(scope.position(i, j), found.arm)
    turning = minus(cross(scope.omega(i), found.arm), cross(scope.omega(j), from_j))
    return plus(scope.velocity(i, j), turning)


def _bristle(scope: Scope, point: Seen, found: Touch) -> Vector:
    """The deflection across the normal, in ground axes."""
    x, y, z = point.bristle
    return across(along_axes(scope.axes(point.j), (x, y, z)), found.normal)


RATE = "CONTACT_BRISTLE"
STATICS = (4.5, 6.5)


@function(RATE, "id:contact_point axis:constant{0..2}", internal=True)
def contact_bristle(scope: Scope, id: Tree, axis: int) -> Expr:
    """Rate of the bristles' deflection along an axis of J; in statics they are straight."""
    point = scope.statement(id)
    found = touch(scope, point)
    slip = across(_relative_velocity(scope, point, found), found.normal)
    bristle = _bristle(scope, point, found)
    rate = bristle_rate(point, slip, bristle, found.overlap > 0)
    straight, moving = -point.bristle[axis], dot(rate, scope.axes(point.j)[axis])
    at_rest = fn.And(scope.mode > STATICS[0], scope.mode < STATICS[1])
    return piecewise((straight, at_rest), otherwise=moving)
