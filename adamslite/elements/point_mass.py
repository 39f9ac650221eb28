"""POINT_MASS: a body with three degrees of freedom and a fixed orientation.

Equation::

    mass * a = force * UCF
"""

from __future__ import annotations

from adamslite.language.statement import Statement, number, reference, statement, vector, words


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
    qg: tuple[float, ...] = vector(
        "QG",
        start=True,
        size=3,
        unit="length",
        default=(0.0, 0.0, 0.0),
        help="origin of the body, in ground",
    )
    reuler: tuple[float, ...] = vector(
        "REULER", "EULER", start=True, size=3, unit="angle", default=(0.0, 0.0, 0.0),
        help="body 3-1-3 angles of the body frame in ground",
    )  # fmt: skip
    zg: tuple[float, ...] | None = vector(
        "ZG", start=True, size=3, unit="length", help="point in ground on the +z axis of the body"
    )
    xg: tuple[float, ...] | None = vector(
        "XG",
        start=True,
        size=3,
        unit="length",
        help="point in ground in the +xz half-plane of the body",
    )
    vx: float = number(
        "VX", start=True, unit="length/time", default=0.0, help="initial velocity, x in ground"
    )
    vy: float = number(
        "VY", start=True, unit="length/time", default=0.0, help="initial velocity, y in ground"
    )
    vz: float = number(
        "VZ", start=True, unit="length/time", default=0.0, help="initial velocity, z in ground"
    )
    exact: tuple[str, ...] = words(
        "EXACT",
        start=True,
        options=("X", "Y", "Z"),
        help="coordinates the initial conditions must keep",
    )
