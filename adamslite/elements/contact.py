"""CONTACT: shapes of two parts push each other apart where they overlap.

Equations, for each point of contact, with the depth d of penetration, its rate d', and the slip v
at the common point across the normal::

    normal force on I, along the normal from J to I, where d > 0:
      IMPACT    N = max(0, STIFFNESS d^EXPONENT + STEP(d, 0, 0, DMAX, DAMPING) d')
      POISSON   N = PENALTY d                             sinking in
                N = max(e^2 PENALTY d, PENALTY d + c d')  coming out, e = RESTITUTION_COEFFICIENT

    friction on I
      F = -mu(|v|) N v/|v|
      mu = MU_STATIC u (3 - u^2)/2,  u = |v|/vs      up to vs = STICTION_TRANSITION_VELOCITY
           STEP from MU_STATIC to MU_DYNAMIC         up to vd = FRICTION_TRANSITION_VELOCITY
           MU_DYNAMIC                                beyond

Sign: a normal force pushes apart; the opposites act on J at the same place, in the middle of the
overlap, so that no momentum is gained or lost::

         .---.
        (  I  )    N on I ^           shapes on one side are on one part;
    =====`---'======      |           each shape of IGEOM meets each of JGEOM
           J       N on J v

Points and depths (r: radius of the ball; K acts at **each** point)::

    ball - PLANE             r - height of the centre
    ball - ball              r1 + r2 - distance of the centres
    ball - BOX, - CYLINDER   r - distance of the centre; r + depth of a centre that is inside
    BOX - PLANE              at each of the 8 corners, how far it is below
    CYLINDER, FRUSTUM        at the lowest point of either edge, how far it is below; it moves to
      - PLANE                the centre of an end that is level within 0.001 rad

A ball is an ELLIPSOID with equal scales, or a POINT (r = 0).  A PLANE has no borders and is solid
below: its XMIN ... YMAX are those of the drawing.  A point has no size: nothing resists a spin
about the normal.

POISSON: coming out gives back e^2 of the work of sinking in, so a free impact ends with e times its
speed, whatever the masses, the speed and PENALTY.  c = 100 (1 - e^2)/e sqrt(PENALTY m), m: reduced
mass of both parts, only joins the branches, for bodies that lie still; it changes e by 1e-4 of it
at most, more below e = 0.1.

STICTION=ON: below vs the surfaces hold a load up to MU_STATIC N by bristles, which yield by
MAX_STICTION_DEFORMATION at most; their deflection b is a state of three components (along the axes
of J), with D = MAX_STICTION_DEFORMATION::

    F = -N (w mu v/|v| + (1 - w) MU_STATIC (b + (1 - b^2) v/vs (3 - u^2)/2)),  w = u^4 (3 - 2 u^2)
    D db/dt = v' - s |v'| b,  v' = v/sqrt(1 + u^2),  s from 0 at |b| = 0.9 to 1 at |b| = 1

Without it a body at rest under load creeps, slower than vs.  In a static analysis nothing slips
and there is no friction, with ON as with DYNAMICSONLY.

Results: incidents is the number of points that touch, depth the greatest penetration.

What differs from ADAMS, or is not documented: ADAMS has one force for each overlap of two solids,
from its volume, where a box or a cylinder has several points here, with STIFFNESS at each.  Its
laws of POISSON and of STICTION are not published.
Source: Adams/Solver statement CONTACT; the curve of friction from the help of Adams/View.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from itertools import product
from typing import TYPE_CHECKING, Any, ClassVar

from adamslite.elements.bases.contact_forms import meetings
from adamslite.elements.bases.contact_point import POINT, ContactPoint, Law
from adamslite.elements.bases.wrench import Wrench
from adamslite.language.expression import Ref, measure
from adamslite.language.statement import (
    Statement,
    choice,
    flag,
    number,
    references,
    statement,
    text,
)

if TYPE_CHECKING:
    from adamslite.elements.bases.contact_forms import Meeting
    from adamslite.language.expression import Node
    from adamslite.language.interfaces import DrawnModel, Key, Lookup

# Components of CONTACT(): how many points touch, the greatest depth.
STATE = (9, 10)


@statement(
    "CONTACT",
    planned=("FRICTION_FUNCTION", "NORMAL_FUNCTION"),
)  # fmt: skip
class Contact(Wrench, Statement):
    """Contact between shapes that GRAPHICS describe."""

    igeom: tuple[Key, ...] = references(
        "IGEOM", to="GRAPHICS", required=True, help="shapes on the part the force is reported on"
    )
    jgeom: tuple[Key, ...] = references(
        "JGEOM", to="GRAPHICS", required=True, help="shapes on the other part"
    )
    type: str | None = text("TYPE", inert=True, help="kinds of the shapes, which decide themselves")
    law: str = choice(options=("IMPACT", "POISSON"), required=True, help="law of normal force")
    stiffness: float | None = number(
        "STIFFNESS", unit="force/length^EXPONENT", help="IMPACT: stiffness"
    )
    exponent: float | None = number("EXPONENT", unit="1", help="IMPACT: power of the depth")
    damping: float | None = number(
        "DAMPING", unit="force time/length", help="IMPACT: damping from the depth DMAX on"
    )
    dmax: float | None = number("DMAX", unit="length", help="IMPACT: depth of full damping")
    penalty: float | None = number("PENALTY", unit="force/length", help="POISSON: stiffness")
    restitution_coefficient: float | None = number(
        "RESTITUTION_COEFFICIENT", unit="1", help="POISSON: speed after an impact over that before"
    )
    augmented_lagrangian_formulation: bool = flag(
        "AUGMENTED_LAGRANGIAN_FORMULATION", inert=True,
        help="POISSON: as if PENALTY were infinite; restitution is that anyway",
    )  # fmt: skip
    coulomb_friction: str = choice(
        "COULOMB_FRICTION", options=("ON", "OFF", "DYNAMICSONLY", "DYNAMICS_ONLY"),
        default="OFF",
        help="whether there is friction; not in statics in any case",
    )  # fmt: skip
    mu_static: float | None = number("MU_STATIC", unit="1", help="coefficient at rest")
    mu_dynamic: float | None = number("MU_DYNAMIC", unit="1", help="coefficient in motion")
    stiction_transition_velocity: float | None = number(
        "STICTION_TRANSITION_VELOCITY", unit="length/time", help="slip of greatest friction, vs"
    )
    friction_transition_velocity: float | None = number(
        "FRICTION_TRANSITION_VELOCITY", unit="length/time", help="slip from which it slides, vd"
    )
    stiction: str = choice(
        "STICTION", options=("ON", "OFF"), default="OFF", help="whether it holds at rest"
    )
    max_stiction_deformation: float = number(
        "MAX_STICTION_DEFORMATION", unit="length", default=0.01,
        help="STICTION=ON: deformation at which it slips",
    )  # fmt: skip

    normal_routine: str | None = text(
        "NORMAL_ROUTINE", inert=True, help="routine of NORMAL_FUNCTION, without which it is idle"
    )
    friction_routine: str | None = text(
        "FRICTION_ROUTINE", inert=True, help="the same of FRICTION_FUNCTION"
    )

    laws: ClassVar[dict[str, tuple[str, ...]]] = {
        "IMPACT": ("stiffness", "exponent", "damping", "dmax"),
        "POISSON": ("penalty", "restitution_coefficient"),
    }
    """What each law needs."""
    rubbing: ClassVar[tuple[str, ...]] = (
        "mu_static", "mu_dynamic", "stiction_transition_velocity", "friction_transition_velocity",
    )  # fmt: skip
    """What friction needs."""

    @property
    def rubs(self) -> bool:
        """Whether there is friction."""
        return self.coulomb_friction != "OFF"

    def bringing(self, deck: Lookup) -> int:
        """Points, and the three states of bristles that each may have."""
        return 4 * len(self.igeom) * len(self.jgeom)

    def companions(self, deck: Lookup) -> tuple[Statement, ...]:
        """The points at which its shapes may touch, with their states."""
        points = self._points(deck.find)
        return tuple(each for point in points for each in (point, *point.companions(deck)))

    def _points(self, find: Callable[[str, Key], Any]) -> list[ContactPoint]:
        """Its points of contact; ``find`` gives a statement by keyword and id."""
        if not (self.igeom and self.jgeom and self.law in self.laws) or self.missing:
            return []
        law = self._law()
        found = enumerate(self._meetings(find), 1)
        return [
            ContactPoint(
                id=f"CONTACT_{self.key}_{n}", contact=self.key, first=first, second=second,
                turned=turned, law=law, spans=self.spans,
            )
            for n, (first, second, turned) in found
        ]  # fmt: skip

    def _meetings(self, find: Callable[[str, Key], Any]) -> Iterator[Meeting]:
        for i, j in product(self.igeom, self.jgeom):
            first, second = find("GRAPHICS", i), find("GRAPHICS", j)
            if not (first is None or second is None or first.missing or second.missing):
                yield from meetings(first, second)

    @property
    def missing(self) -> tuple[str, ...]:
        """Fields that its laws need and that are not given."""
        needed = self.laws.get(self.law, ()) + self.rubbing * self.rubs
        return tuple(field for field in needed if getattr(self, field) is None)

    def _law(self) -> Law:
        """The numbers of its laws."""
        normal = {
            "IMPACT": {"stiffness": self.stiffness, "damping": self.damping,
                       "exponent": self.exponent, "dmax": self.dmax},
            "POISSON": {"stiffness": self.penalty, "restitution": self.restitution_coefficient},
        }[self.law]  # fmt: skip
        rubbing = {
            "mu_static": self.mu_static, "mu_dynamic": self.mu_dynamic,
            "vs": self.stiction_transition_velocity, "vd": self.friction_transition_velocity,
            "deformation": self.max_stiction_deformation * (self.stiction == "ON"),
        }  # fmt: skip
        numbers = normal | (rubbing if self.rubs else {})
        return Law(self.law, **{name: value or 0.0 for name, value in numbers.items()})

    def derived(self, model: DrawnModel) -> dict[str, object]:
        """Its points, and the marker about which the torque is reported."""
        origin = model.element("GRAPHICS", self.igeom[0]).marker
        points = tuple(Ref(POINT, each.key) for each in self._points(model.element))
        return {"points": points, "origin": Ref("MARKER", origin)}

    @property
    def result_names(self) -> tuple[str, ...]:
        """Force and torque on I, ground axes, torque about the marker of the first shape of IGEOM;
        the number of points that touch; the greatest depth.
        """
        return (*super().result_names, "incidents", "depth")

    def outputs(self, model: DrawnModel) -> list[Node]:
        """Values of ``result_names``."""
        own = Ref(self.keyword, self.key)
        further = (measure(self.keyword, own, component) for component in STATE)
        return [*super().outputs(model), *further]
