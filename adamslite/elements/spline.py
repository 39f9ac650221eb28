"""SPLINE: a table of numbers, as a curve or as a family of curves.

Equation (x_1 < ... < x_n, of a family z_1 < ... < z_m; the function that uses it decides how the
points are joined)::

    one curve   y(x_k) = Y_k                                X=x_1, ..., x_n, Y=y_1, ..., y_n
    a family    y(x_k, z_j) = Y_jk, linear in z between     X=x_1, ..., x_n,
                neighbours, and beyond z_1 and z_m too      Y=z_1, y_11, ..., y_1n,
                                                            Y=z_2, y_21, ..., y_2n, ...

Beyond x_1 and x_n the curve continues as the parabola through the outermost three points; with
LINEAR_EXTRAPOLATE along its tangent.
"""

from __future__ import annotations

from functools import partial

from adamslite.language.interfaces import DrawnModel
from adamslite.language.statement import Statement, flag, statement, vector, vectors
from adamslite.symbolic.interpolant import Interpolant, interpolant

LEAST, MOST = 4, 10**6


@statement("SPLINE", planned=("FILE", "CHANNEL", "BLOCK", "ROUTINE"), data=True)
class Spline(Statement):
    """Points for the functions AKISPL, CUBSPL and INTERP."""

    x: tuple[float, ...] = vector(
        "X", size=LEAST, most=MOST, required=True, unit="the user's", help="where the points are"
    )
    y: tuple[tuple[float, ...], ...] = vectors(
        "Y", size=LEAST, most=MOST, unit="the user's",
        help="values at X; in a family z before them, and Y= once for each curve",
    )  # fmt: skip
    linear_extrapolate: bool = flag(
        "LINEAR_EXTRAPOLATE", help="beyond its ends the curve continues along its tangent"
    )

    @property
    def family(self) -> bool:
        """Whether there are several curves, one for each z."""
        return len(self.y) > 1

    @property
    def curves(self) -> tuple[tuple[float, ...], ...]:
        """Values of each curve at X."""
        return tuple(row[1:] for row in self.y) if self.family else self.y

    @property
    def places(self) -> tuple[float, ...]:
        """z of each curve; 0 of a single one."""
        return tuple(row[0] for row in self.y) if self.family else (0.0,)

    def table(self, kind: str) -> Interpolant:
        """The points joined in a way of :mod:`adamslite.symbolic.interpolant`."""
        import numpy as np

        beyond = "tangent" if self.linear_extrapolate else "parabola"
        return interpolant(np.array(self.x), np.array(self.curves).T, kind, beyond, self.places)

    def derived(self, model: DrawnModel) -> dict[str, object]:
        """A table for each way to join the points."""
        tables = {
            kind: model.once(("SPLINE", self.key, kind), partial(self.table, kind))
            for kind in ("linear", "akima", "natural")
        }
        return {**tables, "family": "yes" if self.family else None}
