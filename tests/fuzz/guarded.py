"""Guarded child processes that meet cases, and what becomes of them.

A child meets many cases and is replaced when it dies, and after ``LIFE`` of them.  Of each case it
measures CPU and the peak of its memory. The kernel ends it when one case takes more than
``MOST_CPU`` or asks for more than ``MOST_MEMORY``; its parent ends it when nothing comes for
``SILENCE``.
"""

from __future__ import annotations

import faulthandler
import os
import resource
import signal
import sys
import time
import traceback
from collections.abc import Iterator
from contextlib import suppress
from dataclasses import dataclass
from multiprocessing import get_context
from multiprocessing.connection import Connection, wait
from pathlib import Path
from tempfile import TemporaryDirectory

from benchmarks.memory import forget_peak, peak

from .calls import Broken
from .cases import Case
from .kinds import KINDS

#: What a case may take, CPU [s] and memory [MB]; more is a fault.
ALLOWED_CPU, ALLOWED_MEMORY = 5.0, 500.0
#: What ends a child: CPU of a case [s], memory for data [bytes], no answer [s of elapsed time].
MOST_CPU, MOST_MEMORY, SILENCE = 20, 3 << 30, 600.0
#: Elapsed time that a child has to remove its files [s].
PARTING = 10.0
LIFE = 5000
TRACEBACK, BROKEN, SIGNAL, SLOW, LARGE = (
    "tracebacks", "exit 70", "signals", f"over {ALLOWED_CPU:g} s", f"over {ALLOWED_MEMORY:g} MB",
)  # fmt: skip
FAULTS = (TRACEBACK, BROKEN, SIGNAL, SLOW, LARGE)


@dataclass(frozen=True)
class Verdict:
    """What became of a case: a word, or one of ``FAULTS`` with what it was."""

    word: str
    what: str = ""

    @property
    def is_fault(self) -> bool:
        """Whether the program, not the case, is wrong."""
        return self.word in FAULTS


class Child:
    """A process that meets cases of a kind: those of a seed by their numbers, and any others."""

    def __init__(self, kind: str, seed: int = 0) -> None:
        self.kind, self.seed = kind, seed
        self.number = -1
        self._start()

    def _start(self) -> None:
        context = get_context("fork")
        self.pipe, theirs = context.Pipe()
        self.process = context.Process(
            target=_work, args=(self.kind, self.seed, theirs, self.pipe), daemon=True
        )
        self.process.start()
        theirs.close()
        self.met = 0

    def give(self, case: int | Case | None) -> bool:
        """Let it meet a case; False where there is none."""
        if case is None:
            return False
        self.number, self.since = case if isinstance(case, int) else -1, time.monotonic()
        self.pipe.send(case)
        return True

    @property
    def is_silent(self) -> bool:
        """Whether an answer is not waited for any more."""
        return time.monotonic() - self.since > SILENCE

    def answer(self) -> Verdict:
        """What became of the case; a child that has died, or met many, is replaced."""
        verdict = self._received()
        self.met += 1
        if self.met >= LIFE or not self.process.is_alive():
            self.stop()
            self._start()
        return verdict

    def _received(self) -> Verdict:
        if not self.pipe.poll(max(0.0, self.since + SILENCE - time.monotonic())):
            self.process.kill()
            self.process.join()
            return Verdict(SLOW, f"no answer for {SILENCE:g} s")
        try:
            found: Verdict = self.pipe.recv()
            return found
        except (EOFError, ConnectionResetError):
            self.process.join()
        code = self.process.exitcode or 0
        if code == -signal.SIGXCPU:
            return Verdict(SLOW, f"ended after {MOST_CPU} s of CPU")
        return Verdict(SIGNAL, signal.Signals(-code).name if code < 0 else f"exit code {code}")

    def stop(self) -> None:
        """Let it go; its folder goes with it."""
        with suppress(OSError):
            self.pipe.send(None)
        self.process.join(PARTING)
        if self.process.is_alive():
            self.process.kill()
            self.process.join()
        self.pipe.close()

    def __enter__(self) -> Child:
        return self

    def __exit__(self, *fault: object) -> None:
        self.stop()

    def verdict(self, case: Case) -> Verdict:
        """The verdict on a case."""
        self.give(case)
        return self.answer()


def verdicts(kind: str, seed: int, numbers: range, jobs: int) -> Iterator[tuple[int, Verdict]]:
    """The verdicts on cases of a seed, by so many children at a time."""
    left = iter(numbers)
    children = [Child(kind, seed) for _ in range(max(1, min(jobs, len(numbers))))]
    try:
        busy = [each for each in children if each.give(next(left, None))]
        while busy:
            ready = wait([each.pipe for each in busy], timeout=1.0)
            for child in [each for each in busy if each.pipe in ready or each.is_silent]:
                yield child.number, child.answer()
                if not child.give(next(left, None)):
                    busy.remove(child)
    finally:
        for child in children:
            child.stop()


# ---- in a child ----------------------------------------------------------------------------------


def _work(kind: str, seed: int, pipe: Connection, of_parent: Connection) -> None:
    """Meet cases until the parent has no more, or is gone."""
    of_parent.close()
    faulthandler.disable()
    resource.setrlimit(resource.RLIMIT_DATA, (MOST_MEMORY, MOST_MEMORY))
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
    sink = os.open(os.devnull, os.O_WRONLY)
    for stream in (1, 2):
        os.dup2(sink, stream)
    with TemporaryDirectory() as name:
        os.environ.setdefault("ADAMSLITE_CACHE", name)
        folder = Path(name, "case")
        folder.mkdir()
        os.chdir(folder)
        while True:
            try:
                given = pipe.recv()
            except EOFError:
                given = None
            if given is None:
                return
            case = given if isinstance(given, Case) else KINDS[kind].make(seed, given)
            pipe.send(_verdict(kind, case, folder))


def _verdict(kind: str, case: Case, folder: Path) -> Verdict:
    start = time.process_time()
    resource.setrlimit(resource.RLIMIT_CPU, (int(start) + 1 + MOST_CPU, resource.RLIM_INFINITY))
    forget_peak()
    try:
        word = KINDS[kind].meet(case, folder)
    except Broken as fault:
        return Verdict(BROKEN, str(fault)[:1000])
    except BaseException as fault:  # whatever it is, the case has found it
        return Verdict(TRACEBACK, _place(fault))
    taken, memory = time.process_time() - start, peak()
    if taken > ALLOWED_CPU:
        return Verdict(SLOW, f"{taken:.1f} s of CPU, {word}")
    return Verdict(LARGE, f"{memory:.0f} MB, {word}") if memory > ALLOWED_MEMORY else Verdict(word)


def _place(fault: BaseException) -> str:
    """What was raised, and where."""
    frames = traceback.extract_tb(fault.__traceback__)
    ours = [each for each in frames if f"{os.sep}adamslite{os.sep}" in each.filename] or frames
    last = ours[-1]
    text = "".join(traceback.format_exception_only(fault)).strip()
    return f"{text[:500]} ({Path(last.filename).name}:{last.lineno})"


if sys.platform != "linux":
    raise ImportError("limits and peaks of memory are those of Linux")
