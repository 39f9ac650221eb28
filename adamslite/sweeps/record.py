"""All runs of a sweep: the numbers that they had, how they ended and what was kept of them."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from importlib import import_module
from pathlib import Path
from typing import Any

import numpy as np

import adamslite
from adamslite.results.outcomes import Outcome
from adamslite.results.results import UnknownChannel
from adamslite.sweeps.job import AHEAD, SUMMARY, Run

REQUESTED = {outcome.name for outcome in Outcome if outcome.is_requested}


@dataclass(kw_only=True, repr=False, eq=False)
class Sweep:
    """Runs of one model with other numbers.

    Parameters
    ----------
    names : tuple of str
        The numbers that vary, by the names that ``adamslite names`` lists.
    values : (run, number) array
    measured, channels : tuple of str
        What was kept: measures (``max REQUEST/1.F2``), and columns with their histories.
    key : str
        Identifies the sweep: what it runs, varies and keeps.
    meta : mapping of str to str
        What it belongs to: deck, hash, units, sample.
    units : mapping of str to str
        Of numbers, measures and channels.
    outcomes, messages : list of str
        How each run ended, empty while it is ahead; and why it ended early.
    summaries, measures : (run, ...) array
        Counters of the runs, and their measures; not a number where a run has none.
    histories : dict of int to (time (nt,), values (nt, channel))
        By the number of the run.
    """

    names: tuple[str, ...]
    values: np.ndarray
    measured: tuple[str, ...] = ()
    channels: tuple[str, ...] = ()
    key: str = ""
    meta: Mapping[str, str] = field(default_factory=dict)
    units: Mapping[str, str] = field(default_factory=dict)
    outcomes: list[str] = field(init=False)
    messages: list[str] = field(init=False)
    summaries: np.ndarray = field(init=False)
    measures: np.ndarray = field(init=False)
    histories: dict[int, tuple[np.ndarray, np.ndarray]] = field(init=False, default_factory=dict)

    def __post_init__(self) -> None:
        count = len(self.values)
        self.outcomes, self.messages = [AHEAD] * count, [""] * count
        self.summaries = np.full((count, len(SUMMARY)), np.nan)
        self.measures = np.full((count, len(self.measured)), np.nan)

    def enter(self, run: Run) -> None:
        """Keep a run."""
        at = run.number
        self.outcomes[at], self.messages[at] = run.outcome, run.message
        self.summaries[at], self.measures[at] = run.summary, run.measures
        if self.channels:
            self.histories[at] = run.time, run.histories

    def __len__(self) -> int:
        return len(self.values)

    @property
    def ahead(self) -> list[int]:
        """The runs that have not been carried out."""
        return [k for k, outcome in enumerate(self.outcomes) if outcome == AHEAD]

    @property
    def failed(self) -> list[int]:
        """The runs that ended early."""
        known = {*REQUESTED, AHEAD}
        return [k for k, outcome in enumerate(self.outcomes) if outcome not in known]

    @property
    def endings(self) -> Counter[str]:
        """How many runs ended in which way, most first."""
        return Counter(outcome for outcome in self.outcomes if outcome != AHEAD)

    def __getitem__(self, name: str) -> np.ndarray:
        """By its name a number, a measure or a counter (run,), the history of a column (run, nt),
        or ``time`` (nt,).
        """
        if name.casefold() == "time":
            return self.common_time
        for names, table in (
            (self.names, self.values), (self.measured, self.measures), (SUMMARY, self.summaries),
        ):  # fmt: skip
            for k, each in enumerate(names):
                if each.casefold() == name.casefold():
                    return table[:, k]
        for k, each in enumerate(self.channels):
            if each.casefold() == name.casefold():
                return self.history(k)
        known = [*self.names, *self.measured, *self.channels]
        raise UnknownChannel(f"the sweep has no '{name}'; there are {', '.join(known)}")

    @property
    def samples(self) -> np.ndarray:
        """How many output times each run has (run,)."""
        return np.array([len(self.histories[k][0]) if k in self.histories else 0
                         for k in range(len(self))], dtype=np.int32)  # fmt: skip

    @property
    def common_time(self) -> np.ndarray:
        """The output times of the longest run (nt,)."""
        return max((time for time, _ in self.histories.values()), key=len, default=np.empty(0))

    @property
    def has_common_time(self) -> bool:
        """Whether all runs have the same output times, as far as they go."""
        whole = self.common_time
        return all(np.array_equal(each, whole[: len(each)]) for each, _ in self.histories.values())

    def times(self) -> np.ndarray:
        """The output times of each run (run, nt); not a number behind its end."""
        return self._padded([(at, time) for at, (time, _) in self.histories.items()])

    def history(self, channel: int) -> np.ndarray:
        """A column of all runs (run, nt); not a number behind the end of a run."""
        return self._padded([(at, v[:, channel]) for at, (_, v) in self.histories.items()])

    def _padded(self, rows: list[tuple[int, np.ndarray]]) -> np.ndarray:
        found = np.full((len(self), len(self.common_time)), np.nan)
        for at, row in rows:
            found[at, : len(row)] = row
        return found

    def save(self, path: str | Path) -> None:
        """Write a NetCDF file of all runs, whole or not at all; it opens in xarray."""
        import_module("adamslite.sweeps.netcdf").write(self, path)

    def indices(self, measures: str | Iterable[str] = ()) -> Any:
        """:func:`adamslite.indices` of these runs."""
        return import_module("adamslite.sweeps.saltelli").indices(self, measures)

    def plot(self, *names: str, **options: Any) -> Any:
        """Draw measures or histories; ``x``, ``by``, ``band``, ``pairs``, ``indices`` and
        ``output`` as for :func:`adamslite.plot`.
        """
        return adamslite.plot(self, names, **options)

    def view(self, output: str | Path | None = None, **options: Any) -> Any:
        """Show the run that sliders choose; ``runs``, ``channels``, ``deck`` and ``show`` as for
        :func:`adamslite.view`.
        """
        return adamslite.view(self, output, **options)

    def __repr__(self) -> str:
        done = len(self) - len(self.ahead)
        ends = ", ".join(f"{count} {ending}" for ending, count in self.endings.most_common())
        return f"<Sweep of {', '.join(self.names)}: {done} of {len(self)} runs; {ends or 'none'}>"
