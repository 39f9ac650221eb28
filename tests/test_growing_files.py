"""Files of results that are written while their run lasts: the bytes of those written at the end.

    a mass on a spring, x = cos t, 4000 outputs: 52 000 numbers

The bounds are lowered so that a file is long from 3000 numbers on, and grows by 500.
"""

from __future__ import annotations

import os
import signal
import subprocess
import sys
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from unfinished_runs import OFTEN, command, solved, until_there_is_a_state
from unfinished_scenes import pendulum, rests, spring, written

from adamslite.analyses.dynamics.history import History, Piece
from adamslite.outputs import row_by_row
from adamslite.outputs.part_file import PartFile
from adamslite.outputs.row_by_row import Growing
from adamslite.results import results as results_of_runs
from adamslite.results.formats import format_of
from adamslite.results.outcomes import Outcome
from adamslite.results.results import Results

NAMES = ("PART/2.x", "PART/2.psi", "REQUEST/1.F2")
FORMATS = (".csv", ".nc", ".parquet")
ALL = (*FORMATS, ".req", ".res")
POSIX = pytest.mark.skipif(os.name != "posix", reason="a process of Windows gets no signal")


@pytest.fixture(autouse=True)
def _soon(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(row_by_row, "LONG", 300)
    monkeypatch.setattr(row_by_row, "SLICE", 50)
    monkeypatch.setattr(row_by_row, "SENT", 1000)
    monkeypatch.setattr(results_of_runs, "BLOCK", 60)


def results(count: int, names: tuple[str, ...] = NAMES, **facts: Any) -> Results:
    """Rows of numbers of all sizes."""
    numbers = np.random.default_rng(5).standard_normal((count, len(names) + 1))
    numbers *= 10.0 ** np.arange(-3, 3 * len(names), 3)
    found = {"meta": {"deck": "a spring", "units": "NEWTON KILOGRAM METER SECOND"}, **facts}
    return Results(time=np.arange(float(count)), names=names, values=numbers[:, 1:], **found)


def piece(found: Results, first: int, end: int) -> Piece:
    return Piece(found.time[first:end], found.names, found.values[first:end])


def growing(path: Path, patterns: tuple[str, ...] = ()) -> tuple[History, Any]:
    """A history that is followed by a file."""
    begin = format_of(path).growing
    assert begin is not None
    history, table = History(), begin(path, patterns)
    table.begun = lambda names: results(0, names)
    history.growing = [table]
    return history, table


def drafts(folder: Path) -> list[Path]:
    return [*folder.glob(".*.part")]


def kept_rows(part: Path) -> int:
    """How many rows an unfinished run begins with when it is resumed."""
    if not part.exists():
        return 0
    found = PartFile.open(part)
    found.close()
    return sum(count for _, _, count, _ in found.state["stretches"])


def same(path: Path, whole: Results) -> bool:
    """Whether a file has the bytes of one that was written at the end."""
    other = path.with_name(f"other{path.suffix}")
    whole.save(other)
    return path.read_bytes() == other.read_bytes()


LATE = {
    "done": {},
    "ended early": {"outcome": Outcome.CPU_LIMIT, "message": "at t = 3"},
    "with notes": {
        "meta": {"deck": "a spring", "accuracy": "small", "units": "NEWTON KILOGRAM METER SECOND"}
    },
}


@pytest.mark.parametrize("suffix", FORMATS)
@pytest.mark.parametrize("late", LATE)
def test_a_file_that_has_grown(tmp_path: Path, suffix: str, late: str) -> None:
    path, whole = tmp_path / f"x{suffix}", results(1000, **LATE[late])
    history, table = growing(path)
    for first in range(0, 990, 30):
        history.extend(piece(whole, first, first + 30))
    history.extend(piece(whole, 990, 1000))
    assert table.count >= 980 and len(drafts(tmp_path)) == 1 and not path.exists()
    assert table.finish(whole)
    assert not drafts(tmp_path) and same(path, whole)
    read = Results.load(path)
    assert (read.outcome, read.message) == (whole.outcome, whole.message)
    assert dict(read.meta) == dict(whole.meta)
    np.testing.assert_array_equal(read.values, whole.values)


@pytest.mark.parametrize("count", [1000, 300])
@pytest.mark.parametrize("suffix", FORMATS)
def test_rows_that_are_taken_back(tmp_path: Path, suffix: str, count: int) -> None:
    """A step that fails behind its first outputs, and another method that begins again, which may
    come to fewer rows.  Parquet knows no going back.
    """
    stays = suffix != ".parquet"
    path, whole, other = tmp_path / f"x{suffix}", results(1000), results(1000)
    other.values[:] = -1.0 / 3.0
    history, table = growing(path)
    for first in (0, 100):
        history.extend(piece(whole, first, first + 100))
    mark = history.mark()
    for first in range(200, 500, 30):
        history.extend(piece(other, first, first + 30))
    history.cut(100)
    assert 300 < table.count <= 400 if stays else table.count == 0
    for first in range(400, 900, 100):
        history.extend(piece(other, first, first + 100))
    assert table.count == 800
    history.return_to(mark)
    assert table.count == (200 if stays else 0)
    for first in range(200, count, 100):
        history.extend(piece(whole, first, first + 100))
    whole = Results(
        time=whole.time[:count], names=NAMES, values=whole.values[:count], meta=whole.meta
    )
    assert table.finish(whole) and same(path, whole)


@pytest.mark.parametrize("suffix", FORMATS)
def test_a_long_file_that_becomes_a_short_one(tmp_path: Path, suffix: str) -> None:
    """All rows were taken back, and few have come since: a table without its head would be written
    otherwise.
    """
    path, whole = tmp_path / f"x{suffix}", results(1000)
    history, table = growing(path)
    for first in (0, 500):
        history.extend(piece(whole, first, first + 500))
    history.return_to([])
    for first in range(0, 60, 20):
        history.extend(piece(whole, first, first + 20))
    few = Results(time=whole.time[:60], names=NAMES, values=whole.values[:60], meta=whole.meta)
    assert not table.finish(few) and [*tmp_path.iterdir()] == []


def test_motion_in_the_place_of_the_equilibrium_that_it_begins_from(tmp_path: Path) -> None:
    path, whole = tmp_path / "x.csv", results(1000)
    history, table = growing(path)
    history.append(piece(whole, 0, 401), static=False, after_rest=False)
    table.follow(history)
    assert table.count == 401
    rest = Piece(whole.time[400:], whole.names, -whole.values[400:])
    history.append(rest, static=False, after_rest=True)
    values = np.concatenate([whole.values[:400], -whole.values[400:]])
    there = Results(time=whole.time, names=NAMES, values=values, meta=whole.meta)
    assert table.finish(there) and same(path, there)


@pytest.mark.parametrize("suffix", FORMATS)
def test_some_columns(tmp_path: Path, suffix: str) -> None:
    path, whole = tmp_path / f"x{suffix}", results(1000)
    history, table = growing(path, ("PART/2.x", "REQUEST/*"))
    for first in range(0, 1000, 100):
        history.extend(piece(whole, first, first + 100))
    chosen = whole.limited([0, 2])
    assert table.finish(chosen) and same(path, chosen)


@pytest.mark.parametrize("suffix", FORMATS)
def test_columns_that_a_command_brings(tmp_path: Path, suffix: str) -> None:
    """Rows before it hold no number there; the file begins anew."""
    path, names = tmp_path / f"x{suffix}", (*NAMES, "REQUEST/2.F2")
    history, table = growing(path)
    for found in (results(500), results(500, names)):
        for first in range(0, 500, 100):
            history.extend(piece(found, first, first + 100))
    table_of_all = history.whole
    whole = Results(
        time=table_of_all.times, names=names, values=table_of_all.values, meta=results(0).meta
    )
    assert table.finish(whole) and same(path, whole)


@pytest.mark.parametrize("suffix", FORMATS)
@pytest.mark.parametrize(
    "facts",
    [{"meta": {"deck": "a spring", "units": "POUND_FORCE POUND_MASS INCH SECOND"}}, {"meta": {}}],
    ids=str,
)
def test_results_that_are_not_as_they_began(
    tmp_path: Path, suffix: str, facts: dict[str, Any]
) -> None:
    """Another method, whose name is shorter, has begun again: the head of a table has other bytes
    then, while that of NetCDF has room.
    """
    path, whole = tmp_path / f"x{suffix}", results(1000, **facts)
    history, table = growing(path)
    for first in (0, 500):
        history.extend(piece(whole, first, first + 500))
    if not table.finish(whole):
        assert not drafts(tmp_path)
        whole.save(path)
    assert same(path, whole)


def test_more_than_there_is_room_for(tmp_path: Path) -> None:
    """Of NetCDF the head then is longer than what was kept for it."""
    path, whole = tmp_path / "x.nc", results(1000, message="far " * 10_000)
    history, table = growing(path)
    for first in (0, 500):
        history.extend(piece(whole, first, first + 500))
    assert not table.finish(whole) and not drafts(tmp_path)
    whole.save(path)
    assert Results.load(path).message == whole.message


@pytest.mark.parametrize("end", [row_by_row.Growing.close, lambda table: table.finish(results(9))])
def test_nothing_is_left(tmp_path: Path, end: Callable[[Growing], Any]) -> None:
    history, table = growing(tmp_path / "x.csv")
    for first in (0, 500):
        history.extend(piece(results(1000), first, first + 500))
    assert drafts(tmp_path)
    end(table)
    assert [*tmp_path.iterdir()] == []


@pytest.mark.parametrize("fault", [OSError(28, "No space left on device"), MemoryError()], ids=repr)
def test_no_room(tmp_path: Path, fault: Exception) -> None:
    """The run goes on; whether there is room is seen again when it has ended."""

    def full(time: np.ndarray, values: np.ndarray, before: Any) -> Iterator[bytes]:
        yield b"1,2,3"
        raise fault

    history, table = growing(tmp_path / "x.csv")
    whole = results(1000)
    for first in range(0, 600, 100):
        history.extend(piece(whole, first, first + 100))
    assert drafts(tmp_path)
    table._writer = full
    history.extend(piece(whole, 600, 1000))
    assert not drafts(tmp_path) and history.count == 1000
    assert not table.finish(whole) and [*tmp_path.iterdir()] == []


def test_an_interruption_while_rows_are_written(tmp_path: Path) -> None:
    """Who adds them does so again: they are there once."""
    history, table = growing(tmp_path / "x.csv")
    whole = results(1000)
    for first in (0, 250):
        history.extend(piece(whole, first, first + 250))
    writer = table._writer

    def interrupted(*_: Any) -> Any:
        raise KeyboardInterrupt

    table._writer = interrupted
    with pytest.raises(KeyboardInterrupt):
        history.extend(piece(whole, 500, 1000))
    table._writer = writer
    history.extend(piece(whole, 500, 1000))
    assert table.finish(whole) and same(tmp_path / "x.csv", whole)


def test_a_short_table_is_not_begun(tmp_path: Path) -> None:
    history, table = growing(tmp_path / "x.csv")
    history.extend(piece(results(70), 0, 70))
    assert not drafts(tmp_path) and not table.finish(results(70))


# runs

CASES = {
    "a spring": (spring(400, 4000), "--error", "1e-6"),
    "two analyses": (rests(90, 3000), "--error", "1e-6"),
    "some columns": (pendulum(20, 3000), "--outputs", "PART/*", "--integrator", "HHT"),
    "confirmed": (spring(40, 2000), "--error", "1e-6", "--confirm"),
}


@pytest.mark.parametrize("suffix", ALL)
@pytest.mark.parametrize("case", CASES)
def test_a_run_writes_the_same_bytes(tmp_path: Path, case: str, suffix: str) -> None:
    text, *words = CASES[case]
    deck, output = written(tmp_path, text), tmp_path / f"grown{suffix}"
    done = subprocess.run(
        command(str(deck), "-o", str(output), *words), capture_output=True, text=True, cwd=tmp_path
    )
    assert done.returncode == 0, done.stderr
    assert output.read_bytes() == solved(deck, *words, suffix=suffix)
    assert not drafts(tmp_path)


COUNTED = """\
from adamslite.outputs import csv, netcdf, parquet, row_by_row
def finishing(whole):
    def finish(self, results):
        before = self.count
        done = whole(self, results)
        print(done, results.count - before, results.count)
        return done
    return finish
for kind in (row_by_row.GrowingFile, parquet.GrowingTable):
    kind.finish = finishing(kind.finish)
from adamslite.analyses.session import row_notes
row_notes.MOST_LOOKED_AT = 1000
"""


@POSIX
@pytest.mark.parametrize("suffix", (*FORMATS, ".res"))
def test_an_interrupted_run_has_little_left_to_write(tmp_path: Path, suffix: str) -> None:
    """However many rows there are: those of the block that was not full yet; what all of them show
    is not looked for.
    """
    deck, output = written(tmp_path, pendulum(4e5, 4_000_000)), tmp_path / f"x{suffix}"
    process = subprocess.Popen(
        [sys.executable, "-c", COUNTED + OFTEN, "solve", str(deck), "-o", str(output), "--quiet"],
        cwd=tmp_path, text=True, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
    )  # fmt: skip
    until_there_is_a_state(process, Path(f"{output}.part"), more=6)
    process.send_signal(signal.SIGTERM)
    told, error = process.communicate(timeout=60)
    assert process.returncode == 4, error
    grown, left, count = told.split()
    found = Results.load(output)
    blocks = int(left) * len(found.names) / 3000
    assert grown == "True" and blocks < 4 and int(left) < int(count)
    assert found.outcome is Outcome.INTERRUPTED and found.count == int(count)
    assert f"in {count} rows" in found.meta["not looked for"]
    assert not drafts(tmp_path)


@POSIX
def test_an_interrupted_run_is_neither_confirmed_nor_drawn(tmp_path: Path) -> None:
    """Witnesses would run to their ends; of a page all rows would be read."""
    deck, output = written(tmp_path, spring(4e5, 4_000_000)), tmp_path / "x.csv"
    few = "from adamslite.cli.commands import solve\nsolve.MOST_DRAWN = 1000\n"
    words = ["solve", str(deck), "-o", str(output), "--quiet", "--confirm", "--page"]
    process = subprocess.Popen(
        [sys.executable, "-c", few + OFTEN, *words],
        cwd=tmp_path, text=True, stderr=subprocess.PIPE,
    )  # fmt: skip
    until_there_is_a_state(process, Path(f"{output}.part"), more=6)
    process.send_signal(signal.SIGTERM)
    error = process.communicate(timeout=60)[1]
    assert process.returncode == 4 and "CONFIRMED" not in error
    assert f"{tmp_path / 'x.html'} is not written: the run was interrupted" in error
    assert sorted(each.name for each in tmp_path.iterdir()) == ["deck.adm", "x.csv", "x.csv.part"]


@pytest.mark.slow
@POSIX
@pytest.mark.parametrize("suffix", FORMATS)
def test_an_interruption_while_earlier_rows_are_written_again(tmp_path: Path, suffix: str) -> None:
    """A resumed run begins with them: there is nothing new yet, and what is there stays."""
    deck, output = written(tmp_path, spring(4e4, 400_000)), tmp_path / f"x{suffix}"
    part = Path(f"{output}.part")
    more = 3
    while kept_rows(part) < 1000:  # or there are too few for a file that grows
        part.unlink(missing_ok=True)
        process = subprocess.Popen(
            command(str(deck), "-o", str(output)), cwd=tmp_path, stderr=subprocess.PIPE
        )
        until_there_is_a_state(process, part, more)
        process.send_signal(signal.SIGTERM)
        assert process.communicate(timeout=60)[1] and process.returncode == 4
        more += 2
    before, whole = output.read_bytes(), solved(deck, suffix=suffix)
    asked = """\
import os, signal
from adamslite.outputs import row_by_row
row_by_row.Growing._send = lambda *_: os.kill(os.getpid(), signal.SIGINT)
"""
    again = subprocess.run(
        [sys.executable, "-c", asked + OFTEN, "solve", "--quiet", "--resume", str(part)],
        capture_output=True, text=True, cwd=tmp_path, timeout=60,
    )  # fmt: skip
    assert again.returncode == 4 and "--resume" in again.stderr, again.stderr
    assert output.read_bytes() == before and part.exists() and not drafts(tmp_path)
    last = subprocess.run(
        command("--resume", str(part)), capture_output=True, text=True, cwd=tmp_path, timeout=60
    )
    assert last.returncode == 0 and output.read_bytes() == whole
