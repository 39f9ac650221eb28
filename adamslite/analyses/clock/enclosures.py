"""Interval arithmetic: bounds of an expression of time and of its rate over a span of time.

An instruction (:mod:`adamslite.kernels.code.clock_program`) becomes an *enclosure* over n spans at
once: the least and the largest value, the least and the largest rate, each (n,) or a number.  Every
value that the expression takes within the span lies between them, up to round-off; with the span
they shrink to it.  Where a branch that jumps is not decided the rate is unbounded.

Reference: Moore, Kearfott, Cloud, Introduction to Interval Analysis, 2009, chapters 5 and 6.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, Any, TypeAlias

import numpy as np

from adamslite.analyses.clock.table_ranges import ranges

if TYPE_CHECKING:
    from adamslite.symbolic.interpolant import Interpolant

Bound: TypeAlias = Any
"""One number for all spans of time, or one for each, (n,)."""
Interval = tuple[Bound, Bound]
Enclosure = tuple[Any, Any]
"""Intervals of a value and of its rate; of a condition whether it may hold, and may not."""
Values = list[Enclosure]
Instruction = tuple[Any, ...]
"""A word, and what its rule takes after the values."""
# The kind of analysis, as MODE gives it.
DYNAMICS = 4.0


def enclose(code: Sequence[Instruction], low: np.ndarray, high: np.ndarray) -> np.ndarray:
    """Least and largest value and rate of the last instruction over spans of time, (4, n)."""
    values: Values = []
    with np.errstate(all="ignore"):
        for name, *given in code:
            if name == "t":
                values.append(((low, high), (np.float64(1.0), np.float64(1.0))))
            else:
                values.append(RULES[name](values, *given))
    result = np.empty((4, len(low)))
    result[:] = [np.broadcast_to(x, len(low)) for pair in values[-1] for x in pair]
    return result


def _plus(a: Interval, b: Interval) -> Interval:
    low, high = np.asarray(a[0] + b[0]), np.asarray(a[1] + b[1])
    if np.isnan(low + high).any():
        return np.where(np.isnan(low), -np.inf, low), np.where(np.isnan(high), np.inf, high)
    return low, high


def _times(a: Interval, b: Interval) -> Interval:
    w, x, y, z = a[0] * b[0], a[0] * b[1], a[1] * b[0], a[1] * b[1]
    if np.isnan(w + x + y + z).any():
        # Zero times what has no bound: an exact zero.
        w, x, y, z = (np.where(np.isnan(each), 0.0, each) for each in (w, x, y, z))
    low, high = np.minimum(np.minimum(w, x), np.minimum(y, z)), np.maximum(w, x)
    return low, np.maximum(high, np.maximum(y, z))


def _inverse(a: Interval) -> Interval:
    low, high = np.asarray(1.0 / a[1]), np.asarray(1.0 / a[0])
    across = (a[0] < 0.0) & (a[1] > 0.0)
    low = np.where(across | (a[1] == 0.0), -np.inf, low)
    return low, np.where(across | (a[0] == 0.0), np.inf, high)


def _even(a: Interval, power: Callable[[Bound], Bound]) -> Interval:
    """An even function that grows away from zero."""
    one, other = power(np.abs(a[0])), power(np.abs(a[1]))
    across = (a[0] < 0.0) & (a[1] > 0.0)
    return np.where(across, power(0.0), np.minimum(one, other)), np.maximum(one, other)


def _power(a: Interval, p: int, q: int) -> Interval:
    """a**(p/q); fractions only of what is not negative."""
    if p < 0:
        return _inverse(_power(a, -p, q))
    if q != 1:
        return np.maximum(a[0], 0.0) ** (p / q), np.maximum(a[1], 0.0) ** (p / q)
    if p % 2:
        return a[0] ** p, a[1] ** p
    return _even(a, lambda x: x**p)


def _cosine(a: Interval) -> Interval:
    """Extrema at the multiples of pi that lie inside."""
    one, other = np.cos(a[0]), np.cos(a[1])
    top = np.floor(a[1] / (2.0 * math.pi)) >= np.ceil(a[0] / (2.0 * math.pi))
    bottom = np.floor(a[1] / (2.0 * math.pi) - 0.5) >= np.ceil(a[0] / (2.0 * math.pi) - 0.5)
    wide = ~np.isfinite(a[0] + a[1])
    low = np.where(bottom | wide, -1.0, np.minimum(one, other))
    return low, np.where(top | wide, 1.0, np.maximum(one, other))


def _sine(a: Interval) -> Interval:
    return _cosine((a[0] - 0.5 * math.pi, a[1] - 0.5 * math.pi))


def _tangent(a: Interval) -> Interval:
    pole = np.floor(a[1] / math.pi - 0.5) >= np.ceil(a[0] / math.pi - 0.5)
    pole |= ~np.isfinite(a[0] + a[1])
    return np.where(pole, -np.inf, np.tan(a[0])), np.where(pole, np.inf, np.tan(a[1]))


def _rising(
    function: Callable[[Bound], Bound], least: float, most: float
) -> Callable[[Interval], Interval]:
    """A function that rises where it is defined, from ``least`` to ``most``."""
    return lambda a: (function(np.clip(a[0], least, most)), function(np.clip(a[1], least, most)))


def _one_less_square(a: Interval) -> Interval:
    low, high = _even(a, np.square)
    return 1.0 - high, 1.0 - low


def _bell(a: Interval, power: int) -> Interval:
    """(1 -+ a**2)**(-1/2) for ``power`` 2, else 1/(1 + a**2)."""
    if power == 1:
        return _inverse(_plus((1.0, 1.0), _even(a, np.square)))
    inside = (np.clip(a[0], -1.0, 1.0), np.clip(a[1], -1.0, 1.0))
    return _inverse(_power(_one_less_square(inside), 1, 2))


def _minus(a: Interval) -> Interval:
    return -a[1], -a[0]


_exp = _rising(np.exp, -np.inf, np.inf)
_tanh = _rising(np.tanh, -np.inf, np.inf)
_sinh = _rising(np.sinh, -np.inf, np.inf)
_log = _rising(np.log, 0.0, np.inf)


def _cosh(a: Interval) -> Interval:
    return _even(a, np.cosh)


def _arccosine(a: Interval) -> Interval:
    return np.arccos(np.clip(a[1], -1.0, 1.0)), np.arccos(np.clip(a[0], -1.0, 1.0))


# Value and rate by the argument of functions of one argument.
FUNCTIONS: dict[str, tuple[Callable[[Interval], Interval], Callable[[Interval], Interval]]] = {
    "sin": (_sine, _cosine),
    "cos": (_cosine, lambda a: _minus(_sine(a))),
    "tan": (_tangent, lambda a: _plus((1.0, 1.0), _even(_tangent(a), np.square))),
    "asin": (_rising(np.arcsin, -1.0, 1.0), lambda a: _bell(a, 2)),
    "acos": (_arccosine, lambda a: _minus(_bell(a, 2))),
    "atan": (_rising(np.arctan, -np.inf, np.inf), lambda a: _bell(a, 1)),
    "sinh": (_sinh, _cosh),
    "cosh": (_cosh, _sinh),
    "tanh": (_tanh, lambda a: _one_less_square(_tanh(a))),
    "exp": (_exp, _exp),
    "log": (_log, lambda a: _inverse((np.maximum(a[0], 0.0), a[1]))),
}


def _number(values: Values, value: float) -> Enclosure:
    exact, still = np.float64(value), np.float64(0.0)
    return (exact, exact), (still, still)


def _add(values: Values, *terms: int) -> Enclosure:
    value, rate = values[terms[0]]
    for each in terms[1:]:
        value, rate = _plus(value, values[each][0]), _plus(rate, values[each][1])
    return value, rate


def _multiply(values: Values, *factors: int) -> Enclosure:
    value, rate = values[factors[0]]
    for each in factors[1:]:
        other, its_rate = values[each]
        rate = _plus(_times(value, its_rate), _times(rate, other))
        value = _times(value, other)
    return value, rate


def _less(values: Values, first: int, second: int) -> Enclosure:
    """A difference."""
    return _add([values[first], _negative(values, second)], 0, 1)


def _negative(values: Values, argument: int) -> Enclosure:
    value, rate = values[argument]
    return _minus(value), _minus(rate)


def _quotient(values: Values, top: int, bottom: int) -> Enclosure:
    return _multiply([values[top], _root(values, bottom, -1, 1)], 0, 1)


def _root(values: Values, base: int, p: int, q: int) -> Enclosure:
    """A rational power; its rate is (p/q) a**(p/q - 1) a'."""
    value, rate = values[base]
    slope = _power(value, p - q, q) if p != q else (1.0, 1.0)
    return _power(value, p, q), _times(_times((p / q, p / q), slope), rate)


def _pow(values: Values, base: int, exponent: int) -> Enclosure:
    """a**b = exp(b log a)."""
    logarithm = _of_one("log")(values, base)
    kept = [logarithm, values[exponent]]
    return _of_one("exp")([_multiply(kept, 0, 1)], 0)


def _of_one(name: str) -> Callable[..., Enclosure]:
    function, slope = FUNCTIONS[name]

    def rule(values: Values, argument: int) -> Enclosure:
        value, rate = values[argument]
        return function(value), _times(slope(value), rate)

    return rule


def _atan2(values: Values, sine: int, cosine: int) -> Enclosure:
    """The angle of a point (c, s): at the corners of its box, unless that meets the cut."""
    (s, ds), (c, dc) = values[sine], values[cosine]
    angles = [np.arctan2(y, x) for y in s for x in c]
    cut = (c[0] <= 0.0) & (s[0] <= 0.0) & (s[1] >= 0.0) & ~((s[0] == s[1]) & (c[0] == c[1]))
    low = np.where(cut, -math.pi, np.minimum.reduce(np.broadcast_arrays(*angles)))
    high = np.where(cut, math.pi, np.maximum.reduce(np.broadcast_arrays(*angles)))
    square = _plus(_even(s, np.square), _even(c, np.square))
    turn = _times(_plus(_times(c, ds), _minus(_times(s, dc))), _inverse(square))
    return (low, high), (np.where(cut, -np.inf, turn[0]), np.where(cut, np.inf, turn[1]))


def _floor(values: Values, argument: int) -> Enclosure:
    (low, high), _ = values[argument]
    low, high = np.floor(low), np.floor(high)
    unknown = np.where(low == high, 0.0, np.inf)
    return (low, high), (-unknown, unknown)


def _choose(values: Values, jumps: bool, *pieces: int) -> Enclosure:
    """All pieces that may be chosen; ``pieces``: conditions and values in turn."""
    open_: np.ndarray | bool = True
    several: np.ndarray | bool = False
    reach: Interval = (np.inf, -np.inf)
    rates: Interval = (np.inf, -np.inf)
    for condition, piece in zip(pieces[::2], pieces[1::2], strict=True):
        may, may_not = values[condition]
        taken, (value, rate) = open_ & may, values[piece]
        reach, rates = _joined(taken, reach, value), _joined(taken, rates, rate)
        several = several | (taken & may_not)
        open_ = open_ & may_not
    if jumps:
        rates = np.where(several, -np.inf, rates[0]), np.where(several, np.inf, rates[1])
    return reach, rates


def _joined(taken: np.ndarray | bool, a: Interval, b: Interval) -> Interval:
    """The span of both where ``taken``."""
    return np.where(taken, np.fmin(a[0], b[0]), a[0]), np.where(taken, np.fmax(a[1], b[1]), a[1])


def _relation(compare: Callable[[Interval, Interval], Enclosure]) -> Callable[..., Enclosure]:
    return lambda values, a, b: compare(values[a][0], values[b][0])


def _equal(a: Interval, b: Interval) -> Enclosure:
    return (a[0] <= b[1]) & (b[0] <= a[1]), (a[0] != a[1]) | (b[0] != b[1]) | (a[0] != b[0])


def _both(values: Values, *terms: int) -> Enclosure:
    may, may_not = values[terms[0]]
    for each in terms[1:]:
        may, may_not = may & values[each][0], may_not | values[each][1]
    return may, may_not


def _either(values: Values, *terms: int) -> Enclosure:
    may_not, may = _both([each[::-1] for each in values], *terms)
    return may, may_not


def _lookup(values: Values, table: Interpolant, curve: int, order: int, at: int) -> Enclosure:
    """A curve of a table; its rate is that of the argument times the next derivative."""
    (low, high), rate = values[at]
    here, slope = (_of_curve(table, curve, order + k, (low, high)) for k in range(2))
    jumps = ranges(table, curve, order).jumps_within(*_arrays(low, high)) if order < 4 else False
    return here, _unbounded(jumps, _times(slope, rate))


def _lookup_between(
    values: Values, table: Interpolant, order: int, z_order: int, x: int, z: int
) -> Enclosure:
    """A table of two arguments: the sum of both slopes times the rates of their arguments."""
    (at, its_rate), (across, z_rate) = values[x], values[z]
    by_x = _times(_between(table, order + 1, z_order, at, across), its_rate)
    by_z = _times(_between(table, order, z_order + 1, at, across), z_rate)
    jumps = np.logical_or.reduce(
        [ranges(table, k, order).jumps_within(*_arrays(*at)) for k in range(len(table.places))]
    )
    places = table.places[1:-1]
    first, last = (np.searchsorted(places, side, side="right") for side in _arrays(*across))
    jumps = jumps | ((first < last) & (z_order > 0))
    return _between(table, order, z_order, at, across), _unbounded(jumps, _plus(by_x, by_z))


def _between(table: Interpolant, order: int, z_order: int, x: Interval, z: Interval) -> Interval:
    """Values between all pairs of neighbouring curves that z meets."""
    places, last = table.places, len(table.places) - 1
    if last == 0:
        return _of_curve(table, 0, order, x) if z_order == 0 else (np.float64(0.0),) * 2
    total = (np.inf, -np.inf)
    for k in range(last):
        low, high = places[k] if k else -np.inf, places[k + 1] if k < last - 1 else np.inf
        met = (z[0] <= high) & (z[1] >= low)
        one, other = (_of_curve(table, c, order, x) for c in (k, k + 1))
        rise = _plus(other, _minus(one))
        slope = _times(rise, _both_ends(1.0 / (places[k + 1] - places[k])))
        way = tuple(np.clip(end, low, high) - places[k] for end in z)
        pieces = (_plus(one, _times(way, slope)), slope, _both_ends(0.0))
        total = _joined(met, total, pieces[min(z_order, 2)])
    return total


def _of_curve(table: Interpolant, curve: int, order: int, x: Interval) -> Interval:
    return ranges(table, curve, order).within(*_arrays(*x)) if order < 4 else _both_ends(0.0)


def _arrays(low: Bound, high: Bound) -> tuple[np.ndarray, np.ndarray]:
    one, other = np.broadcast_arrays(np.atleast_1d(low), np.atleast_1d(high))
    return one, other


def _both_ends(x: float) -> Interval:
    return np.float64(x), np.float64(x)


def _unbounded(where: np.ndarray | bool, rate: Interval) -> Interval:
    return np.where(where, -np.inf, rate[0]), np.where(where, np.inf, rate[1])


# Conditions are (may be true, may be false).
RULES: dict[str, Callable[..., Enclosure]] = {
    "Add": _add, "Mul": _multiply, "root": _root, "Pow": _pow, "atan2": _atan2,
    "-": _less, "neg": _negative, "/": _quotient,
    "floor": _floor, "choose": _choose, "And": _both, "Or": _either,
    "Lookup": _lookup, "LookupBetween": _lookup_between,
    "Not": lambda values, a: values[a][::-1],
    "decided": lambda values, holds: (np.bool_(holds), np.bool_(not holds)),
    "number": _number, "mode": lambda values: _number(values, DYNAMICS),
    "nan": lambda values: _number(values, math.nan),
    "<": _relation(lambda a, b: (a[0] < b[1], ~(a[1] < b[0]))),
    "<=": _relation(lambda a, b: (a[0] <= b[1], ~(a[1] <= b[0]))),
    ">": _relation(lambda a, b: (a[1] > b[0], ~(a[0] > b[1]))),
    ">=": _relation(lambda a, b: (a[1] >= b[0], ~(a[0] >= b[1]))),
    "==": _relation(lambda a, b: _equal(a, b)),
    "!=": _relation(lambda a, b: _equal(a, b)[::-1]),
    **{name: _of_one(name) for name in FUNCTIONS},
}  # fmt: skip
