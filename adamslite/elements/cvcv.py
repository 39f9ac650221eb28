"""CVCV: a curve that slides on another one and stays tangent to it.

Equation (``d = r_IRM - r_JRM``; c_i, c_j the curves in the axes of IRM and JRM, s_i and s_j their
parameters, unknowns; t = dc/ds)::

    d + c_i(s_i) in IRM - c_j(s_j) in JRM = 0                  both curves meet in one point
    t_i(s_i) . (z_JRM x t_j(s_j)) = 0                          and have one tangent there

The parameters are paths of massless points (``POINT_MASS/CVCV_id_I``, ``CVCV_id_J``), as that of a
PTCV.  The curves are plane: z of their points is zero.  In a plane mechanism one freedom is taken;
the third of the rows above is then held by the joints already.

At the start the curves touch where, in the deck, they have a common normal and are closest, or next
to IDISP and JDISP.  It is a constraint of both signs: it pulls, too, where a contact would open.

Sign: the reaction reported acts on the part of IRM, torque about the origin of IRM; it has no
component along the common tangent::

        ( curve i, IRM )
       ~~~~~~~~x~~~~~~~~~~ curve j, JRM
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from adamslite.elements.bases.constraint import Constraint
from adamslite.elements.bases.curve_contact import touching
from adamslite.elements.bases.curve_point import carrier_name, carriers, parameter, point
from adamslite.elements.bases.joint_coordinates import pose
from adamslite.language.expression import Ref
from adamslite.language.statement import Statement, reference, statement, vector
from adamslite.symbolic.scope import along_axes, dot, minus, plus

if TYPE_CHECKING:
    from adamslite.language.interfaces import DrawnModel, Lookup
    from adamslite.symbolic.scope import Scope
    from adamslite.symbolic.types import Expr, Seen


def _curve(side: str) -> int | str:
    return reference(f"{side}CURVE", to="CURVE", required=True, help=f"curve {side.lower()}")


def _marker(side: str) -> int | str:
    return reference(
        f"{side}RM",
        to="MARKER",
        required=True,
        help=f"marker that curve {side.lower()} is fixed to",
    )


def _floating(side: str) -> int | str | None:
    return reference(f"{side}FLOAT", to="MARKER", help=f"floating marker on the part of {side}RM")


def _start(side: str) -> tuple[float, ...] | None:
    return vector(
        f"{side}DISPLACEMENT", size=3, unit="length", start=True,
        help=f"point of curve {side.lower()} at the start, or near it, in the axes of {side}ICM",
    )  # fmt: skip


def _start_marker(side: str) -> int | str | None:
    return reference(
        f"{side}ICM", to="MARKER", start=True,
        help=f"marker that {side}DISPLACEMENT refers to; {side}RM unless given",
    )  # fmt: skip


@statement("CVCV")
class Cvcv(Constraint, Statement):
    """Keeps two curves in touch, as a cam and its follower, without friction."""

    icurve: int | str = _curve("I")
    jcurve: int | str = _curve("J")
    i: int | str = _marker("I")
    j: int | str = _marker("J")
    ifloat: int | str | None = _floating("I")
    jfloat: int | str | None = _floating("J")
    idisp: tuple[float, ...] | None = _start("I")
    jdisp: tuple[float, ...] | None = _start("J")
    iicm: int | str | None = _start_marker("I")
    jicm: int | str | None = _start_marker("J")

    @property
    def n_rows(self) -> int:
        """Three for the point, one for the tangent, two for each parameter."""
        return 8

    @property
    def row_names(self) -> tuple[str, ...]:
        """What each row keeps at zero."""
        away = tuple(f"distance of the curves along {axis}" for axis in "xyz")
        unused = (f"unused {axis} of the parameter of {n}" for n in "ij" for axis in "yz")
        return (*away, "angle between the tangents", *unused)

    def companions(self, deck: Lookup) -> tuple[Statement, ...]:
        """The massless points and markers on them."""
        starts = {"I": self.idisp, "J": self.jdisp}
        made = (
            carriers(carrier_name(self, side), self, kept=place is not None)
            for side, place in starts.items()
        )
        return tuple(each for pair in made for each in pair)

    def derived(self, model: DrawnModel) -> dict[str, object]:
        """The parameters of the drawn posture, and what carries them."""
        starts = model.once(("CVCV", self.key), lambda: self._starts(model))
        names = (carrier_name(self, side).upper() for side in "IJ")
        return {"paths": tuple(Ref("MARKER", name) for name in names), "starts": starts}

    def _starts(self, model: DrawnModel) -> tuple[float, float]:
        """Parameters at which the curves touch in the deck."""
        splines = [model.element("CURVE", key).spline(model) for key in (self.icurve, self.jcurve)]
        poses = [pose(model, key) for key in (self.i, self.j)]
        given = []
        for place, icm, home in (
            (self.idisp, self.iicm, self.i),
            (self.jdisp, self.jicm, self.j),
        ):
            origin, axes = pose(model, home if icm is None else icm)
            given.append(None if place is None else origin + axes @ place)
        return touching(splines, poses, given)

    def constraints(self: Seen, scope: Scope) -> list[Expr]:
        """Rows that vanish."""
        places, slopes, unused = [], [], []
        for curve, path, start in zip(
            (self.icurve, self.jcurve), self.paths, self.starts, strict=True
        ):
            s, rest = parameter(scope, path, start, curve)
            places.append(point(curve, s))
            slopes.append(point(curve, s, 1))
            unused += rest
        axes_i, axes_j = scope.axes(self.i), scope.axes(self.j)
        apart = plus(scope.position(self.i, self.j), along_axes(axes_i, places[0]))
        apart = minus(apart, along_axes(axes_j, places[1]))
        x, y, _ = slopes[1]
        across = along_axes(axes_j, (-y, x, 0))
        sine = dot(along_axes(axes_i, slopes[0]), across)
        return [*apart, sine / (self.icurve.length * self.jcurve.length), *unused]
