"""Runs on the workers of a Dask cluster, wherever these are.

The job goes to the scheduler once, as a task of its own: a worker that joins, or replaces a lost
one, gets it from there.  Runs go in lots of about ``LOT`` seconds, two for each thread of a worker
at a time, and their results come back as they are ready.  What a lost worker was doing is carried
out by another one.  Dask tries that some times, after which a lot is taken apart, so that a run
that brings its workers down fails alone.
"""

from __future__ import annotations

import os
import threading
import time as clock
from collections.abc import Iterable, Iterator, Sequence
from concurrent.futures import CancelledError
from contextlib import contextmanager, suppress
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from adamslite.caching.program import fingerprint
from adamslite.elements.bases.data_file import tables
from adamslite.errors import RunFailed, UsageError
from adamslite.kept_scene import tables_of
from adamslite.language.file_name import OPENED, inside
from adamslite.sweeps.job import FAULT, Job, Run

if TYPE_CHECKING:
    from distributed import Client, Future

#: A lot takes about so long [s], or longer, so that no more lots end in a second, each of which
#: costs the scheduler some milliseconds; it has so many runs at most.
LOT, ENDING, LARGEST = 0.5, 50.0, 5000
#: A run is thought to take so long before one has ended [s].
UNKNOWN = 0.5
#: Of a lot whose scheduler has gone.
ENDED = ("cancelled", "lost")
#: A scheduler answers within this time [s]; workers are counted this often [s].
PATIENCE, COUNTED = 10.0, 2.0
NEEDED = (
    "sweeps on a cluster need distributed, which is not installed: pip install 'dask[distributed]'"
)


class Parcel(NamedTuple):
    """What goes to the workers: a job without its values, the files that its deck names, and the
    program that it was made by.
    """

    job: Job
    files: dict[str, bytes]
    program: str


class Lot(NamedTuple):
    """Runs that go to a worker together; a suspect one has gone out before, and is alone now."""

    numbers: list[int]
    suspect: bool


class OtherWorker(RuntimeError):
    """A worker has not what the sweep began with: the program, or a file."""


# ---- where the sweep is ---------------------------------------------------------------------


@contextmanager
def connected(scheduler: Any) -> Iterator[Client]:
    """A client of a scheduler: given as such, or by its address or the name of its file (.json).

    Raises
    ------
    UsageError
        When Dask is not there, or no scheduler answers.
    """
    try:
        from distributed import Client
    except ImportError:
        raise UsageError(NEEDED) from None
    if isinstance(scheduler, Client):
        if scheduler.asynchronous:
            raise UsageError("an asynchronous Client cannot carry out a sweep: make another one")
        yield scheduler
        return
    client = _client(str(scheduler))
    try:
        yield client
    finally:
        with suppress(Exception):  # of a scheduler that has gone
            client.close(timeout=PATIENCE)


def _client(address: str) -> Client:
    import logging

    from distributed import Client

    logging.getLogger("distributed").setLevel(logging.CRITICAL)  # one sentence reports failures
    at = {"scheduler_file": address} if address.endswith(".json") else {"address": address}
    try:
        if "scheduler_file" in at and not Path(address).is_file():
            raise OSError("there is no such file")
        return Client(**at, timeout=PATIENCE, set_as_default=False)
    except (OSError, ValueError, TypeError) as fault:
        reason = str(fault).strip().splitlines()[0] if str(fault).strip() else "no answer"
        raise UsageError(
            f"--scheduler {address}: no scheduler is reached there: {reason}"
        ) from None


def carried_out_by(client: Client, job: Job, numbers: Sequence[int]) -> Iterator[list[Run]]:
    """Carry out runs by the workers of a cluster, in lots as they become ready, in any order.

    Raises
    ------
    RunFailed
        When the scheduler goes, or a worker has another program or none.
    """
    lots = _Lots(client, job, numbers)
    try:
        while lots.waiting or lots.left or lots.alone:
            lots.hand_out()
            for future in lots.ready():
                yield lots.taken(future)
    finally:
        lots.call_off()


class _Lots:
    """The lots of a sweep that are ahead, and those that workers have."""

    def __init__(self, client: Client, job: Job, numbers: Sequence[int]) -> None:
        from distributed import as_completed

        self.client, self.job = client, job
        self.left = [int(number) for number in reversed(numbers)]
        self.alone: list[int] = []  # of lots that were lost with their workers, or beside those
        self.each, self._threads, self._counted = UNKNOWN, 1, -COUNTED
        self.waiting: dict[Future, Lot] = {}
        self._ended = as_completed([], loop=client.loop)
        self.parcel = self._sent()

    def _sent(self) -> Future:
        from distributed.protocol import pickle

        if not fingerprint():
            raise UsageError(
                "files of adamslite were changed since this process began: begin again"
            )
        own = replace(self.job, values=self.job.values[:0])
        files = tables(own.deck.folder, tables_of(own.deck, own.commands))
        _require_absolute(Path(os.path.abspath(own.deck.folder)), files)
        contents = {name: path.read_bytes() for name, path in files.items()}
        try:
            packed = pickle.dumps(Parcel(own, contents, fingerprint()))
        except Exception as fault:
            raise UsageError(f"the deck cannot be sent to workers: {fault}") from None
        return self.client.submit(_unpacked, packed, pure=False)

    @property
    def threads(self) -> int:
        """Of all workers as they are now, at least one."""
        now = clock.monotonic()
        if now - self._counted >= COUNTED:
            with suppress(OSError, AttributeError):  # of a scheduler that is about to be missed
                self._threads = max(1, sum(self.client.nthreads().values()))
            self._counted = now
        return self._threads

    def hand_out(self) -> None:
        """So many lots that no thread waits for its next one; a suspect when all have ended."""
        while self.left and len(self.waiting) < 2 * self.threads:
            fair = -(-len(self.left) // (2 * self.threads))
            lasting = max(LOT, self.threads / ENDING)
            count = max(1, min(int(lasting / self.each), fair, LARGEST))
            self._submit([self.left.pop() for _ in range(count)])
        if self.alone and not self.waiting:
            self._submit([self.alone.pop()], suspect=True)

    def _submit(self, numbers: list[int], *, suspect: bool = False) -> None:
        given = np.array(numbers), self.job.values[numbers]
        future = self.client.submit(_lot, self.parcel, *given, pure=False)
        self.waiting[future] = Lot(numbers, suspect)
        self._ended.add(future)

    def ready(self) -> list[Future]:
        """Lots that have ended in some way; waits for one."""
        return list(self._ended.next_batch())

    def taken(self, future: Future) -> list[Run]:
        """The runs of a lot that has ended; those of one that goes again are not among them."""
        from distributed import KilledWorker

        lot = self.waiting.pop(future)
        try:
            spent, runs = future.result()
        except KilledWorker as fault:
            if lot.suspect:
                ended = f"its worker ended by itself: {fault}"
                return [self.job.without(lot.numbers[0], FAULT, ended)]
            self.alone += reversed(lot.numbers)
            return []
        except Exception as fault:
            raise RunFailed(self._why(future, fault)) from None
        finally:
            future.release()
        self.each = max(0.5 * (self.each + spent / len(runs)), 1e-6)
        return list(runs)

    def _why(self, future: Future, fault: Exception) -> str:
        missed = isinstance(fault, CancelledError) or future.status in ENDED
        if missed or self.client.status != "running":
            return "the scheduler has gone; the same command goes on with the rest"
        first = str(fault).strip().splitlines()
        return f"a worker cannot carry out runs: {first[0] if first else type(fault).__name__}"

    def call_off(self) -> None:
        """Nobody waits for what is left."""
        with suppress(Exception):  # of a scheduler that has gone
            self.client.cancel([*self.waiting, self.parcel], asynchronous=False)


# ---- in a worker -----------------------------------------------------------------------------


_beginning = threading.Lock()


def _unpacked(packed: bytes) -> Parcel:
    """What came with the job."""
    from distributed.protocol import pickle

    found: Parcel = pickle.loads(packed)
    return found


def _lot(parcel: Parcel, numbers: np.ndarray, values: np.ndarray) -> tuple[float, list[Run]]:
    """The runs of these numbers, with ``values`` (run, number), and how long they took [s]."""
    job = replace(parcel.job, values=values)
    with _beginning:
        if _lot not in job.deck.kept:
            _begin(parcel, job)
    began = clock.perf_counter()
    runs = [job.run(k)._replace(number=number) for k, number in enumerate(numbers.tolist())]
    return clock.perf_counter() - began, runs


def _begin(parcel: Parcel, job: Job) -> None:
    """The first lot of a process: what all need is compiled once on this machine, or found."""
    if parcel.program != fingerprint():
        raise OtherWorker("it has another adamslite, or its files were changed since it began")
    if parcel.files:
        _lay_out(parcel)
    job.prepare()
    job.deck.kept[_lot] = True


def _lay_out(parcel: Parcel) -> None:
    """Files that the deck names, where this process finds them."""
    import atexit
    import shutil
    import tempfile

    folder = Path(tempfile.mkdtemp(prefix="adamslite-"))
    atexit.register(shutil.rmtree, folder, ignore_errors=True)
    deck = parcel.job.deck
    for name, content in parcel.files.items():
        place = (folder / name).resolve()
        if not place.is_relative_to(folder.resolve()):  # nothing is written elsewhere
            _require_there(folder, name, content)
            continue
        place.parent.mkdir(parents=True, exist_ok=True)
        place.write_bytes(content)
    for each in {id(one): one for one in (deck, deck.base) if one is not None}.values():
        each.path = folder / (each.path.name if each.path else "sweep.adm")


def _require_there(folder: Path, name: str, content: bytes) -> None:
    """A table outside of the folder of the deck: this machine has it, and opens its folder."""
    found = inside(folder, name)
    if found is None:
        raise OtherWorker(f"its machine does not open the folder of {name} ({OPENED})")
    if not (found.is_file() and found.read_bytes() == content):
        raise OtherWorker(f"its machine has no file {name}, or another one of that name")


def _require_absolute(folder: Path, names: Iterable[str]) -> None:
    """A worker has the deck in another folder, from which a name with `..` leads elsewhere."""
    for name in names:
        out = not Path(os.path.normpath(folder / name)).is_relative_to(folder)
        if out and not os.path.isabs(name):
            raise UsageError(
                f"workers do not find {name}, which leads out of the folder of the deck: give it "
                "an absolute path, the same on all machines"
            )
