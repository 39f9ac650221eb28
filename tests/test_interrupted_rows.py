"""Interruptions while rows are kept: at every line, each row is there once, as it was found.

Analyses that solve their output times in turn keep their rows in the thread that signals reach.
"""

from __future__ import annotations

import gc
import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from types import FrameType
from typing import Any

import numpy as np
import pytest
from test_growing_files import growing, piece, results, same
from unfinished_scenes import cranked, lowered, spring, written

from adamslite.analyses.dynamics import dynamic, history
from adamslite.analyses.session.session_state import SessionState
from adamslite.cli.main import main as command
from adamslite.native.worker import Worker
from adamslite.outputs import parquet, row_by_row
from adamslite.outputs.part_file import PartFile
from adamslite.results import results as results_of_runs
from adamslite.results.outcomes import Outcome
from adamslite.results.results import Results

#: Modules that keep rows.
KEEPING = tuple(
    str(Path(*each))
    for each in (
        ("outputs", "row_by_row.py"), ("outputs", "parquet.py"), ("outputs", "part_file.py"),
        ("dynamics", "history.py"), ("session", "session_state.py"),
    )
)  # fmt: skip


@contextmanager
def at_line(number: int, fault: type[BaseException]) -> Iterator[list[int]]:
    """Raise ``fault`` at that line of the modules that keep rows; how many there were."""
    lines = [0]

    def trace(frame: FrameType, event: str, _: Any) -> Any:
        if not frame.f_code.co_filename.endswith(KEEPING):
            return None
        if event == "line":
            lines[0] += 1
            if lines[0] == number:
                sys.settrace(None)
                raise fault
        return trace

    before = sys.gettrace()
    sys.settrace(trace)
    try:
        yield lines
    finally:
        sys.settrace(before)


@pytest.fixture(autouse=True)
def _soon(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(row_by_row, "LONG", 300)
    monkeypatch.setattr(row_by_row, "SLICE", 50)
    monkeypatch.setattr(row_by_row, "BLOCK", 100)
    monkeypatch.setattr(row_by_row, "SENT", 1000)
    monkeypatch.setattr(results_of_runs, "BLOCK", 60)
    monkeypatch.setattr(dynamic, "ROOM", 600)


@pytest.mark.parametrize(
    "suffix", [".csv", ".nc", pytest.param(".parquet", marks=pytest.mark.slow)]
)
def test_whoever_adds_rows_again(tmp_path: Path, suffix: str) -> None:
    """Blocks are written, given back and written; interrupted at each line of that in turn."""
    path, whole = tmp_path / f"x{suffix}", results(400)

    def add(kept: history.History, first: int, end: int) -> None:
        before = list(kept.stretches)
        try:
            kept.extend(piece(whole, first, end))
        except KeyboardInterrupt:
            kept.return_to(before)
            kept.extend(piece(whole, first, end))

    number, lines = 0, [1]
    while number <= lines[0]:
        number += 1
        kept, table = growing(path)
        add(kept, 0, 150)
        with at_line(number, KeyboardInterrupt) as lines:
            add(kept, 150, 300)
            add(kept, 300, 350)
        add(kept, 350, 400)
        assert table.count >= 300
        assert table.finish(whole), number
        assert same(path, whole), number
    assert number > 50


def test_a_group_whose_call_is_lost_is_written_once(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """An interruption between the beginning of a call and the next statement: nobody knows of it,
    and it writes.
    """
    kept, table = growing(tmp_path / "x.parquet")
    whole, begun = results(400), []

    def lost(call: Any) -> Worker[Any]:
        begun.append(Worker(call))
        if len(begun) == 3:
            raise KeyboardInterrupt
        return begun[-1]

    monkeypatch.setattr(parquet, "Worker", lost)
    for first in range(0, 400, 50):
        before = list(kept.stretches)
        try:
            kept.extend(piece(whole, first, first + 50))
        except KeyboardInterrupt:
            kept.return_to(before)
            kept.extend(piece(whole, first, first + 50))
    assert len(begun) > 5 and table.count >= 300
    assert table.finish(whole) and same(tmp_path / "x.parquet", whole)


@pytest.mark.parametrize("part", ["_write", "end"])
@pytest.mark.parametrize("fault", [KeyboardInterrupt, MemoryError, OSError], ids=str)
@pytest.mark.parametrize("grown", [True, False])
def test_a_table_that_is_not_ended_is_given_up(
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    grown: bool,
    fault: type[BaseException],
    part: str,
) -> None:
    """Arrow would end it when it is collected, in a stream that is closed, and say so with a
    traceback.
    """
    kept, table = growing(tmp_path / "x.parquet")
    whole, ignored = results(400), []
    for first in range(0, 400, 50):
        kept.extend(piece(whole, first, first + 50))

    def failing(*_: Any) -> None:
        raise fault

    monkeypatch.setattr(sys, "unraisablehook", ignored.append)
    monkeypatch.setattr(parquet._Table, part, failing)
    met = False
    try:
        if grown:
            table.finish(whole)
        else:
            whole.save(tmp_path / "y.parquet")
    except fault:
        met = True
    table.close()
    gc.collect()
    assert met and not ignored and [*tmp_path.iterdir()] == []


SERIES = {"equilibria": lowered(400), "postures": cranked(2, 400)}


@pytest.mark.slow
@pytest.mark.parametrize("fault", [KeyboardInterrupt, MemoryError])
@pytest.mark.parametrize("series", SERIES)
def test_a_series_has_each_row_once(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, series: str, fault: type[BaseException]
) -> None:
    """What there is when a full block is being kept: rows of the undisturbed run, from the first
    one on, none of them twice.
    """
    deck, output = written(tmp_path, SERIES[series]), tmp_path / "x.csv"
    words = ["solve", str(deck), "-o", str(output), "--quiet"]
    assert command(words) == 0
    whole = Results.load(output)
    spill, calls, number = SessionState.spill, [0], 0
    lines = [1]

    def spilled(self: Any, *words: Any) -> None:
        nonlocal lines
        calls[0] += 1
        if calls[0] != 3:
            spill(self, *words)
            return
        with at_line(number, fault) as lines:
            spill(self, *words)

    monkeypatch.setattr(SessionState, "spill", spilled)
    met = 0
    while number <= lines[0]:
        number, calls[0] = number + 1, 0
        code = command(words)
        found = Results.load(output)
        met += found.outcome is not Outcome.DONE
        assert code == (0 if found.outcome is Outcome.DONE else 4)
        assert 0 < found.count <= whole.count, number
        np.testing.assert_array_equal(found.time, whole.time[: found.count], str(number))
        np.testing.assert_array_equal(found.values, whole.values[: found.count], str(number))
        Path(f"{output}.part").unlink(missing_ok=True)
        assert sorted(each.name for each in tmp_path.iterdir()) == ["deck.adm", "x.csv"]
    assert calls[0] > 3 and met > 5


def test_rows_on_their_way_to_the_file_of_the_run(tmp_path: Path) -> None:
    whole, number, lines = results(400), 0, [1]
    while number <= lines[0]:
        number += 1
        kept = history.History()
        for first in range(0, 300, 100):
            kept.extend(piece(whole, first, first + 100))
        part = PartFile.nameless(tmp_path)
        with at_line(number, KeyboardInterrupt) as lines, suppress(KeyboardInterrupt):
            kept.file(part)
        kept.extend(piece(whole, 300, 400))
        table = kept.whole
        np.testing.assert_array_equal(table.times, whole.time, str(number))
        np.testing.assert_array_equal(table.values, whole.values, str(number))
        part.close()
    assert number > 20


CUT = """\
import sys
from pathlib import Path
from adamslite.__main__ import main
from adamslite.outputs import whole_files
lock, unlink = whole_files.lock, Path.unlink
def again(self, missing_ok=False):
    Path.unlink = unlink
    raise KeyboardInterrupt
def interrupted(stream):
    if Path(stream.name).name.startswith(".x."):
        Path.unlink = again
        raise KeyboardInterrupt
    return lock(stream)
whole_files.lock = interrupted
sys.exit(main())
"""


@pytest.mark.parametrize("suffix", [".csv", ".mat"])
def test_nothing_is_left_of_a_draft_whose_removal_is_interrupted(
    tmp_path: Path, suffix: str
) -> None:
    """Ctrl-C while the results are written, and again: the draft goes when the process ends."""
    deck, output = written(tmp_path, spring(1, 10)), tmp_path / f"x{suffix}"
    done = subprocess.run(
        [sys.executable, "-c", CUT, "solve", str(deck), "-o", str(output)],
        capture_output=True, text=True, cwd=tmp_path,
    )  # fmt: skip
    assert done.returncode == 4 and done.stderr.endswith("adamslite: interrupted\n"), done.stderr
    assert [each.name for each in tmp_path.iterdir()] == ["deck.adm"]
