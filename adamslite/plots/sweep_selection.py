"""What a figure of a sweep shows: measures or histories, and the numbers that they are drawn over.

Runs that failed are no numbers here: their measures, if they have any, are of unfinished histories.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from adamslite.errors import UsageError
from adamslite.plots.selection import clipped, titled
from adamslite.results.selection import means, near
from adamslite.sweeps.job import SUMMARY
from adamslite.sweeps.ranges import GRID
from adamslite.sweeps.record import Sweep

#: So many axes are drawn above each other.
MOST = 12
TIME = "time"


@dataclass(frozen=True, kw_only=True)
class Wanted:
    """What a user asks for: measures or histories, over what, coloured by which number.

    ``band``: percentiles from which to which a band is drawn, 0 and 100 for all; ``pairs``: each
    over each other; ``indices``: Sobol indices.
    """

    names: Sequence[str] = ()
    x: str | None = None
    by: str | None = None
    band: tuple[float, float] | None = None
    pairs: bool = False
    indices: bool = False

    def __post_init__(self) -> None:
        if self.band and not 0.0 <= self.band[0] < self.band[1] <= 100.0:
            low, high = self.band
            raise UsageError(
                f"--band {low:g}:{high:g}: percentiles go up from 0 to 100, as in 5:95"
            )
        kinds = [
            flag
            for flag, given in (
                ("--band", self.band), ("--pairs", self.pairs), ("--indices", self.indices),
            )
            if given
        ]  # fmt: skip
        if len(kinds) > 1:
            raise UsageError(f"{' and '.join(kinds)} are different figures: take one")
        if kinds and self.by:
            raise UsageError(f"--by does not belong to {kinds[0]}: all runs have one colour there")
        if (self.pairs or self.indices) and self.x:
            raise UsageError(f"--x does not belong to {kinds[0]}, which draws over all numbers")
        if self.x and self.by and self.x.casefold() == self.by.casefold():
            raise UsageError(f"--x and --by are both {self.x}: one of them is enough")


@dataclass(frozen=True, eq=False)
class Column:
    """A quantity with a value for each run (run,); not a number where a run has none."""

    name: str
    unit: str
    values: np.ndarray

    @property
    def label(self) -> str:
        """For an axis: name and unit."""
        return titled(clipped(self.name, 44), self.unit)

    @cached_property
    def levels(self) -> np.ndarray:
        """The different values."""
        return np.unique(self.values[np.isfinite(self.values)])


@dataclass(frozen=True, eq=False)
class Runs:
    """The runs of a sweep as columns."""

    sweep: Sweep

    @cached_property
    def good(self) -> np.ndarray:
        """Which runs reached their end (run,)."""
        found = np.ones(len(self.sweep), dtype=bool)
        found[[*self.sweep.failed, *self.sweep.ahead]] = False
        return found

    @property
    def failed(self) -> np.ndarray:
        """Numbers of the runs that ended early."""
        return np.array(self.sweep.failed, dtype=int)

    def column(self, name: str) -> Column:
        """A number that varies, a measure or a counter."""
        listed = (*self.sweep.names, *self.sweep.measured, *SUMMARY)
        found = next((each for each in listed if each.casefold() == name.casefold()), None)
        if found is None:
            numbers = (*self.sweep.names, *self.sweep.measured)
            raise UsageError(f"the sweep has no number or measure '{name}'{near(name, numbers)}")
        values = np.array(self.sweep[found], dtype=float)
        values[~np.isfinite(values)] = np.nan
        if found not in self.sweep.names:
            values[~self.good] = np.nan
        return Column(found, self.sweep.units.get(found, ""), values)

    @cached_property
    def varied(self) -> list[Column]:
        """The numbers that have more than one value, else the first one."""
        every = [self.column(name) for name in self.sweep.names]
        return [each for each in every if len(each.levels) > 1] or every[:1]

    def number(self, name: str, flag: str) -> Column:
        """A number that varies, by its name."""
        found = self.column(name)
        if found.name not in self.sweep.names:
            listed = ", ".join(self.sweep.names)
            raise UsageError(f"{flag} {name}: it is none of the numbers that vary, {listed}")
        return found

    @property
    def is_grid(self) -> bool:
        """Whether all combinations of values were run."""
        return self.sweep.meta.get("sample", "").startswith(GRID)

    def notes(self) -> Iterator[str]:
        """What is known of the runs, for small print."""
        endings = Counter(self.sweep.outcomes[k] for k in self.sweep.failed)
        if endings:
            ends = ", ".join(f"{count} {ending}" for ending, count in endings.most_common())
            yield f"{len(self.sweep.failed)} of {len(self.sweep)} runs failed: {ends}."
        if self.sweep.ahead:
            yield f"{len(self.sweep.ahead)} of {len(self.sweep)} runs are ahead and not drawn."

    @property
    def subtitle(self) -> str:
        """Deck, sample and how many runs."""
        words = (self.sweep.meta.get("deck", ""), f"{len(self.sweep)} runs")
        return ", ".join(filter(None, (*words, self.sweep.meta.get("sample", ""))))


def chosen(sweep: Sweep, patterns: Sequence[str]) -> tuple[list[str], list[str]]:
    """Measures (or counters), or else histories, that names and patterns mean; of none all
    measures, else all histories.

    A name of a column without its history means the measures of it.

    Raises
    ------
    UsageError
        When one means nothing, or there are measures and histories among them.
    """
    if not patterns:
        return _few(list(sweep.measured), [] if sweep.measured else list(sweep.channels))
    listed = (*sweep.measured, *sweep.channels, *SUMMARY)
    found: dict[str, None] = {}
    for pattern in patterns:
        mine = [name for name in listed if means(pattern, name) and _is_meant(pattern, name)]
        of = [each for each in sweep.measured if means(pattern, each.partition(" ")[2])]
        if not mine and not of:
            raise UsageError(f"the sweep has no '{pattern}'{near(pattern, listed)}")
        found |= dict.fromkeys(mine or of)
    histories = [name for name in found if name in sweep.channels]
    measures = [name for name in found if name not in sweep.channels]
    if histories and measures:
        raise UsageError(
            f"{measures[0]} is a measure and {histories[0]} a history: draw one or the other"
        )
    return _few(measures, histories)


def _is_meant(pattern: str, name: str) -> bool:
    """A counter is meant by its name alone."""
    return name not in SUMMARY or pattern.casefold() == name.casefold()


def _few(measures: list[str], histories: list[str]) -> tuple[list[str], list[str]]:
    count = len(measures) + len(histories)
    if not count:
        raise UsageError("the sweep kept neither measures nor histories: there is nothing to draw")
    if count > MOST:
        first = ", ".join([*measures, *histories][:3])
        raise UsageError(f"{count} axes are too many: name {MOST} at most of {first}, ...")
    return measures, histories
