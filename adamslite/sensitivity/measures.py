"""Derivatives of measures of histories: of the largest value, the mean, the value at the end, ...

A measure is what sweeps call one (:mod:`adamslite.sweeps.measures`), ``max REQUEST/1.F2``, or the
value at a time, ``PART/2.x@end``, ``PART/2.x@0.5``.

Derivatives are compared with central differences of runs by

    |dy/dp - (y(p + h) - y(p - h))/2h|,     h = r scale(p),     r = ERROR^(1/3)

The rounding of an integration, some ERROR of the size of y, is divided by h, and the third
derivative times h^2/6 is left out: r balances both.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from adamslite.errors import UsageError
from adamslite.results.selection import selected
from adamslite.sweeps.measures import MEASURES, Measure, parsed

if TYPE_CHECKING:
    from adamslite.sensitivity.record import Sensitivities

AT, END, START = "@", "end", "start"
#: Relative steps of differences are never smaller or larger.
SMALLEST_STEP, LARGEST_STEP = 1e-4, 2e-2
#: Derivatives are taken where differences of runs are so close to them, as a share of their size,
#: or no further than so many times what differences with another step are from each other.
CONFIRMED, DOUBT = 0.01, 3.0
#: Smaller values of a measure are round-off.
LEAST = 1e-6
#: More numbers than this are moved together.
MOST_ALONE = 4
APART = (
    "a difference of two runs is {share:.2g} of it away: do not rely on it, or use a smaller ERROR"
)


class At(NamedTuple):
    """The value of a column at a time: ``end``, ``start`` or a number."""

    channel: str
    when: str

    def __str__(self) -> str:
        return f"{self.channel}{AT}{self.when}"

    def of(self, time: np.ndarray, values: np.ndarray) -> float:
        """The value, between output times on a straight line."""
        if self.when in (START, END):
            return float(values[0 if self.when == START else -1])
        when = float(self.when)
        if not time[0] <= when <= time[-1]:
            raise UsageError(f"{self}: the analysis is from {time[0]:g} to {time[-1]:g}")
        return float(np.interp(when, time, values))


def _one(n: int, k: int, value: float = 1.0) -> np.ndarray:
    found = np.zeros(n)
    found[k] = value
    return found


def _mean(t: np.ndarray, v: np.ndarray) -> np.ndarray:
    """Of trapezoids."""
    steps, span = np.diff(t), t[-1] - t[0]
    if not span > 0.0:
        return _one(len(t), len(t) - 1)
    return 0.5 * (np.append(steps, 0.0) + np.append(0.0, steps)) / span


def _rms(t: np.ndarray, v: np.ndarray) -> np.ndarray:
    weights = _mean(t, v)
    size = np.sqrt(weights @ v**2)
    return weights * v / size if size > 0.0 else 0.0 * v


def _absmax(t: np.ndarray, v: np.ndarray) -> np.ndarray:
    k = int(np.argmax(np.abs(v)))
    return _one(len(v), k, float(np.sign(v[k])))


WEIGHTS: dict[str, Callable[[np.ndarray, np.ndarray], np.ndarray]] = {
    "max": lambda t, v: _one(len(v), int(np.argmax(v))),
    "min": lambda t, v: _one(len(v), int(np.argmin(v))),
    "absmax": _absmax,
    "range": lambda t, v: _one(len(v), int(np.argmax(v))) - _one(len(v), int(np.argmin(v))),
    "mean": _mean,
    "rms": _rms,
    "first": lambda t, v: _one(len(v), 0),
    "final": lambda t, v: _one(len(v), len(v) - 1),
}
"""By the word of a measure: its derivatives by the values (nt,)."""


def weights_of(measure: Measure | At, time: np.ndarray, values: np.ndarray) -> np.ndarray:
    """The derivatives of a measure by the values of its column (nt,)."""
    if isinstance(measure, Measure):
        return WEIGHTS[measure.kind](time, values)
    found = np.zeros(len(time))
    if measure.when in (START, END):
        found[0 if measure.when == START else -1] = 1.0
        return found
    when = float(measure.when)
    k = min(max(int(np.searchsorted(time, when)), 1), len(time) - 1)
    share = (when - time[k - 1]) / (time[k] - time[k - 1])
    found[k - 1], found[k] = 1.0 - share, share
    return found


def slope(measure: Measure | At, time: np.ndarray, values: np.ndarray, slopes: np.ndarray) -> float:
    """The derivative of a measure, from those of the column (nt,); rms has none where it is 0."""
    weights = weights_of(measure, time, values)
    some = np.flatnonzero(weights)
    root = not isinstance(measure, Measure) or measure.kind != "rms" or some.size
    return float(weights[some] @ slopes[some]) if root else np.nan


def asked(texts: Iterable[str], names: Sequence[str]) -> tuple[list[Measure | At], list[int]]:
    """The measures, and the columns of all that is asked for: a text that is a column, or a pattern
    of several, asks for histories alone.

    Raises
    ------
    UsageError
        When a word or a column is none, or a measure has no derivative.
    """
    found: list[Measure | At] = []
    columns: set[int] = set()
    for text in [texts] if isinstance(texts, str) else [str(each).strip() for each in texts]:
        channel, at, when = text.rpartition(AT)
        if at:
            meant = selected(names, [channel.strip()])
            found += [At(names[k], _when(text, when)) for k in meant]
        elif text.partition(" ")[0].lower() in MEASURES or " " in text:
            (measure,) = parsed([text])
            if measure.kind not in WEIGHTS:
                raise UsageError(
                    f"{text}: the time of an extreme jumps from output to output and has no "
                    f"derivative; there are {', '.join(WEIGHTS)}"
                )
            meant = selected(names, [measure.channel])
            found += [Measure(measure.kind, names[k]) for k in meant]
        else:
            meant = selected(names, [text])
        columns.update(meant)
    return list(dict.fromkeys(found)), sorted(columns)


def _when(text: str, when: str) -> str:
    word = when.strip().lower()
    try:
        return word if word in (START, END) else f"{float(word):g}"
    except ValueError:
        raise UsageError(
            f"{text}: behind {AT} stands end, start or a time, as PART/2.x{AT}end"
        ) from None


def relative_step(error: float) -> float:
    """Step of differences as a share of a number, for runs of some ERROR."""
    return min(max(error ** (1.0 / 3.0), SMALLEST_STEP), LARGEST_STEP)


Columns = tuple[np.ndarray, Sequence[str], np.ndarray]
Run = Callable[[Mapping[str, float]], Columns]


def compared(
    found: Sensitivities, run: Run, sizes: Mapping[str, float], error: float
) -> tuple[Sensitivities, int]:
    """Derivatives whose errors and notes tell how far differences of runs are from them; and how
    many runs there were.

    Parameters
    ----------
    run : callable
        Output times, names and values (nt, nc) of a run with other numbers, to within ``error``.
    sizes : mapping
        How large each number is.
    """
    lots = [[j] for j in range(len(found.by))]
    lots = lots if len(lots) <= MOST_ALONE else [[*range(len(lots))]]
    slopes = found.gradient.T if found.measures else found.curves
    notes, errors, count = dict(found.notes), found.errors.copy(), 0
    h = relative_step(error) * np.array([sizes[name] for name in found.by])
    h *= np.where(slopes.reshape(len(h), -1)[:, 0] < 0.0, -1.0, 1.0)

    def difference(lot: list[int], wider: float) -> np.ndarray:
        ends = [{found.by[j]: found.at[j] + side * h[j] for j in lot} for side in (wider, -wider)]
        above, below = (_quantities(found, *run(each)) for each in ends)
        return (above - below) / (2.0 * wider)

    own = _quantities(found, found.time, found.results.names, found.results.values)
    least = np.maximum(_length(own), LEAST)
    for lot in lots:
        expected, near = np.tensordot(h[lot], slopes[lot], 1), difference(lot, 1.0)
        off, size, noise = _length(expected - near), _length(near), error * least
        count += 2
        if (off > CONFIRMED * size + noise).any():
            noise += DOUBT * _length(near - difference(lot, 2.0))
            count += 2
        wrong = off > CONFIRMED * size + noise
        # What differences are off by themselves.
        shares = off / np.maximum(size, noise)
        errors[lot] = np.fmax(errors[lot], (shares + CONFIRMED * wrong).max())
        if wrong.any():
            notes |= {found.by[j]: APART.format(share=shares[wrong].max()) for j in lot}
    return replace(found, notes=notes, errors=errors), count


def _length(quantities: np.ndarray) -> np.ndarray:
    """Of each measure, or of each column over the times."""
    return np.asarray(np.linalg.norm(np.atleast_2d(quantities), axis=0))


def _quantities(
    found: Sensitivities, time: np.ndarray, names: Sequence[str], values: np.ndarray
) -> np.ndarray:
    """The measures (nm,), or without any the columns (nt, nc), of a run."""
    if not found.measures:
        return values[:, [names.index(name) for name in found.results.names]]
    return np.array([
        each.of(time, values[:, names.index(each.channel)])
        for each in asked(found.measures, names)[0]
    ])  # fmt: skip
