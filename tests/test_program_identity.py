"""The name of the program that is part of every kept entry: any change of a source changes it."""

from __future__ import annotations

import os
import sys
import time
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest
from replacing import replaced

import adamslite
from adamslite import resources
from adamslite.caching import program


@pytest.fixture
def sources(tmp_path: Path, cache: Path, monkeypatch) -> Iterator[list[str]]:
    """Folders like those of the program, and a library, written long before this process began."""
    for name in ("package/a.py", "package/room/b.py", "grammar/deck.lark", "numpy/version.py"):
        (tmp_path / name).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / name).write_text(f"# {name} 1")
    monkeypatch.setattr(adamslite, "STARTED", float("inf"))
    monkeypatch.setattr(program, "TICK", 0.0)
    yield [str(tmp_path / name) for name in ("package", "grammar", "numpy/version.py")]


CHANGES: dict[str, Callable[[Path], object]] = {
    "content": lambda at: replaced(at / "package/a.py", "1", "2"),
    "content deeper": lambda at: replaced(at / "package/room/b.py", "1", "2"),
    "grammar": lambda at: replaced(at / "grammar/deck.lark", "1", "2"),
    "library": lambda at: replaced(at / "numpy/version.py", "1", "2"),
    "new module": lambda at: (at / "package/room/c.py").write_text(""),
    "module gone": lambda at: (at / "package/room/b.py").unlink(),
    "module renamed": lambda at: (at / "package/a.py").rename(at / "package/b.py"),
    "file swapped": lambda at: (
        (at / "new").write_text("# package/a.py 3"), (at / "new").rename(at / "package/a.py"),
    ),
}  # fmt: skip


@pytest.mark.parametrize("change", CHANGES)
def test_any_change_of_the_program_gives_it_another_name(change, sources, tmp_path) -> None:
    """Also one that keeps size and time of a file, as some tools do that install."""
    before = program.identity_of(sources)
    assert before and program.identity_of(sources) == before
    CHANGES[change](tmp_path)
    assert program.identity_of(sources) != before


def test_what_is_no_source_does_not_count(sources, tmp_path) -> None:
    before = program.identity_of(sources)
    (tmp_path / "package/__pycache__").mkdir()
    (tmp_path / "package/__pycache__/a.py").write_text("")
    (tmp_path / "package/notes.txt").write_text("")
    assert program.identity_of(sources) == before


def test_the_name_is_that_of_the_contents_whatever_their_times(sources, tmp_path) -> None:
    before = program.identity_of(sources)
    os.utime(tmp_path / "package/a.py", (1e9, 1e9))
    assert program.identity_of(sources) == before


def test_a_file_newer_than_the_process_leaves_no_name(sources, monkeypatch) -> None:
    monkeypatch.setattr(adamslite, "STARTED", time.time() - 60.0)
    assert program.identity_of(sources) == ""


def test_files_that_have_just_changed_are_read_each_time(sources, tmp_path, monkeypatch) -> None:
    """Two changes within a tick of the clock may have equal times."""
    monkeypatch.setattr(program, "TICK", 60.0)
    facts = os.stat(tmp_path / "package/a.py")
    before = program.identity_of(sources)
    replaced(tmp_path / "package/a.py", "1", "2")
    stat = os.stat
    monkeypatch.setattr(os, "stat", lambda p: facts if str(p).endswith("a.py") else stat(p))
    assert program.identity_of(sources) != before


def test_the_program_covers_every_module_that_is_loaded(tmp_path: Path) -> None:
    places = [program.PACKAGE, str(resources.find("grammar"))]
    covered = {*program._files(places)}
    loaded = [getattr(m, "__file__", None) for n, m in sys.modules.items() if "adamslite" in n]
    assert {f for f in loaded if f and Path(f).is_relative_to(program.PACKAGE)} <= covered
    assert {*map(str, Path(places[1]).glob("*.lark"))} <= covered
    assert all(Path(file).is_file() for file in program.library_files())
    assert len(program.library_files()) == len(program.LIBRARIES)


def test_a_program_replaced_while_it_is_read_leaves_no_name(sources, tmp_path, monkeypatch) -> None:
    digest = program.content_digest

    def read(paths):
        found = digest(paths)
        replaced(tmp_path / "package/a.py", "1", "2")
        return found

    monkeypatch.setattr(program, "content_digest", read)
    assert program.identity_of(sources) == ""
    monkeypatch.setattr(program, "content_digest", digest)
    assert program.identity_of(sources) == digest(sorted(program._files(sources)))
