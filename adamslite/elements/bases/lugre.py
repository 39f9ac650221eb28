"""The LuGre law of dry friction: bristles that bend, a state.

Equations (v: slip of the surfaces, z: deformation of the bristles, b = k z, the state)::

    mu = k z + c dz/dt + f v,     dz/dt = v - k |v| z/g
    g  = MU_DYNAMIC + (MU_STATIC - MU_DYNAMIC) exp(-(|v|/w)^p)

At a constant slip z reaches g v/(k |v|): mu = g + f |v| along v.  A vector law of the same form
holds for slips with components.  The direction b/g has the size 1 there.

Source: Canudas de Wit, Olsson, Astrom, Lischinsky, A New Model for Control of Systems with
Friction, IEEE Transactions on Automatic Control 40 (1995) 419.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from adamslite.elements.bases.stick_slip import STILL, Regime, size, speed_of
from adamslite.symbolic.formulas import fn, piecewise, power

if TYPE_CHECKING:
    from adamslite.symbolic.scope import Scope
    from adamslite.symbolic.types import Expr, Seen, Symbol


def regime(scope: Scope, friction: Seen, slip: Sequence[Expr]) -> Regime:
    """The law for a slip by components."""
    speed, bristles = slip_speed(friction, slip), friction.creep
    share = [b / level(friction, speed) for b in bristles]
    yields = [v - speed * d for v, d in zip(slip, share, strict=True)]
    damping, viscous = friction.damping_coefficient, friction.viscous_friction_coefficient
    mu = [
        b + damping * rate + viscous * v for b, rate, v in zip(bristles, yields, slip, strict=True)
    ]
    stiffness = friction.bristle_stiffness_coefficient
    return Regime(share, mu, size(bristles), fn.S.Zero, [b / stiffness for b in bristles])


def creep_rate(
    scope: Scope, friction: Seen, slip: Sequence[Expr], number: int, state: Symbol
) -> Expr:
    """Rate of a component of b = k z."""
    speed = slip_speed(friction, slip)
    yields = slip[number] - speed * friction.creep[number] / level(friction, speed)
    return friction.bristle_stiffness_coefficient * yields


def slip_speed(friction: Seen, slip: Sequence[Expr]) -> Expr:
    """|v|"""
    return speed_of(slip, STILL * friction.velocity_threshold_stribeck)


def level(friction: Seen, speed: Expr) -> Expr:
    """g, the coefficient at a constant slip."""
    rest, moving = friction.mu_static, friction.mu_dynamic
    x = speed / friction.velocity_threshold_stribeck
    # The slope of x**p is written with 1/x.
    decay = piecewise((power(x, friction.decay_exponent_stribeck), x > 0), otherwise=0)
    return moving + (rest - moving) * fn.exp(-decay)
