"""SPRINGDAMPER: a linear spring with a damper beside it.

Equation::

    TRANSLATIONAL  force on I along u = FORCE - K (DM(I,J) - LENGTH) - C VR(I,J)
    ROTATIONAL     torque on I about z = TORQUE - KT (AZ(I,J) - ANGLE) - CT WZ(I,J,J)

with ``u = (r_I - r_J)/|r_I - r_J|``; the opposite acts on J.  Sign: positive pushes apart::

      <---- J o-/\\/\\/\\-o I ---->     force > 0
"""

from __future__ import annotations

from adamslite.statement import Statement, choice, number, reference, statement


@statement("SPRINGDAMPER")
class Springdamper(Statement):
    """A spring and damper between two markers; in the rotational form their z axes are parallel."""

    kind: str = choice(
        options=("TRANSLATIONAL", "ROTATIONAL"), default="TRANSLATIONAL",
        help="along the line between the markers, or about their common z axis",
    )  # fmt: skip
    i: int | str = reference("I", to="MARKER", required=True, help="marker the force acts on")
    j: int | str = reference("J", to="MARKER", required=True, help="marker that takes the reaction")
    k: float = number("K", unit="force/length", default=0.0, help="stiffness")
    c: float = number("C", unit="force time/length", default=0.0, help="damping")
    force: float = number("FORCE", unit="force", default=0.0, help="force at LENGTH")
    length: float = number("LENGTH", unit="length", default=0.0, help="length at which it is FORCE")
    kt: float = number("KT", unit="torque/angle", default=0.0, help="torsional stiffness")
    ct: float = number("CT", unit="torque time/angle", default=0.0, help="torsional damping")
    torque: float = number("TORQUE", unit="torque", default=0.0, help="torque at ANGLE")
    angle: float = number("ANGLE", unit="angle", default=0.0, help="angle at which it is TORQUE")
