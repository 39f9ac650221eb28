"""Places where expressions of time change, found by bisection of enclosures.

Over a span of time an enclosure (:mod:`adamslite.analyses.clock.enclosures`) says what a value and
its rate can be.  A span in which the answer is plain is done, every other one is divided.

A *guard* keeps its branch in a span without a zero (a floor: without a whole number), and changes
it once at most where it is monotone: what the ends say.

A *curve* f of range R has the time scale R/|f'|.  A span is done where f is constant up to a small
share of R, where it cannot cross R, or where a step as long as the output's cannot miss it; and
where f' is of one size throughout, as of a fast sine.  A span that stays open down to the round-off
of the time holds a pole or a kink without a tangent.

Reference: Moore, Kearfott, Cloud, Introduction to Interval Analysis, 2009, section 8.1.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import wraps
from typing import TYPE_CHECKING, Any, TypeVar

import numpy as np

from adamslite.analyses.clock.enclosures import enclose
from adamslite.symbolic.interpolant import Interpolant

if TYPE_CHECKING:
    from adamslite.analyses.clock.clock import Program


Answer = TypeVar("Answer")
# Answers that are kept; instructions of a program, and numbers of an answer, up to which they are.
MOST_KEPT, SHORT, SMALL = 128, 500, 1000


def kept(size: Callable[[Answer], int]) -> Callable[[Callable[..., Answer]], Callable[..., Answer]]:
    """Keep what a function finds of a program and of other arguments; ``size``: its numbers.

    Nobody changes what is kept.  Programs with tables are not: those of other kernels are other
    ones.
    """

    def keeping(function: Callable[..., Answer]) -> Callable[..., Answer]:
        known: dict[tuple[Any, ...], Answer] = {}

        @wraps(function)
        def answer(program: Program, *asked: Any) -> Answer:
            if len(program) > SHORT:
                return function(program, *asked)
            found = known.get((program, *asked))
            if found is None:
                found = function(program, *asked)
                tables = any(isinstance(each, Interpolant) for line in program for each in line)
                if size(found) <= SMALL and not tables:
                    if len(known) >= MOST_KEPT:
                        known.pop(next(iter(known)), None)
                    known[program, *asked] = found
            return found

        return answer

    return keeping


# Spans at first, and into how many one is divided.
FIRST, PARTS = 64, 4
# Spans of one expression at a time, at most; what is still open then is taken as it is.
MOST = 2**16
# From so many open spans on, bounds of a value are taken from its middle and its rate too, which
# shrink with the square of the span; values below this share of the largest are round-off of zero.
MANY, NOISE = 512, 64.0 * np.finfo(float).eps
# Spans are not divided below this share of the run.
ROUND_OFF = 5e-14
# Changes below this share of the range are none, whatever else is known of the range or of its
# bound.
QUIET, SURELY_QUIET = 1e-5, 1e-9
# Values from here on are on their way to infinity, not at a pole: whoever takes their reciprocal
# gets zero.
OVERFLOW = 1e290
# Rates within this factor are of one size, if one is found that is not far below.
ALIKE, FOUND = 0.5, 0.1
# Ratios above this are above one whatever the round-off.
CLEARLY = 1.0 + 1e-9
# Where a span is evaluated: nowhere a periodic function could always be met at the same phase.
GOLDEN = 0.6180339887498949


@dataclass(frozen=True)
class Found:
    """``times``: of kinks and poles.  ``spans`` (n, 3): start, end and time scale where it is
    short.  ``whole``: False when there was too much to look at.
    """

    times: np.ndarray
    spans: np.ndarray
    whole: bool


def _size(found: Found) -> int:
    return found.times.size + found.spans.size


@kept(_size)
def around_changes(program: Program, start: float, end: float, floor: bool) -> Found:
    """Times between which a guard changes once at most, but for what is round-off of zero: a guard
    that touches zero without a slope, as a STEP at the end of another, changes there by chance.
    """
    low, high = _spans(start, end)
    kept, level, whole, ends = [], [], True, low
    while low.size:
        least, most, slow, fast = found = enclose(program, low, high)
        zero = np.zeros(low.shape, dtype=bool)
        if low.size > MANY and not floor:
            least, most = _by_rate(program, low, high, found)
            noise = NOISE * _magnitude(program, ends)
            zero = (least >= -noise) & (most <= noise)
        still = (np.floor(least) == np.floor(most)) if floor else (least > 0.0) | (most < 0.0)
        still |= np.isnan(least + most)
        plain = (slow >= 0.0) | (fast <= 0.0) | (high - low <= ROUND_OFF * (end - start))
        if np.count_nonzero(~still & ~plain & ~zero) * PARTS > MOST:
            plain, whole = np.ones_like(plain), False
        kept += [low[plain & ~still & ~zero], high[plain & ~still & ~zero]]
        level.append(np.array([low, high])[:, zero])
        low, high = _divided(low, high, ~still & ~plain & ~zero)
    kept += _runs(np.concatenate(level, axis=1))
    return Found(np.unique(np.concatenate(kept)), np.zeros((0, 3)), whole)


def _magnitude(program: Program, times: np.ndarray) -> float:
    """The largest of what a guard is the difference of: its round-off is a share of that."""
    name, *operands = program[-1]
    parts = [program[: each + 1] for each in operands] if name in ("-", "Add") else [program]
    sizes = [np.abs(enclose(part, times, times)[0]) for part in parts]
    return max(float(each[np.isfinite(each)].max(initial=0.0)) for each in sizes)


def _by_rate(
    program: Program, low: np.ndarray, high: np.ndarray, found: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """Bounds of a value from those of its rate, where they are closer than those ``found``."""
    least, most, slow, fast = found
    middle = enclose(program, *[low + 0.5 * (high - low)] * 2)[0]
    with np.errstate(invalid="ignore"):
        reach = np.maximum(np.abs(slow), np.abs(fast)) * 0.5 * (high - low)
    return np.fmax(least, middle - reach), np.fmin(most, middle + reach)


def _runs(spans: np.ndarray) -> list[np.ndarray]:
    """Of runs of neighbouring spans (2, n) the ends, and the middle of the widest in each."""
    low, high = spans[:, np.argsort(spans[0])]
    first = np.append(True, low[1:] > high[:-1]) if low.size else np.zeros(0, dtype=bool)
    run = np.cumsum(first) - 1
    by_width = np.lexsort((high - low, run))
    widest = by_width[np.append(run[1:] > run[:-1], True)] if low.size else by_width
    last = np.append(first[1:], True) if low.size else first
    return [low[first], high[last], 0.5 * (low + high)[widest]]


@kept(_size)
def time_scales(program: Program, start: float, end: float, longest: float) -> Found:
    """Where a curve changes so fast that steps up to ``longest`` may miss it."""
    if _is_gradual(program, start, end, longest):
        return Found(np.zeros(0), np.zeros((0, 3)), True)
    curve = _Curve(program, start, end)
    low, high = _spans(start, end)
    kept, whole, first = [], True, True
    while low.size:
        rate, quiet = curve.look(low, high)
        width = high - low
        scale = curve.scale(rate)
        open_ = ~quiet & (scale < np.minimum(2.0 * width, longest))
        sharp = open_ & (width <= ROUND_OFF * (end - start))
        if not first:
            open_ &= ~curve.alike(rate)
        open_ &= ~sharp
        if np.count_nonzero(open_) * PARTS > MOST:
            open_, whole = np.zeros_like(open_), False
        done = ~open_ & ~quiet
        kept.append(np.array([low, high, rate, sharp])[:, done])
        low, high = _divided(low, high, open_)
        first = False
    low, high, rate, sharp = np.concatenate(kept, axis=1)
    scale = curve.scale(rate)
    short = (scale < longest) & (sharp == 0.0)
    spans = np.stack([low, high, scale], axis=1)[short]
    return Found(high[sharp > 0.0], spans[np.argsort(spans[:, 0])], whole)


def _is_gradual(program: Program, start: float, end: float, longest: float) -> bool:
    """Whether one enclosure of the whole run shows that a curve rises, or falls, throughout, and
    nowhere so fast that it crosses its range within ``longest``.
    """
    _, _, slow, fast = enclose(program, np.array([start]), np.array([end]))[:, 0].tolist()
    least, most = sorted((abs(slow), abs(fast)))
    return slow * fast > 0.0 and most < np.inf and least * (end - start) > CLEARLY * most * longest


class _Curve:
    """What is known of a curve so far: its range at least and at most."""

    def __init__(self, program: Program, start: float, end: float) -> None:
        self.program = program
        self.least, self.most = np.inf, -np.inf
        self.bottom, self.top = np.inf, -np.inf
        ends = np.array([start, end])
        self._sample(ends)

    @property
    def range(self) -> float:
        """The range that was seen."""
        return max(0.0, self.most - self.least)

    def scale(self, rate: np.ndarray) -> np.ndarray:
        """The time in which the curve crosses its range at this rate."""
        with np.errstate(all="ignore"):
            return np.where(rate > 0.0, self.range / rate, np.inf)

    def look(self, low: np.ndarray, high: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Largest rate in each span, and whether the value is constant there."""
        inside = low + (high - low) * (np.arange(low.size) * GOLDEN % 1.0)
        self.seen = self._sample(inside)
        least, most, slow, fast = enclose(self.program, low, high)
        bounds = np.concatenate([least, most])
        bounds = bounds[np.isfinite(bounds)]
        self.bottom = min(self.bottom, bounds.min(initial=np.inf))
        self.top = max(self.top, bounds.max(initial=-np.inf))
        room = max(0.0, self.top - self.bottom)
        flat = max(QUIET * self.range, SURELY_QUIET * room)
        with np.errstate(invalid="ignore"):
            quiet = ~(most - least > flat)  # what has no value, too
        quiet |= np.minimum(np.abs(least), np.abs(most)) > OVERFLOW
        return np.maximum(np.abs(slow), np.abs(fast)), quiet

    def _sample(self, times: np.ndarray) -> np.ndarray:
        value, _, slow, fast = enclose(self.program, times, times)
        value = value[np.isfinite(value)]
        self.least = min(self.least, value.min(initial=np.inf))
        self.most = max(self.most, value.max(initial=-np.inf))
        return np.maximum(np.abs(slow), np.abs(fast))

    def alike(self, rate: np.ndarray) -> np.ndarray:
        """Whether rates are of one size in all parts of a span that was divided."""
        parts, seen = rate.reshape(-1, PARTS), self.seen.reshape(-1, PARTS)
        top = parts.max(axis=1)
        alike = (parts.min(axis=1) >= ALIKE * top) & (seen.max(axis=1) >= FOUND * top)
        return np.repeat(alike & np.isfinite(top), PARTS)


def _spans(start: float, end: float) -> tuple[np.ndarray, np.ndarray]:
    ends = np.linspace(start, end, FIRST + 1)
    return ends[:-1], ends[1:]


def _divided(low: np.ndarray, high: np.ndarray, which: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """The parts of some spans, neighbours side by side."""
    low, high = low[which, None], high[which, None]
    ends = low + (high - low) * (np.arange(PARTS + 1) / PARTS)
    ends[:, -1:] = high
    return ends[:, :-1].ravel(), ends[:, 1:].ravel()
