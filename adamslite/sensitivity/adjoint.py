"""Gradients: the derivatives of a measure of a run by any number of its deck, by one sweep back.

A run keeps its tape, the measure is differentiated by what was written, and a sweep from the end of
the tape to its beginning (:mod:`adamslite.sensitivity.adjoint_sweep`) gives the derivatives by all
numbers of the equations at once: its effort does not grow with how many are asked for.
"""

from __future__ import annotations

from collections.abc import Iterable
from functools import partial
from typing import TYPE_CHECKING, Any

import numpy as np

from adamslite.analyses.setup.run_options import within_memory
from adamslite.analyses.simulation import explained
from adamslite.equations.result_columns import columns
from adamslite.errors import RunFailed, UsageError
from adamslite.native.worker import Overspent, interruptible
from adamslite.results.outcomes import Outcome
from adamslite.results.results import Results
from adamslite.sensitivity.adjoint_columns import Columns, Seed
from adamslite.sensitivity.adjoint_numbers import Chain
from adamslite.sensitivity.adjoint_stages import StageSweep
from adamslite.sensitivity.adjoint_sweep import Sweep
from adamslite.sensitivity.measures import asked, weights_of
from adamslite.sensitivity.record import Sensitivities
from adamslite.sensitivity.study import SENSED, Study, noted, recorded
from adamslite.sensitivity.taped import Along, Taped, followed

if TYPE_CHECKING:
    from adamslite.analyses.setup.run_options import Budget
    from adamslite.analyses.setup.subject import Subject
    from adamslite.deck.redefinition import Command
    from adamslite.equations.system import System
    from adamslite.reading.numbers import Named

ALL, RUN = "all", "accuracy"
ONLY = "gradients go back along the steps of {known}; {method} is followed forwards alone"
#: What goes back along the steps of a method.
SWEEPS: dict[str, type[Sweep]] = {"GSTIFF": Sweep, "RADAU": StageSweep}
MEASURE = "a gradient is that of a measure, as 'max REQUEST/1.F2' or 'PART/2.x@end'"
NUMBERS = "a gradient by what? `adamslite names DECK` lists numbers"
NO_RUN = "derivatives are those of a dynamic analysis, and there is none"


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
    chain = Chain(study)
    named = chain.all() if by == ALL else study.named(by)
    if not named:
        raise UsageError(NUMBERS)
    chain, named = _ready(study, chain, named)
    session = study.session(Taped, study.kernels)
    made: dict[str, Any] = {}

    def follow(system: System, method: str) -> np.ndarray:
        if system.triggered:
            raise UsageError(SENSED)
        if method not in SWEEPS:
            raise UsageError(ONLY.format(known=" and ".join(SWEEPS), method=method))
        begun = (not (session.assembled or session.speeds), bool(session.history.stretches))
        made.update(_gradients(chain, system, SWEEPS[method], of, named, begun, study.budget))
        if not made["stopped"]:
            made["along"] = _estimated(study, system, method, made["gradient"], named, begun[0])
        return np.zeros(0)

    session.follow = follow
    session.execute(study.plan)
    if session.outcome is not Outcome.DONE:
        raise RunFailed(explained(session))
    if not made:
        raise UsageError(NO_RUN)
    results = Results(
        time=made["time"], names=made["names"], values=made["columns"],
        meta={"deck": study.deck.title}, outcome=session.outcome, message="", summary={},
    )  # fmt: skip
    along: Along | None = made.get("along")
    errors = along.errors if along else np.array([np.nan])
    found = Sensitivities(
        tuple(n.name for n in named), np.array([n.value for n in named]), results,
        np.zeros((len(named), 0, 0)), made["measures"], made["values"], made["gradient"],
        session.notes | noted(along, {RUN: errors[0]}), np.repeat(errors, len(named)),
        made["stopped"],
    )  # fmt: skip
    several, coupled = made["several"], along.coupled if along else 0
    return study.compared(found, named, session, several, coupled)


def _estimated(
    study: Study,
    system: System,
    method: str,
    gradient: np.ndarray,
    named: list[Named],
    as_drawn: bool,
) -> Along | None:
    """The number with the largest effect followed forwards, for its estimate of errors; None where
    the CPU is spent or rows of constraints are redundant, along which that is not done in space.
    """
    if system.elimination.dead.size:
        return None
    effects = np.abs(gradient * [each.value for each in named]).max(axis=0)
    most = [named[int(np.nanargmax(effects))]]
    try:
        return followed(system, method, study.directions(most)(system, as_drawn), study.budget)
    except Overspent:
        return None


def _ready(study: Study, chain: Chain, named: list[Named]) -> tuple[Chain, list[Named]]:
    """The chain of numbers, verified; zeros that would change the form are put a hair beside."""
    chain.verify(named)
    slow = [each for each in named if not chain.is_direct(each) and each.value == 0.0]
    if not slow:
        return chain, named
    study.put_beside(slow)
    chain = Chain(study)
    chain.verify(named)
    return chain, study.named(each.name for each in named)


def _gradients(
    chain: Chain,
    system: System,
    sweep: type[Sweep],
    of: Iterable[str],
    named: list[Named],
    begun: tuple[bool, bool],
    budget: Budget,
) -> dict[str, Any]:
    """The measures of a run that has just been made, and their derivatives; ``begun``: whether it
    starts as it is drawn, and whether another analysis came before.
    """
    time, record = system.times.copy(), recorded(system).copy()
    names, values = columns(system, record)
    measures, kept = asked(of, names)
    if not measures:
        raise UsageError(MEASURE)
    places, found, numbers, several = Columns(system), [], [], 0
    for each in measures:
        at = names.index(each.channel)
        weights = weights_of(each, time, values[:, at])
        numbers.append(each.of(time, values[:, at]))
        seeds = {int(row): Seed(record[row]) for row in np.flatnonzero(weights)}
        for row, seed in seeds.items():
            places.weigh(seed, each.channel, float(weights[row]))
        try:
            back = sweep(system)
            found.append(interruptible(partial(back.back, seeds), over=budget.over))
            several = max(several, back.several)
        except Overspent:
            break
    gradient = np.full((len(measures), len(named)), np.nan)
    for k, one in enumerate(found):
        gradient[k] = chain.along(system, *begun, one, named)
    numbers += [each.of(time, values[:, names.index(each.channel)]) for each in
                measures[len(numbers):]]  # fmt: skip
    return {
        "time": time, "names": tuple(names[k] for k in kept),
        "columns": np.ascontiguousarray(values[:, kept]),
        "measures": tuple(map(str, measures)), "values": np.array(numbers),
        "gradient": gradient, "several": several,
        "stopped": Outcome.CPU_LIMIT.sentence if len(found) < len(measures) else "",
    }  # fmt: skip
