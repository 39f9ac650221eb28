"""Sines, series and polynomials of one argument."""

from __future__ import annotations

import math

from adamslite.functions.steps import step5
from adamslite.language.function import ascending, function
from adamslite.symbolic.formulas import fn, piecewise
from adamslite.symbolic.scope import Scope
from adamslite.symbolic.types import Expr


@function("SHF", "x:number x0:number a:number w:number phi:number=0 b:number=0")
def shf(scope: Scope, x: Expr, x0: Expr, a: Expr, w: Expr, phi: Expr = 0, b: Expr = 0) -> Expr:
    """Simple harmonic: a sin(w (x - x0) - phi) + b.

    phi and w (x - x0) in radians.  Unit: that of a and b.  Source: Adams/Solver function SHF.
    """
    return a * fn.sin(w * (x - x0) - phi) + b


@function("FORCOS", "x:number x0:number w:number *a0:number[1..31]")
def forcos(scope: Scope, x: Expr, x0: Expr, w: Expr, *a: Expr) -> Expr:
    """Cosine series: a0 + sum a_j cos(j w (x - x0)), j = 1..30; a0 is not halved.

    Unit: that of the a_j.  Source: Adams/Solver function FORCOS.
    """
    return a[0] + sum(aj * fn.cos(j * w * (x - x0)) for j, aj in enumerate(a[1:], 1))


@function("FORSIN", "x:number x0:number w:number *a0:number[1..31]")
def forsin(scope: Scope, x: Expr, x0: Expr, w: Expr, *a: Expr) -> Expr:
    """Sine series: a0 + sum a_j sin(j w (x - x0)), j = 1..30.

    Unit: that of the a_j.  Source: Adams/Solver function FORSIN.
    """
    return a[0] + sum(aj * fn.sin(j * w * (x - x0)) for j, aj in enumerate(a[1:], 1))


@function("POLY", "x:number x0:number *a0:number[1..31]")
def poly(scope: Scope, x: Expr, x0: Expr, *a: Expr) -> Expr:
    """Polynomial: sum a_j (x - x0)**j, j = 0..30.

    Unit: that of a0.  Source: Adams/Solver function POLY.
    """
    total = a[-1]
    for aj in reversed(a[:-1]):
        total = aj + (x - x0) * total
    return total


@function("CHEBY", "x:number x0:number *a0:number[1..31]")
def cheby(scope: Scope, x: Expr, x0: Expr, *a: Expr) -> Expr:
    """Chebyshev series: sum a_j T_j(x - x0), T_0 = 1, T_1 = u, T_j = 2 u T_(j-1) - T_(j-2).

    Unit: that of the a_j.  Source: Adams/Solver function CHEBY.
    """
    u = x - x0
    # Clenshaw: b_j = a_j + 2 u b_(j+1) - b_(j+2), the sum is a_0 + u b_1 - b_2.
    after, last = 0, 0
    for aj in reversed(a[1:]):
        after, last = aj + 2 * u * after - last, after
    return a[0] + u * after - last


@function(
    "SWEEP",
    "x:number a:number x0:number f0:number x1:number f1:number dx:number",
    edges=lambda x, a, x0, f0, x1, f1, dx: (x - x0, x - x1, x - (x0 + dx)),
    order=1,
    rule=ascending(2, 4, "the sweep must begin below its end: x0 < x1"),
)
def sweep(scope: Scope, x: Expr, a: Expr, x0: Expr, f0: Expr, x1: Expr, f1: Expr, dx: Expr) -> Expr:
    """Sine of amplitude a whose frequency goes from f0 at x0 to f1 at x1, constant outside.

    a sin(2 pi p) STEP5(x, x0, 0, x0 + dx, 1), with the phase p(x) = f0 x up to x0,
    f0 x + (f1 - f0)(x - x0)**2/(2 (x1 - x0)) between, and f1 x - (f1 - f0)(x1 + x0)/2 beyond x1.
    f0, f1 in cycles per unit of x.  Unit: that of a.  Source: Adams/Solver function SWEEP.
    """
    rise = f1 - f0
    phase = piecewise(
        (f0 * x, x <= x0),
        (f1 * x - rise * (x1 + x0) / 2, x >= x1),
        otherwise=f0 * x + rise * (x - x0) ** 2 / (2 * (x1 - x0)),
        order=1,
    )
    return a * fn.sin(2 * math.pi * phase) * step5(scope, x, x0, 0, x0 + dx, 1)
