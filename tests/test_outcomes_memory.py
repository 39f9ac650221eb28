"""The memory and the disk that a run takes: estimated before it begins, and kept within a limit."""

from __future__ import annotations

import gc
import subprocess
import sys
import tracemalloc
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from scenes import GROUND, done, run

import adamslite as al
from adamslite import Outcome, machine
from adamslite.analyses import simulation
from adamslite.analyses.dynamics import history
from adamslite.analyses.session import session, session_state
from adamslite.analyses.setup import run_size
from adamslite.analyses.setup.output_times import rows_of
from adamslite.analyses.setup.run_options import size_of, within_memory
from adamslite.cli.main import main
from adamslite.elements.simulate import Simulate
from adamslite.errors import OutOfMemory, RunFailed, UsageError
from adamslite.native import worker

POINT = GROUND + "POINT_MASS/2, MASS=1, CM=2, VX=1\nMARKER/2, POINT_MASS=2\nEND\n"
PART = GROUND + "PART/2, MASS=1, IP=1,1,1, CM=2, VX=1\nMARKER/2, PART=2\nEND\n"
TWICE = POINT.replace(
    "END\n", "SIMULATE/DYNAMIC, END=1, STEPS=10\nSIMULATE/DYNAMIC, END=2, STEPS=10\nEND\n"
)
LINUX = pytest.mark.skipif(sys.platform != "linux", reason="only Linux keeps the limit")


def commands(*lines: str) -> list[Simulate]:
    text = GROUND + "".join(f"SIMULATE/{line}\n" for line in lines) + "END\n"
    return al.read(text).of(Simulate)


@pytest.mark.parametrize(
    ("lines", "rows"),
    [
        (["DYNAMIC, END=1, STEPS=10"], 11),
        (["DYNAMIC, END=1"], 101),
        (["DYNAMIC, END=1, DTOUT=0.3"], 5),
        (["DYNAMIC, END=1, DTOUT=0.1", "DYNAMIC, DURATION=2, DTOUT=0.1"], 11 + 21),
        (["STATIC", "DYNAMIC, END=1, STEPS=4"], 5),
        (["DYNAMIC, END=1, STEPS=100000000"], 100_000_001),
    ],
)
def test_rows_are_counted_before_a_run(lines: list[str], rows: int) -> None:
    assert rows_of(commands(*lines)) == rows


SENSED = POINT.replace("END", "SENSOR/1, FUNCTION=DX(2,1)\\ VALUE=0.5, GE, PRINT\nEND")


@pytest.mark.parametrize("deck", [POINT, PART, SENSED], ids=["point", "part", "sensed"])
@pytest.mark.parametrize("analyses", [1, 2])
@pytest.mark.parametrize("outputs", [(), ("*.x",), ("*[xyz]",), ("*",)], ids=str)
def test_the_estimate_is_what_a_run_takes(
    deck: str, analyses: int, outputs: tuple[str, ...], monkeypatch: pytest.MonkeyPatch
) -> None:
    """Within a third, and not less; of so many numbers there is no second run if they are estimated
    at all, and one that gets no memory is left out.
    """
    monkeypatch.setattr("adamslite.analyses.simulation._attempted", lambda *_, **__: None)
    found: list[int] = []
    monkeypatch.setattr(run_size, "_need", lambda what, need, *_: found.append(need))
    monkeypatch.setattr("adamslite.analyses.setup.output_times.SMALL", 0)

    def take(rows: int) -> None:
        lines = f"SIMULATE/DYNAMIC, DURATION=1, STEPS={rows // analyses}\n" * analyses
        al.simulate(deck, commands=f"{lines}STOP\n", outputs=outputs, max_steps=10**6)

    take(10)
    tracemalloc.start()
    try:
        take(100_000)
        peak = tracemalloc.get_traced_memory()[1]
    finally:
        tracemalloc.stop()
    assert 0.65 * found[-1] < peak < 1.05 * found[-1]


def test_more_rows_than_there_is_memory_for_are_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    """9 columns of 3e7 rows."""
    monkeypatch.setattr(machine, "_of_machine", lambda: 2_000_000_000)
    with pytest.raises(UsageError) as refusal:
        run(POINT, 1.0, 30_000_000)
    assert str(refusal.value).startswith("The results would have 30000001 rows of 9 columns, which")
    assert str(refusal.value).endswith(
        " GB of memory, and 2 GB are free: fewer STEPS, a longer DTOUT."
    )
    done(POINT, 1.0, 1_000_000, max_steps=2_000_000)


def test_more_than_the_disk_has_room_for_is_refused(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: Any
) -> None:
    """8 byte for each of 10 numbers of 2e6 rows, and as much for those that are kept while the run
    lasts; the file that was there stays.
    """
    deck, out = tmp_path / "point.adm", tmp_path / "out.csv"
    deck.write_text(POINT)
    out.write_text("as it was")
    monkeypatch.setattr(run_size, "free_disk", lambda folder: 250_000_000)
    flags = ["--end", "1", "--steps", "2000000", "-o", str(out)]
    assert main(["solve", str(deck), *flags]) == 2
    told = capsys.readouterr().err
    assert f"which take 0.32 GB of disk, and 0.25 GB are free in {tmp_path.resolve()}" in told
    assert "fewer columns (--outputs), or another disk" in told and out.read_text() == "as it was"
    assert (
        main(["solve", str(deck), *flags, "--outputs", "POINT_MASS/2.x", "--max-steps", "9"]) == 4
    )
    assert len(al.Results.load(out).time) > 1
    deck.write_text(POINT.replace("END\n", "RESULTS/XRF\nEND\n"))
    assert main(["solve", str(deck), *flags, "--outputs", "POINT_MASS/2.*"]) == 2
    assert "which take 0.48 GB of disk" in capsys.readouterr().err  # once more as .res


@pytest.mark.parametrize("suffix", ["csv", "nc", "mat", "req", "res", "parquet"])
def test_rows_that_are_kept_in_a_file_need_no_memory(
    suffix: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """2e7 rows of 9 columns with 2 GB free: all formats are written some rows at a time."""
    if suffix == "parquet":
        pytest.importorskip("pyarrow")
    deck, out = tmp_path / "point.adm", tmp_path / f"out.{suffix}"
    deck.write_text(POINT)
    monkeypatch.setattr(machine, "_of_machine", lambda: 2_000_000_000)
    flags = ["--end", "1", "--steps", "20000000", "--max-steps", "9", "-o", str(out)]
    assert main(["solve", str(deck), *flags]) == 4 and out.exists()


@pytest.mark.parametrize(("flag", "code"), [("--page", 2), ("--confirm", 2), ("--quiet", 4)])
def test_pages_and_confirmations_need_all_rows_in_memory(
    flag: str, code: int, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: Any
) -> None:
    """2e7 rows of 9 columns with 3 GB free: twice 1.44 GB and 0.8 GB for times, without 0.8 GB."""
    deck = tmp_path / "point.adm"
    deck.write_text(POINT)
    monkeypatch.setattr(machine, "_of_machine", lambda: 3_000_000_000)
    flags = ["--end", "1", "--steps", "20000000", "--max-steps", "9", flag]
    assert main(["solve", str(deck), *flags, "-o", str(tmp_path / "out.csv")]) == code
    assert ("or without --page and --confirm" in capsys.readouterr().err) == (code == 2)


def test_more_rows_than_a_matlab_file_holds_are_refused(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: Any
) -> None:
    """4e7 rows of 9 columns: MATLAB reads 2^31 bytes of a variable."""
    deck, out = tmp_path / "point.adm", tmp_path / "out.mat"
    deck.write_text(POINT)
    monkeypatch.setattr(machine, "_of_machine", lambda: 20_000_000_000)
    flags = ["--end", "1", "--steps", "40000000", "--max-steps", "9", "-o", str(out)]
    assert main(["solve", str(deck), *flags]) == 2 and not out.exists()
    told = capsys.readouterr().err
    assert "The values take 2.88 GB, and a MATLAB file (version 5) holds 2.15 GB" in told
    assert "--outputs with fewer columns, fewer STEPS, or -o FILE.csv" in told
    assert main(["solve", str(deck), *flags, "--outputs", "POINT_MASS/2.x"]) == 4


@pytest.mark.parametrize(
    ("text", "size"),
    [("2GB", 2_000_000_000), ("1.5 gib", 1_610_612_736), ("500MB", 500_000_000), (4096, 4096),
     ("1e6", 1_000_000), (1e9, 1_000_000_000)],
)  # fmt: skip
def test_sizes_are_read(text: object, size: int) -> None:
    assert size_of(text) == size


@pytest.mark.parametrize(
    "text", ["", "GB", "-1GB", "0", "nan", "inf", "1e999", "2XB", "2 G B", None]
)
def test_what_is_no_size_is_rejected(text: object) -> None:
    with pytest.raises(UsageError, match="it must be a size"):
        size_of(text)


@LINUX
def test_a_limit_below_what_the_process_has_is_refused() -> None:
    with pytest.raises(UsageError, match=r"memory_limit=1000000: before the run .* takes \d+ MB"):
        run(POINT, 1.0, memory_limit="1MB")
    assert machine.left_of_limit() is None


@LINUX
def test_the_limit_holds_while_a_run_lasts_and_no_longer() -> None:
    gc.collect()  # what others have left would make room in the middle of it
    room = (machine.used_memory() or 0) + 300_000_000
    with pytest.raises(UsageError, match="rows of 9 columns, which take .* GB of memory"):
        run(POINT, 1.0, 3_000_000, memory_limit=room)
    assert machine.left_of_limit() is None
    assert np.zeros(100_000_000).size  # 0.8 GB
    with machine.memory_limited(room), pytest.raises(MemoryError):
        np.zeros(100_000_000)


@LINUX
@pytest.mark.slow  # compiles the engine of a new process
def test_a_compiler_without_memory_ends_by_name(tmp_path: Path) -> None:
    """LLVM ends the process where it gets no memory: it is not asked to begin."""
    deck = tmp_path / "point.adm"
    deck.write_text(POINT)
    program = "import sys; from adamslite.cli.main import main; sys.exit(main())"
    command = [sys.executable, "-c", program, "solve", str(deck), "--end", "1"]
    for limit, code in (("110MB", 4), ("2GB", 0)):
        ended = subprocess.run(
            [*command, "--memory-limit", limit], capture_output=True, text=True, cwd=tmp_path,
            env={"ADAMSLITE_CACHE": str(tmp_path / limit), "PYTHONPATH": ":".join(sys.path),
                 "OPENBLAS_NUM_THREADS": "1"},
        )  # fmt: skip
        assert ended.returncode == code, ended.stderr
        assert "Traceback" not in ended.stderr
        assert ("than --memory-limit allows" in ended.stderr) == (code == 4)


def failing(once: Any, times: int = 1) -> Any:
    """A function that first finds no memory so many times."""
    left = [times]

    def tried(*given: Any) -> Any:
        left[0] -= 1
        if left[0] >= 0:
            raise MemoryError
        return once(*given)

    return tried


def test_rows_are_kept_where_memory_ends_behind_them(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(session_state, "columns", failing(session_state.columns))
    results = run(POINT, 1.0, 10)
    assert results.outcome is Outcome.MEMORY_LIMIT and len(results.time) == 11
    assert results.message == f"At t = 1. {Outcome.MEMORY_LIMIT.sentence}"


@pytest.mark.parametrize(
    ("fault", "outcome"),
    [(MemoryError, Outcome.MEMORY_LIMIT), (KeyboardInterrupt, Outcome.INTERRUPTED)],
)
def test_what_earlier_commands_gave_is_kept(
    fault: type[BaseException], outcome: Outcome, monkeypatch: pytest.MonkeyPatch
) -> None:
    whole, calls = al.simulate(al.read(TWICE)), []
    choose = session.choose_method

    def chosen(*given: Any) -> Any:
        calls.append(given)
        if len(calls) == 2:
            raise fault
        return choose(*given)

    monkeypatch.setattr(session, "choose_method", chosen)
    results = al.simulate(al.read(TWICE))
    assert results.outcome is outcome
    np.testing.assert_array_equal(results.time, whole.time[:11])
    np.testing.assert_array_equal(results.values, whole.values[:11])


@pytest.mark.parametrize(
    ("fault", "limit", "raised"),
    [(MemoryError, None, OutOfMemory), (SystemError, "8GB", OutOfMemory),
     (SystemError, None, SystemError)],
)  # fmt: skip
def test_where_memory_ends_before_a_row_nothing_is_said_to_be_kept(
    fault: type[Exception], limit: str | None, raised: type[Exception]
) -> None:
    """Caches of Python that get no memory raise SystemError."""
    with pytest.raises(raised) as found, within_memory(size_of(limit) if limit else None):
        raise fault
    assert "kept" not in str(found.value)


def test_a_run_whose_rows_are_in_a_file_goes_on_in_more_memory(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: Any
) -> None:
    """A file with a state is left, and the command that goes on is named."""
    monkeypatch.chdir(tmp_path)
    Path("point.adm").write_text(POINT)
    monkeypatch.setattr(history, "SETTLED", 0.0)
    monkeypatch.setattr(session_state, "columns", failing(session_state.columns, 2))
    words = ["solve", "point.adm", "--end", "1", "--steps", "10", "--quiet"]
    assert main(words) == 4
    assert not Path("point.csv").exists() and Path("point.csv.part").is_file()
    assert "--resume point.csv.part --memory-limit SIZE` goes on" in capsys.readouterr().err
    assert main(["solve", "--resume", "point.csv.part", "--quiet"]) == 0
    resumed = Path("point.csv").read_bytes()
    assert main(words) == 0 and Path("point.csv").read_bytes() == resumed


def test_without_room_for_a_thread_nothing_is_run(monkeypatch: pytest.MonkeyPatch) -> None:
    def full(*_: Any) -> None:
        raise RuntimeError("can't start new thread")

    monkeypatch.setattr(worker, "start_new_thread", full)
    with pytest.raises(RunFailed, match="needs more memory than there is"):
        run(POINT, 1.0, integrator="GSTIFF")


def test_a_thread_without_room_for_its_first_call_is_not_waited_for(monkeypatch) -> None:
    """It has begun, and ends before it does anything: nobody would ever be told."""
    called: list[Any] = []
    monkeypatch.setattr(worker, "start_new_thread", lambda *_: called.append(1))
    with pytest.raises(RunFailed, match="needs more memory than there is"):
        run(POINT, 1.0, integrator="GSTIFF")
    with pytest.raises(MemoryError):
        worker.interruptible(lambda: called.append(2))
    assert called == [1, 1]


#: A call in a thread where so much is left [byte]; the exit code says whether it was made.
LEFT = """
import os, resource, sys
from adamslite import machine
from adamslite.native import worker
limit = machine.used_memory() + int(sys.argv[1])
resource.setrlimit(resource.RLIMIT_DATA, (limit, limit))
try:
    worker.interruptible(lambda: None)
except MemoryError:
    os._exit(4)
os._exit(0)
"""


@LINUX
@pytest.mark.slow
def test_however_much_is_left_a_call_is_made_or_not(monkeypatch: pytest.MonkeyPatch) -> None:
    """In steps of two pages round the stack of a thread, 8 MB, and what Python adds to it."""
    codes = []
    for left in range(8_340_000, 8_640_000, 8192):
        done = subprocess.run(
            [sys.executable, "-c", LEFT, str(left)], capture_output=True, timeout=60
        )
        codes.append(done.returncode)
    assert set(codes) == {0, 4} and codes[0] == 4 and codes[-1] == 0


def test_no_memory_elsewhere_is_no_fault_of_the_program(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: Any
) -> None:
    def full(*_: Any) -> None:
        raise MemoryError

    deck = tmp_path / "point.adm"
    deck.write_text(POINT)
    monkeypatch.setattr("adamslite.scene.load_scene", full)
    assert main(["solve", str(deck), "--end", "1"]) == 4
    assert capsys.readouterr().err == (
        "adamslite: there is not enough memory for that; no file was changed\n"
    )


@pytest.mark.parametrize(
    ("line", "folder", "names"),
    [
        ("0::/job/step", "job", ("memory.max", "memory.current")),
        ("4:memory:/job/step", "memory/job", ("memory.limit_in_bytes", "memory.usage_in_bytes")),
    ],
)
def test_a_container_has_what_its_group_leaves(
    line: str, folder: str, names: tuple[str, str], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The group around its own allows 10 MB, of which 8 are taken, 3 of these by files."""
    around = tmp_path / folder
    (around / "step").mkdir(parents=True)
    for name, number in zip(names, (10_000_000, 8_000_000), strict=True):
        (around / name).write_text(f"{number}\n")
    (around / "step" / names[0]).write_text("max\n")
    kind = "inactive_file" if folder == "job" else "total_inactive_file"
    (around / "memory.stat").write_text(f"anon 5000000\n{kind} 3000000\n")
    groups = tmp_path / "groups"
    groups.write_text(f"9:name=systemd:/\n{line}\n")
    monkeypatch.setattr(machine, "GROUP", groups)
    monkeypatch.setattr(machine, "GROUPS", tmp_path)
    assert machine._of_group() == 5_000_000
    assert machine.free_memory() == 5_000_000


@pytest.mark.parametrize("memory", [None, "100GB"])
def test_a_second_run_without_memory_is_left_out(
    memory: str | None, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The results of the first one stay."""
    begun, room = [], simulation.need_room

    def need_room(*arguments: Any, **options: Any) -> None:
        begun.append(arguments)
        if len(begun) > 1:
            raise MemoryError
        room(*arguments, **options)

    monkeypatch.setattr(simulation, "need_room", need_room)
    options = {"integrator": "GSTIFF", "error": 1e-5, "memory_limit": memory}
    results = al.simulate(al.read(POINT), end=1.0, steps=100, **options)
    assert results.success and dict(results.meta)["deck"] and len(begun) == 2
