"""CURVE: a smooth curve through given points.

Equation (s from 0 at the first point to 1 at the last, proportional to the length of the chords)::

    c(s) = cubic spline through the rows of MATRIX     OPEN: third derivative continuous next to the
                                                       ends; CLOSED: periodic, the last point being
                                                       the first again
    CONTROL_POINTS: the cubic B-spline of the rows, over equal steps of s
    the same through points that a routine gives       FUNCTION=USER(...), MINPAR <= alpha <= MAXPAR
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from adamslite.elements.bases.arguments import routine_name
from adamslite.elements.bases.spline_curve import guided, through
from adamslite.elements.bases.traced_curve import traced_points
from adamslite.language.statement import (
    Statement,
    choice,
    expression,
    integer,
    number,
    reference,
    statement,
)
from adamslite.symbolic.interpolant import interpolant

if TYPE_CHECKING:
    from adamslite.elements.bases.spline_curve import SplineCurve
    from adamslite.language.expression import Node
    from adamslite.language.interfaces import DrawnModel
    from adamslite.symbolic.interpolant import Interpolant


@statement("CURVE", data=True)
class Curve(Statement):
    """Geometry for PTCV, in the axes of the marker to which the curve is fixed.

    To its routine ``--user`` binds six numbers, the first and the last point of a straight line, or
    a function of Python, which returns x, y, z for (parameters, alpha).
    """

    alternatives = ((("matrix",), ("function", "routine", "minpar", "maxpar")),)

    form: str = choice(options=("OPEN", "CLOSED"), default="OPEN", help="whether it has ends")
    matrix: int | str | None = reference("MATRIX", to="MATRIX", help="points, one row x, y, z each")
    points: str = choice(
        options=("CURVE_POINTS", "CONTROL_POINTS"), default="CURVE_POINTS",
        help="what the rows of MATRIX are: the curve goes through them, or is guided by them",
    )  # fmt: skip
    order: int = integer("ORDER", default=4, help="degree of the pieces plus one; always 4")

    function: Node | None = expression(
        "FUNCTION", unit="length", help="USER(...), a routine that gives its points"
    )
    routine: str | None = routine_name()
    minpar: float = number("MINPAR", unit="1", default=-1.0, help="alpha at the first point")
    maxpar: float = number("MAXPAR", unit="1", default=1.0, help="alpha at the last point")

    def spline(self, model: DrawnModel) -> SplineCurve:
        """The curve itself."""
        closed = self.form == "CLOSED"
        if self.function is not None:
            traced = traced_points(self.function)
            return model.once(("CURVE", self.key), lambda: through(traced, closed))
        assert self.matrix is not None  # a rule requires it
        points = model.element("MATRIX", self.matrix)
        made = guided if self.points == "CONTROL_POINTS" else through
        return model.once(("CURVE", self.key), lambda: made(points.table, closed))

    def over_alpha(self, model: DrawnModel) -> Interpolant:
        """The curve over (alpha - first)/(last - first): a routine has points at equal steps."""
        spline = self.spline(model)
        if self.function is None:
            return spline.table
        points = traced_points(self.function)
        alpha = [n / (len(points) - 1) for n in range(len(points))]
        kind = "periodic" if spline.closed else "not-a-knot"
        if spline.closed:
            points[-1] = points[0]
        return interpolant(alpha, points, kind, "piece")

    def derived(self, model: DrawnModel) -> dict[str, object]:
        """The curve as a table over its length and over alpha, and the length of its chords."""
        spline = self.spline(model)
        routine = self.function is not None
        return {
            "over_alpha": model.once(("CURVE", self.key, "a"), lambda: self.over_alpha(model)),
            "first": self.minpar if routine else -1.0,
            "last": self.maxpar if routine else 1.0,
            "table": spline.table,
            "length": spline.length,
            "closed": "yes" if self.form == "CLOSED" else None,
        }
