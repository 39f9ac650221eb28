"""Factors between units that are written in symbols: ``mm/s^2`` to ``m/s^2``."""

from __future__ import annotations

from collections.abc import Mapping
from functools import cache
from itertools import product
from math import inf, pi

import numpy as np

from adamslite.language.units import FORCE, LENGTH, MASS, SYMBOLS, TIME

KINDS = {"force": FORCE, "mass": MASS, "length": LENGTH, "time": TIME}
SIZES = {
    SYMBOLS[name]: (kind, size) for kind, units in KINDS.items() for name, size in units.items()
} | {"rad": ("angle", 1.0), "deg": ("angle", pi / 180)}
"""Kind and size in units of the SI, by symbol."""
#: Values that are in the ratio of two units are in one ratio, but for this share of them, and their
#: ratio is so close to that of the units.
PROPORTIONAL, CLOSE = 0.05, 2e-3
Size = tuple[dict[str, int], float]


def unit_factor(unit: str, other: str) -> float | None:
    """What a number in ``unit`` is multiplied with to be in ``other``.

    None where one of them is not known, or they are units of different quantities.
    """
    if unit == other:
        return 1.0
    size, other_size = _size(unit), _size(other)
    if size is None or other_size is None or size[0] != other_size[0]:
        return None
    return size[1] / other_size[1]


def unit_ratio(values: np.ndarray, others: np.ndarray) -> float | None:
    """The ratio of two units of one quantity, by which all values (nt,) are beside others.

    None where they are in no such ratio, of two or more.
    """
    square = float(others @ others)
    if not square or not np.isfinite(square):
        return None
    times = float(values @ others) / square
    if not 0.0 < times < inf or _apart(values, times * others) > PROPORTIONAL:
        return None
    larger = max(times, 1.0 / times)
    nearest = min(_ratios(), key=lambda ratio: abs(ratio / larger - 1.0))
    if abs(nearest / larger - 1.0) > CLOSE:
        return None
    return nearest if times > 1.0 else 1.0 / nearest


def _apart(values: np.ndarray, others: np.ndarray) -> float:
    """How far two histories (nt,) are apart, as a share of the first."""
    return float(np.linalg.norm(values - others) / np.linalg.norm(values))


@cache
def _ratios() -> list[float]:
    """Of any two units of a quantity, those of two and above."""
    pairs = product(SIZES.values(), repeat=2)
    return sorted({size / other for (kind, size), (own, other) in pairs if kind == own
                   and size > 2.0 * other})  # fmt: skip


def in_symbols(unit: str, symbols: Mapping[str, str]) -> tuple[str, float]:
    """A unit in the symbols of a deck, and the factor for numbers in it.

    Parameters
    ----------
    symbols : mapping
        By ``force``, ``mass``, ``length``, ``time``.  What it lacks stays as it is.
    """
    parts = unit.split("/")
    words = [[_in_symbol(word, symbols) for word in part.split()] for part in parts]
    found = "/".join(" ".join(part) for part in words)
    factor = unit_factor(unit, found)
    return (unit, 1.0) if factor is None else (found, factor)


def _in_symbol(word: str, symbols: Mapping[str, str]) -> str:
    """``mm^2`` as ``m^2``."""
    symbol, power, exponent = word.partition("^")
    kind = SIZES[symbol][0] if symbol in SIZES else ""
    return symbols.get(kind, symbol) + power + exponent


def _size(unit: str) -> Size | None:
    """Powers by kind, and the size in units of the SI."""
    top, _, bottom = unit.partition("/")
    powers: dict[str, int] = {}
    size = 1.0
    for text, sign in ((top, 1), (bottom, -1)):
        for word in text.split():
            symbol, _, exponent = word.partition("^")
            if symbol not in SIZES or (exponent and not exponent.isdecimal()):
                return None
            kind, each = SIZES[symbol]
            power = sign * int(exponent or 1)
            powers[kind] = powers.get(kind, 0) + power
            size *= each**power
    return powers, size
