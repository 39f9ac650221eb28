"""Positions, velocities and accelerations of markers.

With r = r_i - r_j, w = w_i - w_j, and derivatives in frame l written with those in ground (')

    v_l = r' - w_l x r
    a_l = r'' - al_l x r - 2 w_l x v_l - w_l x (w_l x r)
    b_l = w' - w_l x w

a measure is the length of one of these vectors or its component along an axis of marker k.  A
frame l that does not turn leaves the derivative in ground alone.  Markers that are omitted or 0
are the ground frame.  Accelerations are purely kinematic: gravity is not part of them.
"""

from __future__ import annotations

from collections.abc import Callable

from adamslite.language.function import function
from adamslite.symbolic.formulas import norm, root
from adamslite.symbolic.scope import Scope, Vector, cross, dot, minus, scale
from adamslite.symbolic.types import Expr, Frame

IN_GROUND = "i:marker j:marker=0 k:marker=0"
IN_FRAME = f"{IN_GROUND} l:marker=0"
Motion = Callable[..., Vector]


def _along_axes(family: str, signature: str) -> Callable[[Motion], Motion]:
    """Register the components of a vector along the axes of k, such as DX, DY and DZ.

    The docstring of the vector is the page of the first of them.
    """

    def register(vector: Motion) -> Motion:
        for number, axis in enumerate("xyz"):

            def component(
                scope: Scope, i: Frame, j: Frame, k: Frame, *frame: Frame, number: int = number
            ) -> Expr:
                return dot(vector(scope, i, j, *frame), scope.axes(k)[number])

            name, page = family + axis.upper(), str(vector.__doc__)
            for word in ("{} axis", "{}_k"):
                page = page.replace(word.format("x"), word.format(axis))
            component.__doc__ = page.replace(f"{family}X", name)
            function(name, signature)(component)
        return vector

    return register


@function("DM", "i:marker j:marker=0")
def dm(scope: Scope, i: Frame, j: Frame) -> Expr:
    """Distance of marker i from marker j: |r_i - r_j|.

    Unit: length; never negative.  Where the markers coincide its derivative does not exist.
    Source: Adams/Solver function DM.
    """
    arm = scope.position(i, j)
    return root(dot(arm, arm))


@_along_axes("D", IN_GROUND)
def _displacement(scope: Scope, i: Frame, j: Frame) -> Vector:
    """Displacement of i from j along the x axis of k: (r_i - r_j) . x_k.

    Unit: length.  Without k the axes are those of ground, not those of j.
    Source: Adams/Solver function DX.
    """
    return scope.position(i, j)


@function("VM", "i:marker j:marker=0 l:marker=0")
def vm(scope: Scope, i: Frame, j: Frame, frame: Frame) -> Expr:
    """Speed of i against j: the length of d/dt(r_i - r_j) taken in frame l.

    Unit: length/time; never negative.  At rest its derivative is taken as 0.
    Source: Adams/Solver function VM.
    """
    return norm(_velocity(scope, i, j, frame))


@function("VR", "i:marker j:marker=0 l:marker=0")
def vr(scope: Scope, i: Frame, j: Frame, frame: Frame) -> Expr:
    """Separation speed of i and j: d/dt(r_i - r_j) along the unit vector from j to i.

    Unit: length/time; positive when the markers move apart.  w_l x r is square to r, so frame l
    makes no difference.  Not defined where the markers coincide.
    Source: Adams/Solver function VR.
    """
    arm = scope.position(i, j)
    return dot(scope.velocity(i, j), arm) / root(dot(arm, arm))


@_along_axes("V", IN_FRAME)
def _velocity(scope: Scope, i: Frame, j: Frame, frame: Frame) -> Vector:
    """Velocity of i against j along the x axis of k: d/dt(r_i - r_j) in frame l, times x_k.

    Unit: length/time.  Source: Adams/Solver function VX.
    """
    velocity = scope.velocity(i, j)
    if scope.is_ground(frame):
        return velocity
    return minus(velocity, cross(scope.omega(frame), scope.position(i, j)))


@function("ACCM", "i:marker j:marker=0 l:marker=0")
def accm(scope: Scope, i: Frame, j: Frame, frame: Frame) -> Expr:
    """Length of the acceleration of i against j: d2/dt2(r_i - r_j) taken in frame l.

    Unit: length/time**2; never negative; without gravity.  At 0 its derivative is taken as 0.
    Source: Adams/Solver function ACCM.
    """
    return norm(_acceleration(scope, i, j, frame))


@_along_axes("ACC", IN_FRAME)
def _acceleration(scope: Scope, i: Frame, j: Frame, frame: Frame) -> Vector:
    """Acceleration of i against j along the x axis of k: d2/dt2(r_i - r_j) in frame l, times x_k.

    Unit: length/time**2; without gravity.  Source: Adams/Solver function ACCX.
    """
    acceleration = scope.acceleration(i, j)
    if scope.is_ground(frame):
        return acceleration
    turn, arm = scope.omega(frame), scope.position(i, j)
    coriolis = scale(2, cross(turn, _velocity(scope, i, j, frame)))
    centripetal = cross(turn, cross(turn, arm))
    euler = cross(scope.alpha(frame), arm)
    return minus(minus(minus(acceleration, euler), coriolis), centripetal)


@function("WM", "i:marker j:marker=0")
def wm(scope: Scope, i: Frame, j: Frame) -> Expr:
    """Length of the angular velocity of i against j: |w_i - w_j|.

    Unit: rad/time; never negative.  At rest its derivative is taken as 0.
    Source: Adams/Solver function WM.
    """
    return norm(scope.omega(i, j))


@_along_axes("W", IN_GROUND)
def _spin(scope: Scope, i: Frame, j: Frame) -> Vector:
    """Angular velocity of i against j along the x axis of k: (w_i - w_j) . x_k.

    Unit: rad/time.  Source: Adams/Solver function WX.
    """
    return scope.omega(i, j)


@function("WDTM", "i:marker j:marker=0 l:marker=0")
def wdtm(scope: Scope, i: Frame, j: Frame, frame: Frame) -> Expr:
    """Length of the angular acceleration of i against j: d/dt(w_i - w_j) taken in frame l.

    Unit: rad/time**2; never negative.  At 0 its derivative is taken as 0.
    Source: Adams/Solver function WDTM.
    """
    return norm(_spin_rate(scope, i, j, frame))


@_along_axes("WDT", IN_FRAME)
def _spin_rate(scope: Scope, i: Frame, j: Frame, frame: Frame) -> Vector:
    """Angular acceleration of i against j along the x axis of k: d/dt(w_i - w_j) in l, times x_k.

    Unit: rad/time**2.  Source: Adams/Solver function WDTX.
    """
    rate = scope.alpha(i, j)
    if scope.is_ground(frame):
        return rate
    return minus(rate, cross(scope.omega(frame), scope.omega(i, j)))
