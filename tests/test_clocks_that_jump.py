"""The clock of the machine is put forward and back by years, before and during a run."""

from __future__ import annotations

import os
import time
from pathlib import Path

import pytest
from writing_commands import DECK, RUN, adamslite, contents

from adamslite.caching import entries
from adamslite.caching.contents import DAY, DRAFT

YEAR = 365.25 * DAY
CLOCKS = {
    "ten years ago": "lambda: real() - 10 * 31557600",
    "in ten years": "lambda: real() + 10 * 31557600",
    "before 1970": "lambda: -1e9 + real() % 1000",
    "put back while it runs": "lambda turns=iter(range(10**9)): real() - 31557600 * next(turns)",
    "put forward while it runs": "lambda turns=iter(range(10**9)): real() + 31557600 * next(turns)",
    "stopped": "lambda now=real(): now",
}


@pytest.mark.slow
@pytest.mark.parametrize("clock", CLOCKS)
def test_a_run_has_the_same_bytes(clock: str, cache: Path, tmp_path: Path) -> None:
    """Twice from one cache, which the second run finds in the state that the first has left."""
    (tmp_path / "swing.adm").write_text(DECK.format(requested=RUN))
    assert adamslite(tmp_path, ["solve", "swing.adm", "-o", "right.csv"]).returncode == 0
    before = f"import time\nreal = time.time\ntime.time = {CLOCKS[clock]}\n"
    for _ in range(2):
        done = adamslite(tmp_path, ["solve", "swing.adm", "-o", "out.csv", "--quiet"], before)
        assert done.returncode == 0, done.stderr
        assert (tmp_path / "out.csv").read_bytes() == (tmp_path / "right.csv").read_bytes()
    assert not [name for name in contents(tmp_path) if name.endswith((".lock", ".part"))]


@pytest.mark.slow
def test_files_of_the_future_are_read(cache: Path, tmp_path: Path) -> None:
    """A deck and entries whose times are ten years ahead."""
    deck = tmp_path / "swing.adm"
    deck.write_text(DECK.format(requested=RUN))
    tables = []
    for _ in range(3):
        for path in (deck, *cache.iterdir()):
            os.utime(path, (time.time() + 10 * YEAR,) * 2)
        done = adamslite(tmp_path, ["solve", "swing.adm", "--quiet"])
        assert (done.returncode, done.stderr) == (0, "")
        tables.append((tmp_path / "swing.csv").read_bytes())
    assert len({*tables}) == 1


def entry(cache: Path, number: int, age: float) -> Path:
    path = cache / f"k{number:032x}.o"
    entries.store(path, bytes(1000))
    os.utime(path, (time.time() - age,) * 2)
    return path


def test_an_entry_of_the_future_is_not_kept_for_ever(cache: Path) -> None:
    """It counts as used when it is first seen, so that what is used later outlives it."""
    ahead, old = entry(cache, 1, -10 * YEAR), entry(cache, 2, 3 * DAY)
    entries.trim(cache, 1e6)
    assert abs(ahead.stat().st_mtime - time.time()) < 100.0
    assert abs(old.stat().st_mtime - time.time() + 3 * DAY) < 100.0


def test_an_entry_of_the_future_that_is_used_gets_the_time_of_now(cache: Path) -> None:
    ahead = entry(cache, 1, -10 * YEAR)
    assert entries.find(ahead.name) == bytes(1000)
    assert abs(ahead.stat().st_mtime - time.time()) < 100.0


def test_a_draft_of_the_future_goes(cache: Path) -> None:
    draft = cache / f".k{1:032x}.o.1-1.part"
    assert DRAFT.fullmatch(draft.name)
    draft.write_bytes(b"")
    os.utime(draft, (time.time() + YEAR,) * 2)
    entries.trim(cache, 1e6)
    assert not draft.exists()
