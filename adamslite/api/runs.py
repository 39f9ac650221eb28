"""`simulate` and `linearize` as users of Python call them: for paths, texts and decks."""

from __future__ import annotations

import os
import warnings
from collections.abc import Callable, Iterable
from contextlib import closing
from pathlib import Path
from typing import TYPE_CHECKING, Any

from adamslite.analyses import simulation
from adamslite.analyses.setup.subject import Subject
from adamslite.api.inputs import CommandSource, User, inputs
from adamslite.errors import RunFailed, RunWarning
from adamslite.language.interfaces import Key
from adamslite.outputs.saved_files import SavedFiles
from adamslite.progress import Progress, progress_of
from adamslite.results.results import Results

if TYPE_CHECKING:
    from adamslite.analyses.dynamics.history import Journal
    from adamslite.results.linearization import Linearization


def simulate(
    scene: Subject | str | os.PathLike[str],
    end: float | None = None,
    steps: int | None = None,
    integrator: str | None = None,
    formulation: str | None = None,
    error: float | None = None,
    hmax: float | None = None,
    commands: CommandSource = None,
    user: User = None,
    progress: Progress | Callable[[float, float], Any] | bool | None = None,
    no_reduction: Iterable[str] = (),
    audit: bool = False,
    confirm: bool = False,
    files: SavedFiles | str | os.PathLike[str] | None = None,
    outputs: Iterable[str] = (),
    cpu_limit: float | None = None,
    max_steps: int | None = None,
    memory_limit: int | str | None = None,
    file: str | os.PathLike[str] | None = None,
    journal: Journal | None = None,
    strict: bool | None = False,
) -> Results:
    """Run a deck, as `adamslite solve` does.

    Parameters
    ----------
    scene : str, Path, Deck, Model or Kernels
        A file, the text of a deck (more than one line), or what another stage returned.
    end, steps : float, int
        End time and number of output steps; instead of SIMULATE.
    integrator, formulation, error, hmax
        Win over INTEGRATOR in ``commands``, which wins over the deck.
    commands : str, Path, or iterable of str or of statements
        A command file, its text, or its lines.  By default the ``.acf`` of the name of the deck
        beside it, where there is one; ``()`` runs the deck without it.
    user : mapping or iterable of str
        What ``FUNCTION=USER(...)`` means, of a path or text: see :func:`adamslite.read`.
    progress : bool, callable or Progress
        True shows how far the run is, False does not; by default it is shown in notebooks.  A
        function is called as ``progress(time, end)`` about ten times a second.
    no_reduction : iterable of str
        Rules of :mod:`adamslite.model.reduction` not to apply; ``points`` and ``variables`` of a
        model are settled when it is assembled.
    audit : bool
        Follow the balance of energy; elastic elements of ready kernels are not followed.
    confirm : bool
        Run again, more tightly and by another method, and say how far the results agree.
    files : str, Path or SavedFiles
        The folder of the files of SAVE and RELOAD; in memory unless given.
    outputs : iterable of str
        Patterns of the columns to keep, ``REQUEST/*``, ``PART/2``; all unless given.
    cpu_limit : float
        CPU of this process [s] after which the run ends as CPU_LIMIT, with what it has by then.
    max_steps : int
        Accepted steps after which it ends as STEP_LIMIT. Without, a run that creeps ends as
        CREEPING: see :class:`adamslite.results.outcomes.Outcome`.
    journal : adamslite.analyses.dynamics.history.Journal
        Where a run is kept that takes long, as the command line has it; not kept unless given.

    memory_limit : int or str
        Data of this process, all its threads, in byte or as "2GB", beyond which allocations fail
        while the run lasts, and it ends as MEMORY_LIMIT. Only Linux keeps it; elsewhere what the
        run is estimated to need is held against it.

    file : str or Path
        Where the results will be saved: a run is refused whose results the disk has no room for.
    strict : bool or None
        True raises RunFailed for a run that does not reach its end, False warns of it, None does
        neither.  The end by a SENSOR with HALT is one that the deck requests.

    Warns
    -----
    RunWarning
        When the run did not reach its end; ``results.success`` is False then, and
        ``results.message`` gives the reason.
    DeckWarning
        For every warning about a deck or command file that is read here.

    Raises
    ------
    DeckError
        With everything that is wrong in deck and commands.
    RunFailed
        With ``strict``, when the run did not reach its end; its ``results`` are those so far.  When
        there is no memory for as much as the start of the run.
    UsageError
        When nothing says how long to run, or an argument is not what it has to be.
    """
    given = inputs(scene, commands, user)
    kept = SavedFiles(Path(files)) if isinstance(files, str | os.PathLike) else files
    with closing(progress_of(progress)) as shown:
        results = simulation.simulate(
            given.subject, end, steps, integrator, formulation, error, hmax, given.commands,
            shown, no_reduction, audit, confirm, kept, outputs,
            cpu_limit=cpu_limit, max_steps=max_steps, memory_limit=memory_limit,
            output=Path(file) if file else None, journal=journal,
        )  # fmt: skip
    if strict is not None and not results.success:
        how = f"{results.outcome.name}: {results.message}"
        if strict:
            raise RunFailed(how, results)
        warnings.warn(how, RunWarning, stacklevel=2)
    return results


def linearize(
    scene: Subject | str | os.PathLike[str],
    commands: CommandSource = None,
    time: float | None = None,
    rm: Key | None = None,
    user: User = None,
    cpu_limit: float | None = None,
    max_steps: int | None = None,
    memory_limit: int | str | None = None,
) -> Linearization:
    """The model about one state, as `adamslite linear` finds it.

    Without commands it is the equilibrium that the deck's own SIMULATE statements begin with, else
    the assembled start.  A LINEAR command decides state and observer; otherwise it is the last
    state.

    Parameters
    ----------
    scene, commands, user, cpu_limit, max_steps, memory_limit
        As for :func:`simulate`.
    time : float
        The motion is followed up to this time; without commands from the assembled start, which
        0 is.
    rm : int or str
        A MARKER on whose body the observer stands.

    Raises
    ------
    DeckError
        With everything that is wrong in deck and commands.
    UsageError
        When there is no such MARKER.
    RunFailed
        When the state could not be reached, or a limit was.
    """
    given = inputs(scene, commands, user)
    return simulation.linearize(
        given.subject, given.commands, time, rm,
        cpu_limit=cpu_limit, max_steps=max_steps, memory_limit=memory_limit,
    )  # fmt: skip
