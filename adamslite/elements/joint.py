"""JOINT: a constraint between two parts.

Equations (``d = r_I - r_J``, axes of the markers, theta: I turned from the deck's posture)::

    SPHERICAL      d = 0
    REVOLUTE       d = 0,  z_I . x_J = 0,  z_I . y_J = 0
    FIXED          d = 0,  axes of I and J parallel
    TRANSLATIONAL  d . x_J = 0,  d . y_J = 0,  axes of I and J parallel
    CYLINDRICAL    d . x_J = 0,  d . y_J = 0,  z_I . x_J = 0,  z_I . y_J = 0
    PLANAR         d . z_J = 0,  z_I . x_J = 0,  z_I . y_J = 0
    HOOKE          d = 0,  x_I . y_J = 0              z along the shafts
    UNIVERSAL      d = 0,  z_I . z_J = 0              z along the arms of the cross
    CONVEL         d = 0,  x_I . y_J = y_I . x_J      z along the shafts, both the same way
                   d = 0,  x_I . y_J = -y_I . x_J     z along the shafts, both away from the joint
                   bent by more than 120 degrees instead: see coordinates.equal_speed
    SCREW          d . z_J - d0 = PITCH theta / (2 pi)         theta about z of J
    RACKPIN        s - s0 = PD/2 theta,  s = -d . z_J          theta about z of I

Sign: the reaction reported is the force and torque on I; the free coordinate is that of I relative
to J along or about z of J.  A positive PITCH is a right-handed screw.  RACKPIN: I is on the pinion,
z its axis; J is on the rack, z along it.  A positive PD drives the rack along +z of J when the
pinion turns about +z of I, and only the rotation **relative to the rack** counts: a rack that is
carried round the pinion winds up.  SCREW and RACKPIN start from the posture of the deck, or where
it draws other joints apart from the one in which these are closed (d0, s0, theta 0), and count full
turns.  The shafts of a CONVEL turn equally fast, in one sense seen along
the line of shafts; which of its two forms applies is decided by the drawn z axes::

          z_I (out of the page)
             .--.
            ( o  )  theta ccw          rack J  ====|====>  z_J,  s
             '--'
"""

from __future__ import annotations

from typing import TYPE_CHECKING, ClassVar

from adamslite.elements.bases.constraint import ON_LINE, PARALLEL, SAME_TURN, TOGETHER, Constraint
from adamslite.elements.bases.joint_coordinates import (
    angle_since,
    built_slide,
    built_turn,
    built_turn_on_rack,
    equal_speed,
    faces_away,
    slide,
    turn,
    turn_on_rack,
)
from adamslite.language.statement import (
    Statement,
    choice,
    number,
    reference,
    statement,
    text,
    vector,
)
from adamslite.symbolic.formulas import fn
from adamslite.symbolic.scope import dot

if TYPE_CHECKING:
    from adamslite.language.interfaces import DrawnModel
    from adamslite.symbolic.scope import Scope
    from adamslite.symbolic.types import Expr, Seen

Initial = tuple[str, str, float | None, float | None]


def _older(key: str, unit: str, help: str) -> float | None:
    """An argument of friction as older versions of ADAMS have it in JOINT."""
    return number(key, unit=unit, inert=True, help=f"older form of FRICTION: {help}")


@statement("JOINT")
class Joint(Constraint, Statement):
    """An ideal joint between markers I and J of two different parts."""

    kind: str = choice(
        options=(
            "CONVEL", "CYLINDRICAL", "FIXED", "HOOKE", "PLANAR", "RACKPIN", "REVOLUTE", "SCREW",
            "SPHERICAL", "TRANSLATIONAL", "UNIVERSAL",
        ),
        required=True, help="a type of joint",
    )  # fmt: skip
    i: int | str = reference("I", to="MARKER", required=True, help="marker on the first part")
    j: int | str = reference("J", to="MARKER", required=True, help="marker on the second part")
    pitch: float | None = number(
        "PITCH", unit="length", help="SCREW: travel of I along z of J in one turn"
    )
    pd: float | None = number("PD", unit="length", help="RACKPIN: pitch diameter of the pinion")
    ic: tuple[float, ...] | None = vector(
        "IC", start=True, size=1, most=2, unit="length or angle, the same per time",
        help="displacement and velocity at the start of the one freedom",
    )  # fmt: skip
    ictran: tuple[float, ...] | None = vector(
        "ICTRAN", start=True, size=1, most=2, unit="length, length per time",
        help="CYLINDRICAL: translation and its velocity at the start",
    )  # fmt: skip
    icrot: tuple[float, ...] | None = vector(
        "ICROT", start=True, size=1, most=2, unit="angle, angle per time",
        help="CYLINDRICAL: rotation and its velocity at the start",
    )  # fmt: skip

    friction: str | None = text(
        "FRICTION", inert=True, help="older form of FRICTION: ON, PRELOAD_ONLY or OFF"
    )
    mu_stat_rot: float | None = _older("MU_STAT_ROT", "1", "coefficient at rest, rotation")
    mu_dyn_rot: float | None = _older("MU_DYN_ROT", "1", "coefficient in rotation")
    mu_stat_trans: float | None = _older("MU_STAT_TRANS", "1", "coefficient at rest, translation")
    mu_dyn_trans: float | None = _older("MU_DYN_TRANS", "1", "coefficient in translation")
    max_fric_rot: float | None = _older("MAX_FRIC_ROT", "torque", "greatest torque")
    max_fric_trans: float | None = _older("MAX_FRIC_TRANS", "force", "greatest force")
    delta_v: float | None = _older("DELTA_V", "length/time", "slip at which friction is greatest")
    maximum_deformation: float | None = _older(
        "MAXIMUM_DEFORMATION", "length", "deformation before slip"
    )
    preload_radial: float | None = _older("PRELOAD_RADIAL", "force", "radial preload")
    preload_axial: float | None = _older("PRELOAD_AXIAL", "force", "axial preload")
    preload_x: float | None = _older("PRELOAD_X", "force", "preload along x")
    preload_y: float | None = _older("PRELOAD_Y", "force", "preload along y")
    inner_radius: float | None = _older("INNER_RADIUS", "length", "inner radius of the bearing")
    outer_radius: float | None = _older("OUTER_RADIUS", "length", "outer radius of the bearing")
    height: float | None = _older("HEIGHT", "length", "height of the slider")
    width: float | None = _older("WIDTH", "length", "width of the slider")

    rows: ClassVar[dict[str, int]] = {
        "CONVEL": 4, "CYLINDRICAL": 4, "FIXED": 6, "HOOKE": 4, "PLANAR": 3, "RACKPIN": 1,
        "REVOLUTE": 5, "SCREW": 1, "SPHERICAL": 3, "TRANSLATIONAL": 5, "UNIVERSAL": 4,
    }  # fmt: skip
    free: ClassVar[dict[str, tuple[str, ...]]] = {
        "CYLINDRICAL": ("TRANSLATION", "ROTATION"),
        "REVOLUTE": ("ROTATION",),
        "TRANSLATIONAL": ("TRANSLATION",),
    }

    @property
    def n_rows(self) -> int:
        """Constraint equations of this joint."""
        return self.rows[self.kind]

    @property
    def counts_from_start(self) -> bool:
        """Whether it holds what has been turned and travelled since the start."""
        return self.kind in ("SCREW", "RACKPIN")

    @property
    def row_names(self) -> tuple[str, ...]:
        """What each row keeps at zero."""
        return {
            "CONVEL": (*TOGETHER, "equal speed"),
            "CYLINDRICAL": ON_LINE + PARALLEL,
            "FIXED": TOGETHER + PARALLEL + SAME_TURN,
            "HOOKE": TOGETHER + SAME_TURN,
            "PLANAR": ("offset along z_J", *PARALLEL),
            "RACKPIN": ("travel against turn",),
            "REVOLUTE": TOGETHER + PARALLEL,
            "SCREW": ("travel against turn",),
            "SPHERICAL": TOGETHER,
            "TRANSLATIONAL": ON_LINE + PARALLEL + SAME_TURN,
            "UNIVERSAL": (*TOGETHER, "right angle (z_I . z_J)"),
        }[self.kind]

    @property
    def coordinates(self) -> tuple[str, ...]:
        """The freedoms that have a name: TRANSLATION along and ROTATION about z of J."""
        return self.free.get(self.kind, ())

    def initial(self) -> list[Initial]:
        """(field, freedom, displacement, velocity) requested at the start; None where free."""
        starts = {"ictran": "TRANSLATION", "icrot": "ROTATION"}
        if len(self.coordinates) == 1:
            starts = {"ic": self.coordinates[0]}
        given = ((field, freedom, getattr(self, field)) for field, freedom in starts.items())
        return [(field, name, *(*values, None)[:2]) for field, name, values in given if values]

    def derived(self, model: DrawnModel) -> dict[str, object]:
        """From the posture the deck draws: where SCREW and RACKPIN start, how CONVEL faces."""
        if self.kind == "SCREW":
            found = built_turn(model, self.i, self.j)
        elif self.kind == "RACKPIN":
            found = built_turn_on_rack(model, self.i, self.j)
        else:
            away = self.kind == "CONVEL" and faces_away(model, self.i, self.j)
            return {"opposed": "yes" if away else None}
        return {"slid": built_slide(model, self.i, self.j), "turned": found}

    #: Of CONVEL.
    beyond = (
        "bent to within 5 degrees of its fold, where its shafts lie on each other: its twist and "
        "reactions are hardly determined there"
    )

    def constraints(self: Seen, scope: Scope) -> list[Expr]:
        """Rows that vanish: positions first, then directions."""
        i, j = self.i, self.j
        if self.kind == "SCREW":
            angle = angle_since(scope, turn(scope, i, j), self.turned, ("turn", i, j))
            return [slide(scope, i, j) - self.slid - self.pitch / (2 * fn.pi) * angle]
        if self.kind == "RACKPIN":
            rotation = turn_on_rack(scope, i, j)
            angle = angle_since(scope, rotation, self.turned, ("turn on rack", i, j))
            return [self.slid - slide(scope, i, j) - self.pd / 2 * angle]
        together = scope.position(i, j)
        (xi, _, zi), (xj, yj, zj) = scope.axes(i), scope.axes(j)
        on_line = [dot(together, xj), dot(together, yj)]
        parallel = [dot(zi, xj), dot(zi, yj)]
        same_turn = [dot(xi, yj)]
        if self.kind == "CONVEL":
            return [*together, equal_speed(scope, i, j, bool(self.opposed))]
        return {
            "CYLINDRICAL": on_line + parallel,
            "FIXED": [*together, *parallel, *same_turn],
            "HOOKE": [*together, *same_turn],
            "PLANAR": [slide(scope, i, j), *parallel],
            "REVOLUTE": [*together, *parallel],
            "SPHERICAL": [*together],
            "TRANSLATIONAL": on_line + parallel + same_turn,
            "UNIVERSAL": [*together, dot(zi, zj)],
        }[self.kind]
