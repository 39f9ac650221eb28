"""PART: a rigid body with six degrees of freedom, or the ground.

Equation (Newton-Euler, about the centre of mass)::

    mass * a = force * UCF,    J alpha + omega x J omega = torque * UCF

The orientation of the body frame is ``R = Rz(a) Rx(b) Rz(c)`` from ``REULER=a,b,c`` (body 3-1-3);
its columns are the body axes in ground.
"""

from __future__ import annotations

from adamslite.elements.bases.arguments import (
    body_angles,
    body_origin,
    body_rate,
    body_x_point,
    body_z_point,
)
from adamslite.language.statement import (
    Statement,
    flag,
    number,
    reference,
    statement,
    text,
    vector,
    words,
)


@statement("PART", body=True)
class Part(Statement):
    """A rigid body.

    ``PART/1, GROUND`` is the inertial reference; a deck has exactly one.
    ``IP=xx,yy,zz,xy,xz,yz`` holds products of inertia as positive integrals (``Ixy = int xy dm``),
    so the inertia tensor about the origin of IM, in IM axes, is::

        [[ xx, -xy, -xz],
         [-xy,  yy, -yz],
         [-xz, -yz,  zz]]
    """

    alternatives = ((("reuler",), ("zg", "xg")),)

    ground: bool = flag("GROUND", help="this part is the inertial reference")
    mass: float | None = number("MASS", "M", "MA", unit="mass", help="mass")
    cm: int | str | None = reference("CM", to="MARKER", help="marker at the centre of mass")
    im: int | str | None = reference(
        "IM", to="MARKER", help="marker whose origin and axes IP refers to; default: the CM marker"
    )
    ip: tuple[float, ...] | None = vector(
        "IP", size=3, most=6, unit="mass length^2", help="inertia xx,yy,zz[,xy,xz,yz] at IM"
    )
    qg: tuple[float, ...] = body_origin()
    reuler: tuple[float, ...] = body_angles()
    zg: tuple[float, ...] | None = body_z_point()
    xg: tuple[float, ...] | None = body_x_point()
    vx: float = body_rate("VX", "length", "velocity of CM along x")
    vy: float = body_rate("VY", "length", "velocity of CM along y")
    vz: float = body_rate("VZ", "length", "velocity of CM along z")
    wx: float = body_rate("WX", "angle", "rate about x of CM or WM")
    wy: float = body_rate("WY", "angle", "rate about y of CM or WM")
    wz: float = body_rate("WZ", "angle", "rate about z of CM or WM")
    vm: int | str | None = reference(
        "VM", to="MARKER", start=True, help="marker whose axes VX, VY, VZ are along; else ground"
    )
    wm: int | str | None = reference(
        "WM", to="MARKER", start=True, help="marker whose axes WX, WY, WZ are along; else CM"
    )
    exact: tuple[str, ...] = words(
        "EXACT", start=True, options=("X", "Y", "Z", "PSI", "THETA", "PHI"),
        help="coordinates the initial conditions must keep",
    )  # fmt: skip
    material: str | None = text("MATERIAL", inert=True, help="for display; not used")
