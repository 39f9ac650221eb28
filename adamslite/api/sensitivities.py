"""`sensitivities` as users of Python call it."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterable
from contextlib import closing
from typing import Any

from adamslite.analyses.setup.subject import Subject
from adamslite.api.inputs import CommandSource, User, given_options, inputs
from adamslite.progress import Progress, progress_of
from adamslite.sensitivity.adjoint import ALL
from adamslite.sensitivity.adjoint import gradient as swept
from adamslite.sensitivity.record import Sensitivities
from adamslite.sensitivity.study import sensitivities as worked_out


def sensitivities(
    scene: Subject | str | os.PathLike[str],
    by: Iterable[str],
    of: Iterable[str] = (),
    end: float | None = None,
    steps: int | None = None,
    integrator: str | None = None,
    formulation: str | None = None,
    error: float | None = None,
    hmax: float | None = None,
    cpu_limit: float | None = None,
    max_steps: int | None = None,
    memory_limit: int | str | None = None,
    commands: CommandSource = None,
    user: User = None,
    progress: Progress | Callable[[float, float], Any] | bool | None = None,
) -> Sensitivities:
    """Derivatives of a dynamic run by numbers of its deck, along its own steps.

    Parameters
    ----------
    scene : str, Path, Deck, Model or Kernels
        As for :func:`adamslite.simulate`.
    by : iterable of str
        Names of numbers, ``SPRINGDAMPER/1.K``; :func:`adamslite.names` lists them.
    of : iterable of str
        Measures, ``max REQUEST/1.F2`` (words are max, min, absmax, range, mean, rms, first, final)
        or ``PART/2.x@end``, ``PART/2.x@0.5``; columns or patterns of which only histories are
        wanted.  Histories of all columns unless given.
    end, steps, integrator, formulation, error, hmax, commands, user, progress
        As for :func:`adamslite.simulate`.
    cpu_limit, max_steps, memory_limit
        As there, of all that is worked out.  Where the CPU is spent behind the run, derivatives
        that are missing are not a number, and ``stopped`` says so.

    Returns
    -------
    Sensitivities
        ``s["max REQUEST/1.F2", "SPRINGDAMPER/1.K"]`` is a number, ``s.gradient`` all of them (nm,
        np), ``s.curve("PART/2.x", "SPRINGDAMPER/1.K")`` a history (nt,), ``s.curves`` all of them
        (np, nt, nc), by numbers as they are written: degrees are degrees.

    Raises
    ------
    DeckError
        With everything that is wrong in deck and commands.
    UsageError
        When a name, a column or a measure is none, or the run has no derivatives.
    RunFailed
        When it ends early.
    """
    given = inputs(scene, commands, user)
    options = given_options(
        end=end, steps=steps, integrator=integrator, formulation=formulation, error=error,
        hmax=hmax, cpu_limit=cpu_limit, max_steps=max_steps, memory_limit=memory_limit,
    )  # fmt: skip
    with closing(progress_of(progress)) as shown:
        return worked_out(given.subject, by, of, given.commands, shown, **options)


def gradient(
    scene: Subject | str | os.PathLike[str],
    of: Iterable[str],
    by: Iterable[str] | str = ALL,
    end: float | None = None,
    steps: int | None = None,
    integrator: str | None = None,
    formulation: str | None = None,
    error: float | None = None,
    hmax: float | None = None,
    cpu_limit: float | None = None,
    max_steps: int | None = None,
    memory_limit: int | str | None = None,
    commands: CommandSource = None,
    user: User = None,
) -> Sensitivities:
    """Derivatives of measures of a dynamic run by many numbers of its deck, by a sweep from the end
    of the run to its beginning.

    They are those of :func:`adamslite.sensitivities` to round-off, and cost some runs for each
    measure, however many numbers there are.

    Parameters
    ----------
    scene : str, Path, Deck, Model or Kernels
        As for :func:`adamslite.simulate`.
    of : iterable of str
        Measures, ``max REQUEST/1.F2`` or ``PART/2.x@end``, as for
        :func:`adamslite.sensitivities`.
    by : iterable of str
        Names of numbers; ``all``: every number on which equations may hang.
    end, steps, integrator, formulation, error, hmax, commands, user
        As for :func:`adamslite.simulate`.
    cpu_limit, max_steps, memory_limit
        As for :func:`adamslite.sensitivities`.

    Returns
    -------
    Sensitivities
        ``g["max REQUEST/1.F2", "SPRINGDAMPER/1.K"]``, ``g.gradient`` (nm, np) with ``g.values``
        (nm,); there are no curves.

    Raises
    ------
    DeckError
        With everything that is wrong in deck and commands.
    UsageError
        When a name or a measure is none, or the run has no derivatives.
    RunFailed
        When it ends early.
    """
    given = inputs(scene, commands, user)
    options = given_options(
        end=end, steps=steps, integrator=integrator, formulation=formulation, error=error,
        hmax=hmax, cpu_limit=cpu_limit, max_steps=max_steps, memory_limit=memory_limit,
    )  # fmt: skip
    return swept(given.subject, of, by, given.commands, **options)
