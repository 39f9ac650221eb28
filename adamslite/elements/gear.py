"""GEAR: two joints on one carrier, with equal speeds at the pitch point.

Equation (P the origin of CV, z_CV the direction of the common velocity, seen from the carrier)::

    s1 (q1 - q1_0) - s2 (q2 - q2_0) = 0

    s = (z_J x (P - r_J)) . z_CV    for a rotation q about z of J
    s = z_J . z_CV                  for a translation q along z of J

The carrier holds the J markers of both joints and CV, so the factors s are constants of the deck
and the speeds ds1/dt = s1 dq1/dt, ds2/dt of the two gears at P along z_CV are equal.  A cylindrical
joint counts with both its freedoms.  The q count from the start, with full turns: from
the posture of the deck, or where it draws joints apart from the one in which these are closed.
Sign: the reaction reported acts on I of the first joint.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from adamslite.elements.bases.constraint import Constraint
from adamslite.elements.bases.joint_coordinates import (
    angle_since,
    built_slide,
    built_turn,
    slide,
    turn,
)
from adamslite.language.statement import Statement, reference, references, statement

if TYPE_CHECKING:  # reading a deck does without numpy
    import numpy as np

    from adamslite.language.interfaces import DrawnModel
    from adamslite.symbolic.scope import Scope
    from adamslite.symbolic.types import Expr, Seen


@statement("GEAR")
class Gear(Constraint, Statement):
    """A pair of gears, or a rack and a pinion, on a common carrier."""

    joints: tuple[int | str, ...] = references(
        "JOINTS", to="JOINT", required=True, help="the joints of the two gears"
    )
    cv: int | str = reference(
        "CV", to="MARKER", required=True, help="marker at the pitch point, z along its velocity"
    )

    @property
    def counts_from_start(self) -> bool:
        """Whether it holds what has been turned and travelled since the start."""
        return True

    @property
    def row_names(self) -> tuple[str, ...]:
        """What the row keeps at zero."""
        return ("travel of one gear past the other along z of CV",)

    def derived(self, model: DrawnModel) -> dict[str, object]:
        """For each joint (factor, built value) of its translation and of its rotation."""
        pitch = model.marker(self.cv)
        along = pitch.axes[:, 2]
        slides, turns = [], []
        for key in self.joints:
            joint = model.element("JOINT", key)
            place = model.marker(joint.j)
            axis, arm = place.axes[:, 2], pitch.p - place.p
            free = joint.coordinates
            shift = float(axis @ along) if "TRANSLATION" in free else 0.0
            lever = float(along @ _cross(axis, arm)) if "ROTATION" in free else 0.0
            slides.append((shift, built_slide(model, joint.i, joint.j)))
            turns.append((lever, *built_turn(model, joint.i, joint.j)))
        return {"slides": tuple(slides), "turns": tuple(turns)}

    def constraints(self: Seen, scope: Scope) -> list[Expr]:
        """The row that vanishes."""
        row = 0
        for sign, joint, (shift, slid), (lever, *turned) in zip(
            (1, -1), self.joints, self.slides, self.turns, strict=True
        ):
            if shift != 0:
                row = row + sign * shift * (slide(scope, joint.i, joint.j) - slid)
            if lever != 0:
                rotation, of = turn(scope, joint.i, joint.j), ("turn", joint.i, joint.j)
                row = row + sign * lever * angle_since(scope, rotation, tuple(turned), of)
        return [row]


def _cross(a: np.ndarray, b: np.ndarray) -> np.ndarray:
    from numpy import cross

    return cross(a, b)
