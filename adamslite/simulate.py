"""A deck in, results out."""

from __future__ import annotations

import time as clock
from collections.abc import Iterable, Mapping
from dataclasses import replace
from typing import Any

import numpy as np

from adamslite.analyses.dynamic import Settings, counters, run_dynamic
from adamslite.analyses.initial import initial_conditions
from adamslite.analyses.redundancy import leave_out_redundant, row_name
from adamslite.columns import columns
from adamslite.compiled import Kernels, compile_model
from adamslite.explain import explain
from adamslite.faults import UsageError
from adamslite.integrators import base
from adamslite.model import Model, assemble
from adamslite.outcomes import Outcome
from adamslite.results import Results
from adamslite.system import System, engine

TOLERANCE_OF_TIME = 1e-9


def simulate(
    scene: Any,
    end: float | None = None,
    steps: int | None = None,
    integrator: str | None = None,
    formulation: str | None = None,
    error: float | None = None,
    hmax: float | None = None,
    commands: Iterable[Any] = (),
    progress: Any = None,
) -> Results:
    """Run a deck, a model or its kernels.

    Parameters
    ----------
    scene : Deck, Model or Kernels
        What to simulate.
    end, steps : float, int
        End time and number of output steps; instead of SIMULATE.
    integrator, formulation, error, hmax
        Win over INTEGRATOR in ``commands``, which wins over the deck.
    commands : iterable of Statement
        Statements of a command file.
    progress : callable
        ``progress(time, end)`` from time to time; ``progress.say(sentence)`` before a long wait.

    Raises
    ------
    UsageError
        When nothing says how long to run.
    """
    began = clock.process_time()
    deck = _deck(scene)
    statements = (*deck.statements, *commands)
    settings = _settings(statements, method=integrator, formulation=formulation, error=error, hmax=hmax)
    times = _times(statements, end, steps)
    kernels = _compiled(scene, progress)
    engine(progress)
    system = System(kernels, settings.formulation == "SI2")
    ready = clock.process_time()
    unclosed = initial_conditions(system)
    if unclosed:
        outcome = Outcome.INITIAL_CONDITIONS_FAILED
    else:
        leave_out_redundant(system)
        outcome = run_dynamic(system, times, settings, progress)
    done = clock.process_time()
    return _results(system, outcome, unclosed, settings, (ready - began, done - ready))


def _deck(scene: Any) -> Any:
    if isinstance(scene, Kernels):
        return scene.model.deck
    return scene.deck if isinstance(scene, Model) else scene


def _compiled(scene: Any, progress: Any) -> Kernels:
    if isinstance(scene, Kernels):
        return scene
    model = scene if isinstance(scene, Model) else assemble(scene)
    return compile_model(model, progress)


def _settings(statements: Iterable[Any], **flags: Any) -> Settings:
    """Settings of the last INTEGRATOR that gives each, flags first."""
    settings = Settings()
    given: dict[str, Any] = {}
    for statement in statements:
        if statement.keyword == "INTEGRATOR":
            for name in Settings.__dataclass_fields__:
                value = getattr(statement, name)
                if value is not None:
                    given[name] = value
    given |= {name: value for name, value in flags.items() if value is not None}
    return replace(settings, **given)


def _times(statements: tuple[Any, ...], end: float | None, steps: int | None) -> np.ndarray:
    """Output times from 0: flags, else the SIMULATE statements of the command file, else the deck's."""
    asked = [s for s in statements if s.keyword == "SIMULATE"]
    if not asked and end is None:
        raise UsageError(Outcome.NO_END_TIME.value)
    last = asked[-1] if asked else None
    stop = end if end is not None else (last.end if last.end is not None else last.duration)
    if steps is None and last is not None and end is None:
        steps = last.steps
    if stop < 0.0 or (steps is not None and steps < 1):
        raise UsageError("The end time must not be negative and there must be at least one step.")
    dtout = last.dtout if last is not None else None
    if steps is None:
        steps = max(1, round(stop / dtout)) if dtout else 100
        if dtout and abs(steps * dtout - stop) > TOLERANCE_OF_TIME * stop:
            return np.append(np.arange(0.0, stop, dtout), stop)
    return np.linspace(0.0, stop, steps + 1)


def _results(
    system: System,
    outcome: Outcome,
    unclosed: Any,
    settings: Settings,
    cpu: tuple[float, float],
) -> Results:
    made = int(system.count[base.RECORDS])
    row = system.nw + int(system.sizes[base.N_OUT])
    record = system.record[: made * row].reshape(made, row)
    names, values = columns(system, record)
    time = system.times[:made].copy()
    reached = float(system.report[base.AT]) if outcome is not Outcome.DONE else float(time[-1])
    summary = {
        "outcome": outcome.name, "t_end": reached, "dof": system.dof, **counters(system),
        "setup_cpu_s": cpu[0], "solve_cpu_s": cpu[1],
        "max_violation": float(system.report[base.VIOLATION]),
    }  # fmt: skip
    message = "" if outcome is Outcome.DONE else explain(system, outcome, unclosed)
    return Results(
        time=time, names=names, values=values, meta=_meta(system, settings), outcome=outcome,
        message=message, summary=summary,
    )  # fmt: skip


def _meta(system: System, settings: Settings) -> Mapping[str, str]:
    deck = system.model.deck
    units = deck.single("UNITS").names
    return {
        "deck": deck.title,
        "deck hash": deck.hash,
        "units": " ".join(units) if units else "as in the deck",
        "integrator": f"{settings.method} {settings.formulation} ERROR={settings.error:g}",
        **_redundant(system),
    }


def _redundant(system: System) -> dict[str, str]:
    if not system.dropped:
        return {}
    names = "; ".join(row_name(system, row) for row in system.dropped)
    return {"redundant, left out, reaction zero": names}
