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
Rule = Callable[[np.ndarray, np.ndarray, np.ndarray], float]


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


def _mean(time: np.ndarray, values: np.ndarray, slopes: np.ndarray) -> float:
    return Measure("mean", "").of(time, slopes)


def _rms(time: np.ndarray, values: np.ndarray, slopes: np.ndarray) -> float:
    root = Measure("rms", "").of(time, values)
    return _mean(time, values, values * slopes) / root if root > 0.0 else np.nan


def _absmax(time: np.ndarray, values: np.ndarray, slopes: np.ndarray) -> float:
    at = np.abs(values).argmax()
    return float(np.sign(values[at]) * slopes[at])


#: By the word of a measure: its derivative from times, values and their derivatives, all (nt,).
SLOPES: dict[str, Rule] = {
    "max": lambda time, values, slopes: slopes[values.argmax()],
    "min": lambda time, values, slopes: slopes[values.argmin()],
    "absmax": _absmax,
    "range": lambda time, values, slopes: slopes[values.argmax()] - slopes[values.argmin()],
    "mean": _mean,
    "rms": _rms,
    "first": lambda time, values, slopes: slopes[0],
    "final": lambda time, values, slopes: slopes[-1],
}


def slope(measure: Measure | At, time: np.ndarray, values: np.ndarray, slopes: np.ndarray) -> float:
    """The derivative of a measure, from those of the column (nt,)."""
    if isinstance(measure, At):
        return measure.of(time, slopes)
    return float(SLOPES[measure.kind](time, values, slopes))


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
            if measure.kind not in SLOPES:
                raise UsageError(
                    f"{text}: the time of an extreme jumps from output to output and has no "
                    f"derivative; there are {', '.join(SLOPES)}"
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
        if wrong.any():
            share = float((off[wrong] / np.maximum(size[wrong], noise[wrong])).max())
            errors[lot] = np.fmax(errors[lot], share)
            notes |= {found.by[j]: APART.format(share=share) for j in lot}
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
