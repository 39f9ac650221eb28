"""What the derivatives of a run are: histories, and numbers of them."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace

import numpy as np

from adamslite.errors import UsageError
from adamslite.language.likeness import did_you_mean
from adamslite.results.results import Results


@dataclass(frozen=True)
class Sensitivities:
    """Derivatives of a run by np numbers of its deck.

    Attributes
    ----------
    by : tuple of str
        Names of the numbers; ``at``: (np,) their values, in the units of the text.
    results : Results
        The run itself, with the columns that were asked for, (nt, nc).
    curves : numpy.ndarray
        (np, nt, nc) derivatives of these columns, in their units over those of the text.
    measures : tuple of str
        Names of the nm measures; ``values`` (nm,), ``gradient`` (nm, np).
    notes : mapping
        Words about numbers, by their names, and about the run.
    errors : numpy.ndarray
        (np,) what derivatives of places and velocities are estimated to be off by, against the
        largest.
    stopped : str
        What has ended the work early; derivatives that are missing are not a number.  Empty when
        all is done.
    """

    by: tuple[str, ...]
    at: np.ndarray
    results: Results
    curves: np.ndarray
    measures: tuple[str, ...]
    values: np.ndarray
    gradient: np.ndarray
    notes: Mapping[str, str]
    errors: np.ndarray = field(default_factory=lambda: np.zeros(0))
    stopped: str = ""

    @property
    def time(self) -> np.ndarray:
        """(nt,) output times of the dynamic analysis."""
        return self.results.time

    def curve(self, channel: str, by: str) -> np.ndarray:
        """The derivative of a column by a number, (nt,).

        Raises
        ------
        UsageError
            When there is none.
        """
        columns = [name.casefold() for name in self.results.names]
        return self.curves[self._number(by), :, _found(channel, columns, self.results.names)]

    @property
    def histories(self) -> Results:
        """The curves as results, columns ``PART/2.x by SPRINGDAMPER/1.K``."""
        pairs = [(k, j) for k in range(len(self.results.names)) for j in range(len(self.by))]
        names = tuple(f"{self.results.names[k]} by {self.by[j]}" for k, j in pairs)
        values = np.array([self.curves[j, :, k] for k, j in pairs]).T
        shaped = np.ascontiguousarray(values.reshape(len(self.time), len(pairs)))
        return replace(self.results, names=names, values=shaped)

    def __getitem__(self, asked: tuple[str, str]) -> float:
        """The derivative of a measure by a number."""
        measures = [name.casefold() for name in self.measures]
        row = _found(asked[0], measures, self.measures)
        return float(self.gradient[row, self._number(asked[1])])

    def _number(self, name: str) -> int:
        return _found(name, [each.casefold() for each in self.by], self.by)

    def __str__(self) -> str:
        head = ["d", "value", *(f"/d {name}" for name in self.by)]
        rows = [
            [name, f"{value:.10g}", *(f"{slope:.10g}" for slope in row)]
            for name, value, row in zip(self.measures, self.values, self.gradient, strict=True)
        ]
        widths = [max(map(len, column)) for column in zip(head, *rows, strict=True)]
        lines = ("  ".join(map(str.ljust, row, widths)).rstrip() for row in [head, *rows])
        return "".join(f"{line}\n" for line in lines)


def _found(name: str, known: list[str], shown: tuple[str, ...]) -> int:
    if name.casefold() not in known:
        hint = did_you_mean(name, shown) or f"there are {', '.join(shown[:6])}"
        raise UsageError(f"no derivative is called {name}; {hint}")
    return known.index(name.casefold())
