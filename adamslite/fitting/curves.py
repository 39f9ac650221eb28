"""Runs of a deck as a function of some of its numbers: curves at the times of a measurement.

Derivatives are those of :mod:`adamslite.sensitivity`, along the steps of a run, where there are
such and two runs beside confirm them at the start.  Elsewhere they are central differences::

    dy/dp = (y(p + h) - y(p - h)) / 2 h,     h = r scale(p),     r = ERROR^(1/3)

The rounding of an integration, some ERROR of the size of y, is divided by h, and the third
derivative times h^2/6 is left out: r balances both.  Beside a bound, or where the run on one side
fails, the difference is one-sided.
"""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any, NamedTuple

import numpy as np

from adamslite.analyses.simulation import simulate
from adamslite.deck.deck import Deck
from adamslite.deck.redefinition import Command
from adamslite.errors import RunFailed, UsageError
from adamslite.fitting.measured import Measured, amplitudes
from adamslite.fitting.parameters import Parameter
from adamslite.language.diagnostics import DeckError
from adamslite.progress import Progress, RunState
from adamslite.results.comparison import INTERPOLATIONS, Mismatch, sampler
from adamslite.results.outcomes import Outcome
from adamslite.results.results import Results
from adamslite.sensitivity.study import sensitivities
from adamslite.variation.decks import with_values

CUBIC = INTERPOLATIONS[-1]
#: Relative steps of differences are never smaller or larger.
SMALLEST_STEP, LARGEST_STEP = 1e-4, 2e-2
EXACT, DIFFERENCES = "sensitivities of runs", "central differences of runs"
#: Sensitivities are taken where differences of runs are so close to them, as a share of their size.
CONFIRMED = 0.01
#: ERROR of a run that does not say it.
USUAL_ERROR = 1e-3


@dataclass(frozen=True, kw_only=True)
class FitState(RunState):
    """``steps`` are the runs that are done; how many there will be is not known."""

    @property
    def share(self) -> float:
        return 0.0

    @property
    def reached(self) -> str:
        return f"{self.steps} runs"

    @property
    def counted(self) -> str:
        return "runs"


class Failed(RunFailed):
    """A run that gives no curves; says how it ended."""


class Curves(NamedTuple):
    """Values at the times of the measurement (nt, nc), and derivatives (nt, nc, np)."""

    values: np.ndarray
    derivatives: np.ndarray


@dataclass
class Runs:
    """Runs of a deck with other numbers.

    Parameters
    ----------
    deck : Deck
    given : mapping
        Numbers that all runs have.
    parameters : sequence of Parameter
    commands, options
        As ``simulate`` takes them.
    """

    deck: Deck
    given: Mapping[str, float]
    parameters: Sequence[Parameter]
    commands: Sequence[Command] = ()
    options: dict[str, Any] = field(default_factory=dict)
    progress: Progress = field(default_factory=Progress)
    count: int = 0
    interpolate: str | None = None
    """How values between output times are found."""
    differs: str | None = None
    """Why derivatives are differences; empty where they are not, None while it is not known."""

    _last: tuple[tuple[Any, ...], Results] | None = field(init=False, default=None)

    @property
    def derivatives(self) -> str:
        """How derivatives are found."""
        return f"{DIFFERENCES} ({self.differs})" if self.differs else EXACT

    def results(self, values: Sequence[float], **options: Any) -> Results:
        """One run to its end.

        Raises
        ------
        Failed
            When the numbers make no model, or the run ends early.
        """
        asked = (*values, *sorted(options.items()), *sorted(self.options.items()))
        if self._last is not None and self._last[0] == asked:
            return self._last[1]
        self.count += 1
        self.progress.watch(FitState(time=0.0, end=1.0, steps=self.count))
        try:
            found = simulate(
                self._with(values), commands=self.commands, **{**self.options, **options}
            )
        except DeckError as fault:
            first = next((each for each in fault.diagnostics if each.is_error), None)
            raise Failed(first.message if first else str(fault)) from None
        except (UsageError, RunFailed, ArithmeticError) as fault:
            raise Failed(str(fault)) from None
        if found.outcome is Outcome.INTERRUPTED:
            raise KeyboardInterrupt
        if not found.outcome.is_requested:
            reached = found.summary.get("t_end", found.time[-1] if found.time.size else 0.0)
            raise Failed(f"{found.outcome.name} at t = {reached:.6g}")
        self._last = asked, found
        return found

    def _with(self, values: Sequence[float]) -> Deck:
        """The deck with these numbers."""
        numbers = dict(zip((each.name for each in self.parameters), values, strict=True))
        return with_values(self.deck, {**self.given, **numbers})

    def sampled(self, results: Results, measured: Measured) -> np.ndarray:
        """Curves at the times of the measurement (nt, nc); angles without whole turns.

        Raises
        ------
        Failed
            When the run does not cover them, or a value is no number.
        """
        try:
            sample = sampler(results, measured.time, self.interpolate)
        except Mismatch as fault:
            raise Failed(str(fault)) from None
        columns = []
        for name, turns in zip(measured.channels, measured.turning, strict=True):
            history = results[name]
            columns.append(sample(np.unwrap(history) if turns else history))
        found = np.column_stack(columns)
        if not np.isfinite(found[measured.known]).all():
            raise Failed("a measured channel is no number")
        return found

    def curves(self, values: Sequence[float], measured: Measured, **options: Any) -> np.ndarray:
        """Curves (nt, nc) with these numbers."""
        return self.sampled(self.results(values, **options), measured)

    def curves_and_derivatives(
        self, values: Sequence[float], measured: Measured, wider: float = 1.0, **options: Any
    ) -> Curves:
        """Curves, and their derivatives by the numbers.

        Parameters
        ----------
        wider : float
            Factor for the steps of differences, to see what they do.

        Raises
        ------
        Failed
            When there is no run with these numbers, or on neither side of one of them.
        """
        at = self.results(values, **options)
        own = self.sampled(at, measured)
        if self.differs is None:
            self.differs = self._doubt(values, measured, at)
        if not self.differs:
            return Curves(own, self._sensitivities(values, measured, options))
        step = wider * relative_step(error_of(at))
        return Curves(own, self._differences(values, own, step, measured, options))

    def _sensitivities(
        self, values: Sequence[float], measured: Measured, options: dict[str, Any]
    ) -> np.ndarray:
        """dy/dp (nt, nc, np) along the steps of a run."""
        self.count += 1
        names = [each.name for each in self.parameters]
        try:
            found = sensitivities(
                self._with(values), names, measured.channels, self.commands, None,
                **{**self.options, **options},
            )  # fmt: skip
        except (DeckError, RunFailed, ArithmeticError) as fault:
            raise Failed(str(fault)) from None
        sample = sampler(found.results, measured.time, self.interpolate)
        columns = [
            np.column_stack([sample(found.curve(channel, name)) for name in names])
            for channel in measured.channels
        ]
        return np.stack(columns, axis=1)

    def _doubt(self, values: Sequence[float], measured: Measured, at: Results) -> str:
        """Why sensitivities are not taken, from a comparison with differences; empty where they
        are.
        """
        try:
            exact = self._sensitivities(values, measured, {})
            own, step = self.sampled(at, measured), relative_step(error_of(at))
            other = self._differences(values, own, step, measured, {})
        except (UsageError, Mismatch, Failed) as fault:
            return str(fault)
        scale = 1.0 / amplitudes(measured)[:, None]
        off, size = (
            np.linalg.norm(each * scale, axis=(0, 1)) for each in (exact - other, other)
        )  # fmt: skip
        worst = int(np.argmax(off - CONFIRMED * size))
        if not off[worst] > CONFIRMED * size[worst]:
            return ""
        name = self.parameters[worst].name
        return f"sensitivities by {name} and differences are {off[worst] / size[worst]:.2g} apart"

    def _differences(
        self,
        values: Sequence[float],
        own: np.ndarray,
        step: float,
        measured: Measured,
        options: dict[str, Any],
    ) -> np.ndarray:
        """dy/dp (nt, nc, np) from runs on both sides."""
        columns = [
            self._difference(list(values), k, own, step, measured, options)
            for k in range(len(self.parameters))
        ]
        return np.stack(columns, axis=-1)

    def _difference(
        self,
        values: list[float],
        k: int,
        own: np.ndarray,
        step: float,
        measured: Measured,
        options: dict[str, Any],
    ) -> np.ndarray:
        """dy/dp (nt, nc) of one number."""
        parameter, middle = self.parameters[k], values[k]
        scale = abs(middle) or parameter.scale
        sides: list[tuple[float, np.ndarray]] = []
        fault: Failed | None = None
        for sign in (1.0, -1.0):
            values[k] = min(max(middle + sign * step * scale, parameter.low), parameter.high)
            if values[k] == middle:
                continue
            try:
                sides.append((values[k], self.curves(values, measured, **options)))
            except Failed as failed:
                fault = failed
        if not sides:
            raise fault or Failed(f"{parameter.name} cannot be moved")
        if len(sides) == 1:
            sides.append((middle, own))
        (above, upper), (below, lower) = sides
        return (upper - lower) / (above - below)


def relative_step(error: float) -> float:
    """Step of differences as a share of a number, for runs of some ERROR."""
    return min(max(error ** (1.0 / 3.0), SMALLEST_STEP), LARGEST_STEP)


def error_of(results: Results) -> float:
    """ERROR of a run."""
    found = re.search(r"ERROR=(\S+)", results.meta.get("integrator", ""))
    return float(found[1]) if found else USUAL_ERROR


def prepared(runs: Runs, start: Results, time: np.ndarray) -> str:
    """Choose outputs or an interpolation, so that runs have values at the measured times.

    Equal steps of the output that meet all measured times are taken where there are such; a cubic
    spline through the output elsewhere.  Returns a sentence about it, which may be empty.
    """
    if _covers(start, time):
        return ""
    steps = _steps_that_meet(float(start.time[0]), float(start.time[-1]), time)
    if steps and steps >= len(start.time) - 1:
        runs.options["steps"] = steps
        again = runs.results([each.start for each in runs.parameters])
        if _covers(again, time):
            return f"output in {steps} steps, which meet the measured times"
        del runs.options["steps"]
    runs.interpolate = CUBIC
    return (
        f"measured times are no output times: curves are interpolated between "
        f"{len(start.time)} of them"
    )


#: Output that meets measured times has at most so many steps, and times may be off by a share.
MOST_STEPS, SAME = 200_000, 1e-6


def _steps_that_meet(begin: float, end: float, time: np.ndarray) -> int:
    """Equal steps from ``begin`` to ``end`` that meet all times; 0 where there are none."""
    gaps = np.diff(np.unique(np.concatenate([[begin], time, [end]])))
    gaps = gaps[gaps > 1e-9 * (end - begin)]
    if not gaps.size:
        return 0
    steps = (end - begin) / gaps.min()
    count = round(steps)
    if not 0 < count <= MOST_STEPS or abs(steps - count) > SAME * count:
        return 0
    places = (time - begin) / (end - begin) * count
    return count if np.abs(places - np.round(places)).max() <= SAME * count else 0


def _covers(results: Results, time: np.ndarray) -> bool:
    try:
        sampler(results, time, None)
    except Mismatch:
        return False
    return True
