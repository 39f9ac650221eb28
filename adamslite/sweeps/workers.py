"""Runs on all processors: by processes, or by threads.

Native loops release the interpreter, but of a short run most of the time is Python; so processes
are the rule. On Linux they are forks of the first one, with kernels, libraries and plans as they
are there; elsewhere each starts anew and loads what is compiled from the cache.

Runs are handed out in lots that take about ``LOT`` seconds, two for each worker at a time, so that
little is lost when the sweep is interrupted.
"""

from __future__ import annotations

import multiprocessing
import os
import signal
import sys
import threading
import time as clock
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import (
    FIRST_COMPLETED,
    Executor,
    Future,
    ProcessPoolExecutor,
    ThreadPoolExecutor,
    wait,
)
from concurrent.futures.process import BrokenProcessPool
from contextlib import contextmanager

from adamslite.errors import RunFailed
from adamslite.sweeps.job import AHEAD, Job, Run

PROCESSES, THREADS = "processes", "threads"
#: A lot takes about so long [s], and runs that take less altogether are not worth workers.
LOT, SHORT = 0.1, 0.2
#: Most runs in a lot.
LARGEST = 500
#: Between two looks at what has been done, so that an interruption is noticed on Windows, too [s].
LOOK = 0.5

_job: Job | None = None


def carried_out(
    job: Job, numbers: Sequence[int], workers: int, kind: str = PROCESSES
) -> Iterator[list[Run]]:
    """Carry out runs, in lots as they become ready, in any order.

    The first ones are carried out here: they compile what is missing, and show how long one takes.
    A run that is interrupted is not among them, and ends it.

    Raises
    ------
    RunFailed
        When a process of a worker ends by itself.
    """
    job.prepare()
    began, done = clock.perf_counter(), 0
    for number in numbers:
        before = clock.perf_counter()
        run = job.run(number)
        if run.outcome == AHEAD:
            raise KeyboardInterrupt
        yield [run]
        done += 1
        now = clock.perf_counter()
        share = now - before
        left = len(numbers) - done
        if workers > 1 and now - began > LOT / 2 and share * left > SHORT:
            break
    if done < len(numbers):
        yield from _handed_out(job, numbers[done:], workers, kind, share)


def _handed_out(
    job: Job, numbers: Sequence[int], workers: int, kind: str, each: float
) -> Iterator[list[Run]]:
    """By workers; ``each``: how long a run takes at first [s]."""
    with _told_of_death(), _pool(job, min(workers, len(numbers)), kind) as (pool, lot_of):
        at, waiting = 0, set[Future[tuple[float, list[Run]]]]()
        while at < len(numbers) or waiting:
            while at < len(numbers) and len(waiting) < 2 * workers:
                fair = -(-(len(numbers) - at) // (2 * workers))
                size = max(1, min(int(LOT / each), fair, LARGEST))
                waiting.add(pool.submit(lot_of, list(numbers[at : at + size])))
                at += size
            ready, waiting = wait(waiting, LOOK, FIRST_COMPLETED)
            for future in ready:
                taken, runs = future.result()
                each = 0.5 * (each + taken / len(runs))
                yield runs


@contextmanager
def _told_of_death() -> Iterator[None]:
    """A process that ends by itself is noticed when a lot is handed out, or when one is missed."""
    try:
        yield
    except BrokenProcessPool:
        raise RunFailed(
            "a process that carried out runs has ended by itself, perhaps for lack of memory; "
            "fewer workers need less"
        ) from None


LotOf = Callable[[list[int]], tuple[float, list[Run]]]


@contextmanager
def _pool(job: Job, workers: int, kind: str) -> Iterator[tuple[Executor, LotOf]]:
    """Workers, and what they are asked to do; they are gone afterwards, whatever they do then."""
    if kind == THREADS:
        with ThreadPoolExecutor(workers) as threads:
            try:
                yield threads, lambda numbers: _timed(job, numbers)
            finally:
                threads.shutdown(wait=True, cancel_futures=True)
        return
    pool = ProcessPoolExecutor(workers, _context(), _take, (job,))
    try:
        yield pool, _lot
    except BaseException:
        end_now(pool)
        raise
    pool.shutdown()


def end_now(pool: ProcessPoolExecutor) -> None:
    """End the processes of workers, whatever they do."""
    processes = list((pool._processes or {}).values())
    pool.shutdown(wait=False, cancel_futures=True)
    for process in processes:
        process.terminate()


def _context() -> multiprocessing.context.BaseContext:
    """A fork is ready at once, but is no copy of a process with several threads."""
    forks = sys.platform == "linux" and threading.active_count() == 1
    return multiprocessing.get_context("fork" if forks else "spawn")


def _take(job: Job) -> None:
    """A process begins."""
    global _job
    _job = job
    follow_the_first()


def follow_the_first() -> None:
    """The first process decides what an interruption of this one means, and ends it."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    signal.signal(signal.SIGTERM, signal.SIG_DFL)
    end_with_the_first()


def end_with_the_first() -> None:
    """Let this process end when the first one has been killed, which could not end it any more.

    A fork holds the ends of pipes of those that were forked before it: the youngest ends first.
    """

    def follow() -> None:
        first = multiprocessing.parent_process()
        if first is not None:
            first.join()
            os._exit(1)

    threading.Thread(target=follow, daemon=True).start()


def _lot(numbers: list[int]) -> tuple[float, list[Run]]:
    """Runs in a process of a worker."""
    assert _job is not None
    return _timed(_job, numbers)


def _timed(job: Job, numbers: list[int]) -> tuple[float, list[Run]]:
    """Runs, and how long they took [s]."""
    began = clock.perf_counter()
    runs = [job.run(number) for number in numbers]
    return clock.perf_counter() - began, runs
