"""Coordinates of I relative to J: slides along and rotations about an axis.

Equations (``d = r_I - r_J``)::

    slide   d . z_J
    turn    theta = atan2(x_I . y_J, x_I . x_J)        I about z of J, right hand
    feed    -d . z_J  and  atan2(-z_J . y_I, z_J . x_I)
            a rack J along its own z, and the turn of a pinion I about its own z seen from the rack

A turn is carried as (sine, cosine), which may be scaled by one positive factor: it has no branch to
choose until it becomes an angle.  An angle that has to count full turns counts from the posture at
the start, so that it starts near zero and never on the edge of a branch: as the deck draws the
model, or where its joints are closed if it draws them apart.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from adamslite.symbolic.formulas import fn, piecewise
from adamslite.symbolic.scope import cross, dot, scale
from adamslite.symbolic.types import Expr

if TYPE_CHECKING:  # reading a deck does without numpy
    import numpy as np

    from adamslite.language.interfaces import DrawnModel, Key
    from adamslite.symbolic.scope import Scope
    from adamslite.symbolic.types import Frame, Measure

Turn = tuple[Expr, Expr]
# Sines below this are the round-off of markers that are drawn aligned.
ALIGNED = 1e-14
# Minus the cosine of the bend from which a constant-velocity joint counts as folded.
FOLDED = 0.5
# Cosine of 175 degrees: nearer to its fold a joint hardly holds the twist.
NEARLY_FOLDED = 0.9962


def slide(scope: Scope, i: Frame, j: Frame) -> Expr:
    """Displacement of I along z of J."""
    return dot(scope.position(i, j), scope.axes(j)[2])


def turn(scope: Scope, i: Frame, j: Frame) -> Turn:
    """Rotation of I about z of J, as sine and cosine."""
    xi, (xj, yj, _) = scope.axes(i)[0], scope.axes(j)
    return dot(xi, yj), dot(xi, xj)


def turn_on_rack(scope: Scope, i: Frame, j: Frame) -> Turn:
    """Rotation of a pinion I about its own z, seen from a rack J along z of J."""
    (xi, yi, _), zj = scope.axes(i), scope.axes(j)[2]
    return -dot(zj, yi), dot(zj, xi)


def less(first: Turn, second: Turn) -> Turn:
    """The turn ``first`` less the turn ``second``."""
    (s, c), (s0, c0) = first, second
    return s * c0 - c * s0, c * c0 + s * s0


def angle_to(rotation: Turn, target: Expr) -> Expr:
    """``rotation`` less the angle ``target``, within half a turn: zero on any full turn."""
    return fn.atan2(*less(rotation, (fn.sin(target), fn.cos(target))))


def angle_since(scope: Scope, rotation: Turn, built: Turn, of: Measure) -> Expr:
    """The angle turned since ``built``, full turns counted; ``of`` names it."""
    return scope.angle(*less(rotation, built), of)


def spin(scope: Scope, i: Frame, j: Frame) -> Expr:
    """Angular velocity of I relative to J about z of J."""
    return dot(scope.omega(i, j), scope.axes(j)[2])


def relative_velocity(scope: Scope, i: Frame, j: Frame, axis: int) -> Expr:
    """Velocity of I seen from J along an axis (0 x, 1 y, 2 z) of J."""
    swept = cross(scope.omega(j), scope.position(i, j))
    along = scope.axes(j)[axis]
    return dot(scope.velocity(i, j), along) - dot(swept, along)


def pose(model: DrawnModel, marker: Key) -> tuple[np.ndarray, np.ndarray]:
    """Origin (3,) and axes (3, 3) in ground of a marker at the start."""
    place = model.marker(marker)
    if place.kind == "ground":
        return place.p, place.axes
    x, attitude = model.start_of(place.body)
    if place.kind == "point":
        return x + place.p, place.axes
    return x + attitude @ place.p, attitude @ place.axes


def built_slide(model: DrawnModel, i: Key, j: Key) -> float:
    """The slide of I along z of J as the deck draws it."""
    (ri, _), (rj, axes) = pose(model, i), pose(model, j)
    return float((ri - rj) @ axes[:, 2])


def built_turn(model: DrawnModel, i: Key, j: Key) -> tuple[float, float]:
    """Sine and cosine of the turn of I about z of J as the deck draws it."""
    seen = pose(model, j)[1].T @ pose(model, i)[1]
    return _unit(float(seen[1, 0]), float(seen[0, 0]))


def built_turn_on_rack(model: DrawnModel, i: Key, j: Key) -> tuple[float, float]:
    """The same for :func:`turn_on_rack`."""
    seen = pose(model, i)[1].T @ pose(model, j)[1]
    return _unit(-float(seen[1, 2]), float(seen[0, 2]))


def faces_away(model: DrawnModel, i: Key, j: Key) -> bool:
    """Whether the z axes of I and J make more than a right angle as the deck draws them."""
    return float(pose(model, i)[1][:, 2] @ pose(model, j)[1][:, 2]) < -ALIGNED


def equal_speed(scope: Scope, i: Frame, j: Frame, opposed: bool) -> Expr:
    """Zero where I is turned against J about an axis across both shafts: q_z = 0 of its quaternion.

    4 q_w q_z, 4 q_x q_z and 4 q_y q_z are sums of direction cosines; the first, x_I.y_J - y_I.x_J,
    says nothing where the joint is folded (q_w = 0).  From a bend of 120 degrees on it is the one
    whose factor is larger.  No single one will do: q and -q are one attitude, so that q_z has no
    sign.  ``opposed``: the z axes face each other, and y_I, z_I are taken the other way round.
    """
    (xi, yi, zi), (xj, yj, zj) = scope.axes(i), scope.axes(j)
    if opposed:
        yi, zi = scale(-1, yi), scale(-1, zi)
    scope.limit(dot(zi, zj) + NEARLY_FOLDED)
    return piecewise(
        (dot(xi, yj) - dot(yi, xj), dot(zi, zj) > -FOLDED),
        (dot(zi, xj) + dot(xi, zj), dot(xi, xj) > dot(yi, yj)),
        otherwise=dot(zi, yj) + dot(yi, zj), order=-1,
    )  # fmt: skip


def _unit(sine: float, cosine: float) -> tuple[float, float]:
    size = (sine * sine + cosine * cosine) ** 0.5 or 1.0
    sine, cosine = sine / size, cosine / size
    if abs(sine) < ALIGNED:
        return 0.0, 1.0 if cosine >= 0.0 else -1.0
    return sine, cosine
