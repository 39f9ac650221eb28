"""Numbers that know what they were made of.

A deck that is read with the numbers of its text as traced ones is made of them as of any others:
:class:`Traced` is a ``float``.  What becomes of a number by ``+ - * / **`` has a *recipe*,

    ("written", number)    (operator, recipe or number, ...)

by which it is made again of other numbers, with the same rounding.  Everything else, as a function
of a library, gives plain numbers: who relies on recipes compares once with the long way.
"""

from __future__ import annotations

import math
import operator
from collections.abc import Callable, Iterable, Mapping
from typing import Any, TypeAlias

Recipe: TypeAlias = tuple[Any, ...]
WRITTEN = "written"
PLAIN = (float, int)


class Traced(float):
    """A number with its recipe."""

    __slots__ = ("recipe",)
    recipe: Recipe

    def __new__(cls, value: float, recipe: Recipe) -> Traced:
        made = super().__new__(cls, value)
        made.recipe = recipe
        return made

    def __reduce__(self) -> tuple[type[float], tuple[float]]:
        return float, (float(self),)  # kept on disk as any other

    def __neg__(self) -> Traced:
        return Traced(-float(self), (operator.neg, self.recipe))

    def __add__(self, other: float) -> Traced:
        return _made(operator.add, self, other) if isinstance(other, PLAIN) else NotImplemented

    def __radd__(self, other: float) -> Traced:
        return _made(operator.add, other, self) if isinstance(other, PLAIN) else NotImplemented

    def __sub__(self, other: float) -> Traced:
        return _made(operator.sub, self, other) if isinstance(other, PLAIN) else NotImplemented

    def __rsub__(self, other: float) -> Traced:
        return _made(operator.sub, other, self) if isinstance(other, PLAIN) else NotImplemented

    def __mul__(self, other: float) -> Traced:
        return _made(operator.mul, self, other) if isinstance(other, PLAIN) else NotImplemented

    def __rmul__(self, other: float) -> Traced:
        return _made(operator.mul, other, self) if isinstance(other, PLAIN) else NotImplemented

    def __truediv__(self, other: float) -> Traced:
        return _made(operator.truediv, self, other) if isinstance(other, PLAIN) else NotImplemented

    def __rtruediv__(self, other: float) -> Traced:
        return _made(operator.truediv, other, self) if isinstance(other, PLAIN) else NotImplemented


def power(base: float, exponent: float) -> float:
    """base ** exponent of real numbers."""
    if type(base) is Traced or type(exponent) is Traced:
        return _made(math.pow, base, exponent)
    return math.pow(base, exponent)


def _made(function: Callable[..., float], *given: float) -> Traced:
    parts = [each.recipe if type(each) is Traced else float(each) for each in given]
    return Traced(function(*map(float, given)), (function, *parts))


def traced(values: Iterable[float]) -> list[Traced]:
    """The traced ones."""
    return [each for each in values if type(each) is Traced]


def untraced(values: Iterable[Any]) -> list[Any]:
    """Values with plain numbers in place of traced ones."""
    return [float(each) if type(each) is Traced else each for each in values]


def again(recipe: Recipe, written: Mapping[int, float]) -> float:
    """The number that a recipe makes of the numbers ``written``, by their place in the text.

    Raises
    ------
    ArithmeticError, ValueError
        Where an operation has no value.
    """
    if recipe[0] == WRITTEN:
        return written[recipe[1]]
    parts = [again(each, written) if type(each) is tuple else each for each in recipe[1:]]
    return float(recipe[0](*parts))


def places(recipe: Recipe) -> set[int]:
    """The numbers of the text that a recipe takes."""
    if recipe[0] == WRITTEN:
        return {recipe[1]}
    found: set[int] = set()
    return found.union(*(places(each) for each in recipe[1:] if type(each) is tuple))
