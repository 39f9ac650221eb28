"""`sensitivities` as users of Python call it."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterable
from contextlib import closing
from typing import Any

from adamslite.analyses.subject import Subject
from adamslite.api.inputs import CommandSource, User, inputs
from adamslite.progress import Progress, progress_of
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
    flags = {
        "end": end, "steps": steps, "integrator": integrator, "formulation": formulation,
        "error": error, "hmax": hmax,
    }  # fmt: skip
    options = {name: each for name, each in flags.items() if each is not None}
    with closing(progress_of(progress)) as shown:
        return worked_out(given.subject, by, of, given.commands, shown, **options)
