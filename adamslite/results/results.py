"""The results of a run: time histories under the names of the deck, and the outcome."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field, replace
from functools import cached_property
from importlib import import_module
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

import adamslite
from adamslite.language.diagnostics import DeckError
from adamslite.results.formats import format_of
from adamslite.results.outcomes import Outcome
from adamslite.results.printed import Printed

if TYPE_CHECKING:
    from matplotlib.figure import Figure
    from pandas import DataFrame
    from xarray import Dataset

    from adamslite.deck.deck import Deck
    from adamslite.results.balance import Balance
    from adamslite.results.channels import Channel
    from adamslite.results.confirmation import Confirmation
    from adamslite.results.linearization import Linearization
    from adamslite.results.source import RunSource


#: Numbers of a block.
BLOCK = 2**20


def rows_of_block(columns: int) -> int:
    """How many rows of so many columns make a block."""
    return max(1, BLOCK // max(1, columns))


class UnknownChannel(KeyError):
    """A name that no column of the results has."""

    def __str__(self) -> str:
        return self.args[0]


class Linearized(NamedTuple):
    """One LINEAR command: ``kind`` EIGENSOL or STATEMAT, its FILE if it names one, the ``time`` of
    the state, and the :class:`~adamslite.results.linearization.Linearization`.

    ``form`` MATLAB: matrices as plain tables; ``shapes``, ``energies``: first and last mode of
    which these are written.
    """

    kind: str
    file: str | None
    time: float
    model: Linearization
    form: str | None = None
    shapes: tuple[int, int] | None = None
    energies: tuple[int, int] | None = None


@dataclass(frozen=True, eq=False, repr=False, kw_only=True)
class Results:
    """Time histories of one run.

    Parameters
    ----------
    time : (nt,) array
        Output times [time].
    names : tuple of str, length nc
        Result names in column order, without `time`: `PART/2.x`, `REQUEST/1.F2`, `JOINT/3.fx`, ...
    values : (nt, nc) array
        One row per output time, in the units of the deck (angles in radians).
    meta : mapping of str to str
        What the values belong to (deck, hash, units, integrator, ...): the comment lines of a file.
        That on the accuracy takes a second run when it, or all of them, are first looked at.
    outcome : Outcome
        How the run ended.
    message : str
        For an early end: statement, line, time, cause and remedy. Empty when the run is done.
    summary : mapping
        Counters of the run: outcome, t_end, dof, steps, rejected, newton, jacobians,
        factorizations, setup_cpu_s, solve_cpu_s, max_violation.
    linearizations : tuple of Linearized
        What the LINEAR commands found, in their order.
    balances : tuple of Balance
        With an audit, the balance of energy of every dynamic analysis.
    confirmation : Confirmation
        The two other runs of a confirmation, when it was requested
        (:mod:`adamslite.analyses.findings.confirmation`).
    source : RunSource or None
        The texts of deck and command file; None where they are not known.
    channels : mapping of str to Channel
        Units and titles of columns, where a file has named them; see :meth:`channel`.
    printed : Printed
        How far the file that they are from has rounded them.
    """

    time: np.ndarray
    names: tuple[str, ...]
    values: np.ndarray
    meta: Mapping[str, str] = field(default_factory=dict)
    outcome: Outcome = Outcome.DONE
    message: str = ""
    summary: Mapping[str, Any] = field(default_factory=dict)
    linearizations: tuple[Linearized, ...] = ()
    balances: tuple[Balance, ...] = ()
    confirmation: Confirmation | None = None
    source: RunSource | None = None
    channels: Mapping[str, Channel] = field(default_factory=dict, repr=False)
    printed: Printed = Printed()

    def __getitem__(self, name: str) -> np.ndarray:
        """Return the (nt,) history called `name` (upper or lower case), or the times for "time"."""
        key = name.casefold()
        if key == "time":
            return self.time
        if key not in self._column:
            raise UnknownChannel(self._unknown(name))
        return self.values[:, self._column[key]]

    def __contains__(self, name: str) -> bool:
        return name.casefold() == "time" or name.casefold() in self._column

    def __iter__(self) -> Iterator[str]:
        return iter(self.names)

    def channel(self, name: str) -> Channel:
        """Statement, quantity and unit of the column called `name`, or of "time"."""
        from adamslite.results.channels import Channel, describe

        if name.casefold() == "time":
            own = Channel("time", "", "", "", "time", self.unit_symbols.get("time", ""))
            return self.channels.get("time", own)
        if name not in self:
            raise UnknownChannel(self._unknown(name))
        name = self.names[self._column[name.casefold()]]
        return self.channels.get(name) or describe(name, self.unit_symbols, self.deck)

    @cached_property
    def unit_symbols(self) -> dict[str, str]:
        """Symbols by ``force``, ``mass``, ``length``, ``time``; empty where none are known."""
        from adamslite.results.channels import unit_symbols

        return unit_symbols(self.meta.get("units", ""))

    def blocks(self, first: int = 0) -> Iterator[tuple[np.ndarray, np.ndarray]]:
        """Times (n,) and values (n, nc) of the rows from one on, some at a time."""
        return self.parts(rows_of_block(len(self.names)), first)

    def parts(self, size: int, first: int = 0) -> Iterator[tuple[np.ndarray, np.ndarray]]:
        """The same, so many rows at a time."""
        for start in range(first, self.count, size):
            end = start + size
            yield self.time[start:end], self.values[start:end]

    def limited(self, columns: list[int]) -> Results:
        """The results with some of the columns alone."""
        if columns == [*range(len(self.names))]:
            return self
        names = tuple(self.names[k] for k in columns)
        values, row = np.empty((self.count, len(columns))), 0
        for _, part in self.blocks():  # all at once would be there twice
            values[row : row + len(part)] = part[:, columns]
            row += len(part)
        return replace(self, names=names, values=values)

    def by_row(self) -> Results:
        """Return the results over row numbers where all of several rows are at one time
        (successive equilibria), else as they are.
        """
        if self.count < 2 or np.ptp(self.time) != 0.0:
            return self
        from adamslite.results.channels import Channel

        channels = {**self.channels, "time": Channel("time", "", "", "", "row")}
        return replace(self, time=np.arange(1.0, self.count + 1.0), channels=channels)

    @property
    def success(self) -> bool:
        """Whether the run reached its end, or a SENSOR with HALT ended it as the deck requests."""
        return self.outcome.is_requested

    @property
    def count(self) -> int:
        """How many output times there are."""
        return len(self.time)

    @property
    def shape(self) -> tuple[int, ...]:
        """Rows and columns of the values."""
        return self.values.shape

    def save(self, path: str | Path) -> None:
        """Write the results to `path` in the format of its suffix.

        A failed write leaves an earlier file as it was.
        """
        format_of(path).write(self, path)

    @staticmethod
    def load(path: str | Path) -> Results:
        """Read what `save` wrote; the comment lines come back in `meta`."""
        read = format_of(path, to_read=True).read
        assert read is not None
        found: Results = import_module("adamslite.results.untrusted").shown(read(path))
        return found

    def select(self, *patterns: str) -> Results:
        """The results with some columns alone: ``REQUEST/*``, ``PART/2.v?``, ``PART/2`` for all
        of it.

        Raises
        ------
        UsageError
            When a pattern means none; names what comes near.
        """
        selection = import_module("adamslite.results.selection")
        selection.selected(self.names, patterns)
        chosen: Results = selection.limited(self, patterns)
        return chosen

    def plot(self, *channels: str, **options: Any) -> Figure:
        """Draw channels (names or patterns); ``against``, ``x`` and ``output`` as for
        :func:`adamslite.plot`.
        """
        return adamslite.plot(self, channels, **options)

    def view(self, output: str | Path | None = None, **options: Any) -> Any:
        """Show how it moves; ``against``, ``deck`` and ``show`` as for :func:`adamslite.view`."""
        return adamslite.view(self, output, **options)

    def to_pandas(self) -> DataFrame:
        """A table of pandas: the times as index, a column for each channel.

        ``attrs`` of the table has the comments of the results, and ``"channel units"``.
        """
        return import_module("adamslite.api.tables").to_pandas(self)

    def to_xarray(self) -> Dataset:
        """A Dataset of xarray: what a NetCDF file of the results (.nc) holds, with units."""
        return import_module("adamslite.api.tables").to_xarray(self)

    @cached_property
    def deck(self) -> Deck | None:
        """The statements of the run, where its text is known and can be read here."""
        try:
            return self.source.read()[0] if self.source else None
        except DeckError:
            return None  # the tables that it names are not here

    @cached_property
    def _column(self) -> dict[str, int]:
        return {name.casefold(): column for column, name in enumerate(self.names)}

    def _unknown(self, name: str) -> str:
        from difflib import get_close_matches

        close = get_close_matches(name.casefold(), self._column, n=3, cutoff=0.6)
        near = [self.names[self._column[key]] for key in close] or list(self.names[:3])
        hint = (
            f"; did you mean {' or '.join(near)}?"
            if close
            else f"; there are {', '.join(near)}, ..."
        )
        return f"no result is called '{name}'{hint if near else ' (the results are empty)'}"

    def __repr__(self) -> str:
        span = f", t = {self.time[0]:g} to {self.time[-1]:g}" if len(self.time) else ""
        title = f" of {self.meta['deck']!r}" if "deck" in self.meta else ""
        size = f"{len(self.names)} channels at {len(self.time)} times{span}"
        return f"<Results{title}: {size}; {self.outcome.name}>"

    def _repr_html_(self) -> str:
        """How the run ended, and the page that moves, for a notebook."""
        return adamslite.html(self)
