"""A sweep from its beginning to its file, which a later one of the same goes on with."""

from __future__ import annotations

import time as clock
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import replace
from hashlib import sha256
from pathlib import Path
from typing import Any, NamedTuple
from uuid import uuid4

import numpy as np

from adamslite import machine
from adamslite.analyses.setup.run_options import checked, within_memory
from adamslite.analyses.setup.subject import kernels_of, prepared_for
from adamslite.caching.program import program
from adamslite.deck.deck import Deck
from adamslite.deck.redefinition import Command
from adamslite.elements.bases.data_file import tables
from adamslite.equations.result_columns import column_names
from adamslite.errors import FormatError, UsageError
from adamslite.kept_scene import tables_of
from adamslite.model.reduction import kept_apart
from adamslite.outputs.whole_files import need_writable
from adamslite.progress import Progress, RunsState
from adamslite.reading.numbers import Named
from adamslite.results.channels import describe, of_argument, unit_symbols
from adamslite.results.outcomes import Outcome
from adamslite.results.selection import selected
from adamslite.sweeps import netcdf
from adamslite.sweeps.job import AHEAD, FAULT, Job, Run
from adamslite.sweeps.measures import of_columns, parsed
from adamslite.sweeps.origin import origin_texts
from adamslite.sweeps.ranges import GRID, Varied, ranges_of, sampled
from adamslite.sweeps.record import Sweep
from adamslite.sweeps.workers import PROCESSES, THREADS, carried_out
from adamslite.variation.decks import variable_of

#: The file is written this often [s], and never more than this share of the time goes into it.
INTERVAL, SHARE = 10.0, 0.05
#: Outcomes of runs that are tried again: what the program failed at may go well now, where memory
#: was short or a worker was ended; a limit of memory is of the machine, not of the run.
AGAIN = (FAULT, Outcome.MEMORY_LIMIT.name)


class Wanted(NamedTuple):
    """What to vary and what to keep, as the user has written it."""

    varied: Varied
    sample: str = GRID
    seed: int = 0
    measures: Iterable[str] = ()
    outputs: Iterable[str] = ()


class Means(NamedTuple):
    """By what the runs are carried out; ``workers`` None: as many as there are processors.

    ``scheduler``: that of a Dask cluster, by its address, its file or a client of it.
    """

    workers: int | None = None
    kind: str = PROCESSES
    scheduler: Any = None


def sweep(
    deck: Deck,
    wanted: Wanted,
    path: str | Path | None = None,
    commands: Sequence[Command] = (),
    options: Mapping[str, Any] | None = None,
    means: Means | None = None,
    progress: Progress | None = None,
    read: Iterable[Path] = (),
) -> Sweep:
    """Carry out all runs, or those that are ahead of a sweep that was interrupted.

    Parameters
    ----------
    path : str or Path
        The file of the runs; in memory alone unless given.
    options : mapping
        As ``simulate`` takes them; ``memory_limit`` is that of each worker.
    read : iterable of Path
        The files that the deck was read from.

    Raises
    ------
    UsageError
        When names, values or measures are not what they have to be, or the file is there and holds
        anything else.
    """
    progress, options = progress or Progress(), checked(options or {})
    means, memory = means or Means(), options.pop("memory_limit", None)
    _need_processes(means, memory)
    with _carrier(means, progress) as lots_of:
        job, made = planned(deck, wanted, commands, options, progress)
        job = replace(job, memory_limit=memory)
        with within_memory(memory):
            pass  # refused here where no run would have room
        if path is not None:
            need_writable(path, read)
            made = _gone_on_with(made, Path(path))
        ahead = made.ahead
        if ahead:
            _enter_all(made, lots_of(job, ahead), len(ahead), path, progress)
    return made


Lots = Iterator[list[Run]]


@contextmanager
def _carrier(means: Means, progress: Progress) -> Iterator[Callable[[Job, Sequence[int]], Lots]]:
    """What carries out runs of a job: workers of this machine, or of a cluster."""
    workers = _workers(means)
    if means.scheduler is None:
        yield lambda job, numbers: carried_out(job, numbers, workers, means.kind)
        return
    from adamslite.sweeps import cluster

    with cluster.connected(means.scheduler) as client:
        if not client.nthreads():
            progress.say("the scheduler has no workers yet: the sweep begins when one is there")
        yield lambda job, numbers: cluster.carried_out_by(client, job, numbers)


def _enter_all(
    made: Sweep, lots: Lots, ahead: int, path: str | Path | None, progress: Progress
) -> None:
    """Keep the runs in lots as they come; an interruption ends them."""
    writing, done = _Writing(made, path), len(made) - ahead
    try:
        for lot in lots:
            for run in lot:
                netcdf.need_room(len(made), len(run.time))
                made.enter(run)
            done += len(lot)
            progress.watch(RunsState(time=float(done), end=float(len(made)), steps=done))
            writing.now_and_then()
    except KeyboardInterrupt:
        pass  # what is ahead shows it
    finally:
        writing.write()


def _need_processes(means: Means, memory_limit: int | None) -> None:
    """Reject a limit of memory where workers are no processes of this machine of their own."""
    if memory_limit is not None and (means.kind == THREADS or means.scheduler is not None):
        raise UsageError(
            "--memory-limit is kept by each process of a worker: threads have one together (leave "
            "out --threads), and workers of a cluster have their own (dask worker --memory-limit)"
        )


def _workers(means: Means) -> int:
    if means.scheduler is not None and (means.workers is not None or means.kind != PROCESSES):
        raise UsageError("--workers and --threads are of this machine: a scheduler has its own")
    if means.kind not in (PROCESSES, THREADS):
        raise UsageError(f"{means.kind}: workers are {PROCESSES} or {THREADS}")
    if means.workers is None:
        return machine.processors()
    if not isinstance(means.workers, int) or means.workers < 1:
        raise UsageError(f"{means.workers} workers: it must be a whole number, at least 1")
    return means.workers


def planned(
    deck: Deck,
    wanted: Wanted,
    commands: Sequence[Command],
    options: Mapping[str, Any],
    progress: Progress,
) -> tuple[Job, Sweep]:
    """What is going to run, and the record that it will fill."""
    ranges, measures = ranges_of(wanted.varied), parsed(wanted.measures)
    outputs = [wanted.outputs] if isinstance(wanted.outputs, str) else [*wanted.outputs]
    if not measures and not outputs:
        raise UsageError(
            "nothing of the runs would be kept: give --measure 'max COLUMN', or --outputs COLUMN"
        )
    numbers = variable_of(deck.base or deck).numbers
    found = [numbers.find(each.name) for each in ranges]
    names = tuple(each.name for each in found)
    twice = next((name for n, name in enumerate(names) if name in names[:n]), None)
    if twice:
        raise UsageError(f"{twice} is varied twice")
    values = sampled(ranges, wanted.sample, wanted.seed)
    columns = _columns(deck, commands, progress)
    kept = of_columns(measures, columns)
    channels = tuple(columns[k] for k in selected(columns, outputs)) if outputs else ()
    job = Job(deck, names, values, commands, options, tuple(kept), channels)
    symbols = unit_symbols(" ".join(deck.single("UNITS").names or ()))
    units = {each.name: _unit_of_number(each, symbols) for each in found}
    units |= {str(each): _unit(each.kind, each.channel, symbols, deck) for each in kept}
    units |= {name: describe(name, symbols, deck).unit for name in channels}
    units["time"] = symbols.get("time", "")
    drawn = wanted.sample if wanted.sample == GRID else f"{wanted.sample} seed {wanted.seed}"
    meta = {"deck": deck.title, "deck hash": deck.hash, "sample": drawn}
    meta |= origin_texts(deck, commands, options)
    made = Sweep(
        names=names, values=values, measured=tuple(map(str, kept)), channels=channels,
        key=_key(job, deck), meta=meta, units=units,
    )  # fmt: skip
    return job, made


def _unit_of_number(number: Named, symbols: dict[str, str]) -> str:
    return "degrees" if number.unit else of_argument(number.argument.unit, symbols)


def _unit(kind: str, channel: str, symbols: dict[str, str], deck: Deck) -> str:
    own = describe(channel, symbols, deck).unit
    return symbols.get("time", "") if kind.endswith("time") else own


def _columns(deck: Deck, commands: Sequence[Command], progress: Progress) -> tuple[str, ...]:
    """The columns that results have."""
    without = kept_apart(commands, False)
    return column_names(kernels_of(prepared_for(deck, commands), progress, without, False))


def _key(job: Job, deck: Deck) -> str:
    """Identifies the results: everything that they follow from.

    Functions of Python may be others under the same name, so such a sweep equals no other.
    """
    digest = sha256()
    written = getattr(job.commands, "source", None)
    facts = [
        program() or uuid4().hex, deck.hash, written.text if written else repr(job.commands),
        repr(sorted(job.options.items())), repr(job.names), repr(list(map(str, job.measures))),
        repr(job.channels), repr(job.values.shape), deck.user.summary(),
        uuid4().hex if deck.user.made else "",
    ]  # fmt: skip
    for each in facts:
        digest.update(sha256(each.encode(errors="surrogateescape")).digest())
    for table in tables(deck.folder, tables_of(deck, job.commands)).values():
        digest.update(sha256(table.read_bytes()).digest())
    digest.update(np.ascontiguousarray(job.values).tobytes())
    return digest.hexdigest()


def _gone_on_with(made: Sweep, path: Path) -> Sweep:
    """The record in the file where that is of this sweep; the new one where there is no file."""
    if not path.exists():
        return made
    try:
        there = netcdf.read(path)
    except FormatError as fault:
        raise UsageError(f"{fault}; remove the file, or give -o another name") from None
    if there.key != made.key:
        raise UsageError(
            f"'{path}' holds another sweep: the deck, the values, what is kept or the program have "
            f"changed since; remove it, or give -o another name"
        )
    there.outcomes = [AHEAD if each in AGAIN else each for each in there.outcomes]
    return there


class _Writing:
    """Writes the record to its file, now and then."""

    def __init__(self, made: Sweep, path: str | Path | None) -> None:
        self._made, self._path = made, path
        self._next = clock.monotonic() + INTERVAL

    def now_and_then(self) -> None:
        began = clock.monotonic()
        if began >= self._next:
            self.write()
            now = clock.monotonic()
            self._next = now + max(INTERVAL, (now - began) / SHARE)

    def write(self) -> None:
        if self._path is not None:
            netcdf.write(self._made, self._path)
