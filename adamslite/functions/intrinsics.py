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


def _whole(name: str, synonym: str, nearest: bool, page: str) -> None:
    """Register a function that rounds, under both of its names."""

    def body(scope: Scope, x: Expr) -> Expr:
        return _nearest(x) if nearest else _truncated(x)

    def edges(x: Expr) -> tuple[Expr, ...]:
        return ((fn.cos if nearest else fn.sin)(math.pi * x),)

    for each, note in ((name, ""), (synonym, f": another name of {name}")):
        body.__doc__ = f"{page}{note}.\n\nUnit: none.  Source: FORTRAN intrinsic {each}."
        function(each, "x:number", edges=edges, order=-1)(body)


_whole("AINT", "INT", False, "x without its fraction (towards 0)")
_whole("ANINT", "NINT", True, "The whole number nearest to x, halves away from 0")


@function("SQRT", "x:number")
def sqrt(scope: Scope, x: Expr) -> Expr:
    """Square root of x >= 0.  Its derivative at 0 does not exist.

    Source: FORTRAN intrinsic SQRT.
    """
    return root(x)


def _plain(name: str, page: str) -> None:
    """Register a function of one argument that formulas have under the same name."""

    def body(scope: Scope, x: Expr) -> Expr:
        return getattr(fn, name.lower())(x)

    body.__doc__ = f"{page}Source: FORTRAN intrinsic {name}."
    function(name, "x:number")(body)


_plain("EXP", "e to the power x.\n\nUnit: none.  ")
_plain("LOG", "Natural logarithm of x > 0.\n\nUnit: none.  ")


@function("LOG10", "x:number")
def log10(scope: Scope, x: Expr) -> Expr:
    """Logarithm of x > 0 to base 10.

    Unit: none.  Source: FORTRAN intrinsic LOG10.
    """
    return fn.log(x) / math.log(10.0)


_plain("SIN", "Sine of x radians.\n\n")
_plain("COS", "Cosine of x radians.\n\n")
_plain("TAN", "Tangent of x radians.\n\n")
_plain("ASIN", "Angle in -pi/2..pi/2 radians whose sine is x, |x| <= 1.\n\n")
_plain("ACOS", "Angle in 0..pi radians whose cosine is x, |x| <= 1.\n\n")
_plain("ATAN", "Angle in -pi/2..pi/2 radians whose tangent is x.\n\n")


@function("ATAN2", "y:number x:number")
def atan2(scope: Scope, y: Expr, x: Expr) -> Expr:
    """Angle in -pi..pi radians of the point (x, y); it jumps by a full turn across y = 0, x < 0.

    Source: FORTRAN intrinsic ATAN2.
    """
    return fn.atan2(y, x)


_plain("SINH", "Hyperbolic sine of x.\n\n")
_plain("COSH", "Hyperbolic cosine of x.\n\n")
_plain("TANH", "Hyperbolic tangent of x.\n\n")
