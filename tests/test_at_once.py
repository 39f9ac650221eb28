"""Processes and threads that compile and solve at once: forked, side by side, without a cache."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
import threading
import warnings
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from falling_mass import FALL
from writing_commands import environment

import adamslite
from adamslite.native import compiler

FORKS = pytest.mark.skipif(not hasattr(os, "fork"), reason="the system does not fork")
FORCES = np.arange(-8.0, 0.0)


def end_of(force: float, title: object) -> float:
    """y at the end of a run: F t^2 / 2 m, with a deck that nothing is kept of."""
    text = FALL.format(now=title).replace("FY=-10.0", f"FY={force}*(1+0*TIME**{abs(force)})")
    run = adamslite.simulate(text)
    return float(run["POINT_MASS/2.y"][-1])


def in_a_fork(work: Callable[[], bool], patience: float = 100.0) -> None:
    """The work in a forked child, which ends by itself; one that hangs is ended and fails."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", DeprecationWarning)  # of forks of processes with threads
        child = os.fork()
    if child == 0:
        try:
            os._exit(0 if work() else 1)
        except BaseException:
            os._exit(2)
    over = threading.Event()
    watch = threading.Timer(patience, lambda: over.is_set() or os.kill(child, 9))
    watch.start()
    _, status = os.waitpid(child, 0)
    over.set()
    watch.cancel()
    assert os.waitstatus_to_exitcode(status) == 0


def agrees(force: float, title: object) -> bool:
    return abs(end_of(force, title) - force) < 1e-6


@FORKS
@pytest.mark.slow
def test_a_forked_child_compiles_and_solves(cache: Path) -> None:
    """After native code has run here: the same deck, and one that must be compiled."""
    assert agrees(-3.0, "parent")
    in_a_fork(lambda: agrees(-3.0, "parent") and agrees(-5.0, "child"))
    assert agrees(-5.0, "child")


@pytest.mark.slow
def test_threads_compile_and_solve_at_once(cache: Path) -> None:
    found: dict[float, float] = {}

    def run(force: float) -> None:
        found[force] = end_of(force, f"thread {force}")

    threads = [threading.Thread(target=run, args=(force,)) for force in FORCES.tolist()]
    for each in threads:
        each.start()
    for each in threads:
        each.join()
    assert np.allclose([found[force] for force in FORCES], FORCES, atol=1e-6)


@FORKS
@pytest.mark.slow
def test_a_fork_while_threads_compile(cache: Path) -> None:
    """No lock of a thread that the child does not have stays locked in it."""
    on = True

    def compile_much() -> None:
        turn = 0
        while on:
            turn += 1
            end_of(-2.0 - 0.001 * turn, f"busy {turn}")

    assert agrees(-1.0, "first")  # imports of Python are no matter of this test
    threads = [threading.Thread(target=compile_much) for _ in range(2)]
    for each in threads:
        each.start()
    try:
        for turn in range(3):
            in_a_fork(lambda turn=turn: agrees(-4.0 - 0.01 * turn, f"fork {turn}"))
    finally:
        on = False
        for each in threads:
            each.join()


@pytest.mark.slow
def test_eight_processes_compile_into_one_empty_cache(cache: Path, tmp_path: Path) -> None:
    """Each part is compiled by one of them, all have the same results, and no lock is left."""
    (tmp_path / "fall.adm").write_text(FALL.format(now="eight"))
    program = (
        "import sys\n"
        "from adamslite.native import compiler\n"
        "from adamslite.cli.main import main\n"
        "emitted, times = compiler._emitted, []\n"
        "compiler._emitted = lambda *words: times.append(1) or emitted(*words)\n"
        "code = main(sys.argv[1:])\n"
        "print(len(times))\n"
        "sys.exit(code)\n"
    )
    words = [sys.executable, "-c", program, "solve", "fall.adm", "--quiet", "-o"]
    runs = [
        subprocess.Popen(
            [*words, f"{k}.csv"], cwd=tmp_path, env=environment(), text=True,
            stdout=subprocess.PIPE, stderr=subprocess.PIPE,
        )
        for k in range(8)
    ]  # fmt: skip
    told = [(*run.communicate(), run.returncode) for run in runs]
    assert [(err, code) for _, err, code in told] == [("", 0)] * 8
    alone = subprocess.run([*words, "alone.csv"], cwd=tmp_path, env=environment(), text=True,
                           capture_output=True)  # fmt: skip
    assert alone.stdout == "0\n"
    compiled = sum(int(out) for out, _, _ in told)
    assert 0 < compiled == len([*cache.glob("*.o")])
    whole = (tmp_path / "alone.csv").read_bytes()
    assert all((tmp_path / f"{k}.csv").read_bytes() == whole for k in range(8))
    assert [*cache.glob(".*")] == []


@pytest.mark.slow
def test_a_cache_removed_whenever_something_is_compiled(cache: Path, monkeypatch, caplog) -> None:
    """The folder goes under the hands of the run, with the locks that it holds."""
    emitted = compiler._emitted

    def removed(*words: object) -> bytes:
        shutil.rmtree(cache)
        return emitted(*words)

    monkeypatch.setattr(compiler, "_emitted", removed)
    assert agrees(-6.0, "removed") and agrees(-7.0, "removed again")
    assert caplog.messages == [] and [*cache.glob(".*")] == []
