"""`sweep` as users of Python call it, and what reads its files."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterable
from contextlib import closing
from pathlib import Path
from typing import Any

from adamslite.analyses.setup.subject import Subject, deck_of
from adamslite.api.inputs import CommandSource, User, given_options, inputs
from adamslite.kept_scene import tables_of
from adamslite.progress import Progress, progress_of
from adamslite.sweeps import netcdf
from adamslite.sweeps import sweep as sweeps
from adamslite.sweeps.ranges import GRID, Varied
from adamslite.sweeps.record import Sweep
from adamslite.sweeps.saltelli import SobolIndices
from adamslite.sweeps.saltelli import indices as estimated
from adamslite.sweeps.workers import PROCESSES


def sweep(
    scene: Subject | str | os.PathLike[str],
    varied: Varied,
    sample: str = GRID,
    seed: int = 0,
    measures: Iterable[str] = (),
    outputs: Iterable[str] = (),
    path: str | Path | None = None,
    workers: int | None = None,
    by: str = PROCESSES,
    client: Any = None,
    end: float | None = None,
    steps: int | None = None,
    integrator: str | None = None,
    formulation: str | None = None,
    error: float | None = None,
    hmax: float | None = None,
    commands: CommandSource = None,
    user: User = None,
    progress: Progress | Callable[[float, float], Any] | bool | None = None,
    cpu_limit: float | None = None,
    max_steps: int | None = None,
    memory_limit: int | str | None = None,
) -> Sweep:
    """Run a deck many times with other numbers, on all processors.

    On Windows and macOS, and in a process with threads, workers import the calling program: call it
    below ``if __name__ == "__main__":`` there.

    Parameters
    ----------
    scene : str, Path, Deck, Model or Kernels
        As for :func:`adamslite.simulate`.
    varied : mapping or iterable of str
        ``{"SPRINGDAMPER/1.K": [80, 90], "PART/2.MASS": "1:4"}``, or
        ``"SPRINGDAMPER/1.K=80:120:5"``; :func:`adamslite.names` lists the names.
    sample : str
        ``grid``: all combinations; ``sobol:N``, ``lhs:N``: N runs that fill the ranges;
        ``saltelli:N``: N (d + 2) runs for the Sobol indices of d numbers.
    seed : int
        Of those that draw.
    measures : iterable of str
        ``"max REQUEST/1.F2"``: words are max, min, absmax, range, mean, rms, first, final, maxtime,
        mintime.
    outputs : iterable of str
        Patterns of the columns whose histories are kept.
    path : str or Path
        A NetCDF file of all runs; a sweep of the same that was interrupted is gone on with.
    workers : int
        As many as there are processors unless given.
    by : str
        ``processes`` or ``threads``.
    client : distributed.Client or str
        Of a Dask cluster whose workers carry the runs out, or its address.
    end, steps, integrator, formulation, error, hmax, commands, user
        As for :func:`adamslite.simulate`.
    progress : bool, callable or Progress
        A function is called with how many runs are done and how many there are.
    cpu_limit, max_steps : float, int
        Of each run, as for :func:`adamslite.simulate`; with ``by="threads"`` the CPU is that of all
        runs of this process together.

    memory_limit : int or str
        Data of each process of a worker while a run lasts, as for :func:`adamslite.simulate`; not
        with threads or a cluster. Runs that reach it are tried again with the file.

    Returns
    -------
    Sweep
        ``sweep["SPRINGDAMPER/1.K"]``, ``sweep["max REQUEST/1.F2"]`` are arrays with a number for
        each run; runs that failed have an outcome and a message.

    Raises
    ------
    DeckError
        With everything that is wrong in deck and commands.
    UsageError
        When a name, a range or a measure is not what it has to be, or the file holds anything else.
    """
    given = inputs(scene, commands, user)
    deck = deck_of(given.subject)
    options = given_options(
        end=end,
        steps=steps,
        integrator=integrator,
        formulation=formulation,
        error=error,
        hmax=hmax,
        cpu_limit=cpu_limit,
        max_steps=max_steps,
        memory_limit=memory_limit,
    )
    read = [deck.path] if deck.path else []
    read += [deck.folder / name for name in tables_of(deck, given.commands)]
    with closing(progress_of(progress)) as shown:
        return sweeps.sweep(
            deck, sweeps.Wanted(varied, sample, seed, measures, outputs), path, given.commands,
            options, sweeps.Means(workers, by, client), shown, read,
        )  # fmt: skip


def load_sweep(path: str | os.PathLike[str]) -> Sweep:
    """The runs in a file of :func:`adamslite.sweep` or of the command ``sweep``.

    Raises
    ------
    FormatError
        When it holds none.
    """
    return netcdf.read(Path(path))


def indices(
    runs: Sweep | str | os.PathLike[str], measures: str | Iterable[str] = ()
) -> SobolIndices:
    """Sobol indices: how much of the variance of a measure each number is behind, by itself
    (first) and with others (total), as `adamslite indices` prints them.

    Parameters
    ----------
    runs : Sweep, str or Path
        A sweep with ``sample="saltelli:N"``, or its file.
    measures : str or iterable of str
        Names or patterns; all of its measures unless given.

    Raises
    ------
    UsageError
        When the runs are of another sample, are not all there, or have failed.
    """
    return estimated(runs if isinstance(runs, Sweep) else load_sweep(runs), measures)
