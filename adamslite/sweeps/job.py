"""One run of a sweep: what all runs have in common, and what is kept of each."""

from __future__ import annotations

import threading
from collections.abc import Mapping, Sequence
from contextlib import nullcontext
from dataclasses import dataclass, field
from typing import Any, NamedTuple

import numpy as np

from adamslite.analyses.setup.subject import kernels_of, prepared_for
from adamslite.analyses.simulation import simulate
from adamslite.deck.deck import Deck
from adamslite.deck.redefinition import Command
from adamslite.errors import NoRoom, OutOfMemory, RunFailed, UsageError
from adamslite.language.diagnostics import DeckError
from adamslite.model.reduction import kept_apart
from adamslite.results.outcomes import Outcome
from adamslite.results.results import Results
from adamslite.sweeps.measures import Measure
from adamslite.variation.decks import with_values

#: The outcome of a run whose numbers make no model, and of one that the program fails at.
INVALID, FAULT = "INVALID", "FAULT"
#: Of a run that has not been carried out.
AHEAD = ""
_turns = threading.Lock()
SUMMARY = (
    "t_end", "dof", "steps", "rejected", "newton", "jacobians", "factorizations", "max_violation",
)  # fmt: skip


class Run(NamedTuple):
    """What is kept of a run.

    ``number``: which one; ``summary``: of :data:`SUMMARY`; ``measures`` (nm,); ``time`` (nt,) and
    ``histories`` (nt, nc) of the columns that are kept.
    """

    number: int
    outcome: str
    message: str
    summary: tuple[float, ...]
    measures: tuple[float, ...]
    time: np.ndarray
    histories: np.ndarray


@dataclass(frozen=True)
class Job:
    """What the runs of a sweep have in common.

    Parameters
    ----------
    deck : Deck
    names : tuple of str
        The numbers that vary, by their full names.
    values : (run, number) array
    commands, options
        As ``simulate`` takes them.
    measures : tuple of Measure
    channels : tuple of str
        Columns whose histories are kept.
    memory_limit : int, optional
        Data of the process of a worker while a run lasts [byte].
    """

    deck: Deck
    names: tuple[str, ...]
    values: np.ndarray
    commands: Sequence[Command] = ()
    options: Mapping[str, Any] = field(default_factory=dict)
    measures: tuple[Measure, ...] = ()
    channels: tuple[str, ...] = ()
    memory_limit: int | None = None

    def given(self, number: int) -> dict[str, float]:
        """The numbers of a run by name."""
        return dict(zip(self.names, self.values[number].tolist(), strict=True))

    def run(self, number: int) -> Run:
        """Carry out a run; one that fails is described, not raised.

        A routine of the user has one room for what it is given: threads take turns.
        """
        try:
            with _turns if self.deck.user.made else nullcontext():
                deck = with_values(self.deck, self.given(number))
                results = simulate(
                    deck, commands=self.commands, notes=False, memory_limit=self.memory_limit,
                    **self.options,
                )  # fmt: skip
        except (NoRoom, OutOfMemory) as fault:
            return self.without(number, Outcome.MEMORY_LIMIT.name, str(fault))
        except DeckError as fault:
            first = next((each for each in fault.diagnostics if each.is_error), None)
            return self.without(number, INVALID, first.message if first else str(fault))
        except (UsageError, RunFailed) as fault:
            return self.without(number, INVALID, str(fault))
        except Exception as fault:  # the other runs go on
            return self.without(number, FAULT, f"{type(fault).__name__}: {fault}")
        return self._kept(number, results)

    def _kept(self, number: int, results: Results) -> Run:
        time, stopped = results.time, not results.outcome.is_requested
        summary = tuple(float(results.summary[each]) for each in SUMMARY)
        measures = tuple(each.of(time, _column(results, each.channel)) for each in self.measures)
        columns = [_column(results, each) for each in self.channels]
        histories = np.column_stack(columns) if columns else np.empty((len(time), 0))
        message = results.message if stopped else ""
        ending = AHEAD if results.outcome is Outcome.INTERRUPTED else results.outcome.name
        kept = time if columns else time[:0]
        return Run(number, ending, message, summary, measures, kept, histories)

    def without(self, number: int, outcome: str, message: str) -> Run:
        """A run of which there is nothing but how it ended."""
        nothing = (np.nan,) * len(SUMMARY), (np.nan,) * len(self.measures)
        histories = np.empty((0, len(self.channels)))
        return Run(number, outcome, message, *nothing, np.empty(0), histories)

    def prepare(self) -> None:
        """Compile, and use every name with numbers that the deck does not have: they are compared
        with reading the deck when they are first used (:mod:`adamslite.variation.kernels`), and
        workers need not do that again.
        """
        without = kept_apart(self.commands, False)
        for number in (0, len(self.values) // 2, len(self.values) - 1):
            try:
                varied = with_values(self.deck, self.given(number))
                kernels_of(prepared_for(varied, self.commands), None, without, False)
            except (DeckError, UsageError):
                continue


def _column(results: Results, name: str) -> np.ndarray:
    """A column (nt,); of a run that ended before its first output there are none, and no times."""
    return results[name] if results.names else results.time
