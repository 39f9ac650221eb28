"""Where two simple shapes touch: penetration, normal and common point.

A *form* is a shape with its sizes, in the axes of its marker:

========  ======================  ============================================================
form      sizes                   body
========  ======================  ============================================================
BALL      r                       a ball of radius r about the origin; r = 0: a point
CORNER    x, y, z, a, b, c        the point (x + a, y + b, z + c)
PLANE                             all of z < 0
BOX       x, y, z, a, b, c        half edges a, b, c about (x, y, z)
CYLINDER  z, c, R                 half length c about (0, 0, z), radius R, flat ends
RIM       z, c, R                 the edge of an end of a cylinder or cone, at (0, 0, z + c)
========  ======================  ============================================================

The place of a corner or edge is a sum of terms that are not zero: so all of them share one kernel.
Each pair gives the depth [length] by which I is in J, the unit normal from J to I, and the common
point, in the middle of the overlap, as its place relative to the marker of I; in ground axes.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, NamedTuple

from adamslite.symbolic.formulas import fn, magnitude, norm, piecewise, root
from adamslite.symbolic.scope import along_axes, dot, minus, plus, scale

if TYPE_CHECKING:
    from adamslite.symbolic.scope import Scope, Vector
    from adamslite.symbolic.types import Expr, Seen

# Slant of an end from which on its edge alone touches: the contact moves there from its centre.
LEVEL = 1e-3


class Touch(NamedTuple):
    """Penetration, normal from J to I, common point relative to the marker of I.

    ``overlap`` has the sign of ``depth`` and no kink where shapes pass each other at a distance, so
    that a step cannot miss an overlap.
    """

    depth: Expr
    normal: Vector
    arm: Vector
    overlap: Expr


def touch(scope: Scope, point: Seen) -> Touch:
    """How the forms of a point of contact touch."""
    return PAIRS[point.first, point.second](scope, point)


def _of_ball(radius: Expr, depth: Expr, normal: Vector, overlap: Expr) -> Touch:
    """A ball that sinks in by ``depth``: the point is in the middle of the overlap."""
    return Touch(depth, normal, scale(depth / 2 - radius, normal), overlap)


def ball_on_plane(scope: Scope, point: Seen) -> Touch:
    """depth = r - h, h: height of the centre"""
    (radius,), normal = point.first_sizes, scope.axes(point.j)[2]
    height = dot(scope.position(point.i, point.j), normal)
    return _of_ball(radius, radius - height, normal, radius - height)


def corner_on_plane(scope: Scope, point: Seen) -> Touch:
    """depth = -h"""
    x, y, z, a, b, c = point.first_sizes
    corner = along_axes(scope.axes(point.i), (x + a, y + b, z + c))
    normal = scope.axes(point.j)[2]
    depth = -dot(plus(scope.position(point.i, point.j), corner), normal)
    return Touch(depth, normal, plus(corner, scale(depth / 2, normal)), depth)


def ball_on_ball(scope: Scope, point: Seen) -> Touch:
    """depth = r1 + r2 - distance of the centres"""
    (radius,), (other,) = point.first_sizes, point.second_sizes
    apart = scope.position(point.i, point.j)
    square = dot(apart, apart)
    distance, near = root(square), radius + other
    return _of_ball(radius, near - distance, scale(1 / distance, apart), near**2 - square)


def ball_on_box(scope: Scope, point: Seen) -> Touch:
    """depth = r - distance from the box; r + distance to the nearest face for a centre inside"""
    (radius,), (x, y, z, *half) = point.first_sizes, point.second_sizes
    at = _seen_from(scope, point, (x, y, z))
    beyond = [_beyond(x, a) for x, a in zip(at, half, strict=True)]
    square = sum(each**2 for each in beyond)
    outside, distance = square > 0, root(square)
    left = [a - magnitude(x, None) for x, a in zip(at, half, strict=True)]
    # Which face is the nearest is of no interest outside.
    xy, xz, yz = (
        piecewise((-1, outside), otherwise=a - b) <= 0
        for a, b in ((left[0], left[1]), (left[0], left[2]), (left[1], left[2]))
    )
    nearest = [fn.And(xy, xz), fn.And(fn.Not(xy), yz), fn.And(fn.Not(xz), fn.Not(yz))]
    depth = piecewise(
        (radius - distance, outside), (radius + left[0], nearest[0]),
        (radius + left[1], nearest[1]), otherwise=radius + left[2], order=0,
    )  # fmt: skip
    normal = [
        piecewise((e / distance, outside), (_sign(x), near), otherwise=0, order=-1)
        for e, x, near in zip(beyond, at, nearest, strict=True)
    ]
    axes = along_axes(scope.axes(point.j), (normal[0], normal[1], normal[2]))
    overlap = radius**2 - square if radius != 0 else depth
    return _of_ball(radius, depth, axes, overlap)


def ball_on_cylinder(scope: Scope, point: Seen) -> Touch:
    """The same with a cylinder: distances along the axis and from it."""
    (radius,), (middle, half, thickness) = point.first_sizes, point.second_sizes
    x, y, z = _seen_from(scope, point, (0, 0, middle))
    from_axis = norm((x, y, 0))
    beside = x**2 + y**2 > thickness**2
    aside = piecewise((from_axis - thickness, beside), otherwise=0, order=0)
    along = _beyond(z, half)
    square = aside**2 + along**2
    to_side, to_end = thickness - from_axis, half - magnitude(z, None)
    outside, distance = square > 0, root(square)
    sideways = piecewise((-1, outside), otherwise=to_side - to_end) <= 0
    depth = piecewise(
        (radius - distance, outside), (radius + to_side, sideways), otherwise=radius + to_end,
        order=0,
    )  # fmt: skip
    across = piecewise((aside / distance, outside), (1, sideways), otherwise=0, order=-1)
    across = piecewise((across / from_axis, from_axis > 0), otherwise=0)
    axial = piecewise((along / distance, outside), (0, sideways), otherwise=_sign(z), order=-1)
    normal = along_axes(scope.axes(point.j), (across * x, across * y, axial))
    overlap = radius**2 - square if radius != 0 else depth
    return _of_ball(radius, depth, normal, overlap)


def rim_on_plane(scope: Scope, point: Seen) -> Touch:
    """depth = R f(s) - h, at R f'(s) from the centre, s: sine between axis and normal, h: height

    f = sqrt(s^2 + LEVEL^2) - LEVEL (1 - s^2)^2 is s but for ends that are almost level, which then
    touch further inside: f(0) = 0, f(1) = 1, f'(1) = 1.  Whatever f, the force has a potential.
    """
    middle, half, radius = point.first_sizes
    axis, normal = scope.axes(point.i)[2], scope.axes(point.j)[2]
    centre = scale(middle + half, axis)
    height = dot(plus(scope.position(point.i, point.j), centre), normal)
    slant = minus(normal, scale(dot(axis, normal), axis))
    square = dot(slant, slant)
    rounded = root(square + LEVEL**2)
    reach = rounded - LEVEL * (1 - square) ** 2
    depth = radius * reach - height
    outwards = 1 / rounded + 4 * LEVEL * (1 - square)
    lowest = minus(centre, scale(radius * outwards, slant))
    return Touch(depth, normal, plus(lowest, scale(depth / 2, normal)), depth)


def _seen_from(scope: Scope, point: Seen, middle: Vector) -> Vector:
    """The marker of I from a place on J, along the axes of J."""
    apart = scope.position(point.i, point.j)
    x, y, z = (dot(apart, axis) for axis in scope.axes(point.j))
    return minus((x, y, z), middle)


def _beyond(x: Expr, half: Expr) -> Expr:
    """By how much x lies beyond -half ... half."""
    return piecewise((x - half, x > half), (x + half, x < -half), otherwise=0, order=0)


def _sign(x: Expr) -> Expr:
    return piecewise((1, x >= 0), otherwise=-1, order=-1)


PAIRS: dict[tuple[str, str], Callable[[Scope, Seen], Touch]] = {
    ("BALL", "PLANE"): ball_on_plane,
    ("CORNER", "PLANE"): corner_on_plane,
    ("BALL", "BALL"): ball_on_ball,
    ("BALL", "BOX"): ball_on_box,
    ("BALL", "CYLINDER"): ball_on_cylinder,
    ("RIM", "PLANE"): rim_on_plane,
}
"""What is known of a form on I and a form on J."""
