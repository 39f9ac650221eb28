"""Runs that are killed and resumed, with states every few hundredths of a second."""

from __future__ import annotations

import os
import random
import signal
import subprocess
import sys
import time
from pathlib import Path

from unfinished_scenes import written

from adamslite.outputs.part_file import FIRST, RECORD, RECORDS, PartFile

#: A file of results is a long one, with what the run has found behind its rows, from here on; those
#: that are written by blocks have small ones.
LONG = """\
import sys
from adamslite.outputs import row_by_row
from adamslite.results import results
row_by_row.LONG = results.BLOCK = 3000
"""
#: The command line with states from the start on, and small blocks, which writes long files while
#: the run lasts.
OFTEN = f"""\
{LONG}
row_by_row.SLICE = 500
from adamslite.analyses.dynamics import dynamic, history
history.SETTLED, history.EVERY, history.LONG, dynamic.ROOM = 0.0, 0.02, 0.3, 3000
dynamic.WATCH_INTERVAL = 0.02
from adamslite.__main__ import main
sys.exit(main())
"""
#: The command line that writes all files at the end.
AT_ONCE = f"""\
{LONG}
row_by_row.Growing.follow = lambda self, rows: None
from adamslite.__main__ import main
sys.exit(main())
"""
#: The process ends in the middle of its n-th write to the file of the run.
ENDING = """\
import os, signal
from adamslite.outputs.part_file import PartFile
whole, calls = PartFile._write, []
def half(self, at, data):
    calls.append(at)
    if len(calls) == {at}:
        whole(self, at, data[: len(data) // 2])
        self._stream.flush()
        os.kill(os.getpid(), signal.SIGKILL)
    whole(self, at, data)
PartFile._write = half
"""
#: A start takes longer than this only where something hangs [s].
PATIENCE = 240.0


def command(*words: str, at: int = 0) -> list[str]:
    """`adamslite solve` with states from the start on; killed in a write to its file."""
    program = f"{ENDING.format(at=at)}{OFTEN}" if at else OFTEN
    return [sys.executable, "-c", program, "solve", "--quiet", *words]


def solved(deck: Path, *words: str, suffix: str = ".csv") -> bytes:
    """The table of an undisturbed run, written at its end."""
    output = deck.with_name(f"undisturbed{suffix}")
    whole = [sys.executable, "-c", AT_ONCE, "solve", "--quiet", str(deck), "-o", str(output)]
    done = subprocess.run([*whole, *words], capture_output=True, text=True, cwd=deck.parent)
    assert done.returncode == 0, done.stderr
    return output.read_bytes()


def killed(deck: Path, seed: int, kills: int, *words: str) -> tuple[bytes, int]:
    """The table of a run that is killed ``kills`` times at random instants, and each time resumed;
    how often it was alive then.
    """
    chance, output = random.Random(seed), deck.with_name(f"killed{seed}.csv")
    part, hits = Path(f"{output}.part"), 0
    output.unlink(missing_ok=True)
    for kill in range(kills):
        # The first is at once: however fast a processor is, some kill meets a run.
        went_on, after = part.exists(), chance.uniform(0.0, 0.4) if kill else 0.0
        hits += _kill(_words(deck, output, part, words), part, went_on, after)
        if output.exists() and not part.exists():
            break
    if part.exists() or not output.exists():  # it may have been killed between both
        done = subprocess.run(
            _words(deck, output, part, words), capture_output=True, text=True, cwd=deck.parent
        )
        assert done.returncode == 0, done.stderr
    assert not part.exists()
    return output.read_bytes(), hits


def _words(deck: Path, output: Path, part: Path, words: tuple[str, ...]) -> list[str]:
    if part.exists():
        return command("--resume", str(part))
    return command(str(deck), "-o", str(output), *words)


def _kill(words: list[str], part: Path, went_on: bool, after: float) -> bool:
    """Start a run, and kill it some time after there is a state; whether it was still running."""
    process = subprocess.Popen(words, cwd=part.parent, stderr=subprocess.PIPE)
    before = part.stat().st_mtime_ns if went_on else 0
    end = time.monotonic() + PATIENCE
    while process.poll() is None and time.monotonic() < end:
        if part.exists() and part.stat().st_size > 4096 and part.stat().st_mtime_ns != before:
            time.sleep(after)
            break
        time.sleep(0.005)
    alive = process.poll() is None
    if alive:
        os.kill(process.pid, signal.SIGKILL)
    error = process.communicate()[1]
    assert alive or process.returncode == 0, error.decode()
    return alive


def left_behind(folder: Path, text: str, *words: str) -> Path:
    """The file of a run that was killed, with rows before its last state: x.csv.part."""
    deck, output = written(folder, text), folder / "x.csv"
    part = Path(f"{output}.part")
    for _ in range(20):
        process = subprocess.Popen(
            command(str(deck), "-o", str(output), *words), stderr=subprocess.PIPE, cwd=folder
        )
        until_there_is_a_state(process, part)
        process.kill()
        process.communicate()
        killed = PartFile.open(part)
        rows = killed.state["stretches"]
        killed.close()
        if rows:
            return part
        part.unlink()  # killed before rows were made sure of
    raise AssertionError("no row was kept")


def until_there_is_a_state(process: subprocess.Popen[bytes], part: Path, more: int = 3) -> int:
    """Wait for the n-th state; how many there are.  The first one is of a run without rows."""
    end = time.monotonic() + PATIENCE
    while process.poll() is None and time.monotonic() < end:
        if part.exists() and (serial := states_of(part)) >= more:
            return serial
        time.sleep(0.01)
    raise AssertionError(process.communicate())


def states_of(part: Path) -> int:
    """How many states have counted."""
    with open(part, "rb") as file:
        head = file.read(FIRST).ljust(FIRST, b"\0")
    return max(RECORD.unpack_from(head, at)[0] for at in RECORDS)
