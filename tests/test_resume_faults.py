"""Faults of the system while a run is resumed, or has a file to be resumed from: a named outcome,
nothing lost that was kept, nothing left behind.
"""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest
from test_clocks_that_jump import CLOCKS
from unfinished_runs import OFTEN, command, left_behind, solved, states_of, until_there_is_a_state
from unfinished_scenes import box, pendulum, written
from writing_commands import CAREFUL, LIMITED, contents

from adamslite.caching import secret

#: It runs for some seconds.
LONG = pendulum(1200, 6000)
FLAGS = ("--integrator", "GSTIFF", "--error", "1e-6")
POSIX = pytest.mark.skipif(os.name != "posix", reason="limits and locks of POSIX")


@pytest.fixture
def part(tmp_path: Path) -> Path:
    """The file of a run that was killed, in a folder of its own."""
    folder = tmp_path / "here"
    folder.mkdir()
    return left_behind(folder, LONG, *FLAGS)


def resumed(part: Path, before: str = "", *prefix: str) -> subprocess.CompletedProcess[str]:
    """Go on with a run, in a process that begins with some lines of Python."""
    words = [*prefix, sys.executable, "-c", before + OFTEN, "solve", "--quiet"]
    return subprocess.run(
        [*words, "--resume", str(part)], capture_output=True, text=True, cwd=part.parent
    )


def goes_on(part: Path, *beside: str) -> None:
    """It is resumed to the bytes of a run that was not disturbed, and leaves nothing behind."""
    output = part.with_name("x.csv")
    done = resumed(part)
    assert done.returncode == 0, done.stderr
    assert output.read_bytes() == solved(part.with_name("deck.adm"), *FLAGS)
    left = {"deck.adm", "x.csv", "undisturbed.csv", *beside}
    assert {each.name for each in part.parent.iterdir()} == left


# ---- disks and folders -----------------------------------------------------------------------


@POSIX
@pytest.mark.slow
@pytest.mark.parametrize("more", [0, 40_000])
def test_a_disk_that_is_full_when_a_run_is_resumed(part: Path, more: int) -> None:
    """No file may get longer than that of the run, or hardly."""
    limit = LIMITED.format(most=part.stat().st_size + more)
    ended = resumed(part, limit)
    assert ended.returncode == 5 and "Traceback" not in ended.stderr
    assert "x.csv.part': " in ended.stderr and "goes on with `adamslite" in ended.stderr
    assert {*contents(part.parent)} == {"deck.adm", "x.csv.part"}
    goes_on(part)


@POSIX
@pytest.mark.slow
def test_a_disk_that_is_full_when_the_results_of_a_resumed_run_are_written(tmp_path: Path) -> None:
    """Neither an earlier table nor what the run has kept is lost; as text numbers take more room
    than in the file of the run.
    """
    text = box(4000, 20000)
    part, old = left_behind(tmp_path, text), tmp_path / "x.csv"
    whole = solved(tmp_path / "deck.adm")
    old.write_text("# adamslite, old\n")
    ended = resumed(part, LIMITED.format(most=len(whole) - 1000))
    assert ended.returncode == 5
    assert ended.stderr == f"adamslite: '{old}': File too large\n"
    assert old.read_text() == "# adamslite, old\n" and part.exists()
    done = resumed(part)
    assert done.returncode == 0 and old.read_bytes() == whole
    assert {*contents(tmp_path)} == {"deck.adm", "x.csv", "undisturbed.csv"}


@pytest.mark.slow
@pytest.mark.skipif(not CAREFUL, reason="the user may write anywhere")
def test_a_folder_that_is_read_only_when_a_run_is_resumed(part: Path) -> None:
    before = part.read_bytes()
    part.parent.chmod(0o500)
    try:
        ended = resumed(part, "", *CAREFUL)
    finally:
        part.parent.chmod(0o700)
    assert ended.returncode == 5
    assert "cannot be written there: no permission" in ended.stderr
    assert part.read_bytes() == before
    goes_on(part)


@pytest.mark.slow
@pytest.mark.skipif(not CAREFUL, reason="the user may write anywhere")
def test_a_file_that_may_not_be_written_is_named(part: Path) -> None:
    """As one of another user."""
    part.chmod(0o400)
    ended = resumed(part, "", *CAREFUL)
    assert ended.returncode == 5
    assert ended.stderr == f"adamslite: '{part}': Permission denied\n"
    part.chmod(0o600)
    goes_on(part)


@POSIX
@pytest.mark.slow
def test_a_folder_that_is_removed_under_a_run(tmp_path: Path) -> None:
    """Its results have no place any more: it says so, and puts nothing anywhere else."""
    folder = tmp_path / "there"
    folder.mkdir()
    deck = written(tmp_path, LONG)
    process = subprocess.Popen(
        command(str(deck), "-o", str(folder / "x.csv"), *FLAGS),
        stderr=subprocess.PIPE, text=True, cwd=tmp_path,
    )  # fmt: skip
    until_there_is_a_state(process, folder / "x.csv.part")
    shutil.rmtree(folder)
    error = process.communicate(timeout=240)[1]
    assert process.returncode == 5
    assert error == f"adamslite: '{folder / 'x.csv'}': No such file or directory\n"
    assert [each.name for each in tmp_path.iterdir()] == ["deck.adm"]


@POSIX
@pytest.mark.slow
def test_results_that_another_program_reads_are_replaced(part: Path) -> None:
    """The reader has the old file to its end, and the name is that of the new one."""
    old = part.with_name("x.csv")
    old.write_text("# adamslite, old\n" * 100_000)
    with open(old) as reader:
        first = reader.readline()
        goes_on(part)
        assert first + reader.read() == "# adamslite, old\n" * 100_000
    assert "old" not in old.read_text()


# ---- two at once -----------------------------------------------------------------------------


@POSIX
@pytest.mark.slow
@pytest.mark.parametrize("second", ["a new run", "a resumed one"])
def test_two_runs_into_one_name_of_which_one_is_resumed(part: Path, second: str) -> None:
    """The second one is refused, and the first one is not disturbed."""
    states = states_of(part)
    first = subprocess.Popen(
        command("--resume", str(part)), stderr=subprocess.PIPE, text=True, cwd=part.parent
    )
    until_there_is_a_state(first, part, states + 2)
    new = [str(part.with_name("deck.adm")), "-o", str(part.with_name("x.csv")), *FLAGS]
    words = new if second == "a new run" else ["--resume", str(part)]
    done = subprocess.run(command(*words), capture_output=True, text=True, cwd=part.parent)
    assert first.poll() is None, "the first run was over too early"
    assert done.returncode == 2 and "another run is writing" in done.stderr
    error = first.communicate(timeout=240)[1]
    assert first.returncode == 0, error
    assert part.with_name("x.csv").read_bytes() == solved(part.with_name("deck.adm"), *FLAGS)
    assert {each.name for each in part.parent.iterdir()} == {
        "deck.adm", "x.csv", "undisturbed.csv"
    }  # fmt: skip


# ---- clocks and caches -----------------------------------------------------------------------


PAST = ("ten years ago", "before 1970")


def clocked(clock: str) -> str:
    return f"import time\nreal = time.time\ntime.time = {CLOCKS[clock]}\n"


@pytest.mark.slow
@pytest.mark.parametrize("clock", [each for each in CLOCKS if each not in PAST])
def test_a_clock_that_jumps_while_a_run_is_resumed(part: Path, clock: str) -> None:
    """The same bytes, and states as often: what is due goes by a clock that cannot be put."""
    states = states_of(part)
    process = subprocess.Popen(
        [sys.executable, "-c", clocked(clock) + OFTEN, "solve", "--quiet", "--resume", str(part)],
        stderr=subprocess.PIPE, cwd=part.parent,
    )  # fmt: skip
    until_there_is_a_state(process, part, states + 5)
    process.kill()
    process.communicate()
    goes_on(part)


@pytest.mark.slow
@pytest.mark.parametrize("clock", PAST)
def test_a_clock_of_the_past_is_named_where_a_run_is_resumed(part: Path, clock: str) -> None:
    """The program is newer than its process: another version may have taken its place."""
    before = part.read_bytes()
    ended = resumed(part, clocked(clock))
    assert ended.returncode == 2 and "by the clock of this machine" in ended.stderr
    assert part.read_bytes() == before
    goes_on(part)


def test_a_cache_that_is_removed_under_a_run(cache: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """The secret of its states is put back: those before and after are all its own, and those of
    a process that resumes it.
    """
    monkeypatch.setattr(secret, "_held", [])
    before = secret.seal(b"a state")
    shutil.rmtree(cache)
    assert secret.seal(b"a state") == before
    monkeypatch.setattr(secret, "_held", [])
    assert secret.seal(b"a state") == before
