"""Derivatives of curves by the numbers that are fitted.

Those of :mod:`adamslite.sensitivity`, along the steps of a run, are taken of each number for which
differences confirm them at the start.  The others are central differences with the steps of
:mod:`adamslite.sensitivity.measures`.  Beside a bound, or where the run on one side fails, the
difference is one-sided.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any, NamedTuple

import numpy as np

from adamslite.errors import RunFailed, UsageError
from adamslite.fitting.curves import Failed, Runs, Spent, error_of
from adamslite.fitting.measured import Measured, amplitudes
from adamslite.language.diagnostics import DeckError
from adamslite.results.comparison import Mismatch, sampler
from adamslite.sensitivity.measures import CONFIRMED, DOUBT, relative_step
from adamslite.sensitivity.study import sensitivities

EXACT, DIFFERENCES = "sensitivities of runs", "central differences of runs"


class Curves(NamedTuple):
    """Values at the times of the measurement (nt, nc), and derivatives (nt, nc, np)."""

    values: np.ndarray
    derivatives: np.ndarray


@dataclass
class Derivatives:
    """Derivatives of the runs of one fit.

    ``doubts``: by name the numbers whose derivatives are differences, and how far sensitivities are
    off; ``none``: why there are no sensitivities; neither is known before the first use.
    """

    runs: Runs
    measured: Measured
    doubts: dict[str, float] = field(default_factory=dict)
    none: str = ""
    is_known: bool = False

    def __str__(self) -> str:
        if self.none:
            return f"{DIFFERENCES} ({self.none})"
        listed = [f"{name} ({off:.2g} apart)" for name, off in self.doubts.items()]
        return f"{EXACT}, by {', '.join(listed)} differences" if listed else EXACT

    def at(self, values: Sequence[float], wider: float = 1.0, **options: Any) -> Curves:
        """Curves and their derivatives with these numbers.

        Parameters
        ----------
        wider : float
            Factor for the steps of differences, to see what they do.

        Raises
        ------
        Failed
            When there is no run with these numbers, or on neither side of one of them.
        """
        results = self.runs.results(values, **options)
        own = self.runs.sampled(results, self.measured)
        step = wider * relative_step(error_of(results))
        if not self.is_known:
            self._confirm(values, own, step)
        by = [each.name for each in self.runs.parameters]
        exact = [] if self.none else [name for name in by if name not in self.doubts]
        columns = dict(zip(exact, self._sensitivities(values, exact, options), strict=True))
        for k, name in enumerate(by):
            if name not in columns:
                columns[name] = self._difference(values, k, own, step, options)
        return Curves(own, np.stack([columns[name] for name in by], axis=-1))

    def _sensitivities(
        self, values: Sequence[float], by: Sequence[str], options: dict[str, Any]
    ) -> list[np.ndarray]:
        """dy/dp (nt, nc) of some of the numbers, along the steps of a run."""
        if not by:
            return []
        runs, measured = self.runs, self.measured
        runs.count += 1
        try:
            found = sensitivities(
                runs.deck_with(values), by, measured.channels, runs.commands, None,
                False, **runs.lent(options),
            )  # fmt: skip
        except (DeckError, RunFailed, ArithmeticError) as fault:
            runs.need_left()
            raise Failed(str(fault)) from None
        if found.stopped:
            raise Spent(found.stopped)
        sample = sampler(found.results, measured.time, runs.interpolate)
        return [
            np.column_stack([sample(found.curve(channel, name)) for channel in measured.channels])
            for name in by
        ]

    def _confirm(self, values: Sequence[float], own: np.ndarray, step: float) -> None:
        """Compare sensitivities with differences."""
        self.is_known = True
        by = [each.name for each in self.runs.parameters]
        try:
            exact = self._sensitivities(values, by, {})
        except (UsageError, Mismatch, Failed) as fault:
            self.none = str(fault)
            return
        for k, name in enumerate(by):
            try:
                share = self._apart(values, k, own, step, exact[k])
            except Failed:  # nothing says that it is wrong
                continue
            if share > CONFIRMED:
                self.doubts[name] = share

    def _apart(
        self, values: Sequence[float], k: int, own: np.ndarray, step: float, exact: np.ndarray
    ) -> float:
        """How far sensitivities are from differences, as a share; 0 where those say nothing."""
        other = self._difference(values, k, own, step, {})
        off, size = self._length(exact - other), self._length(other)
        if off <= CONFIRMED * size:
            return 0.0
        wide = self._difference(values, k, own, 2.0 * step, {})
        return off / size if off > DOUBT * self._length(other - wide) else 0.0

    def _length(self, curves: np.ndarray) -> float:
        """Of curves (nt, nc), each by the amplitude of its channel."""
        return float(np.linalg.norm(curves / amplitudes(self.measured)))

    def _difference(
        self,
        values: Sequence[float],
        k: int,
        own: np.ndarray,
        step: float,
        options: dict[str, Any],
    ) -> np.ndarray:
        """dy/dp (nt, nc) of one number, from runs on both sides."""
        parameter, middle, moved = self.runs.parameters[k], values[k], list(values)
        size = step * (abs(middle) or parameter.scale)
        sides: list[tuple[float, np.ndarray]] = []
        fault: Failed | None = None
        for sign in (1.0, -1.0):
            moved[k] = min(max(middle + sign * size, parameter.low), parameter.high)
            if moved[k] == middle:
                continue
            try:
                sides.append((moved[k], self.runs.curves(moved, self.measured, **options)))
            except Failed as failed:
                fault = failed
        if not sides:
            raise fault or Failed(f"{parameter.name} cannot be moved")
        if len(sides) == 1:
            sides.append((middle, own))
        (above, upper), (below, lower) = sides
        return (upper - lower) / (above - below)
