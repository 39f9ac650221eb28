"""`fit` as users of Python call it."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterable
from contextlib import closing
from typing import Any

from adamslite.analyses.setup.subject import Subject, deck_of
from adamslite.api.inputs import CommandSource, User, given_options, inputs
from adamslite.api.tools import reference_of
from adamslite.fitting import fit as fits
from adamslite.fitting.parameters import Bounds
from adamslite.fitting.record import Fit
from adamslite.progress import Progress, progress_of
from adamslite.results.results import Results
from adamslite.verification.reference_file import Reference


def fit(
    scene: Subject | str | os.PathLike[str],
    measured: Results | Reference | str | os.PathLike[str],
    by: Iterable[str],
    bounds: Bounds = (),
    of: Iterable[str] = (),
    start: float | None = None,
    until: float | None = None,
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
) -> Fit:
    """Fit numbers of a deck to a measurement by weighted least squares.

    Parameters
    ----------
    scene : str, Path, Deck, Model or Kernels
        As for :func:`adamslite.simulate`; its numbers are the start.
    measured : str, Path or Results
        A file of results: columns with names of the deck's results, ``time`` first.  Lines
        ``# tolerance NAME: abs A rel R`` are its bands, ``NAME [kN]`` in the header are units.
    by : iterable of str
        The numbers to fit; :func:`adamslite.names` lists them.
    bounds : mapping or iterable of str
        ``{"SPRINGDAMPER/1.K": (50, 500)}``, None for an end that is open, or
        ``"SPRINGDAMPER/1.K=50:500"``.  A number that starts above zero stays there, unless its
        lower bound is below zero.
    of : iterable of str
        Patterns of the columns of the file that are fitted; all unless given.
    start, until : float
        The part of the measurement that is fitted [time].
    end, steps, integrator, formulation, error, hmax, commands, user
        As for :func:`adamslite.simulate`.
    cpu_limit, max_steps, memory_limit
        As there, of all runs together.  Where one is reached, or the user interrupts, the fit has
        the best numbers by then, without standard errors, and ``stopped`` says so.
    progress : bool, callable or Progress
        Is shown how many runs are done.

    Returns
    -------
    Fit
        ``fit["SPRINGDAMPER/1.K"]``, ``fit.errors``, ``fit.correlation``; ``fit.save(path)`` writes
        the deck with the fitted numbers, ``fit.plot(path)`` draws.

    Raises
    ------
    DeckError
        With everything that is wrong in deck and commands.
    UsageError, FormatError
        When a name, a bound or the measurement is not what it has to be.
    RunFailed
        When the deck does not run with the numbers that it starts with.
    """
    given = inputs(scene, commands, user)
    options = given_options(
        end=end, steps=steps, integrator=integrator, formulation=formulation, error=error,
        hmax=hmax, cpu_limit=cpu_limit, max_steps=max_steps, memory_limit=memory_limit,
    )  # fmt: skip
    wanted = fits.Wanted(by, bounds, of, (start, until))
    with closing(progress_of(progress)) as shown:
        return fits.fit(
            deck_of(given.subject), reference_of(measured), wanted, given.commands, options, shown
        )
