"""PTCV: a point that stays on a curve.

Equation (``d = r_I - r_RM``, c the curve in the axes of RM, s its parameter, an unknown)::

    d - c_x(s) x_RM - c_y(s) y_RM - c_z(s) z_RM = 0        s = s0 + p / length

The path p is the x coordinate of a massless point of its own (``POINT_MASS/PTCV_id``, y and z kept
at zero), so that it has a velocity and an acceleration like any coordinate.  Its equation of motion
says that the reaction has no component along the curve.  s0 is the point nearest to I in the deck.

Sign: the reaction reported acts on I; at the other end (jflag 1) the force acts on the part of RM,
torque about RM's origin::

           I o---> reaction
        ~~~~~~~~~~~ curve, RM
"""

from __future__ import annotations

from adamslite.elements.bases.constraint import Constraint
from adamslite.elements.bases.joint_coordinates import pose
from adamslite.language.expression import Ref
from adamslite.language.interfaces import DrawnModel, Lookup
from adamslite.language.statement import STATEMENTS, Statement, reference, statement
from adamslite.symbolic.scope import ORIGIN, Scope, along_axes, minus
from adamslite.symbolic.sympy_nodes import floor, lookup
from adamslite.symbolic.types import Expr, Seen


@statement("PTCV", planned=("DISPLACEMENT", "VELOCITY", "IC"))
class Ptcv(Constraint, Statement):
    """Keeps marker I on a CURVE that is fixed to marker RM, without friction."""

    i: int | str = reference("I", to="MARKER", required=True, help="marker that slides")
    jfloat: int | str | None = reference(
        "JFLOAT", to="MARKER", help="floating marker on the part of RM"
    )
    curve: int | str = reference("CURVE", to="CURVE", required=True, help="the curve")
    j: int | str = reference("RM", to="MARKER", required=True, help="marker the curve is fixed to")

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
        return f"PTCV_{self.key}"

    def companions(self, deck: Lookup) -> tuple[Statement, ...]:
        """The massless point and a marker on it."""
        point = STATEMENTS["POINT_MASS"](id=self.slider, mass=0.0, spans=self.spans)
        marker = STATEMENTS["MARKER"](id=self.slider, point_mass=point.key, spans=self.spans)
        return (point, marker)

    def derived(self, model: DrawnModel) -> dict[str, object]:
        """The parameter of the drawn posture, and what carries it."""
        start = model.once(("PTCV", self.key), lambda: self._nearest(model))
        return {"path": Ref("MARKER", self.slider.upper()), "start": start}

    def _nearest(self, model: DrawnModel) -> float:
        """Parameter of the curve's point that is nearest to I."""
        (r, _), (origin, axes) = pose(model, self.i), pose(model, self.j)
        return model.element("CURVE", self.curve).spline(model).nearest((r - origin) @ axes)

    def constraints(self: Seen, scope: Scope) -> list[Expr]:
        """Rows that vanish."""
        p, *unused = scope.position(self.path, ORIGIN)
        s = self.start + p / self.curve.length
        if self.curve.closed:
            s = s - floor(s)
        point = tuple(lookup(self.curve.table, s, component) for component in range(3))
        placed = along_axes(scope.axes(self.j), point)
        return [*minus(scope.position(self.i, self.j), placed), *unused]
