"""Gradients: the derivatives of a measure of a run by any number of its deck, by one sweep back.

A run keeps its tape, the measure is differentiated by what was written, and a sweep from the end of
the tape to its beginning (:mod:`adamslite.sensitivity.adjoint_sweep`) gives the derivatives by all
numbers of the equations at once: its effort does not grow with how many are asked for.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from functools import partial
from typing import TYPE_CHECKING, Any

import numpy as np

from adamslite.analyses.setup.run_options import within_memory
from adamslite.equations.result_columns import columns
from adamslite.errors import UsageError
from adamslite.native.worker import Overspent, interruptible
from adamslite.results.outcomes import Outcome
from adamslite.sensitivity.adjoint_columns import Columns, Seed
from adamslite.sensitivity.adjoint_stages import StageSweep
from adamslite.sensitivity.adjoint_sweep import Sweep
from adamslite.sensitivity.measures import asked, weights_of
from adamslite.sensitivity.recipes import Known
from adamslite.sensitivity.record import Sensitivities
from adamslite.sensitivity.study import Study, noted
from adamslite.sensitivity.taped import Along, followed, recorded

if TYPE_CHECKING:
    from adamslite.analyses.setup.run_options import Budget
    from adamslite.analyses.setup.subject import Subject
    from adamslite.deck.redefinition import Command
    from adamslite.equations.system import System
    from adamslite.sensitivity.directions import Direction

ALL, RUN = "all", "accuracy"
ONLY = "gradients go back along the steps of {known}; {method} is followed forwards alone"
#: What goes back along the steps of a method.
SWEEPS: dict[str, type[Sweep]] = {"GSTIFF": Sweep, "RADAU": StageSweep}
MEASURE = "a gradient is that of a measure, as 'max REQUEST/1.F2' or 'PART/2.x@end'"
NUMBERS = "a gradient by what? `adamslite names DECK` lists numbers"


def gradient(
    scene: Subject,
    of: Iterable[str],
    by: Iterable[str] | str = ALL,
    commands: Iterable[Command] = (),
    **options: Any,
) -> Sensitivities:
    """Derivatives of measures of a deck, a model or kernels; see :func:`adamslite.gradient`."""
    study = Study(scene, commands, options)
    with within_memory(study.memory):
        return _swept(study, of, by)


def _swept(study: Study, of: Iterable[str], by: Iterable[str] | str) -> Sensitivities:
    named = Known(study.kernels).all() if by == ALL else study.named(by)
    if not named:
        raise UsageError(NUMBERS)
    directions = study.directions(named)
    made: dict[str, Any] = {}

    def follow(system: System, method: str, as_drawn: bool) -> None:
        if method not in SWEEPS:
            raise UsageError(ONLY.format(known=" and ".join(SWEEPS), method=method))
        by_number = partial(directions, system, as_drawn)
        made.update(_gradients(by_number, system, SWEEPS[method], of, len(named), study.budget))
        along, error = None, np.nan
        if not made["stopped"]:
            effects = np.abs(made["gradient"] * [each.value for each in named]).max(axis=0)
            most = by_number(int(np.nanargmax(effects)))
            along = made["along"] = _estimated(system, method, most, study.budget)
            error = along.errors[0] if along else np.nan
        made["errors"], made["notes"] = np.full(len(named), error), noted(along, {RUN: error})
        made["curves"] = np.zeros((len(named), 0, 0))

    session = study.run(follow)
    return study.compared(study.gathered(named, session, made), named, session, made)


def _estimated(system: System, method: str, most: Direction, budget: Budget) -> Along | None:
    """The number with the largest effect followed forwards, for its estimate of errors; None where
    the CPU is spent or rows of constraints are redundant, along which that is not done in space.
    """
    try:
        return None if system.elimination.dead.size else followed(system, method, [most], budget)
    except Overspent:
        return None


def _gradients(
    by_number: Callable[[int], Direction],
    system: System,
    sweep: type[Sweep],
    of: Iterable[str],
    count: int,
    budget: Budget,
) -> dict[str, Any]:
    """The measures of a run that has just been made, and their derivatives by ``count`` numbers."""
    time, record = system.times.copy(), recorded(system).copy()
    names, values = columns(system, record)
    measures, kept = asked(of, names)
    if not measures:
        raise UsageError(MEASURE)
    places, found, several = Columns(system), [], 0
    for each in measures:
        at = names.index(each.channel)
        weights = weights_of(each, time, values[:, at])
        seeds = {int(row): Seed(record[row]) for row in np.flatnonzero(weights)}
        for row, seed in seeds.items():
            places.weigh(seed, each.channel, float(weights[row]))
        try:
            back = sweep(system)
            found.append(interruptible(partial(back.back, seeds), over=budget.over))
            several = max(several, back.several)
        except Overspent:
            break
    gradient = np.full((len(measures), count), np.nan)
    for j in range(count if found else 0):
        direction = by_number(j)
        gradient[: len(found), j] = [one.along(direction) for one in found]
    return {
        "time": time, "names": tuple(names[k] for k in kept), "values": values[:, kept],
        "measures": measures, "gradient": gradient, "several": several,
        "events": system.count.events,
        "stopped": Outcome.CPU_LIMIT.sentence if len(found) < len(measures) else "",
    }  # fmt: skip
