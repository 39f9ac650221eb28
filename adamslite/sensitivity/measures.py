"""Derivatives of measures of histories: of the largest value, the mean, the value at the end, ...

A measure is what sweeps call one (:mod:`adamslite.sweeps.measures`), ``max REQUEST/1.F2``, or the
value at a time, ``PART/2.x@end``, ``PART/2.x@0.5``.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from typing import NamedTuple

import numpy as np

from adamslite.errors import UsageError
from adamslite.results.selection import selected
from adamslite.sweeps.measures import MEASURES, Measure, parsed

AT, END, START = "@", "end", "start"
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
