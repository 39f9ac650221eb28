"""What is kept between runs: verified before use, in a folder of one's own, of bounded size."""

from __future__ import annotations

import ctypes
import errno
import os
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest

from adamslite.caching import contents, entries, folder, secret
from adamslite.caching.entries import Damaged, recall, sealed, unsealed
from adamslite.cli.main import main
from adamslite.errors import UsageError
from adamslite.native import compiler
from adamslite.results.results import Results
from adamslite.syntax import forms

UNIX = pytest.mark.skipif(not folder.HAS_OWNERS, reason="modes and owners of Unix")
OWNER = os.geteuid() if folder.HAS_OWNERS else 0
NAME = "k" + "0" * 31 + "1.o"
DECK = """\
a mass on its way down and sideways
PART/1, GROUND
MARKER/1, PART=1
POINT_MASS/2, MASS=1
MARKER/2, POINT_MASS=2
VFORCE/1, I=2, JFLOAT=3, RM=1, FX=2, FY=0, FZ=0
MARKER/3, PART=1, FLOATING
ACCGRAV/JGRAV=-9.81
INTEGRATOR/VERLET
END
"""


def name(number: int) -> str:
    return f"k{number:032x}.o"


# ---- entries are verified ---------------------------------------------------------------------


def flipped(entry: bytes, at: int) -> bytes:
    return entry[:at] + bytes([entry[at] ^ 0x10]) + entry[at + 1 :]


DAMAGE: dict[str, Callable[[bytes], bytes]] = {
    "empty": lambda entry: b"",
    "cut in the head": lambda entry: entry[: entries.HEAD.size // 2],
    "cut behind the head": lambda entry: entry[: entries.HEAD.size],
    "cut by a byte": lambda entry: entry[:-1],
    "cut to half": lambda entry: entry[: len(entry) // 2],
    "longer by a byte": lambda entry: entry + b"\0",
    "zeroed": lambda entry: bytes(len(entry)),
    "zeroed behind the head": lambda entry: entry[:48] + bytes(len(entry) - 48),
    "a last block of zeros": lambda entry: entry[:-64] + bytes(64),
    "a bit of the format": lambda entry: flipped(entry, 7),
    "a bit of the length": lambda entry: flipped(entry, 9),
    "a bit of the digest": lambda entry: flipped(entry, 20),
    "a bit of the content": lambda entry: flipped(entry, len(entry) // 2),
    "the last bit": lambda entry: flipped(entry, len(entry) - 1),
    "without a head": lambda entry: entry[entries.HEAD.size :],
}
CONTENT = bytes(range(256)) * 4


TWICE = """
define double @twice(double %x) {
  %y = fadd double %x, %x
  ret double %y
}
"""


def tables() -> object:
    """Tables of the parser, unpickled; the tokens of ``A/1`` are parsed with them."""
    forms._parser.cache_clear()
    kinds = ("NAME", "SLASH", "NUMBER")
    return forms._form(forms._parser("deck", "statement"), kinds)


def facts() -> object:
    """Facts of a kernel, from JSON."""
    return entries.recall_json("k" + "0" * 32 + ".json", lambda: {"angles": 2, "guards": {}})


def code() -> object:
    """Object code, linked and called."""
    kept = recall(NAME, lambda: compiler.object_code(TWICE))
    address = compiler._link([kept], ["twice"])["twice"]
    return ctypes.CFUNCTYPE(ctypes.c_double, ctypes.c_double)(address)(21.0)


USES = {"parser": tables, "json": facts, "o": code}


@pytest.mark.parametrize("kind", USES)
@pytest.mark.parametrize("damage", DAMAGE)
def test_a_damaged_entry_is_rebuilt_and_reported_in_one_line(damage, kind, cache, caplog) -> None:
    """Of every kind: what is made of it is the same, and the next use says nothing."""
    use = USES[kind]
    right = use()
    (file,) = cache.glob(f"*.{kind}")
    kept = file.read_bytes()
    file.write_bytes(DAMAGE[damage](kept))
    assert file.read_bytes() != kept
    assert use() == right
    (line,) = caplog.messages
    assert str(file) in line and "is rebuilt" in line and "\n" not in line
    assert unsealed(file.name, file.read_bytes())
    assert use() == right and len(caplog.messages) == 1


def test_an_entry_under_the_name_of_another_is_damaged() -> None:
    with pytest.raises(Damaged):
        unsealed(name(2), sealed(name(1), CONTENT))
    assert unsealed(name(1), sealed(name(1), b"")) == b""


def solve(cache: Path, tmp_path: Path) -> subprocess.CompletedProcess:
    """A run in a process of its own, where code is linked and tables are unpickled anew."""
    (tmp_path / "a.adm").write_text(DECK)
    words = ["-m", "adamslite", "solve", "a.adm", "--end", "1", "--steps", "2"]
    path = str(Path(forms.__file__).parents[2])
    environment = {**os.environ, "ADAMSLITE_CACHE": str(cache), "PYTHONPATH": path}
    return subprocess.run(
        [sys.executable, *words], cwd=tmp_path, env=environment, capture_output=True, text=True
    )


@pytest.mark.slow
def test_each_kind_of_entry_survives_damage_in_a_real_run(cache, tmp_path) -> None:
    """Tables of the parser (pickle), facts of kernels (JSON), object code: all files at once.

    x(1) = F / 2 m, y(1) = -g / 2 from rest.
    """
    assert solve(cache, tmp_path).returncode == 0
    right = (tmp_path / "a.csv").read_bytes()
    found = Results.load(tmp_path / "a.csv")
    assert abs(found["POINT_MASS/2.x"][-1] - 1.0) < 1e-9
    assert abs(found["POINT_MASS/2.y"][-1] + 9.81 / 2) < 1e-9
    names = sorted(set(os.listdir(cache)) - {secret.NAME})
    assert {each.rpartition(".")[2] for each in names} == {"o", "json", "parser", "kept"}
    kinds = iter(("empty", "zeroed", "cut to half", "a bit of the content"))
    damage = next(kinds)
    for file in map(cache.joinpath, names):
        file.write_bytes(DAMAGE[damage](file.read_bytes()))
        damage = next(kinds, "without a head")
    ran = solve(cache, tmp_path)
    assert ran.returncode == 0 and (tmp_path / "a.csv").read_bytes() == right
    lines = [line for line in ran.stderr.splitlines() if "is rebuilt" in line]
    assert len(lines) == len(names) and all(line.startswith("adamslite: ") for line in lines)
    assert "is rebuilt" not in solve(cache, tmp_path).stderr


@pytest.mark.parametrize("damage", ("empty", "zeroed", "cut to half", "a bit of the content"))
def test_tables_of_the_parser_are_not_unpickled_before_they_are_verified(
    damage, cache, monkeypatch, caplog
) -> None:
    tables()
    (file,) = cache.glob("deck*.parser")
    file.write_bytes(DAMAGE[damage](file.read_bytes()))
    seen = []
    loads = forms.pickle.loads
    monkeypatch.setattr(forms.pickle, "loads", lambda data: (seen.append(data), loads(data))[1])
    tables()
    assert len(caplog.messages) == 1
    assert seen == [unsealed(file.name, file.read_bytes())]


def test_an_entry_that_cannot_be_read_is_made_each_time(cache, caplog) -> None:
    (cache / NAME).mkdir()
    assert recall(NAME, lambda: CONTENT) == CONTENT
    assert "directory" in caplog.text and os.listdir(cache) == [NAME]


# ---- entries are written whole ----------------------------------------------------------------


def test_what_another_process_makes_just_before_is_taken(cache, monkeypatch) -> None:
    """It has ended between the look into the folder and the lock."""

    @contextmanager
    def late(name: str) -> Iterator[None]:
        entries.keep(name, b"theirs")
        yield

    monkeypatch.setattr("adamslite.caching.alone.alone", late)
    assert recall("an-entry", lambda: b"ours") == b"theirs"


def test_content_is_on_the_disk_before_it_gets_its_name(cache, monkeypatch) -> None:
    done = []
    fsync, replace = os.fsync, os.replace
    monkeypatch.setattr(os, "fsync", lambda file: (done.append("sync"), fsync(file)))
    monkeypatch.setattr(os, "replace", lambda *names: (done.append("name"), replace(*names)))
    recall(NAME, lambda: CONTENT)
    assert done == ["sync", "name"]


@pytest.mark.parametrize("call", ("fsync", "replace"))
def test_a_full_disk_leaves_nothing_behind(call, cache, monkeypatch) -> None:
    def full(*_: object) -> None:
        raise OSError(errno.ENOSPC, "No space left on device")

    monkeypatch.setattr(os, call, full)
    assert recall(NAME, lambda: CONTENT) == CONTENT
    assert os.listdir(cache) == []


@UNIX
def test_a_disk_that_fills_while_an_entry_is_written_leaves_nothing_behind(cache) -> None:
    """The system takes 100 bytes of a file and no more."""
    import resource
    import signal

    soft, hard = resource.getrlimit(resource.RLIMIT_FSIZE)
    heard = signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
    resource.setrlimit(resource.RLIMIT_FSIZE, (100, hard))
    try:
        assert recall(NAME, lambda: CONTENT) == CONTENT
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, (soft, hard))
        signal.signal(signal.SIGXFSZ, heard)
    assert os.listdir(cache) == []


# ---- the folder is of bounded size ------------------------------------------------------------


def fill(cache: Path, number: int, size: int = 1000) -> None:
    """Entries of ``size`` bytes, entry k used k days after the first."""
    for k in range(number):
        entries.store(cache / name(k), bytes(size - entries.HEAD.size))
        os.utime(cache / name(k), (1e9 + k * entries.DAY,) * 2)


def kept(cache: Path) -> list[int]:
    return sorted(int(entry.path.name[1:33], 16) for entry in contents.entries(cache))


def test_the_oldest_entries_go_first(cache, monkeypatch) -> None:
    fill(cache, 20)
    (cache / "notes.txt").write_text("of the user")
    monkeypatch.setenv("ADAMSLITE_CACHE_SIZE", "0.010")
    entries.store(cache / name(20), bytes(1000 - entries.HEAD.size))
    assert kept(cache) == [*range(12, 21)]  # 9000 bytes: a tenth below the bound
    assert (cache / "notes.txt").exists()


def test_code_of_yesterday_outlives_decks_of_today(cache) -> None:
    """A study of many decks in one day must not drive out the integrators, compiled the day before
    and used by every run.
    """
    now = 2e9
    for k, (kind, age) in enumerate([("o", 0.9), ("kept", 0.1), ("o", 3.0), ("kept", 0.0)]):
        entry = cache / name(k).replace(".o", f".{kind}")
        entries.store(entry, bytes(1000 - entries.HEAD.size))
        os.utime(entry, (now - age * entries.DAY,) * 2)
    order = [int(entry.path.name[1:33], 16) for entry in contents.entries(cache)]
    assert order == [2, 1, 3, 0]


def test_an_entry_in_use_is_not_old(cache) -> None:
    fill(cache, 5)
    recall(name(0), pytest.fail)
    assert entries.trim(cache, 2000.0) <= 2000
    assert 0 in kept(cache)


def test_the_bound_holds_while_one_process_adds(cache, monkeypatch) -> None:
    monkeypatch.setenv("ADAMSLITE_CACHE_SIZE", "0.005")
    for k in range(30):
        entries.store(cache / name(k), bytes(1000))
        assert sum(entry.size for entry in contents.entries(cache)) <= 5000
    assert 29 in kept(cache)


def test_drafts_of_dead_processes_go(cache) -> None:
    old, new = cache / f".{name(1)}.77-0.part", cache / f".{name(1)}.78-0.part"
    for draft in (old, new):
        draft.write_bytes(b"half")
    os.utime(old, (time.time() - 2 * entries.HOUR,) * 2)
    entries.trim(cache, 1e9)
    assert os.listdir(cache) == [new.name]


@pytest.mark.parametrize("told", ("much", "-1", "nan"))
def test_a_bound_that_is_no_size_is_a_usage_error(told, monkeypatch) -> None:
    monkeypatch.setenv("ADAMSLITE_CACHE_SIZE", told)
    with pytest.raises(UsageError, match="ADAMSLITE_CACHE_SIZE"):
        entries.bound()


def test_the_usual_bound_is_512_megabytes(monkeypatch) -> None:
    monkeypatch.delenv("ADAMSLITE_CACHE_SIZE", raising=False)
    assert entries.bound() == 512e6


WORKER = """\
import sys
from adamslite.caching import contents, entries, folder, secret
name = "k{:032x}.o".format
for turn in range(60):
    for k in range(8):
        content = bytes([k]) * 2000
        assert entries.recall(name(k), lambda: content) == content
    if turn % 5 == 0:
        contents.clear(folder.cache_folder())
"""


@pytest.mark.slow
def test_processes_that_read_write_trim_and_clear_at_once(cache) -> None:
    environment = {**os.environ, "ADAMSLITE_CACHE_SIZE": "0.009"}
    environment["PYTHONPATH"] = str(Path(forms.__file__).parents[2])
    run = [sys.executable, "-c", WORKER]
    running = [
        subprocess.Popen(run, env=environment, stderr=subprocess.PIPE, text=True) for _ in range(3)
    ]
    assert [(p.communicate()[1], p.returncode) for p in running] == [("", 0)] * 3
    assert not [*cache.glob(".*")]


# ---- the command ------------------------------------------------------------------------------


def test_the_command_shows_and_clears(cache, capsys, monkeypatch) -> None:
    monkeypatch.delenv("ADAMSLITE_CACHE_SIZE", raising=False)
    fill(cache, 3, size=100_000)
    (cache / "notes.txt").write_text("of the user")
    assert main(["cache"]) == 0
    shown = capsys.readouterr().out
    assert shown.splitlines() == [
        f"folder    {cache}",
        "entries   3",
        "size      0.3 MB of 512 MB at most",
    ]
    assert main(["cache", "--clear"]) == 0
    assert capsys.readouterr().out == f"removed 3 entries, 0.3 MB, from {cache}\n"
    assert os.listdir(cache) == ["notes.txt"]
