"""JOINT: a constraint between two parts.

Equations (``d = r_I - r_J``, axes of the markers)::

    REVOLUTE       d = 0,  z_I . x_J = 0,  z_I . y_J = 0
    SPHERICAL      d = 0
    TRANSLATIONAL  d . x_J = 0,  d . y_J = 0,  axes of I and J parallel
    FIXED          d = 0,  axes of I and J parallel

Sign: the reaction reported is the force and torque on I; the free coordinate is that of I relative
to J along or about z of J.
"""

from __future__ import annotations

from typing import Any, ClassVar

from adamslite.expression import COMPONENTS, Node, Ref, measure
from adamslite.statement import Statement, choice, reference, statement
from adamslite.symbolic import Scope, dot

KINDS = (
    "CONVEL", "CYLINDRICAL", "FIXED", "HOOKE", "PLANAR", "RACKPIN", "REVOLUTE", "SCREW",
    "SPHERICAL", "TRANSLATIONAL", "UNIVERSAL",
)  # fmt: skip


@statement("JOINT", planned=("IC", "ICTRAN", "ICROT", "PITCH", "PD", "FRICTION"))
class Joint(Statement):
    """An ideal joint between markers I and J of two different parts."""

    kind: str = choice(
        options=KINDS, required=True, help="a type of joint",
        supported=("REVOLUTE", "SPHERICAL", "TRANSLATIONAL", "FIXED"),
    )  # fmt: skip
    i: int | str = reference("I", to="MARKER", required=True, help="marker on the first part")
    j: int | str = reference("J", to="MARKER", required=True, help="marker on the second part")

    rows: ClassVar[dict[str, int]] = {"REVOLUTE": 5, "SPHERICAL": 3, "TRANSLATIONAL": 5, "FIXED": 6}

    @property
    def n_rows(self) -> int:
        """Constraint equations of this joint."""
        return self.rows[self.kind]

    def is_rate(self, model: Any) -> bool:
        """Whether the rows constrain velocities only."""
        return False

    def constraints(self, scope: Scope) -> list[Any]:
        """Rows that vanish: positions first, then directions."""
        d = scope.position(self.i, self.j)
        xi, _, zi = scope.axes(self.i)
        xj, yj, _ = scope.axes(self.j)
        together = list(d)
        on_line = [dot(d, xj), dot(d, yj)]
        parallel = [dot(zi, xj), dot(zi, yj)]
        same_turn = [dot(xi, yj)]
        return {
            "SPHERICAL": together,
            "REVOLUTE": together + parallel,
            "FIXED": together + parallel + same_turn,
            "TRANSLATIONAL": on_line + parallel + same_turn,
        }[self.kind]

    @property
    def result_names(self) -> tuple[str, ...]:
        """Reaction on I, ground axes, torque about I's origin."""
        return ("fx", "fy", "fz", "tx", "ty", "tz")

    def outputs(self, model: Any) -> list[Node]:
        """Values of ``result_names``."""
        return [measure("JOINT", Ref("JOINT", self.key), c) for c in COMPONENTS]
