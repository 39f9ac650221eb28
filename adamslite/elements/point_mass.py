"""POINT_MASS: a body with three degrees of freedom and a fixed orientation.

Equation::

    mass * a = force * UCF
"""

from __future__ import annotations

from adamslite.elements.bases.arguments import (
    body_angles,
    body_origin,
    body_rate,
    body_x_point,
    body_z_point,
)
from adamslite.language.statement import Statement, number, reference, statement, words


@statement("POINT_MASS", body=True)
class PointMass(Statement):
    """A mass without rotation: it takes forces, no torques, and costs three unknowns.

    The orientation of its frame (REULER, or ZG and XG) remains that at the start.
    """

    alternatives = ((("reuler",), ("zg", "xg")),)

    mass: float = number("MASS", unit="mass", required=True, help="mass, above zero")
    cm: int | str | None = reference(
        "CM", to="MARKER", help="marker at the mass; default: the origin of the body"
    )
    qg: tuple[float, ...] = body_origin()
    reuler: tuple[float, ...] = body_angles()
    zg: tuple[float, ...] | None = body_z_point()
    xg: tuple[float, ...] | None = body_x_point()
    vx: float = body_rate("VX", "length", "velocity, x in ground")
    vy: float = body_rate("VY", "length", "velocity, y in ground")
    vz: float = body_rate("VZ", "length", "velocity, z in ground")
    exact: tuple[str, ...] = words(
        "EXACT",
        start=True,
        options=("X", "Y", "Z"),
        help="coordinates the initial conditions must keep",
    )
