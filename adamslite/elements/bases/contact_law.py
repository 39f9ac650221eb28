"""Forces of a point of contact: normal force and friction.

With the depth d of penetration and its rate d', the normal force N where d > 0, else 0::

    IMPACT    N = max(0, STIFFNESS d^EXPONENT + STEP(d, 0, 0, DMAX, DAMPING) d')
    POISSON   N = PENALTY d                             sinking in, d' >= 0
              N = max(e^2 PENALTY d, PENALTY d + c d')  coming out, e = RESTITUTION_COEFFICIENT

Coming out gives back e^2 of the energy that sinking in took: whatever the masses and the speed, the
speed is e times what it was.  c only joins both branches, so that a body that lies still does not
have to choose: it is so large that it acts for a moment at the greatest depth.

Friction with the slip v of I at the common point, across the normal::

    F = -mu(|v|) N v/|v|
    mu = MU_STATIC u (3 - u^2)/2,  u = |v|/vs       up to vs = STICTION_TRANSITION_VELOCITY
         STEP from MU_STATIC to MU_DYNAMIC          up to vd = FRICTION_TRANSITION_VELOCITY
         MU_DYNAMIC                                 beyond

With STICTION=ON the surfaces hold by bristles, whose deflection b is a state (D =
MAX_STICTION_DEFORMATION)::

    F = -N (w mu v/|v| + (1 - w) MU_STATIC (b + (1 - b^2) v/vs (3 - u^2)/2)),  w = u^4 (3 - 2 u^2)
    D db/dt = v' - s |v'| b,  v' = v/sqrt(1 + u^2),  s from 0 at |b| = 0.9 to 1 at |b| = 1

so that below vs a load up to MU_STATIC N is held, and beyond vs friction is as without bristles.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from adamslite.functions.steps import spring, step
from adamslite.symbolic.formulas import norm, piecewise, root
from adamslite.symbolic.scope import dot, minus, plus, scale

if TYPE_CHECKING:
    from adamslite.elements.bases.contact_geometry import Touch
    from adamslite.symbolic.scope import Vector
    from adamslite.symbolic.types import Expr, Seen

# Deflection from which bristles begin to slip.
YIELDING = 0.9
FAR = 1e30


def normal_force(point: Seen, found: Touch, rate: Expr) -> Expr:
    """N of the table above.

    The branch of a contact goes on with depths below zero: a step that is too long leads far out of
    it, and where nothing acted there its error would seem small.
    """
    touching = found.overlap > 0
    depth = found.depth
    if point.law == "IMPACT":
        elastic = spring(point.stiffness, depth, point.exponent)
        damped = elastic + rate * step(None, depth, 0, 0, point.dmax, point.damping)
        force = piecewise((damped, _meant(damped, touching) > 0), otherwise=0, order=0)
    else:
        elastic = point.stiffness * depth
        least = point.restitution**2 * elastic
        coming_out = elastic + point.damping * rate
        force = piecewise(
            (elastic, _meant(rate, touching) >= 0),
            (coming_out, _meant(coming_out - least, touching) > 0),
            otherwise=least,
            order=0,
        )
    return piecewise((force, touching), otherwise=0, order=0)


def _meant(guard: Expr, condition: Expr) -> Expr:
    """A guard that means something under a condition only: elsewhere it does not move, so that no
    step is examined for its sake, and is so far from changing that the condition changes before.
    """
    return piecewise((guard, condition), otherwise=FAR)


def friction(point: Seen, load: Expr, slip: Vector, bristle: Vector | None) -> Vector:
    """The force on I."""
    square = dot(slip, slip)
    sliding = scale(-load * _over_speed(point, square, norm(slip)), slip)
    if bristle is None:
        return sliding
    share = square / point.vs**2
    weight = piecewise((share**2 * (3 - 2 * share), share <= 1), otherwise=1, order=1)
    damping = (1 - dot(bristle, bristle)) * (3 - share) / (2 * point.vs)
    held = plus(bristle, scale(damping, slip))
    holding = piecewise(((weight - 1) * load * point.mu_static, share <= 1), otherwise=0, order=1)
    return plus(scale(weight, sliding), scale(holding, held))


def _over_speed(point: Seen, square: Expr, speed: Expr) -> Expr:
    """mu over the slip, by the slip's square where it is small: even and smooth."""
    rest, moving, vs, vd = point.mu_static, point.mu_dynamic, point.vs, point.vd
    passed = (speed - vs) / (vd - vs)
    falling = rest + (moving - rest) * passed**2 * (3 - 2 * passed)
    return piecewise(
        (rest * (3 - square / vs**2) / (2 * vs), square <= vs**2),
        (falling / speed, square <= vd**2),
        otherwise=moving / speed,
        order=1,
    )


def bristle_rate(point: Seen, slip: Vector, bristle: Vector, touching: Expr) -> Vector:
    """db/dt; where nothing touches bristles straighten."""
    share = dot(slip, slip) / point.vs**2
    moved = scale(1 / root(1 + share), slip)
    bent = dot(bristle, bristle)
    passed = (bent - YIELDING**2) / (1 - YIELDING**2)
    yielding = piecewise(
        (0, passed <= 0), (passed**2 * (3 - 2 * passed), passed <= 1), otherwise=1, order=1
    )
    dragged = minus(moved, scale(yielding * norm(moved), bristle))
    straightening = scale(-point.vs, bristle)
    x, y, z = (
        piecewise((a, touching), otherwise=b, order=-1) / point.deformation
        for a, b in zip(dragged, straightening, strict=True)
    )
    return x, y, z


def across(vector: Vector, normal: Vector) -> Vector:
    """The part of a vector across a normal."""
    return minus(vector, scale(dot(vector, normal), normal))
