"""COUPLER: two or three joints whose freedoms are proportional.

Equation (q the translation or rotation of I relative to J of each joint)::

    r1 (q1 - q1_0) + r2 (q2 - q2_0) [+ r3 (q3 - q3_0)] = 0         or  FUNCTION = 0

Sign: q is positive along and about z of J; rotations count full turns.  q_0 is the
value in the posture of the deck, or where it draws joints apart in the one in which these are
closed: there the joints are coupled.
The reaction reported acts on I of the first joint.

FUNCTION=USER(...) is a routine of the user that vanishes where the joints are as they should be; a
function of Python says by its ``reads`` which displacements it needs.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from adamslite.elements.bases.arguments import routine_name
from adamslite.elements.bases.constraint import Constraint
from adamslite.elements.bases.joint_coordinates import (
    angle_since,
    built_slide,
    built_turn,
    slide,
    turn,
)
from adamslite.elements.gcon import measures_rates
from adamslite.language.statement import (
    Statement,
    expression,
    references,
    statement,
    vector,
    words,
)

if TYPE_CHECKING:
    from adamslite.language.expression import Node
    from adamslite.language.interfaces import DrawnModel
    from adamslite.symbolic.scope import Scope
    from adamslite.symbolic.types import Expr, Seen


@statement("COUPLER")
class Coupler(Constraint, Statement):
    """Couples the freedoms of translational, revolute and cylindrical joints."""

    joints: tuple[int | str, ...] = references(
        "JOINTS", to="JOINT", required=True, help="two or three joints"
    )
    scales: tuple[float, ...] = vector(
        "SCALES", size=1, most=3, default=(), unit="per length, or per angle",
        help="r1, r2 and r3; r1 is 1 when one is missing",
    )  # fmt: skip
    type: tuple[str, ...] = words(
        "TYPE", options=("TRANSLATIONAL", "ROTATIONAL"),
        help="T or R for each joint; needed for cylindrical joints",
    )  # fmt: skip

    function: Node | None = expression(
        "FUNCTION", unit="the user's", help="USER(...), a routine that vanishes; without SCALES"
    )
    routine: str | None = routine_name()

    @property
    def factors(self) -> tuple[float, ...]:
        """r1, r2 and r3."""
        missing = len(self.scales) < len(self.joints)
        return (1.0, *self.scales) if missing else self.scales

    def is_rate(self, model: DrawnModel) -> bool:
        """Whether FUNCTION measures velocities."""
        return self.function is not None and measures_rates(self.function, model)

    @property
    def counts_from_start(self) -> bool:
        """Whether it holds what has been turned and travelled since the start."""
        return True

    @property
    def row_names(self) -> tuple[str, ...]:
        """What the row keeps at zero."""
        return ("sum of the scaled freedoms",)

    def uses(self, number: int, freedoms: tuple[str, ...]) -> str | None:
        """TRANSLATION or ROTATION of joint ``number`` with these freedoms; None when unclear."""
        if number < len(self.type):
            word = self.type[number].removesuffix("AL")
            return word if word in freedoms else None
        return freedoms[0] if len(freedoms) == 1 else None

    def derived(self, model: DrawnModel) -> dict[str, object]:
        """The freedom used of each joint, its factor and where it counts from."""
        chosen, since = [], []
        for number, key in enumerate(self.joints):
            joint = model.element("JOINT", key)
            chosen.append(self.uses(number, joint.coordinates))
            built = built_turn if chosen[-1] == "ROTATION" else built_slide
            since.append(built(model, joint.i, joint.j))
        return {"chosen": tuple(chosen), "since": tuple(since), "factors": self.factors}

    def constraints(self: Seen, scope: Scope) -> list[Expr]:
        """The row that vanishes."""
        if self.function is not None:
            return [self.function]
        row = 0
        for joint, name, since, factor in zip(
            self.joints, self.chosen, self.since, self.factors, strict=True
        ):
            if name == "ROTATION":
                rotation, of = turn(scope, joint.i, joint.j), ("turn", joint.i, joint.j)
                moved = angle_since(scope, rotation, since, of)
            else:
                moved = slide(scope, joint.i, joint.j) - since
            row = row + factor * moved
        return [row]
