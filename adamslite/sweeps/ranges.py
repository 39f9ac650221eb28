"""What a sweep varies: numbers of the deck and the values that they take.

====================  =========================================================================
written               takes
====================  =========================================================================
``80:120:5``          five values from 80 to 120, at equal distances, both ends among them
``1,2,4``             these values
``80:120``            any value between, where values are drawn (sobol, lhs, saltelli)
====================  =========================================================================

Where values are drawn, of five values or a list one is drawn.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from math import isfinite, prod

import numpy as np

from adamslite.errors import UsageError
from adamslite.language.likeness import did_you_mean

Varied = Mapping[str, str | float | Iterable[float]] | Iterable[str]
#: More runs than this are a slip of the pen.
MOST = 1_000_000
GRID, SOBOL, LHS, SALTELLI = "grid", "sobol", "lhs", "saltelli"
DRAWN = (SOBOL, LHS, SALTELLI)


@dataclass(frozen=True)
class Range:
    """The values of one number; without ``values`` all from ``low`` to ``high``."""

    name: str
    values: tuple[float, ...]
    low: float = 0.0
    high: float = 0.0

    def at(self, share: np.ndarray) -> np.ndarray:
        """The values at shares of the range, 0 to 1 (n,)."""
        if not self.values:
            return self.low + share * (self.high - self.low)
        count = len(self.values)
        return np.array(self.values)[np.minimum((share * count).astype(int), count - 1)]


def ranges_of(varied: Varied) -> list[Range]:
    """Read ``NAME=VALUES``, or a mapping of names to texts or values.

    Raises
    ------
    UsageError
        When one is no range, is empty, or a name is there twice.
    """
    given = [varied] if isinstance(varied, str) else varied
    pairs = given.items() if isinstance(given, Mapping) else map(_pair, given)
    found = [_range(name.strip(), values) for name, values in pairs]
    if not found:
        raise UsageError("nothing is varied: write NAME=VALUES, as SPRINGDAMPER/1.K=80:120:5")
    return found


def _pair(text: str) -> tuple[str, str]:
    name, equal, values = text.partition("=")
    if not equal or not name.strip():
        raise UsageError(f"{text}: write NAME=VALUES, as SPRINGDAMPER/1.K=80:120:5")
    return name, values


def _range(name: str, given: object) -> Range:
    if isinstance(given, str):
        return _written(name, given.strip())
    listed = given if isinstance(given, Iterable) else (given,)
    values = tuple(_number(name, each) for each in listed)
    if not values:
        raise UsageError(f"{name}: it has no values")
    return Range(name, values)


def _written(name: str, text: str) -> Range:
    if not text:
        raise UsageError(f"{name}=: it has no values")
    if ":" not in text:
        return Range(name, tuple(_number(name, word) for word in text.split(",")))
    words = text.split(":")
    if len(words) > 3:
        raise UsageError(f"{name}={text}: write FROM:TO:COUNT")
    low, high = (_number(name, word) for word in words[:2])
    if low == high:
        raise UsageError(f"{name}={text}: the range is empty, it ends where it begins")
    if len(words) == 2:
        return Range(name, (), low, high)
    count = words[2].strip()
    if not count.isdecimal() or not 2 <= int(count) <= MOST:
        raise UsageError(f"{name}={text}: the last word is how many values, 2 to {MOST}")
    return Range(name, tuple(np.linspace(low, high, int(count)).tolist()))


def _number(name: str, word: object) -> float:
    try:
        value = float(word)  # type: ignore[arg-type]
    except (TypeError, ValueError):
        raise UsageError(f"{name}: '{word}' is no number, and a sweep varies numbers") from None
    if not isfinite(value):
        raise UsageError(f"{name}: '{word}' is no finite number")
    return value


def sampled(ranges: Sequence[Range], sample: str = GRID, seed: int = 0) -> np.ndarray:
    """The values of all runs (run, number).

    Parameters
    ----------
    sample : str
        ``grid``: all combinations, the last number changing fastest; ``sobol:N``, N a power of
        two, and ``lhs:N`` (Latin hypercube): N runs that fill the ranges evenly;
        ``saltelli:N``, N a power of two: N (d + 2) runs for the Sobol indices of d numbers.
    seed : int
        Of those that draw.

    Raises
    ------
    UsageError
        When it is none of these, too many, or a range does not say its values.
    """
    kind, count = _kind(sample)
    if kind == GRID:
        return _grid(ranges)
    shares = _shares(kind, count, len(ranges), np.random.default_rng(seed))
    return np.column_stack([each.at(shares[:, k]) for k, each in enumerate(ranges)])


def _shares(kind: str, count: int, numbers: int, generator: np.random.Generator) -> np.ndarray:
    """Shares of the ranges, 0 to 1 (run, number)."""
    from scipy.stats import qmc

    if kind == SALTELLI:
        if numbers < 2:
            raise UsageError(
                "Sobol indices are of two numbers or more: all comes from a single one"
            )
        if count * (numbers + 2) > MOST:
            raise UsageError(
                f"{SALTELLI}:{count} has {count * (numbers + 2)} runs; {MOST} are the most"
            )
        return stacked(qmc.Sobol(2 * numbers, bits=64, seed=generator).random(count))
    sampler = {SOBOL: qmc.Sobol, LHS: qmc.LatinHypercube}[kind](numbers, seed=generator)
    found: np.ndarray = sampler.random(count)
    return found


def stacked(points: np.ndarray) -> np.ndarray:
    """The runs of a Saltelli design, of points (N, 2 d): A (N, d), B, and A with one number after
    the other from B, (N (d + 2), d) in all.
    """
    a, b = np.hsplit(points, 2)
    mixed = np.tile(a, (a.shape[1], 1, 1))
    for k in range(a.shape[1]):
        mixed[k, :, k] = b[:, k]
    return np.concatenate([a, b, *mixed])


def _kind(sample: str) -> tuple[str, int]:
    kind, colon, word = sample.strip().lower().partition(":")
    if kind == GRID and not colon:
        return kind, 0
    if kind not in DRAWN:
        hint = did_you_mean(kind, [GRID, *DRAWN]).lower()
        known = f"{sample}: a sample is grid, sobol:N, lhs:N or saltelli:N"
        raise UsageError(f"{known}; {hint}" if hint else known)
    if not word.isdecimal() or not 1 <= int(word) <= MOST:
        raise UsageError(f"{sample}: say how many runs, as {kind}:256 (at most {MOST})")
    count = int(word)
    if kind != LHS and count & (count - 1):
        near = 1 << count.bit_length()
        raise UsageError(
            f"{sample}: Sobol points fill a space in powers of two: {kind}:{near // 2} or "
            f"{kind}:{near}"
        )
    return kind, count


def _grid(ranges: Sequence[Range]) -> np.ndarray:
    for each in ranges:
        if not each.values:
            raise UsageError(
                f"{each.name}={each.low:g}:{each.high:g}: a grid needs how many values, as "
                f"{each.low:g}:{each.high:g}:5"
            )
    count = prod(len(each.values) for each in ranges)
    if count > MOST:
        raise UsageError(f"the grid has {count} runs, and {MOST} are the most; sobol:N draws some")
    axes = np.meshgrid(*(each.values for each in ranges), indexing="ij")
    return np.column_stack([axis.ravel() for axis in axes])
