"""The folder of what is kept: nobody else may write there."""

from __future__ import annotations

import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

import adamslite
from adamslite.caching import folder
from adamslite.caching.entries import recall, sealed

UNIX = pytest.mark.skipif(not folder.HAS_OWNERS, reason="modes and owners of Unix")
OWNER = os.geteuid() if folder.HAS_OWNERS else 0
NAME, CONTENT = "k" + "0" * 32 + ".o", b"made by this process"


@UNIX
def test_a_new_folder_is_closed_to_others(cache, tmp_path, monkeypatch) -> None:
    monkeypatch.setenv("ADAMSLITE_CACHE", str(tmp_path / "new"))
    assert folder.cache_folder() == (tmp_path / "new").resolve()
    assert (tmp_path / "new").stat().st_mode & 0o777 == 0o700


@UNIX
@pytest.mark.parametrize("mode", (0o770, 0o707, 0o777, 0o1777))
def test_a_chosen_folder_that_others_may_write_to_is_not_used(
    mode, cache, tmp_path, monkeypatch, caplog
) -> None:
    monkeypatch.setattr("tempfile.tempdir", str(tmp_path))
    cache.chmod(mode)
    used = folder.cache_folder()
    assert used == tmp_path.resolve() / f"adamslite-{os.geteuid()}"
    assert used.stat().st_mode & 0o777 == 0o700
    assert caplog.messages == [
        f"adamslite: the cache folder {cache} can be written to by others (chmod go-w {cache}): "
        f"{used} is used instead"
    ]
    assert folder.cache_folder() == used and len(caplog.messages) == 1


@UNIX
def test_a_folder_that_others_may_replace_is_not_used(cache, tmp_path, monkeypatch, caplog) -> None:
    """In a folder with the sticky bit, as that for temporary files, they may not."""
    monkeypatch.setattr("tempfile.tempdir", str(tmp_path))
    open_to_all = tmp_path / "open"
    open_to_all.mkdir()
    open_to_all.chmod(0o1777)
    monkeypatch.setenv("ADAMSLITE_CACHE", str(open_to_all / "cache"))
    assert folder.cache_folder() == open_to_all.resolve() / "cache" and not caplog.messages
    open_to_all.chmod(0o777)
    folder._settled.cache_clear()
    assert folder.cache_folder() != open_to_all.resolve() / "cache"
    assert "can be replaced by others" in caplog.text


@UNIX
def test_the_usual_folder_is_taken_back_from_others(cache, monkeypatch, caplog) -> None:
    """Earlier versions made it with the user's mask; what others may have put there is dropped."""
    usual = cache / "adamslite"
    usual.mkdir()
    (usual / NAME).write_bytes(sealed(NAME, b"forged"))
    usual.chmod(0o775)
    monkeypatch.delenv("ADAMSLITE_CACHE")
    monkeypatch.setattr(folder, "usual_folder", lambda: usual)
    assert recall(NAME, lambda: CONTENT) == CONTENT
    assert usual.stat().st_mode & 0o777 == 0o700
    assert len(caplog.messages) == 1 and "emptied and closed" in caplog.text


@UNIX
@pytest.mark.parametrize("given", ["", "cache", "./cache"])
def test_the_usual_folder_is_never_the_current_one(given, tmp_path, monkeypatch) -> None:
    """Where a deck may have brought entries along; an empty variable counts as none."""
    monkeypatch.chdir(tmp_path)
    (tmp_path / "adamslite").mkdir()
    monkeypatch.setenv("XDG_CACHE_HOME", given)
    assert folder.usual_folder().is_absolute()
    assert not folder.usual_folder().is_relative_to(tmp_path)


@UNIX
@pytest.mark.parametrize("way", ["group", "owner"])
def test_a_folder_in_one_of_others_is_not_used(way, cache, tmp_path, monkeypatch, caplog) -> None:
    """Whoever owns a folder, or may write to it, can put others in the place of those in it."""
    monkeypatch.setattr("tempfile.tempdir", str(tmp_path))
    shared = tmp_path / "shared"
    shared.mkdir()
    monkeypatch.setenv("ADAMSLITE_CACHE", str(shared / "cache"))
    if way == "group":
        shared.chmod(0o775)
    elif OWNER == 0:
        os.chown(shared, 12345, 12345)
    else:
        pytest.skip("only the administrator gives folders away")
    assert folder.cache_folder() != shared.resolve() / "cache"
    assert "can be replaced by" in caplog.text


@UNIX
@pytest.mark.parametrize("way", ["group", "world", "owner"])
def test_an_entry_that_others_could_write_to_is_not_used(way, cache, caplog) -> None:
    """The folder lets others look, and the mask of an earlier process let them write."""
    cache.chmod(0o755)
    entry = cache / NAME
    entry.write_bytes(sealed(NAME, b"forged"))
    if way == "owner":
        if OWNER != 0:
            pytest.skip("only the administrator gives files away")
        os.chown(entry, 12345, 12345)
    else:
        entry.chmod(0o664 if way == "group" else 0o646)
    assert recall(NAME, lambda: CONTENT) == CONTENT
    assert "is rebuilt: others could write to it" in caplog.text
    assert entry.stat().st_mode & 0o777 == 0o600 and entry.stat().st_uid == OWNER


def pipe(entry: Path) -> None:
    os.mkfifo(entry, 0o600)


def endless(entry: Path) -> None:
    entry.symlink_to("/dev/zero")


def device(entry: Path) -> None:
    """Whose owner is trusted, and nobody else may write to it."""
    entry.symlink_to("/proc/self/pagemap")


def terabyte(entry: Path) -> None:
    entry.write_bytes(sealed(NAME, CONTENT))
    os.truncate(entry, 1 << 40)
    entry.chmod(0o600)


@UNIX
@pytest.mark.parametrize("trap", [pipe, endless, device, terabyte, Path.mkdir])
def test_what_is_no_entry_is_neither_waited_for_nor_read(trap, cache, caplog) -> None:
    trap(cache / NAME)
    assert recall(NAME, lambda: CONTENT) == CONTENT
    assert len(caplog.messages) == 1 and "is rebuilt" in caplog.text
    assert ("it is no file" in caplog.text) == (trap in (pipe, endless))
    assert trap == Path.mkdir or (cache / NAME).read_bytes() == sealed(NAME, CONTENT)


@UNIX
def test_entries_are_closed_whatever_the_mask(cache) -> None:
    before = os.umask(0)
    try:
        recall(NAME, lambda: CONTENT)
    finally:
        os.umask(before)
    assert (cache / NAME).stat().st_mode & 0o777 == 0o600


def nowhere(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> Path:
    """No folder can be made where the variable says; temporary files go to ``tmp_path``."""
    (tmp_path / "file").write_text("")
    monkeypatch.setenv("ADAMSLITE_CACHE", str(tmp_path / "file" / "cache"))
    monkeypatch.setattr("tempfile.tempdir", str(tmp_path))
    return tmp_path.resolve() / (f"adamslite-{os.geteuid()}" if folder.HAS_OWNERS else "cache")


@UNIX
def test_the_way_out_is_a_closed_folder_of_this_user(cache, tmp_path, monkeypatch, caplog) -> None:
    expected = nowhere(monkeypatch, tmp_path)
    assert folder.cache_folder() == expected
    assert expected.stat().st_mode & 0o777 == 0o700 and not caplog.messages


@UNIX
@pytest.mark.parametrize("trap", ("open", "link", "file", "foreign"))
def test_a_trap_in_its_place_is_not_stepped_into(
    trap, cache, tmp_path, monkeypatch, caplog
) -> None:
    """Whoever made the folder first: then this process keeps to itself, and says so."""
    expected = nowhere(monkeypatch, tmp_path)
    victim = tmp_path / "elsewhere"
    victim.mkdir(mode=0o700)
    if trap == "link":
        expected.symlink_to(victim)
    elif trap == "file":
        expected.write_text("")
    else:
        expected.mkdir()
        expected.chmod(0o777 if trap == "open" else 0o755)
    (victim / NAME).write_bytes(sealed(NAME, b"forged"))
    if trap in ("open", "foreign"):
        (expected / NAME).write_bytes(sealed(NAME, b"forged"))
    if trap == "foreign":
        monkeypatch.setattr(os, "geteuid", lambda: OWNER + 1)
        expected.rename(expected.with_name(f"adamslite-{os.geteuid()}"))
    monkeypatch.setattr(folder, "ADMINISTRATOR", -1)
    used = folder.cache_folder()
    assert recall(NAME, lambda: CONTENT) == CONTENT
    assert used.parent == tmp_path.resolve() and re.fullmatch(r"adamslite-\w{8}", used.name)
    assert used.stat().st_mode & 0o777 == 0o700
    assert len(caplog.messages) == 1 and "goes with this process" in caplog.text


@UNIX
def test_the_folder_of_another_user_is_not_used(cache, tmp_path, monkeypatch, caplog) -> None:
    monkeypatch.setattr("tempfile.tempdir", str(tmp_path))
    monkeypatch.setattr(folder, "ADMINISTRATOR", -1)
    monkeypatch.setattr(os, "geteuid", lambda: OWNER + 1)
    assert folder.cache_folder() != cache
    assert "belongs to another user" in caplog.messages[-1]


def test_the_private_folder_goes_with_its_process(tmp_path) -> None:
    code = (
        "from adamslite.caching.folder import _private; p = _private(); "
        "(p / 'entry').write_text(''); print(p)"
    )
    environment = {**os.environ, "TMPDIR": str(tmp_path)}
    environment["PYTHONPATH"] = str(Path(adamslite.__file__).parents[1])
    ran = subprocess.run(
        [sys.executable, "-c", code], env=environment, capture_output=True, text=True
    )
    assert ran.stdout.startswith(str(tmp_path.resolve())) and os.listdir(tmp_path) == []


@UNIX
def test_a_folder_that_goes_while_the_process_runs_is_made_again(cache, caplog) -> None:
    recall(NAME, lambda: CONTENT)
    shutil.rmtree(cache)
    assert recall(NAME, lambda: CONTENT) == CONTENT
    assert (cache / NAME).exists() and not caplog.messages


@UNIX
def test_a_folder_put_in_the_place_of_a_trusted_one_is_looked_at(
    cache, tmp_path, monkeypatch, caplog
) -> None:
    """As in the folder for temporary files, where what is old is removed."""
    monkeypatch.setattr("tempfile.tempdir", str(tmp_path))
    assert folder.cache_folder() == cache
    cache.rename(tmp_path / "gone")
    cache.mkdir()
    cache.chmod(0o777)
    (cache / NAME).write_bytes(sealed(NAME, b"forged"))
    assert recall(NAME, lambda: CONTENT) == CONTENT
    assert "is used instead" in caplog.text
