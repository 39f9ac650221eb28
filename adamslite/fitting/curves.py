"""Runs of a deck as a function of some of its numbers: curves at the times of a measurement."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from adamslite.analyses.setup.run_options import Budget
from adamslite.analyses.simulation import simulate
from adamslite.deck.deck import Deck
from adamslite.deck.redefinition import Command
from adamslite.errors import NoRoom, OutOfMemory, RunFailed, UsageError
from adamslite.fitting.measured import Measured
from adamslite.fitting.parameters import Parameter
from adamslite.language.diagnostics import DeckError
from adamslite.progress import Progress, RunState
from adamslite.results.comparison import INTERPOLATIONS, Mismatch, sampler
from adamslite.results.outcomes import Outcome
from adamslite.results.results import Results
from adamslite.variation.decks import with_values

CUBIC = INTERPOLATIONS[-1]
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


class Spent(RunFailed):
    """The runs of a fit have come to a limit; says to which."""


#: Outcomes that end a fit, and not one of its runs.
LIMITS = (Outcome.CPU_LIMIT, Outcome.STEP_LIMIT, Outcome.MEMORY_LIMIT)


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
    budget: Budget = field(default_factory=Budget)
    """What all runs together may spend."""
    best: tuple[np.ndarray, Results] | None = None
    """Coordinates of the best numbers so far, and their run."""
    _last: tuple[tuple[Any, ...], Results] | None = field(init=False, default=None)

    def results(self, values: Sequence[float], **options: Any) -> Results:
        """One run to its end.

        Raises
        ------
        Failed
            When the numbers make no model, or the run ends early.
        Spent
            When it would go beyond a limit.
        """
        asked = self._asked(values, options)
        if self._last is not None and self._last[0] == asked:
            return self._last[1]
        self.need_left()
        self.count += 1
        self.progress.watch(FitState(time=0.0, end=1.0, steps=self.count))
        try:
            found = simulate(self.deck_with(values), commands=self.commands, **self.lent(options))
        except DeckError as fault:
            first = next((each for each in fault.diagnostics if each.is_error), None)
            raise Failed(first.message if first else str(fault)) from None
        except (NoRoom, OutOfMemory) as fault:  # and those after it would have none either
            raise Spent(str(fault)) from None
        except (UsageError, RunFailed, ArithmeticError) as fault:
            raise Failed(str(fault)) from None
        if found.outcome is Outcome.INTERRUPTED:
            raise KeyboardInterrupt
        self.budget.taken += int(found.summary["steps"])
        if found.outcome in LIMITS:
            raise Spent(found.outcome.sentence)
        if not found.outcome.is_requested:
            reached = found.summary.get("t_end", found.time[-1] if found.time.size else 0.0)
            raise Failed(f"{found.outcome.name} at t = {reached:.6g}")
        self._last = asked, found
        return found

    def _asked(self, values: Sequence[float], options: Mapping[str, Any]) -> tuple[Any, ...]:
        return (*values, *sorted(options.items()), *sorted(self.options.items()))

    def lent(self, options: Mapping[str, Any]) -> dict[str, Any]:
        """Options of a run, which may spend what is left."""
        left = {"cpu_limit": self.budget.cpu_left, "max_steps": self.budget.steps_left}
        return {**self.options, **{k: v for k, v in left.items() if v is not None}, **options}

    def need_left(self) -> None:
        """Raises Spent when nothing is left to be spent."""
        if outcome := self.budget.spent():
            raise Spent(outcome.sentence)

    def take_up(self, values: Sequence[float], results: Results) -> None:
        """Remember the run of some numbers."""
        self._last = self._asked(values, {}), results

    def deck_with(self, values: Sequence[float]) -> Deck:
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
