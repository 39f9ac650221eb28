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

from adamslite.statement import Statement, choice, reference, statement

KINDS = (
    "CONVEL", "CYLINDRICAL", "FIXED", "HOOKE", "PLANAR", "RACKPIN", "REVOLUTE", "SCREW",
    "SPHERICAL", "TRANSLATIONAL", "UNIVERSAL",
)  # fmt: skip


@statement("JOINT", planned=("IC", "ICTRAN", "ICROT", "PITCH", "PD", "FRICTION"))
class Joint(Statement):
    """An ideal joint between markers I and J of two different parts."""

    kind: str = choice(
        options=KINDS, required=True, help="type of joint",
        supported=("REVOLUTE", "SPHERICAL", "TRANSLATIONAL", "FIXED"),
    )  # fmt: skip
    i: int | str = reference("I", to="MARKER", required=True, help="marker on the first part")
    j: int | str = reference("J", to="MARKER", required=True, help="marker on the second part")
