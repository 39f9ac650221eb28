"""PTCV: a point that stays on a curve.

Equation (``d = r_I - r_RM``, c the curve in the axes of RM, s its parameter, an unknown)::

    d - c_x(s) x_RM - c_y(s) y_RM - c_z(s) z_RM = 0        s = s0 + p / length

The path p is the x coordinate of a massless point of its own (``POINT_MASS/PTCV_id``, y and z kept
at zero), so that it has a velocity and an acceleration like any coordinate.  Its equation of motion
says that the reaction has no component along the curve.  s0 is the point nearest to I in the deck,
or nearest to DISP, from which the posture is then closed.  VELOCITY is |c'| dp/dt / length there.

Sign: the reaction reported acts on I; at the other end (jflag 1) the force acts on the part of RM,
torque about RM's origin::

           I o---> reaction
        ~~~~~~~~~~~ curve, RM
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from adamslite.elements.bases.constraint import Constraint
from adamslite.elements.bases.curve_point import carrier_name, carriers, parameter, point
from adamslite.elements.bases.joint_coordinates import pose
from adamslite.language.expression import Ref
from adamslite.language.statement import Statement, number, reference, statement, vector
from adamslite.symbolic.scope import along_axes, minus

if TYPE_CHECKING:
    from adamslite.language.interfaces import DrawnModel, Lookup
    from adamslite.symbolic.scope import Scope
    from adamslite.symbolic.types import Expr, Seen


@statement("PTCV")
class Ptcv(Constraint, Statement):
    """Keeps marker I on a CURVE that is fixed to marker RM, without friction."""

    i: int | str = reference("I", to="MARKER", required=True, help="marker that slides")
    jfloat: int | str | None = reference(
        "JFLOAT", to="MARKER", help="floating marker on the part of RM"
    )
    curve: int | str = reference("CURVE", to="CURVE", required=True, help="the curve")
    j: int | str = reference("RM", to="MARKER", required=True, help="marker the curve is fixed to")
    disp: tuple[float, ...] | None = vector(
        "DISPLACEMENT", size=3, unit="length", start=True,
        help="point of the curve at the start, or near it, in the axes of ICM",
    )  # fmt: skip
    velocity: float | None = number(
        "VELOCITY", unit="length/time", start=True,
        help="speed of I along the curve at the start, positive towards its last point",
    )  # fmt: skip
    icm: int | str | None = reference(
        "ICM", to="MARKER", start=True, help="marker that DISPLACEMENT refers to; RM unless given"
    )

    @property
    def n_rows(self) -> int:
        """Three for the point, two for the unused coordinates of the parameter."""
        return 5

    @property
    def row_names(self) -> tuple[str, ...]:
        """What each row keeps at zero."""
        away = tuple(f"distance from the curve along {axis}" for axis in "xyz")
        return (*away, *(f"unused {axis} of the parameter" for axis in "yz"))

    @property
    def slider(self) -> str:
        """Name of the massless point that carries the parameter."""
        return carrier_name(self)

    def companions(self, deck: Lookup) -> tuple[Statement, ...]:
        """The massless point and a marker on it."""
        return carriers(self.slider, self, kept=self.disp is not None)

    def derived(self, model: DrawnModel) -> dict[str, object]:
        """The parameter of the drawn posture, and what carries it."""
        start = model.once(("PTCV", self.key), lambda: self._nearest(model))
        return {"path": Ref("MARKER", self.slider.upper()), "start": start}

    def rate(self, model: DrawnModel, path: float) -> float:
        """dp/dt at the path p for VELOCITY."""
        import numpy as np

        spline = model.element("CURVE", self.curve).spline(model)
        start = model.once(("PTCV", self.key), lambda: self._nearest(model))
        slope = spline.at(np.array([start + path / spline.length]), 1)[0]
        return float((self.velocity or 0.0) * spline.length / np.linalg.norm(slope))

    def _nearest(self, model: DrawnModel) -> float:
        """Parameter of the curve's point that is nearest to I, or to DISP."""
        r, _ = pose(model, self.i)
        if self.disp is not None:
            origin, axes = pose(model, self.j if self.icm is None else self.icm)
            r = origin + axes @ self.disp
        origin, axes = pose(model, self.j)
        return model.element("CURVE", self.curve).spline(model).nearest((r - origin) @ axes)

    def constraints(self: Seen, scope: Scope) -> list[Expr]:
        """Rows that vanish."""
        s, unused = parameter(scope, self.path, self.start, self.curve)
        placed = along_axes(scope.axes(self.j), point(self.curve, s))
        return [*minus(scope.position(self.i, self.j), placed), *unused]
