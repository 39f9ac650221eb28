"""Smooth steps and one-sided contacts.

With D = (x - x0)/(x1 - x0), held at 0 before x0 and at 1 behind x1, a step is h0 + (h1 - h0) s(D):

    STEP    s = D**2 (3 - 2 D)                    first derivative continuous
    STEP5   s = D**3 (10 - 15 D + 6 D**2)         second derivative continuous
    HAVSIN  s = (1 - cos(pi D))/2                 first derivative continuous
"""

from __future__ import annotations

import math
from collections.abc import Callable

from adamslite.language.function import Mistake, ascending, function
from adamslite.symbolic.formulas import fn, piecewise, power
from adamslite.symbolic.scope import Scope
from adamslite.symbolic.types import Expr

STEP_SIGNATURE = "x:number x0:number h0:number x1:number h1:number"
STEP5_ENDS = ascending(1, 3, "STEP5 must begin below its end: x0 < x1")


def _apart(x: Expr, x0: float | None, h0: Expr, x1: float | None, h1: Expr) -> Mistake | None:
    if x0 is not None and x0 == x1:
        return 3, "a step needs a width: x1 must differ from x0"
    return None


def _edges(x: Expr, x0: Expr, h0: Expr, x1: Expr, h1: Expr) -> tuple[Expr, ...]:
    return (x - x0, x - x1)


def _blend(
    order: int, shape: Callable[[Expr], Expr], x: Expr, x0: Expr, h0: Expr, x1: Expr, h1: Expr,
    wave: bool = False,
) -> Expr:  # fmt: skip
    # The conditions are D <= 0 and D >= 1 without the division: x1 < x0 is a step to the left, and
    # x1 = x0 (a contact without damping depth) stays finite.
    width = x1 - x0
    before, behind, share = (x - x0) * width <= 0, (x - x1) * width >= 0, (x - x0) / width
    if wave:  # of time, it would have to be followed where the step is over, too
        share = piecewise((0, before), (1, behind), otherwise=share)
    rise = h0 + (h1 - h0) * shape(share)
    return piecewise((h0, before), (h1, behind), otherwise=rise, order=order)


@function("STEP", STEP_SIGNATURE, edges=_edges, order=1, rule=_apart)
def step(scope: Scope, x: Expr, x0: Expr, h0: Expr, x1: Expr, h1: Expr) -> Expr:
    """Cubic step from h0 (x <= x0) to h1 (x >= x1): h0 + (h1 - h0) D**2 (3 - 2 D).

    D = (x - x0)/(x1 - x0); with x1 < x0 the step goes to the left.
    Unit: that of h0 and h1.  Source: Adams/Solver function STEP.
    """
    return _blend(1, lambda d: d**2 * (3 - 2 * d), x, x0, h0, x1, h1)


@function("STEP5", STEP_SIGNATURE, edges=_edges, order=2, rule=STEP5_ENDS)
def step5(scope: Scope, x: Expr, x0: Expr, h0: Expr, x1: Expr, h1: Expr) -> Expr:
    """Quintic step from h0 (x <= x0) to h1 (x >= x1): h0 + (h1 - h0) D**3 (10 - 15 D + 6 D**2).

    D = (x - x0)/(x1 - x0).  Unit: that of h0 and h1.  Source: Adams/Solver function STEP5.
    """
    return _blend(2, lambda d: d**3 * (10 - 15 * d + 6 * d**2), x, x0, h0, x1, h1)


@function("HAVSIN", STEP_SIGNATURE, edges=_edges, order=1, rule=_apart)
def havsin(scope: Scope, x: Expr, x0: Expr, h0: Expr, x1: Expr, h1: Expr) -> Expr:
    """Haversine step from h0 (x <= x0) to h1 (x >= x1): h0 + (h1 - h0) (1 - cos(pi D))/2.

    D = (x - x0)/(x1 - x0).  Unit: that of h0 and h1.  Source: Adams/Solver function HAVSIN.
    """
    return _blend(1, lambda d: (1 - fn.cos(math.pi * d)) / 2, x, x0, h0, x1, h1, wave=True)


@function(
    "IMPACT",
    "x:number v:number x1:number k:number e:exponent cmax:number d:number",
    edges=lambda x, v, x1, k, e, cmax, d: (x - x1, x - (x1 - d)),
    order=0,
)
def impact(scope: Scope, x: Expr, v: Expr, x1: Expr, k: Expr, e: Expr, cmax: Expr, d: Expr) -> Expr:
    """One-sided contact where x < x1: max(0, k (x1 - x)**e - v STEP(x, x1 - d, cmax, x1, 0)).

    v is the time derivative of x; the damping grows to cmax over the depth d.  Never negative: it
    pushes x up and does not pull.  Unit: force.  Source: Adams/Solver function IMPACT.
    """
    touching = scope.touch(x < x1)
    force = spring(k, x1 - x, e) - v * step(scope, x, x1 - d, cmax, x1, 0)
    return piecewise((force, fn.And(touching, force > 0)), otherwise=0, order=0)


def spring(k: Expr, depth: Expr, e: Expr) -> Expr:
    """k depth**e, continued as an odd function: a step that ends just behind the contact stays
    finite.
    """
    if e in (1, 3):
        return k * power(depth, e)
    deep = depth >= 0
    size = piecewise((depth, deep), otherwise=-depth)
    return k * power(size, e) * piecewise((1, deep), otherwise=-1)


@function(
    "BISTOP",
    "x:number v:number x1:number x2:number k:number e:exponent cmax:number d:number",
    edges=lambda x, v, x1, x2, k, e, cmax, d: (x - x1, x - (x1 - d), x - x2, x - (x2 + d)),
    order=0,
    rule=ascending(2, 3, "the lower stop must lie below the upper one: x1 < x2"),
)
def bistop(
    scope: Scope, x: Expr, v: Expr, x1: Expr, x2: Expr, k: Expr, e: Expr, cmax: Expr, d: Expr
) -> Expr:
    """Stops at x1 and x2: IMPACT up from x1, its mirror image down from x2, 0 between them.

    x < x1: max(0, k (x1 - x)**e - v STEP(x, x1 - d, cmax, x1, 0));
    x > x2: min(0, -k (x - x2)**e - v STEP(x, x2, 0, x2 + d, cmax)).
    Unit: force; positive pushes x up.  Source: Adams/Solver function BISTOP.
    """
    lower = impact(scope, x, v, x1, k, e, cmax, d)
    upper = impact(scope, -x, -v, -x2, k, e, cmax, d)
    return lower - upper
