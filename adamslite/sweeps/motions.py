"""The page of a sweep: its runs, carried out again with all columns, of which a reader chooses one.

A file of a sweep holds a few numbers of each run; the page needs how everything moves. Runs are
computed again from the deck that the file carries, and compared with what it holds.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import replace
from math import isfinite
from typing import Any

import numpy as np

from adamslite.analyses.setup.subject import kernels_of, prepared_for
from adamslite.analyses.simulation import simulate
from adamslite.deck.commands import Commands
from adamslite.deck.deck import Deck
from adamslite.drawing.decimation import FEWEST, POINTS, RUNS_BUDGET, RUNS_CHANNEL_BUDGET
from adamslite.drawing.drawing import Drawing, Page, numbers_of
from adamslite.drawing.run_deck import at_start, need_its_bodies
from adamslite.drawing.scene import Scene, described
from adamslite.equations.result_columns import column_names
from adamslite.errors import RunFailed, UsageError
from adamslite.language.diagnostics import DeckError, Source
from adamslite.model.model import Model
from adamslite.model.reduction import kept_apart
from adamslite.page.page import page_of_scene
from adamslite.progress import Progress, RunsState
from adamslite.reading.read import commands_of
from adamslite.results.outcomes import Outcome
from adamslite.results.results import Results
from adamslite.results.selection import selected
from adamslite.sweeps.job import FAULT, INVALID
from adamslite.sweeps.measures import parsed
from adamslite.sweeps.origin import origin_of
from adamslite.sweeps.record import Sweep
from adamslite.variation.decks import with_values

#: More runs than this are too many for a page.
MOST = 1000
#: Measures of a run that is computed again may differ by so much, as a part of the largest.
AGAIN = 1e-6
MOST_NAMED = 3


def page_of_sweep(
    sweep: Sweep,
    deck: Deck | None = None,
    numbers: Sequence[int] | None = None,
    channels: Sequence[str] = (),
    progress: Progress | None = None,
) -> tuple[str, str]:
    """The text of the page of a sweep, and a sentence about runs that are others than the file
    says, empty where there are none.

    Parameters
    ----------
    deck : Deck
        The deck of the runs, for routines of the user; by default that which the sweep carries.
    numbers : sequence of int
        The runs that are shown; by default all that are done.
    channels : sequence of str
        Names or patterns of columns to plot; by default all, where they have room.

    Raises
    ------
    UsageError
        When there are too many runs or bodies, or none that can be drawn.
    DeckError
        When the deck cannot be read.
    """
    chosen = _chosen(sweep, numbers)
    runs = _Again(sweep, deck, progress or Progress())
    runs.need_room(len(chosen))
    page = Page(runs=len(chosen), plotted=runs.plotted(len(chosen), channels))
    drawn = scene_of_runs(runs.cases(chosen), page, table(sweep, chosen))
    warning = different(runs.others) if runs.others else ""
    notes = [*drawn.plain["notes"], *([warning] if warning else [])]
    return page_of_scene(replace(drawn, plain={**drawn.plain, "notes": notes})), warning


def bound_deck(sweep: Sweep, user: Sequence[str]) -> Deck:
    """The deck that a sweep carries, with bindings of routines, ``VARSUB=module:function``."""
    source, _ = origin_of(sweep)
    return replace(source, user=(*source.user, *user)).read()[0]


def numbers_of_runs(text: str, count: int) -> list[int]:
    """``0,5,7``, ``FROM:TO`` (without TO) or ``FROM:TO:STEP``, of so many runs.

    Raises
    ------
    UsageError
        When it is none of these.
    """
    try:
        if ":" not in text:
            return [int(word) for word in text.split(",")]
        ends = [int(word) if word.strip() else None for word in text.split(":")]
        return list(range(count))[slice(*ends)]
    except (ValueError, TypeError):
        raise UsageError(f"--runs {text}: it is not like 0,5,7 or 0:100 or 0:100:10") from None


def table(sweep: Sweep, numbers: Sequence[int]) -> dict[str, Any]:
    """What a page says of runs: their numbers, measures and how they ended."""
    rows, failed = list(numbers), set(sweep.failed)
    return {
        "runs": rows,
        "numbers": [
            _quantity(sweep, name, sweep.values[rows, k]) for k, name in enumerate(sweep.names)
        ],
        "measures": [
            _quantity(sweep, name, sweep.measures[rows, k]) for k, name in enumerate(sweep.measured)
        ],
        "outcomes": [sweep.outcomes[k] for k in rows],
        "messages": [sweep.messages[k] for k in rows],
        "failed": [k in failed for k in rows],
    }


def _quantity(sweep: Sweep, name: str, values: np.ndarray) -> dict[str, Any]:
    """A number or a measure of the runs; None where it is none."""
    plain = [each if isfinite(each) else None for each in values.tolist()]
    return {"name": name, "unit": sweep.units.get(name, ""), "values": plain}


def different(runs: Sequence[int]) -> str:
    """A sentence about runs that are others when they are computed again."""
    named = ", ".join(map(str, runs[:MOST_NAMED])) + (", ..." if runs[MOST_NAMED:] else "")
    return (
        f"{len(runs)} runs ({named}) have other measures when they are computed again than in the "
        f"file: the program, or a routine of the user, has changed since"
    )


def _chosen(sweep: Sweep, numbers: Sequence[int] | None) -> list[int]:
    ahead = set(sweep.ahead)
    wanted = range(len(sweep)) if numbers is None else numbers
    for each in wanted:
        if not 0 <= each < len(sweep):
            raise UsageError(f"there is no run {each}: they are 0 to {len(sweep) - 1}")
    found = [each for each in dict.fromkeys(wanted) if each not in ahead]
    if not found:
        raise UsageError("none of these runs has been carried out: there is nothing to show")
    if len(found) > MOST:
        every = -(-len(found) // MOST)
        raise UsageError(
            f"{len(found)} runs are too many for a page, and {MOST} are the most: choose some, as "
            f"--runs 0:{len(sweep)}:{every}"
        )
    return found


class _Again:
    """Carries out runs of a sweep again; ``others``: those that are not what the file says."""

    def __init__(self, sweep: Sweep, deck: Deck | None, progress: Progress) -> None:
        self.others: list[int] = []
        self._sweep, self._progress = sweep, progress
        source, self._options = origin_of(sweep)
        if deck is None:
            self._deck, self._commands = source.read()
        else:
            if deck.hash != sweep.meta.get("deck hash"):
                raise UsageError(f"{deck.path or deck.title} is not the deck of these runs")
            written = Source(source.commands, source.commands_name)
            self._deck = deck
            self._commands = commands_of(written, deck) if source.commands else Commands()

    def need_room(self, count: int) -> None:
        """Reject so many runs where their motions would make a page too large."""
        size = max(numbers_of(Model(self._deck)), 1)
        most = max(RUNS_BUDGET // (FEWEST * size), 1)
        if count > most:
            raise UsageError(
                f"{count} runs of a model with {size} coordinates are too many for a page: choose "
                f"{most} at most, as --runs 0:{len(self._sweep)}:{-(-count // most)}"
            )

    def plotted(self, count: int, patterns: Sequence[str]) -> tuple[str, ...]:
        """The columns that are plotted of so many runs: all where they have room, else those that
        the sweep has kept or measured; empty for all.
        """
        without = kept_apart(self._commands, False)
        subject = prepared_for(self._deck, self._commands)
        columns = column_names(kernels_of(subject, self._progress, without, False))
        if patterns:
            chosen = selected(columns, patterns)
            most = RUNS_CHANNEL_BUDGET // (FEWEST * count)
            if len(chosen) > most:
                raise UsageError(
                    f"{len(chosen)} channels of {count} runs are too many for a page: choose "
                    f"{most} channels at most, or fewer runs by --runs"
                )
            return tuple(columns[k] for k in chosen)
        if POINTS[0] * len(columns) * count <= RUNS_CHANNEL_BUDGET:
            return ()
        measured = [each.channel for each in parsed(self._sweep.measured)]
        return tuple(dict.fromkeys([*self._sweep.channels, *measured]))

    def cases(self, numbers: Sequence[int]) -> Iterator[tuple[Deck, Results] | None]:
        """Deck and results of each run, None of one that has no results."""
        for k, number in enumerate(numbers):
            yield self._case(number)
            self._progress.watch(RunsState(time=k + 1.0, end=float(len(numbers)), steps=k + 1))

    def _case(self, number: int) -> tuple[Deck, Results] | None:
        sweep = self._sweep
        if sweep.outcomes[number] in (INVALID, FAULT):
            return None
        given = dict(zip(sweep.names, sweep.values[number].tolist(), strict=True))
        try:
            deck = with_values(self._deck, given)
            results = simulate(deck, commands=self._commands, **self._options)
        except (DeckError, UsageError, RunFailed):
            self.others.append(number)
            return None
        if results.outcome is Outcome.INTERRUPTED:
            raise KeyboardInterrupt
        if not len(results.time):
            return None
        if results.outcome.name != sweep.outcomes[number] or not self._agrees(number, results):
            self.others.append(number)
        drawn = at_start(deck, self._commands)
        need_its_bodies(drawn, results, f"run {number}")
        return drawn, results

    def _agrees(self, number: int, results: Results) -> bool:
        """Whether its measures are those of the file."""
        for name, kept in zip(self._sweep.measured, self._sweep.measures.T, strict=True):
            (measure,) = parsed([name])
            if measure.channel not in results:
                return False
            found = measure.of(results.time, results[measure.channel])
            scale = float(np.nanmax(np.abs(kept), initial=0.0))
            if not (abs(found - kept[number]) <= AGAIN * scale or found == kept[number]):
                return bool(np.isnan(found) and np.isnan(kept[number]))
        return True


def scene_of_runs(
    cases: Iterable[tuple[Deck, Results] | None], page: Page, table: dict[str, Any]
) -> Scene:
    """The scene of all runs.

    Parameters
    ----------
    cases : iterable of (Deck, Results) or None
        Of each run, None where it has nothing to draw.
    page : Page
        How many there are, and which columns are plotted.
    table : dict
        What the page tells of the runs: plain data without numbers that are none.

    Raises
    ------
    UsageError
        When no run can be drawn.
    """
    first: dict[str, Any] | None = None
    scenes: list[dict[str, Any] | None] = []
    for case in cases:
        if case is None:
            scenes.append(None)
            continue
        deck, results = case
        plain = described(Drawing(deck, results, page), results)
        first = first or plain
        scenes.append({key: each for key, each in plain.items() if each != first[key]})
    if first is None:
        raise UsageError("none of the runs has a motion: there is nothing to show")
    return Scene({**first, "runs": page.block.json({**table, "scenes": scenes})}, page.block.text())
