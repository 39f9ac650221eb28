"""Numbers that carry their derivatives, and the functions of formulas for them.

A :class:`Dual` is a value with its slope: the derivatives by some coordinates, an array, or 0.0
where there are none.  The rules of differentiation are applied as values are computed, so that
slopes are exact to round-off.  What has no value is not a number; nothing here raises.

Elements and functions write their formulas with the operations of
:mod:`adamslite.symbolic.formulas`.  Inside :func:`~adamslite.symbolic.formulas.with_numbers`
these are the functions of this module.

Reference: Griewank, Walther, Evaluating Derivatives, 2008, chapter 3.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from types import SimpleNamespace
from typing import Any, TypeAlias

import numpy as np

from adamslite.symbolic.interpolant import Interpolant

Number: TypeAlias = "Dual | float"
Slope: TypeAlias = Any
"""An array, or 0.0."""

NAN = math.nan
pi = math.pi
S = SimpleNamespace(Zero=0.0, Half=0.5)


class Dual:
    """A value and its slope."""

    __slots__ = ("value", "slope")

    def __init__(self, value: float, slope: Slope = 0.0) -> None:
        self.value = value
        self.slope = slope

    def __add__(self, other: Number) -> Dual:
        if type(other) is Dual:
            return Dual(self.value + other.value, self.slope + other.slope)
        return Dual(self.value + _value(other), self.slope)

    __radd__ = __add__

    def __neg__(self) -> Dual:
        return Dual(-self.value, -self.slope)

    def __sub__(self, other: Number) -> Dual:
        if type(other) is Dual:
            return Dual(self.value - other.value, self.slope - other.slope)
        return Dual(self.value - _value(other), self.slope)

    def __rsub__(self, other: float) -> Dual:
        return Dual(other - self.value, -self.slope)

    def __mul__(self, other: Number) -> Dual:
        if type(other) is Dual:
            a, b = self.value, other.value
            return Dual(a * b, b * self.slope + a * other.slope)
        return Dual(self.value * _value(other), _value(other) * self.slope)

    __rmul__ = __mul__

    def __truediv__(self, other: Number) -> Dual:
        return self * _inverse(other)

    def __rtruediv__(self, other: float) -> Dual:
        return _inverse(self) * other

    def __pow__(self, exponent: Number) -> Dual:
        return power(self, exponent)

    def __rpow__(self, base: float) -> Dual:
        return power(Dual(base), self)

    def __lt__(self, other: Number) -> bool:
        return self.value < _value(other)

    def __le__(self, other: Number) -> bool:
        return self.value <= _value(other)

    def __gt__(self, other: Number) -> bool:
        return self.value > _value(other)

    def __ge__(self, other: Number) -> bool:
        return self.value >= _value(other)


def _value(x: Number) -> float:
    return x.value if isinstance(x, Dual) else x


def slope_of(x: Number) -> Slope:
    """The slope of a number, 0.0 of a plain one."""
    return x.slope if isinstance(x, Dual) else 0.0


def _times(factor: float, x: Number) -> Slope:
    """A multiple of the slope of a number; of what has none even an infinite one."""
    slope = slope_of(x)
    return factor * slope if isinstance(slope, np.ndarray) else 0.0


def _safe(function: Callable[..., float], *values: float) -> float:
    """A value that may not exist."""
    try:
        return function(*values)
    except (ArithmeticError, ValueError):
        return NAN


def _inverse(x: Number) -> Dual:
    value = _safe(lambda a: 1.0 / a, _value(x))
    return Dual(value, _times(-value * value, x))


def _smooth(
    function: Callable[[float], float], slope: Callable[[float], float]
) -> Callable[[Number], Dual]:
    """A function of one number from its value and its derivative."""

    def of(x: Number) -> Dual:
        at = _value(x)
        return Dual(_safe(function, at), _times(_safe(slope, at), x))

    return of


sin = _smooth(math.sin, math.cos)
cos = _smooth(math.cos, lambda x: -math.sin(x))
tan = _smooth(math.tan, lambda x: 1.0 + math.tan(x) ** 2)
asin = _smooth(math.asin, lambda x: 1.0 / math.sqrt(1.0 - x * x))
acos = _smooth(math.acos, lambda x: -1.0 / math.sqrt(1.0 - x * x))
atan = _smooth(math.atan, lambda x: 1.0 / (1.0 + x * x))
sinh = _smooth(math.sinh, math.cosh)
cosh = _smooth(math.cosh, math.sinh)
tanh = _smooth(math.tanh, lambda x: 1.0 - math.tanh(x) ** 2)
exp = _smooth(math.exp, math.exp)
log = _smooth(math.log, lambda x: 1.0 / x)
sqrt = _smooth(math.sqrt, lambda x: 0.5 / math.sqrt(x))


def atan2(y: Number, x: Number) -> Dual:
    """The angle of the point (x, y)."""
    a, b = _value(y), _value(x)
    square = _safe(lambda: 1.0 / (a * a + b * b))
    return Dual(math.atan2(a, b), _times(square * b, y) - _times(square * a, x))


def power(base: Number, exponent: Number) -> Dual:
    """base**exponent; where the exponent is a plain number the base may be negative."""
    a, n = _value(base), _value(exponent)
    value = _safe(math.pow, a, n)
    factor = 0.0 if n == 0.0 else n * _safe(math.pow, a, n - 1.0)
    slope = _times(factor, base)
    if isinstance(slope_of(exponent), np.ndarray):
        slope = slope + _times(value * _safe(math.log, a), exponent)
    return Dual(value, slope)


def And(*conditions: bool) -> bool:  # noqa: N802  as a word it is Python's
    """Whether all hold."""
    return all(conditions)


def chosen(*pieces: tuple[Number, bool], otherwise: Number, order: int | None = None) -> Number:
    """The value of the first condition that holds."""
    return next((value for value, holds in pieces if holds), otherwise)


def floor(x: Number, order: int | None = None) -> Dual:
    """The largest whole number not above x."""
    return Dual(_safe(math.floor, _value(x)))


def lookup(table: Interpolant, x: Number, curve: int, order: int) -> Dual:
    """A curve of a table at ``x``, or its derivative."""
    at = np.array([_value(x)])
    value, slope = (float(table.at(at, n)[0, int(curve)]) for n in (order, order + 1))
    return Dual(value, _times(slope, x))


def lookup_between(table: Interpolant, x: Number, z: Number, order: int, z_order: int) -> Dual:
    """A table of two arguments, linear from curve to curve; the outermost strips are extended."""
    at = int(np.searchsorted(table.places, _value(z), side="right")) - 1
    at = max(min(at, len(table.places) - 2), 0)
    low, high = (lookup(table, x, curve, order) for curve in (at, at + 1))
    start, end = float(table.places[at]), float(table.places[at + 1])
    rise = (high - low) / (end - start)
    return rise if z_order else low + (Dual(0.0) + z - start) * rise


def lookup_with_corners(table: Interpolant, pieces: Interpolant, x: Number, order: int) -> Dual:
    """A table of straight lines at ``x``, or its derivative."""
    return lookup(table, x, 0, order)


def lookup_between_with_corners(
    table: Interpolant, strips: Interpolant, x: Number, z: Number
) -> Dual:
    """A table of two arguments."""
    return lookup_between(table, x, z, 0, 0)
