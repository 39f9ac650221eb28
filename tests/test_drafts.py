"""Drafts that killed programs leave beside the files they were writing."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

from adamslite.cli.main import main
from adamslite.outputs.drafts import YOUNG, draft_of, remove_drafts
from adamslite.outputs.whole_files import whole_file

WRITES = """\
import sys, time
from adamslite.outputs.whole_files import whole_file
with whole_file(sys.argv[1]) as stream:
    stream.write("half of it")
    stream.flush()
    print("written", flush=True)
    time.sleep(600)
"""
POSIX = pytest.mark.skipif(os.name != "posix", reason="Windows lets nobody remove an open file")


def aged(path: Path, age: float = 2 * YOUNG) -> Path:
    os.utime(path, (time.time() - age,) * 2)
    return path


def names(folder: Path) -> set[str]:
    return {each.name for each in folder.iterdir()}


@POSIX
def test_a_draft_goes_when_its_writer_has_been_killed(tmp_path: Path) -> None:
    writer = subprocess.Popen(
        [sys.executable, "-c", WRITES, str(tmp_path / "x.csv")], stdout=subprocess.PIPE
    )
    assert writer.stdout is not None and writer.stdout.readline() == b"written\n"
    (draft,) = tmp_path.iterdir()
    remove_drafts(tmp_path / "x.csv")
    aged(draft)
    remove_drafts(tmp_path / "x.csv")
    assert draft.exists()
    writer.send_signal(signal.SIGKILL)
    writer.communicate()
    remove_drafts(tmp_path / "y.csv")
    assert draft.exists()
    remove_drafts(tmp_path / "x.csv")
    assert not draft.exists()


def test_the_next_run_of_a_name_takes_drafts_away(tmp_path: Path) -> None:
    deck = tmp_path / "x.adm"
    deck.write_text(
        "a mass that falls\nPART/1, GROUND\nACCGRAV/JGRAV=-9.81\n"
        "POINT_MASS/2, MASS=1, CM=2\nMARKER/2, POINT_MASS=2\n"
        "SIMULATE/DYNAMIC, END=1, STEPS=2\nEND\n"
    )
    output = tmp_path / "x.csv"
    kept = (".x.csv.part", ".x.csv.swp", ".x.csv.0123ABCD.part", ".y.csv.0123abcd.part")
    for name in (draft_of(output).name, ".x.csv.part.0123abcd.part", *kept):
        (tmp_path / name).write_text("half")
        aged(tmp_path / name)
    assert main(["solve", str(deck), "-o", str(output), "--quiet"]) == 0
    assert names(tmp_path) == {"x.adm", "x.csv", *kept}


@pytest.mark.parametrize("age", [0.0, YOUNG / 2, -YOUNG / 2])
def test_a_young_draft_stays(tmp_path: Path, age: float) -> None:
    """It is empty as long as nobody has locked it."""
    draft = draft_of(tmp_path / "x.csv")
    draft.touch()
    aged(draft, age)
    remove_drafts(tmp_path / "x.csv")
    assert draft.exists()


@POSIX
def test_a_young_draft_that_nobody_writes_goes(tmp_path: Path) -> None:
    """What a killed program has left may have many gigabytes: the next run needs their room."""
    draft = draft_of(tmp_path / "x.csv")
    draft.write_text("half")
    remove_drafts(tmp_path / "x.csv")
    assert not draft.exists()


@POSIX
def test_a_draft_gets_its_name_while_it_is_locked(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Another run of that name may look for drafts in between."""
    replace = os.replace

    def replaced(draft: Path, target: Path) -> None:
        remove_drafts(target)
        replace(draft, target)

    monkeypatch.setattr(os, "replace", replaced)
    with whole_file(tmp_path / "x.csv") as stream:
        stream.write("whole")
    assert (tmp_path / "x.csv").read_text() == "whole"


def test_a_draft_of_the_future_goes(tmp_path: Path) -> None:
    """A clock that was put back does not keep it."""
    draft = draft_of(tmp_path / "x.csv")
    draft.write_text("half")
    aged(draft, -1e8)
    remove_drafts(tmp_path / "x.csv")
    assert not draft.exists()


@POSIX
def test_what_is_no_file_stays(tmp_path: Path) -> None:
    """Neither links nor folders, pipes least of all, are what this program writes."""
    other = tmp_path / "other"
    other.write_text("of others")
    (tmp_path / ".x.csv.00000000.part").symlink_to(other)
    (tmp_path / ".x.csv.00000001.part").mkdir()
    os.mkfifo(tmp_path / ".x.csv.00000002.part")
    for each in tmp_path.glob(".x.csv.*"):
        os.utime(each, (0, 0), follow_symlinks=False)
    before = names(tmp_path)
    remove_drafts(tmp_path / "x.csv")
    assert names(tmp_path) == before and other.read_text() == "of others"


def test_a_folder_that_is_not_there_is_no_fault(tmp_path: Path) -> None:
    remove_drafts(tmp_path / "nowhere" / "x.csv")


def test_a_file_that_is_written_meanwhile_is_whole(tmp_path: Path) -> None:
    with whole_file(tmp_path / "x.csv") as stream:
        stream.write("first")
        (draft,) = tmp_path.iterdir()
        aged(draft)
        remove_drafts(tmp_path / "x.csv")
        stream.write(" and second")
    assert (tmp_path / "x.csv").read_text() == "first and second"
