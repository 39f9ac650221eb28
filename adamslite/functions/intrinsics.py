"""The arithmetic functions a deck shares with FORTRAN; angles are in radians."""

from __future__ import annotations

import math
from functools import reduce

from adamslite.language.function import function
from adamslite.symbolic.formulas import floor, fn, magnitude, piecewise, root
from adamslite.symbolic.scope import Scope
from adamslite.symbolic.types import Expr


def _truncated(x: Expr) -> Expr:
    return piecewise((floor(x, -1), x >= 0), otherwise=-floor(-x, -1), order=-1)


def _nearest(x: Expr) -> Expr:
    return piecewise((floor(x + 0.5, -1), x >= 0), otherwise=-floor(0.5 - x, -1), order=-1)


def _larger(a: Expr, b: Expr) -> Expr:
    return piecewise((a, a >= b), otherwise=b, order=0)


def _smaller(a: Expr, b: Expr) -> Expr:
    return piecewise((a, a <= b), otherwise=b, order=0)


def _against_first(*a: Expr) -> tuple[Expr, ...]:
    return tuple(x - y for index, x in enumerate(a) for y in a[index + 1 :])


@function("ABS", "x:number", edges=lambda x: (x,), order=0)
def abs_(scope: Scope, x: Expr) -> Expr:
    """Absolute value |x|.

    Unit: that of x.  Source: FORTRAN intrinsic ABS.
    """
    return magnitude(x)


@function("MAX", "*x1:number[2..100]", edges=_against_first, order=0)
def max_(scope: Scope, *a: Expr) -> Expr:
    """The largest of its arguments.

    Unit: theirs.  Source: FORTRAN intrinsic MAX.
    """
    return reduce(_larger, a)


@function("MIN", "*x1:number[2..100]", edges=_against_first, order=0)
def min_(scope: Scope, *a: Expr) -> Expr:
    """The smallest of its arguments.

    Unit: theirs.  Source: FORTRAN intrinsic MIN.
    """
    return reduce(_smaller, a)


@function("DIM", "a:number b:number", edges=lambda a, b: (a - b,), order=0)
def dim(scope: Scope, a: Expr, b: Expr) -> Expr:
    """Positive difference: a - b where a > b, else 0.

    Unit: that of a and b.  Source: FORTRAN intrinsic DIM.
    """
    return piecewise((a - b, a > b), otherwise=0, order=0)


@function("SIGN", "a:number b:number", edges=lambda a, b: (a, b), order=-1)
def sign(scope: Scope, a: Expr, b: Expr) -> Expr:
    """|a| where b >= 0, -|a| where b < 0.

    Unit: that of a.  Source: FORTRAN intrinsic SIGN.
    """
    size = magnitude(a)
    return piecewise((size, b >= 0), otherwise=-size, order=-1)


@function("MOD", "a:number b:number", edges=lambda a, b: (fn.sin(math.pi * a / b),), order=-1)
def mod(scope: Scope, a: Expr, b: Expr) -> Expr:
    """Remainder a - AINT(a/b) b; it has the sign of a.

    Unit: that of a and b.  Source: FORTRAN intrinsic MOD.
    """
    return a - _truncated(a / b) * b


@function("AINT", "x:number", edges=lambda x: (fn.sin(math.pi * x),), order=-1)
def aint(scope: Scope, x: Expr) -> Expr:
    """x without its fraction (towards 0).

    Unit: none.  Source: FORTRAN intrinsic AINT.
    """
    return _truncated(x)


@function("INT", "x:number", edges=lambda x: (fn.sin(math.pi * x),), order=-1)
def int_(scope: Scope, x: Expr) -> Expr:
    """x without its fraction (towards 0): another name of AINT.

    Unit: none.  Source: FORTRAN intrinsic INT.
    """
    return _truncated(x)


@function("ANINT", "x:number", edges=lambda x: (fn.cos(math.pi * x),), order=-1)
def anint(scope: Scope, x: Expr) -> Expr:
    """The whole number nearest to x, halves away from 0.

    Unit: none.  Source: FORTRAN intrinsic ANINT.
    """
    return _nearest(x)


@function("NINT", "x:number", edges=lambda x: (fn.cos(math.pi * x),), order=-1)
def nint(scope: Scope, x: Expr) -> Expr:
    """The whole number nearest to x, halves away from 0: another name of ANINT.

    Unit: none.  Source: FORTRAN intrinsic NINT.
    """
    return _nearest(x)


@function("SQRT", "x:number")
def sqrt(scope: Scope, x: Expr) -> Expr:
    """Square root of x >= 0.  Its derivative at 0 does not exist.

    Source: FORTRAN intrinsic SQRT.
    """
    return root(x)


@function("EXP", "x:number")
def exp(scope: Scope, x: Expr) -> Expr:
    """e to the power x.

    Unit: none.  Source: FORTRAN intrinsic EXP.
    """
    return fn.exp(x)


@function("LOG", "x:number")
def log(scope: Scope, x: Expr) -> Expr:
    """Natural logarithm of x > 0.

    Unit: none.  Source: FORTRAN intrinsic LOG.
    """
    return fn.log(x)


@function("LOG10", "x:number")
def log10(scope: Scope, x: Expr) -> Expr:
    """Logarithm of x > 0 to base 10.

    Unit: none.  Source: FORTRAN intrinsic LOG10.
    """
    return fn.log(x) / math.log(10.0)


@function("SIN", "x:number")
def sin(scope: Scope, x: Expr) -> Expr:
    """Sine of x radians.

    Source: FORTRAN intrinsic SIN.
    """
    return fn.sin(x)


@function("COS", "x:number")
def cos(scope: Scope, x: Expr) -> Expr:
    """Cosine of x radians.

    Source: FORTRAN intrinsic COS.
    """
    return fn.cos(x)


@function("TAN", "x:number")
def tan(scope: Scope, x: Expr) -> Expr:
    """Tangent of x radians.

    Source: FORTRAN intrinsic TAN.
    """
    return fn.tan(x)


@function("ASIN", "x:number")
def asin(scope: Scope, x: Expr) -> Expr:
    """Angle in -pi/2..pi/2 radians whose sine is x, |x| <= 1.

    Source: FORTRAN intrinsic ASIN.
    """
    return fn.asin(x)


@function("ACOS", "x:number")
def acos(scope: Scope, x: Expr) -> Expr:
    """Angle in 0..pi radians whose cosine is x, |x| <= 1.

    Source: FORTRAN intrinsic ACOS.
    """
    return fn.acos(x)


@function("ATAN", "x:number")
def atan(scope: Scope, x: Expr) -> Expr:
    """Angle in -pi/2..pi/2 radians whose tangent is x.

    Source: FORTRAN intrinsic ATAN.
    """
    return fn.atan(x)


@function("ATAN2", "y:number x:number")
def atan2(scope: Scope, y: Expr, x: Expr) -> Expr:
    """Angle in -pi..pi radians of the point (x, y); it jumps by a full turn across y = 0, x < 0.

    Source: FORTRAN intrinsic ATAN2.
    """
    return fn.atan2(y, x)


@function("SINH", "x:number")
def sinh(scope: Scope, x: Expr) -> Expr:
    """Hyperbolic sine of x.

    Source: FORTRAN intrinsic SINH.
    """
    return fn.sinh(x)


@function("COSH", "x:number")
def cosh(scope: Scope, x: Expr) -> Expr:
    """Hyperbolic cosine of x.

    Source: FORTRAN intrinsic COSH.
    """
    return fn.cosh(x)


@function("TANH", "x:number")
def tanh(scope: Scope, x: Expr) -> Expr:
    """Hyperbolic tangent of x.

    Source: FORTRAN intrinsic TANH.
    """
    return fn.tanh(x)
