"""A fit: the numbers, how sure they are, and how close the curves come; as text a table."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass
from importlib import import_module
from math import floor, log10
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from adamslite.fitting.certainty import Certainty
from adamslite.fitting.deck_text import commented, encoded
from adamslite.fitting.measured import Measured
from adamslite.fitting.parameters import Parameter
from adamslite.outputs.whole_files import whole_file
from adamslite.results.results import Results

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from adamslite.deck.deck import Deck

HEAD = ("number", "start", "fitted", "standard error", "")
UNIDENTIFIABLE, AT_BOUND, UNKNOWN = "not identifiable", "at its bound", "not worked out"
#: Correlations are printed for so many numbers; of more only those that are larger than this.
MOST_SHOWN, LARGE = 8, 0.95
#: Residuals that the deck does not explain: so many times beyond their band, and without band so
#: large a share of the spread.
BEYOND, LEFT = 3.0, 0.3
#: Between these sizes numbers are written without exponent, with so many places at most.
PLAIN, MOST_PLACES = (1e-3, 1e7), 12


class Residual(NamedTuple):
    """Of one channel: root mean square of model less measurement, as a number and as a part of its
    band, which is not a number where the file has none; how many values; ``left``: the number as a
    part of the spread of the values.
    """

    channel: str
    rms: float
    share: float
    values: int
    unit: str
    left: float

    @property
    def poor(self) -> str:
        """How much too large it is, as a phrase; empty where it is not."""
        if np.isfinite(self.share):
            return f"{self.share:.3g} times its band" if self.share > BEYOND else ""
        return f"{self.left:.2g} of its spread" if self.left > LEFT else ""


@dataclass(frozen=True, eq=False, repr=False, kw_only=True)
class Fit:
    """Numbers of a deck fitted to a measurement.

    Parameters
    ----------
    parameters : tuple of Parameter
        What was fitted: name, start, bounds.
    values, errors : (np,) arrays
        Fitted values and their standard errors; not a number where the measurement does not
        determine a number, or where it is at its bound.
    certainty : Certainty
        Correlation, and combinations that the measurement does not determine.
    residuals : tuple of Residual
        One for each channel.
    deck : Deck
        With the fitted numbers.
    results, before : Results
        Of the deck with the fitted numbers, and with those from the start.
    measured : Measured
    curves, sigmas : (nt, nc) arrays
        Fitted curves at the measured times, and what residuals were divided by.
    runs : int
        How many runs it took.
    derivatives : str
        How they were found.
    notes : tuple of str
        What else there is to say.
    stopped : str
        Why it ended early; empty when it is done.
    limited : bool
        Whether a limit or the user ended it, before standard errors were worked out.
    """

    parameters: tuple[Parameter, ...]
    values: np.ndarray
    errors: np.ndarray
    certainty: Certainty
    residuals: tuple[Residual, ...]
    deck: Deck
    results: Results
    before: Results
    measured: Measured
    curves: np.ndarray
    sigmas: np.ndarray
    runs: int
    derivatives: str
    notes: tuple[str, ...] = ()
    stopped: str = ""
    limited: bool = False

    @property
    def names(self) -> tuple[str, ...]:
        """The numbers that were fitted."""
        return tuple(each.name for each in self.parameters)

    def __getitem__(self, name: str) -> float:
        """The fitted value of a number."""
        known = {each.casefold(): k for k, each in enumerate(self.names)}
        known |= {short(each).casefold(): k for k, each in enumerate(self.names)}
        if name.casefold() not in known:
            raise KeyError(f"{name} was not fitted; there are {', '.join(self.names)}")
        return float(self.values[known[name.casefold()]])

    @property
    def numbers(self) -> dict[str, float]:
        """Fitted values by full names."""
        return dict(zip(self.names, self.values.tolist(), strict=True))

    @property
    def apart(self) -> np.ndarray:
        """Fitted less measured values (nt, nc)."""
        return self.measured.apart(self.curves)

    @property
    def phrases(self) -> list[str]:
        """``EA = 400370 +- 350`` for each number."""
        return [
            f"{row[0]} = {row[2]} {'+- ' if np.isfinite(error) else ''}{row[3]}"
            for row, error in zip(self._rows(), self.errors, strict=True)
        ]

    @property
    def correlation(self) -> np.ndarray:
        """Of the fitted values (np, np)."""
        return self.certainty.correlation

    @property
    def covariance(self) -> np.ndarray:
        """Of the fitted values (np, np)."""
        sizes = self.sizes
        return np.asarray(self.certainty.covariance * np.outer(sizes, sizes))

    @property
    def sizes(self) -> np.ndarray:
        """What relative changes are parts of (np,)."""
        pairs = zip(self.parameters, self.values, strict=True)
        return np.array([abs(value) or each.scale for each, value in pairs])

    @property
    def is_identifiable(self) -> bool:
        """Whether the measurement determines all numbers that are not at a bound."""
        pairs = zip(self.parameters, self.values, self.errors, strict=True)
        known = all(np.isfinite(error) or each.at_bound(value) for each, value, error in pairs)
        return known and not self.certainty.unidentifiable

    @property
    def is_close(self) -> bool:
        """Whether the deck does what was measured: no residual is far beyond its band, or without
        band a large share of the spread.
        """
        return not any(each.poor for each in self.residuals)

    @property
    def text(self) -> str:
        """The text of the deck with the fitted numbers, and below its title what they are."""
        return commented(self.deck, self.numbers, self.comments)

    @property
    def comments(self) -> list[str]:
        """What the fitted deck says about its numbers."""
        count = sum(each.values for each in self.residuals)
        names = ", ".join(self.measured.channels)
        lines = [f"Fitted by adamslite to {self.measured.name}: {count} values of {names}"]
        rows = zip(self.phrases, self._rows(), strict=True)
        lines += [f"{phrase} (standard error), before {row[1]}" for phrase, row in rows]
        lines += [str(each) for each in self.certainty.unidentifiable]
        return [*lines, *([self.stopped] if self.stopped else [])]

    def save(self, path: str | Path) -> None:
        """Write the fitted deck, whole or not at all: bytes of the deck but for the numbers."""
        with whole_file(path, binary=True) as stream:
            stream.write(encoded(self.deck, self.numbers, self.comments))

    def plot(self, output: str | Path | None = None) -> Figure:
        """Draw measured and fitted curves, and what is between them; needs matplotlib."""
        figures = import_module("adamslite.plots.fits")
        figure: Figure = figures.drawn(self)
        if output is not None:
            import_module("adamslite.plots.style").save(figure, output)
        return figure

    def _rows(self) -> list[tuple[str, str, str, str, str]]:
        """Number, start, fitted, standard error, and that as a part."""
        found = []
        for each, value, error in zip(self.parameters, self.values, self.errors, strict=True):
            known = np.isfinite(error)
            why = AT_BOUND if each.at_bound(value) else UNIDENTIFIABLE
            why = UNKNOWN if self.limited else why
            shown, off = _with_error(value, error) if known else (f"{value:.6g}", why)
            part = f"{100.0 * error / abs(value):.2g} %" if known and value else ""
            found.append((short(each.name), f"{each.start:.6g}", shown, off, part))
        return found

    def __str__(self) -> str:
        return "\n".join([*self._head(), *self._numbers(), *self._said()])

    def __repr__(self) -> str:
        rows = ", ".join(f"{row[0]}={row[2]}" for row in self._rows())
        return f"<Fit to {self.measured.name}: {rows}>"

    def _head(self) -> list[str]:
        count = sum(each.values for each in self.residuals)
        time = self.measured.time
        what = "channel" if len(self.residuals) == 1 else "channels"
        return [
            f"{count} values of {len(self.residuals)} {what}, t = {time[0]:g} to {time[-1]:g}; "
            f"{self.runs} runs, derivatives by {self.derivatives}",
            "",
        ]

    def _numbers(self) -> list[str]:
        lines = [*_table([HEAD, *self._rows()]), ""]
        lines += self._correlations()
        channels = [("channel", "values", "residual rms", "of its band")]
        for each in self.residuals:
            rms = f"{each.rms:.4g} {each.unit}".strip()
            share = f"{each.share:.3g}" if np.isfinite(each.share) else "no band"
            channels.append((each.channel, str(each.values), rms, share))
        return [*lines, *_table(channels)]

    def _correlations(self) -> list[str]:
        count = len(self.names)
        if count < 2:
            return []
        table = self.correlation
        if count <= MOST_SHOWN:
            shown = [[*("" if np.isnan(c) else f"{c:+.3f}" for c in row)] for row in table]
            head = ["correlation", *(f"({k + 1})" for k in range(count))]
            rows = [[f"({k + 1}) {short(n)}", *shown[k]] for k, n in enumerate(self.names)]
            return [*_table([head, *rows]), ""]
        pairs = [
            f"correlation {table[i, k]:+.3f}: {self.names[i]} and {self.names[k]}"
            for i in range(count) for k in range(i) if abs(table[i, k]) > LARGE
        ]  # fmt: skip
        return [*pairs, ""] if pairs else []

    def _said(self) -> list[str]:
        silent = [str(each) for each in self.certainty.unidentifiable]
        said = [*self.notes, *silent, *([self.stopped] if self.stopped else [])]
        return ["", *said] if said else []


def short(name: str) -> str:
    """The name of a number in tables: a VARIABLE that is one number goes by its id."""
    found = re.fullmatch(r"VARIABLE/(\w*[A-Za-z_]\w*)\.FUNCTION", name)
    return found[1] if found else name


def _with_error(value: float, error: float) -> tuple[str, str]:
    """A value with the digits that its standard error leaves, and that with two digits."""
    if not error or not PLAIN[0] < max(abs(value), error) < PLAIN[1]:
        return f"{value:.6g}", f"{error:.2g}"
    places = min(1 - floor(log10(error)), MOST_PLACES)
    texts = (f"{round(each, places):.{max(places, 0)}f}" for each in (value, error))
    return next(texts), next(texts)


def _table(rows: Sequence[Sequence[str]]) -> list[str]:
    widths = [max(map(len, column)) for column in zip(*rows, strict=True)]
    return ["  ".join(map(str.ljust, row, widths)).rstrip() for row in rows]
