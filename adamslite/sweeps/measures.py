"""One number of a history: its largest value, its mean, when it was largest, ..."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from typing import NamedTuple

import numpy as np

from adamslite.errors import UsageError
from adamslite.language.likeness import did_you_mean
from adamslite.results.selection import selected

Function = Callable[[np.ndarray, np.ndarray], float]


def _mean(time: np.ndarray, values: np.ndarray) -> float:
    """Over time: the integral by trapezoids, divided by its length."""
    span = time[-1] - time[0]
    return np.trapezoid(values, time) / span if span > 0.0 else values[-1]


def _rms(time: np.ndarray, values: np.ndarray) -> float:
    return np.sqrt(_mean(time, values**2))


def _when(best: Callable[[np.ndarray], np.intp]) -> Function:
    """The time of the first extreme; not a number where a value is none."""
    return lambda time, values: np.nan if np.isnan(values).any() else time[best(values)]


#: By its word: a function of times (nt,) and values (nt,), and what it gives.
MEASURES: dict[str, tuple[Function, str]] = {
    "max": (lambda time, values: values.max(), "the largest value"),
    "min": (lambda time, values: values.min(), "the smallest value"),
    "absmax": (lambda time, values: np.abs(values).max(), "the largest magnitude"),
    "range": (lambda time, values: np.ptp(values), "the largest less the smallest"),
    "mean": (_mean, "the mean over time"),
    "rms": (_rms, "the root of the mean square over time"),
    "first": (lambda time, values: values[0], "the first value"),
    "final": (lambda time, values: values[-1], "the last value"),
    "maxtime": (_when(np.argmax), "when it is largest"),
    "mintime": (_when(np.argmin), "when it is smallest"),
}


class Measure(NamedTuple):
    """A word of :data:`MEASURES` and a column."""

    kind: str
    channel: str

    def __str__(self) -> str:
        return f"{self.kind} {self.channel}"

    def of(self, time: np.ndarray, values: np.ndarray) -> float:
        """The number of a history: times (nt,) and values (nt,); not a number of an empty one."""
        return float(MEASURES[self.kind][0](time, values)) if len(time) else np.nan


def parsed(texts: Iterable[str]) -> list[Measure]:
    """``max REQUEST/1.F2``: the word and a column, or a pattern of several.

    Raises
    ------
    UsageError
        When the word is none.
    """
    listed = [texts] if isinstance(texts, str) else texts
    return [_parsed(str(each)) for each in listed]


def _parsed(text: str) -> Measure:
    word, _, channel = text.strip().partition(" ")
    if word.lower() not in MEASURES or not channel.strip():
        hint = did_you_mean(word.lower(), MEASURES).lower() if channel.strip() else ""
        known = f"{text}: a measure is a word and a column, as 'max REQUEST/1.F2'"
        raise UsageError(f"{known}; {hint or 'words are ' + ', '.join(MEASURES)}")
    return Measure(word.lower(), channel.strip())


def of_columns(measures: Iterable[Measure], names: Sequence[str]) -> list[Measure]:
    """One for each column that the patterns mean.

    Raises
    ------
    UsageError
        When a pattern means none.
    """
    found = (
        Measure(kind, names[k]) for kind, pattern in measures for k in selected(names, [pattern])
    )
    return list(dict.fromkeys(found))
