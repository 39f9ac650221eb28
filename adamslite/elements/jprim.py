"""JPRIM: one geometric condition between two markers.

Equations (``d = r_I - r_J``)::

    ATPOINT        d = 0
    INLINE         d . x_J = 0,  d . y_J = 0          I on the z axis of J
    INPLANE        d . z_J = 0                        I in the xy plane of J
    ORIENTATION    z_I . x_J = 0,  z_I . y_J = 0,  x_I . y_J = 0
    PARALLEL_AXES  z_I . x_J = 0,  z_I . y_J = 0
    PERPENDICULAR  z_I . z_J = 0

Sign: the reaction reported is the force and torque on I.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, ClassVar

from adamslite.elements.bases.constraint import ON_LINE, PARALLEL, SAME_TURN, TOGETHER, Constraint
from adamslite.language.statement import Statement, choice, reference, statement
from adamslite.symbolic.scope import dot

if TYPE_CHECKING:
    from adamslite.symbolic.scope import Scope
    from adamslite.symbolic.types import Expr, Seen


@statement("JPRIM")
class Jprim(Constraint, Statement):
    """A joint primitive; ATPOINT, INLINE and INPLANE also hold a POINT_MASS."""

    kind: str = choice(
        options=("ATPOINT", "INLINE", "INPLANE", "ORIENTATION", "PARALLEL_AXES", "PERPENDICULAR"),
        required=True, help="a type of primitive",
    )  # fmt: skip
    i: int | str = reference("I", to="MARKER", required=True, help="marker that is held")
    j: int | str = reference("J", to="MARKER", required=True, help="marker with the line or plane")

    rows: ClassVar[dict[str, int]] = {
        "ATPOINT": 3, "INLINE": 2, "INPLANE": 1, "ORIENTATION": 3, "PARALLEL_AXES": 2,
        "PERPENDICULAR": 1,
    }  # fmt: skip

    @property
    def n_rows(self) -> int:
        """Constraint equations of this primitive."""
        return self.rows[self.kind]

    @property
    def row_names(self) -> tuple[str, ...]:
        """What each row keeps at zero."""
        return {
            "ATPOINT": TOGETHER,
            "INLINE": ON_LINE,
            "INPLANE": ("offset along z_J",),
            "ORIENTATION": PARALLEL + SAME_TURN,
            "PARALLEL_AXES": PARALLEL,
            "PERPENDICULAR": ("right angle (z_I . z_J)",),
        }[self.kind]

    def constraints(self: Seen, scope: Scope) -> list[Expr]:
        """Rows that vanish."""
        d = scope.position(self.i, self.j)
        xi, _, zi = scope.axes(self.i)
        xj, yj, zj = scope.axes(self.j)
        parallel = [dot(zi, xj), dot(zi, yj)]
        return {
            "ATPOINT": list(d),
            "INLINE": [dot(d, xj), dot(d, yj)],
            "INPLANE": [dot(d, zj)],
            "ORIENTATION": [*parallel, dot(xi, yj)],
            "PARALLEL_AXES": parallel,
            "PERPENDICULAR": [dot(zi, zj)],
        }[self.kind]
