"""The stick-slip law of dry friction: a coefficient from the slip and from creep, a state.

Equations (v: slip of the surfaces, D: creep, vs: STICTION_TRANSITION_VELOCITY, vd = 1.5 vs unless
TRANSITION_VELOCITY_COEFFICIENT is another factor, Dm: MAX_STICTION_DEFORMATION)::

    |v| < vs       mu = MU_STATIC (beta v/|v| + (1 - beta) s(|D|/Dm) D/|D|),  beta = s(|v|/vs)
    vs ... vd      mu = STEP5(|v|, vs, MU_STATIC, vd, MU_DYNAMIC) v/|v|
    beyond         mu = MU_DYNAMIC v/|v|

    s(x) = STEP5(x, -1, -1, 1, 1) = (15 x - 10 x^3 + 3 x^5)/8 for |x| < 1

    dD/dt = v - f max(v . D, 0) D/|D|^2      where |v| < vs, D = 0 when it begins
    f = STEP5(|D|^2, Dm^2, 0, (1.01 Dm)^2, 1)     what lengthens D fades out beyond Dm
    D = 0          beyond vs

The coefficient and its first two derivatives are continuous at vs, vd and Dm; where v turns round
under a creep that has not begun to slip, its slope by v is not, unless D = 0.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, NamedTuple

from adamslite.functions.steps import step5
from adamslite.symbolic.formulas import magnitude, piecewise, root

if TYPE_CHECKING:
    from adamslite.symbolic.scope import Scope
    from adamslite.symbolic.types import Expr, Seen, Symbol

# Creep fades out between MAX_STICTION_DEFORMATION and this multiple of it, where friction no longer
# changes with it: an end at once were an event that a joint rests on.
LONGEST = 1.01
# A slip below this share of vs is none.
STILL = 1e-6


class Regime(NamedTuple):
    """What the law says: direction and coefficient by components, both along the slip.

    The direction is a unit vector in sliding and shorter at rest, where it is that of what holds.
    """

    direction: list[Expr]
    coefficient: list[Expr]
    creep_term: Expr
    beta: Expr
    deformation: list[Expr]


def regime(scope: Scope, friction: Seen, slip: Sequence[Expr]) -> Regime:
    """The law for a slip by components."""
    edge = friction.stiction_transition_velocity
    end = edge * friction.transition_velocity_coefficient
    rest, moving = coefficients(friction)
    within, speed = _is_slow(friction, slip), speed_of(slip, STILL * edge)
    slow = square(slip) / edge**2
    ramp = (15 - 10 * slow + 3 * slow**2) / (8 * edge)
    beta = speed * ramp
    held, creep_term = _held(friction)
    direction = [
        piecewise((v * ramp + (1 - beta) * h, within), otherwise=v / speed, order=2)
        for v, h in zip(slip, held or [0] * len(slip), strict=True)
    ]
    mu = step5(scope, speed, edge, rest, end, moving)
    fade = step5(scope, speed, edge, 1, end, 0) if friction.effect == "STICTION" else 1
    blend = piecewise((beta, within), otherwise=1)
    return Regime(
        [fade * d for d in direction],
        [mu * d for d in direction],
        piecewise((rest * creep_term, within), otherwise=0),
        blend,
        [
            piecewise((friction.max_stiction_deformation * d, blend < 1), otherwise=0)
            for d in friction.creep
        ],
    )


def creep_rate(
    scope: Scope, friction: Seen, slip: Sequence[Expr], number: int, state: Symbol
) -> Expr:
    """Rate of a component of D/Dm; the state counts from where sliding ended."""
    within, creep = _is_slow(friction, slip), friction.creep
    scope.origin(state, within)
    length = square(creep)
    full = step5(scope, length, 1, 0, LONGEST**2, 1)
    barred = piecewise((0, length <= 1), otherwise=full * _lengthening(slip, creep) / length)
    rate = slip[number] - barred * creep[number]
    rate = piecewise((rate, within), otherwise=0, order=-1)
    return rate / friction.max_stiction_deformation


def _lengthening(slip: Sequence[Expr], creep: Sequence[Expr]) -> Expr:
    """v . D where that is positive, else 0."""
    along: Expr = sum(v * d for v, d in zip(slip, creep, strict=True))
    if len(slip) == 1:  # by |v|, which turns round where friction does
        return (along + magnitude(slip[0]) * magnitude(creep[0], None)) / 2
    return piecewise((along, along > 0), otherwise=0)


def coefficients(friction: Seen) -> tuple[Expr, Expr]:
    """At rest and in motion, by EFFECT."""
    return {
        "ALL": (friction.mu_static, friction.mu_dynamic),
        "SLIDING": (friction.mu_dynamic, friction.mu_dynamic),
        "STICTION": (friction.mu_static, 0),
    }[friction.effect]


def _is_slow(friction: Seen, slip: Sequence[Expr]) -> Expr:
    """The condition |v| < vs."""
    return square(slip) < friction.stiction_transition_velocity**2


def _held(friction: Seen) -> tuple[list[Expr], Expr]:
    """s(|D|/Dm) D/|D| by components, and s(|D|/Dm)."""
    creep = friction.creep
    if not creep:
        return [], 0
    far = square(creep)
    length = size(creep)
    share = (15 - 10 * far + 3 * far**2) / 8
    held = [piecewise((d * share, far < 1), otherwise=d / length, order=2) for d in creep]
    return held, piecewise((length * share, far < 1), otherwise=1)


def square(vector: Sequence[Expr]) -> Expr:
    """|v|^2"""
    return sum(component**2 for component in vector)


def speed_of(slip: Sequence[Expr], still: Expr) -> Expr:
    """|v|; below ``still`` v^2/still, so that a joint at rest has one linear law: the mean of those
    of slips to either side.
    """
    total = square(slip)
    moving = magnitude(slip[0]) if len(slip) == 1 else root(total)
    return piecewise((total / still, total < still**2), otherwise=moving)


def size(vector: Sequence[Expr]) -> Expr:
    """|D|; at the zero vector its derivative is 0."""
    total = square(vector)
    return piecewise((root(total), total > 0), otherwise=0)
