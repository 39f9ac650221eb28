"""BUSHING: three springs, three torsion springs and their dampers between two markers.

Equation, components along the axes of J (d = r_I - r_J)::

    force on I    FORCE  - K  d  - C  v      v: velocity of I seen from J
    torque on I   TORQUE - KT th - CT w      th = AX(I,J), AY(I,J), AZ(I,J),  w: that of I less J's
    on J          -force,  -torque - d x force

each value times its own component; the directions are not coupled.  Sign: the forces pull I back
to J.  The angles are projections; two of the three must stay small, and only AZ may exceed a
quarter turn.
Source: Adams/Solver statement BUSHING, Adams/View "Constitutive Equations for Bushings".
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from adamslite.elements.bases.wrench import NOTHING, Compliance, diagonal
from adamslite.language.statement import Statement, reference, statement, vector

if TYPE_CHECKING:
    from adamslite.language.interfaces import DrawnModel

NONE = (0.0, 0.0, 0.0)


def _three(key: str, unit: str, help: str) -> tuple[float, ...]:
    return vector(key, size=3, unit=unit, default=NONE, help=f"{help} x, y, z of J")


@statement("BUSHING")
class Bushing(Compliance, Statement):
    """A linear spring and damper in all six directions."""

    i: int | str = reference("I", to="MARKER", required=True, help="marker the force acts on")
    j: int | str = reference(
        "J", to="MARKER", required=True, help="reference marker, which takes the reaction"
    )
    k: tuple[float, ...] = _three("K", "force/length", "stiffness along")
    c: tuple[float, ...] = _three("C", "force time/length", "damping along")
    force: tuple[float, ...] = _three("FORCE", "force", "force at zero displacement along")
    kt: tuple[float, ...] = _three("KT", "torque/angle", "torsional stiffness about")
    ct: tuple[float, ...] = _three("CT", "torque time/angle", "torsional damping about")
    torque: tuple[float, ...] = _three("TORQUE", "torque", "torque at zero rotation about")

    def derived(self, model: DrawnModel) -> dict[str, object]:
        """The matrices of the law."""
        return {
            "stiffness": diagonal((*self.k, *self.kt)),
            "damping": diagonal((*self.c, *self.ct)),
            "rest": NOTHING,
            "preload": (*self.force, *self.torque),
        }
