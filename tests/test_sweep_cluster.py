"""Sweeps on a Dask cluster: the same runs, lost workers and schedulers, what cannot be reached."""

from __future__ import annotations

import os
import signal
import threading
import time as clock
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import adamslite as al
from adamslite.cli.main import main
from adamslite.deck.deck import Deck
from adamslite.errors import RunFailed, UsageError
from adamslite.language.file_name import OPENED
from adamslite.sweeps import cluster
from adamslite.sweeps.job import Job

distributed = pytest.importorskip("distributed", reason="Dask is not installed: extra [dask]")

DECK = """a mass that falls
UNITS/SYSTEM=MKS
ACCGRAV/JGRAV=-10
PART/1, GROUND
POINT_MASS/2, MASS=2, CM=2, QG=0,5,0
MARKER/2, POINT_MASS=2
SIMULATE/DYNAMIC, END=1, STEPS=10
END
"""
NAME, LOWEST = "ACCGRAV.JGRAV", "min POINT_MASS/2.y"


@pytest.fixture
def path(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "fall.adm").write_text(DECK)
    return tmp_path / "fall.adm"


@pytest.fixture
def threads(tmp_path: Path) -> Iterator[Any]:
    """A cluster in this process: quick to start."""
    with _cluster(tmp_path, processes=False, n_workers=2) as made:
        yield made


@pytest.fixture
def processes(tmp_path: Path) -> Iterator[Any]:
    with _cluster(tmp_path, processes=True, n_workers=3) as made:
        yield made


def _cluster(folder: Path, **given: Any) -> Any:
    return distributed.LocalCluster(
        threads_per_worker=1, dashboard_address=None, local_directory=str(folder), **given
    )


def test_a_cluster_finds_what_this_machine_finds(path: Path, threads: Any) -> None:
    varied = [f"{NAME}=-1:-20:30", "POINT_MASS/2.MASS=1,-1"]
    kept: dict[str, Any] = {"measures": [LOWEST], "outputs": "POINT_MASS/2.y"}
    one = al.sweep(path, varied, **kept, workers=1)
    with distributed.Client(threads) as client:
        two = al.sweep(path, varied, **kept, client=client, path="x.nc")
    assert two.endings == {"DONE": 30, "INVALID": 30}
    assert (one.outcomes, one.messages) == (two.outcomes, two.messages)
    for name in (NAME, LOWEST, "steps", "POINT_MASS/2.y"):
        assert np.array_equal(one[name], two[name], equal_nan=True)
    assert al.load_sweep("x.nc").outcomes == two.outcomes


def test_the_command_takes_the_address_of_a_scheduler(path: Path, threads: Any, capsys) -> None:
    words = ["sweep", str(path), f"{NAME}=-1:-9:9", "--measure", LOWEST, "-o", "x.nc"]
    assert main([*words, "--scheduler", threads.scheduler_address]) == 0
    assert "9 of 9 runs, 9 DONE" in capsys.readouterr().err
    assert al.load_sweep("x.nc")[LOWEST] == pytest.approx(5 - np.arange(1, 10) / 2, abs=1e-3)


@pytest.mark.parametrize(
    ("words", "told"),
    [
        (["--scheduler", "tcp://127.0.0.1:9"], "no scheduler is reached there"),
        (["--scheduler", "no such host"], "no scheduler is reached there"),
        (["--scheduler", "nowhere.json"], "no scheduler is reached there: there is no such file"),
        (["--scheduler", "tcp://127.0.0.1:9", "--workers", "2"], "a scheduler has its own"),
        (["--scheduler", "tcp://127.0.0.1:9", "--threads"], "a scheduler has its own"),
    ],
)
def test_a_scheduler_that_cannot_be_reached_is_told_and_nothing_is_lost(
    path: Path, monkeypatch, capsys, words: list[str], told: str
) -> None:
    monkeypatch.setattr(cluster, "PATIENCE", 0.5)
    command = ["sweep", str(path), f"{NAME}=-1:-3:3", "--measure", LOWEST, "-o", "x.nc", "--quiet"]
    assert main(command) == 0
    before = Path("x.nc").read_bytes()
    assert main([*command, *words]) == 2
    said = capsys.readouterr().err
    assert told in said and len(said.splitlines()) == 1
    assert Path("x.nc").read_bytes() == before


def test_without_dask_the_extra_is_named(path: Path, monkeypatch) -> None:
    monkeypatch.setitem(__import__("sys").modules, "distributed", None)
    with pytest.raises(UsageError, match="pip install"):
        al.sweep(path, f"{NAME}=-1", measures=[LOWEST], client="tcp://127.0.0.1:9")


def test_a_worker_with_another_program_takes_no_part(path: Path, threads: Any, monkeypatch) -> None:
    prints = iter(["one", "one", *["another"] * 99])
    monkeypatch.setattr(cluster, "fingerprint", lambda: next(prints))
    with pytest.raises(RunFailed, match="a worker cannot carry out runs: it has another adamslite"):
        al.sweep(path, f"{NAME}=-1:-9:9", measures=[LOWEST], client=threads.scheduler_address)


def test_files_that_a_deck_names_go_along(path: Path, monkeypatch) -> None:
    """They are laid out in a folder of the worker, and nothing is written beyond that."""
    (path.parent / "workers").mkdir()
    monkeypatch.setattr("tempfile.tempdir", str(path.parent / "workers"))
    deck = al.read(path)
    job = Job(deck, (), np.empty((1, 0)))
    Path("mine.csv").write_text("1,2\n")
    parcel = cluster.Parcel(job, {"tables/law.csv": b"0,0\n1,2\n"}, "")
    cluster._lay_out(parcel)
    assert deck.folder != path.parent
    assert (deck.folder / "tables" / "law.csv").read_bytes() == b"0,0\n1,2\n"
    mine = str(Path("mine.csv").resolve())
    for name in ("../mine.csv", mine):
        with pytest.raises(cluster.OtherWorker, match="does not open the folder of .*mine.csv"):
            cluster._lay_out(parcel._replace(files={name: b"1,2\n"}))
    monkeypatch.setenv(OPENED, str(path.parent.resolve()))
    with pytest.raises(cluster.OtherWorker, match="has no file"):
        cluster._lay_out(parcel._replace(files={mine: b"3,4\n"}))
    assert Path("mine.csv").read_text() == "1,2\n"
    cluster._lay_out(parcel._replace(files={mine: b"1,2\n"}))


PUSHED = """a mass that is pushed by a table
UNITS/SYSTEM=MKS
PART/1, GROUND
MARKER/1, PART=1
POINT_MASS/2, MASS=2, CM=2
MARKER/2, POINT_MASS=2
SPLINE/1, FILE={table}
VARIABLE/1, FUNCTION=2
VFORCE/1, I=2, J_PART=1, FX=VARVAL(1)*AKISPL(TIME,0,1)
SIMULATE/DYNAMIC, END=1, STEPS=10
END
"""


@pytest.mark.slow
@pytest.mark.parametrize("opens", [True, False])
def test_a_worker_reads_tables_elsewhere_only_where_its_environment_opens_them(
    path: Path, monkeypatch, opens: bool
) -> None:
    """2 x'' = t and 2 t: x(1) = 1/12 and 1/6.  Its process begins with the environment
    of its own machine; this one opens the folder for itself.
    """
    other = path.parent.resolve() / "elsewhere"
    other.mkdir()
    rows = "".join(f"{t},{t}\n" for t in range(6))
    (other / "table.csv").write_text(rows)
    (path.parent / "decks").mkdir()
    deck = path.parent / "decks" / "pushed.adm"
    monkeypatch.setenv(OPENED, str(other) if opens else "")
    with (
        _cluster(path.parent, processes=True, n_workers=1) as made,
        distributed.Client(made) as client,
    ):
        monkeypatch.setenv(OPENED, str(other))

        def swept(table: str) -> Any:
            deck.write_text(PUSHED.format(table=table))
            return al.sweep(
                deck, "VARIABLE/1=1,2", measures=["max POINT_MASS/2.x"], client=client, error=1e-6
            )

        if opens:
            assert swept(f"{other}/table.csv")["max POINT_MASS/2.x"] == pytest.approx(
                [1 / 12, 1 / 6], rel=1e-3
            )
            with pytest.raises(UsageError, match="give it an absolute path"):
                swept("../elsewhere/table.csv")
        else:
            with pytest.raises(RunFailed, match="does not open the folder of .*table.csv"):
                swept(f"{other}/table.csv")


# ---- lost workers ----------------------------------------------------------------------------


class Watched:
    """Lots of a cluster as they come; calls ``after`` when the first ones are there."""

    def __init__(self, after: Any, monkeypatch: pytest.MonkeyPatch) -> None:
        self.numbers: list[int] = []
        self._after, self._carried_out = after, cluster.carried_out_by
        monkeypatch.setattr(cluster, "carried_out_by", self._watched)

    def _watched(self, *given: Any) -> Iterator[Any]:
        for lot in self._carried_out(*given):
            before = len(self.numbers)
            self.numbers += [run.number for run in lot]
            if before < 20 <= len(self.numbers):
                self._after()
            yield lot


@pytest.mark.slow
def test_a_worker_that_is_lost_costs_no_run_and_none_comes_twice(
    path: Path, processes: Any, monkeypatch
) -> None:
    monkeypatch.setattr(cluster, "LOT", 0.02)  # many lots
    lost = next(iter(processes.workers.values())).pid
    seen = Watched(lambda: os.kill(lost, signal.SIGKILL), monkeypatch)
    varied = f"{NAME}=-1:-9:600"
    found = al.sweep(path, varied, measures=[LOWEST], client=processes.scheduler_address)
    assert lost not in [each.pid for each in processes.workers.values()]
    assert sorted(seen.numbers) == list(range(600))
    assert found.outcomes == ["DONE"] * 600
    here = al.sweep(path, varied, measures=[LOWEST], workers=1)
    assert np.array_equal(found[LOWEST], here[LOWEST])


@pytest.mark.slow
@pytest.mark.filterwarnings("ignore::adamslite.errors.DeckWarning")
def test_a_run_that_brings_its_worker_down_fails_alone(tmp_path: Path, monkeypatch) -> None:
    deck = DECK.replace(
        "SIMULATE", "VARIABLE/1, FUNCTION=USER(3)\nREQUEST/1, F2=VARVAL(1)\nSIMULATE"
    )

    monkeypatch.setattr(cluster, "LOT", 1e3)  # it is in a lot with others

    def law(parameters: Any, time: float) -> float:
        if parameters[0] == 2:
            clock.sleep(3.0)  # Dask does not replace a worker that ends while it is begun
            os._exit(9)
        return float(parameters[0])

    dask = pytest.importorskip("dask")
    with (
        dask.config.set({"distributed.scheduler.allowed-failures": 0}),
        distributed.LocalCluster(
            n_workers=1, threads_per_worker=1, dashboard_address=None, local_directory=str(tmp_path)
        ) as made,
    ):  # one worker: what waits for it is lost each time, too
        found = al.sweep(
            deck, "VARIABLE/1.FUNCTION=1:8:8", measures=["max REQUEST/1.F2"],
            user={"VARIABLE/1": law}, client=made.scheduler_address,
        )  # fmt: skip
    assert found.endings == {"DONE": 7, "FAULT": 1}
    assert found.failed == [1]
    assert "its worker ended by itself" in found.messages[1]


@pytest.mark.slow
def test_a_scheduler_that_goes_leaves_what_is_done(path: Path, monkeypatch, capsys) -> None:
    import subprocess
    import sys

    monkeypatch.setattr(cluster, "LOT", 0.01)
    program = [sys.executable, "-m", "distributed.cli.dask_scheduler", "--port", "0"]
    program += ["--scheduler-file", "s.json", "--dashboard-address", ":0", "--no-dashboard"]
    scheduler = subprocess.Popen(program, stderr=subprocess.DEVNULL)
    worker = subprocess.Popen(
        [sys.executable, "-m", "distributed.cli.dask_worker", "--scheduler-file", "s.json",
         "--nthreads", "1", "--no-nanny", "--death-timeout", "60", "--no-dashboard"],
        stderr=subprocess.DEVNULL,
    )  # fmt: skip
    try:
        waiting = threading.Event()
        while not Path("s.json").exists():
            waiting.wait(0.1)
        Watched(scheduler.kill, monkeypatch)
        words = ["sweep", str(path), f"{NAME}=-1:-9:900", "--measure", LOWEST, "-o", "x.nc"]
        assert main([*words, "--scheduler", "s.json"]) == 4
    finally:
        scheduler.kill()
        worker.kill()
    assert "the scheduler has gone" in capsys.readouterr().err
    there = al.load_sweep("x.nc")
    assert 20 <= len(there) - len(there.ahead) < 900
    assert main([*words, "--quiet", "--workers", "1"]) == 0
    assert al.load_sweep("x.nc").outcomes == ["DONE"] * 900


def test_values_stay_with_the_client() -> None:
    """The scheduler keeps the parcel as long as the sweep lasts: it holds no values of runs."""
    job = Job(al.read(DECK), (NAME,), np.arange(1e6).reshape(-1, 1))
    packed = distributed.protocol.pickle.dumps(replace(job, values=job.values[:0]))
    assert len(packed) < 20_000
    assert isinstance(distributed.protocol.pickle.loads(packed).deck, Deck)
