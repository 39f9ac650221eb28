"""The numbers that are fitted, as coordinates in which steps of all of them are alike.

Equations, for a number p that starts at p0::

    p = p0 exp(x)     where p0 > 0 and it may not become negative: mass, stiffness, length
    p = p0 + |p0| x   elsewhere; the width of its bounds stands for |p0| where it starts at zero
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from math import inf, isfinite, log
from typing import Any

import numpy as np

from adamslite.errors import UsageError
from adamslite.reading.numbers import Named, Numbers

Bounds = Mapping[str, tuple[float | None, float | None] | str] | Iterable[str]
#: The exponential of more has no number.
LARGEST = 700.0
#: Of bounds as a text.
FORM = "for bounds write NAME=LOW:HIGH, as SPRINGDAMPER/1.K=50:500; either may be left out"


@dataclass(frozen=True)
class Parameter:
    """A number of the deck; ``unit``: of its argument."""

    name: str
    start: float
    low: float = -inf
    high: float = inf
    unit: str = ""

    @property
    def is_log(self) -> bool:
        """Whether it keeps its sign."""
        return self.start > 0.0 and (self.low >= 0.0 or self.low == -inf)

    @property
    def scale(self) -> float:
        """What counts as a change of one."""
        return abs(self.start) or self.high - self.low

    def value(self, x: float) -> float:
        """p of x."""
        found = self.start * np.exp(min(x, LARGEST)) if self.is_log else self.start + self.scale * x
        return float(min(max(found, self.low), self.high))

    def slope(self, x: float) -> float:
        """dp/dx."""
        return float(self.start * np.exp(x)) if self.is_log else self.scale

    def coordinate(self, value: float) -> float:
        """x of p."""
        if self.is_log:
            return log(value / self.start) if 0.0 < value < inf else (inf if value > 0.0 else -inf)
        return (value - self.start) / self.scale

    def at_bound(self, value: float) -> bool:
        """Whether a value is on one of its bounds, to a millionth."""
        slack = 1e-6 * max(self.scale, abs(value))
        return abs(value - self.low) <= slack or abs(value - self.high) <= slack


def parameters_of(
    numbers: Numbers, names: Iterable[str], bounds: Bounds, given: Mapping[str, float]
) -> list[Parameter]:
    """The numbers to fit, from their names and bounds.

    Parameters
    ----------
    given : mapping
        Values by full names that stand for those of the text.

    Raises
    ------
    UsageError
        When a name is none, is there twice, or bounds are not what they have to be.
    """
    listed = [names] if isinstance(names, str) else [*names]
    found = [numbers.find(name) for name in listed]
    if not found:
        raise UsageError("nothing is fitted: name numbers by --by, as --by SPRINGDAMPER/1.K")
    own = [each.name for each in found]
    twice = next((name for n, name in enumerate(own) if name in own[:n]), None)
    if twice:
        raise UsageError(f"{twice} is fitted twice")
    whole = next((each.name for each in found if each.argument.kind == "integer"), None)
    if whole:
        raise UsageError(f"{whole} takes whole numbers, which are not fitted")
    limits = {numbers.find(name).name: limit for name, limit in _limits(bounds)}
    for name in limits:
        if name not in own:
            raise UsageError(f"{name} has bounds and is not fitted: --by names what is fitted")
    return [_parameter(each, given, limits.get(each.name, (-inf, inf))) for each in found]


def _parameter(number: Named, given: Mapping[str, float], limits: tuple[float, float]) -> Parameter:
    low, high = limits
    start = given.get(number.name, number.value)
    made = Parameter(number.name, start, low, high, number.argument.unit)
    if not low < high:
        raise UsageError(f"bounds {made.name}={low:g}:{high:g}: nothing is between them")
    if not low <= made.start <= high:
        raise UsageError(
            f"{made.name} starts at {made.start:g}, outside of its bounds {low:g} to {high:g}; "
            f"it needs another start, or other bounds"
        )
    if made.start == 0.0 and not isfinite(high - low):
        raise UsageError(
            f"{made.name} starts at zero, which does not say how large it may be: it needs another "
            f"start, or two bounds, as {made.name}=-1:1"
        )
    return made


def _limits(bounds: Bounds) -> list[tuple[str, tuple[float, float]]]:
    """Names and their bounds."""
    given = [bounds] if isinstance(bounds, str) else bounds
    if not isinstance(given, Mapping):
        return [_written(text) for text in given]
    return [
        _written(f"{name}={limit}") if isinstance(limit, str) else (name, _pair(name, limit))
        for name, limit in given.items()
    ]


def _pair(name: str, limit: Any) -> tuple[float, float]:
    try:
        low, high = limit
        return _number(-inf if low is None else low), _number(inf if high is None else high)
    except (TypeError, ValueError):
        raise UsageError(f"{name}={limit}: {FORM}") from None


def _written(text: str) -> tuple[str, tuple[float, float]]:
    name, equal, words = text.partition("=")
    low, colon, high = words.partition(":")
    try:
        pair = (_number(low.strip() or -inf), _number(high.strip() or inf))
    except ValueError:
        raise UsageError(f"{text}: {FORM}") from None
    if not equal or not colon or not name.strip():
        raise UsageError(f"{text}: {FORM}")
    return name.strip(), pair


def _number(word: Any) -> float:
    value = float(word)
    if value != value:
        raise ValueError("not a number")
    return value
