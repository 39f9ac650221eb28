"""Commands whose files or streams cannot be written: a sentence that names the file, exit code 5,
the old file as it was, and nothing beside it.
"""

from __future__ import annotations

import json
import os
import re
import shutil
import subprocess
import sys
import threading
from collections.abc import Mapping
from pathlib import Path

import pytest
from fakes import fall
from writing_commands import CAREFUL, LIMITED, WRITING, adamslite, contents, environment, prepare

from adamslite.cli.commands.codes import IO_FAILED
from adamslite.cli.main import command_parsers
from adamslite.outputs.whole_files import whole_file

POSIX = pytest.mark.skipif(os.name != "posix", reason="limits and streams of POSIX")
#: The others take as long as matplotlib does to be imported, or longer.
QUICK = ("a table", "files of SAVE and LINEAR", "a deck of a cable", "a layout")
EACH = [name if name in QUICK else pytest.param(name, marks=pytest.mark.slow) for name in WRITING]
#: Of each command.
FIRST = {each.command.split()[0]: each.command for each in reversed(WRITING.values())}
OLD = b"# adamslite: what was there before\n"


@pytest.fixture(scope="module")
def made(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder with all that the commands read."""
    folder = tmp_path_factory.mktemp("made")
    prepare(folder)
    return folder


@pytest.fixture
def folder(made: Path, tmp_path: Path) -> Path:
    """A copy of it."""
    return Path(shutil.copytree(made, tmp_path / "here"))


def put_old(name: str, folder: Path) -> None:
    """Let the files that a command will write be there, but for a sweep, which goes on with one."""
    for each in WRITING[name].files if name != "a sweep" else ():
        if not (folder / each).exists():
            (folder / each).parent.mkdir(parents=True, exist_ok=True)
            (folder / each).write_bytes(OLD)


def test_every_command_that_writes_files_is_in_the_table() -> None:
    writes = {
        name
        for name, parser in command_parsers().items()
        if any("--output" in each.option_strings for each in parser._actions)
    }
    assert writes | {"fmt", "editors"} == {each.command.split()[0] for each in WRITING.values()}


@pytest.mark.parametrize("name", EACH)
def test_the_files_of_a_command(name: str, folder: Path) -> None:
    """Without a fault: what the table says, so that the tests below look at all files."""
    before = contents(folder)
    done = adamslite(folder, WRITING[name].command.split())
    after = contents(folder)
    assert done.returncode == 0, done.stderr
    assert {each for each in after if after[each] != before.get(each)} == {*WRITING[name].files}


@pytest.mark.parametrize("command", [each for each in FIRST.values() if "untidy" not in each])
def test_standard_output_is_no_file(command: str, folder: Path) -> None:
    """`-o -` writes what is meant for a pipe, or is refused; no file is called so."""
    before = contents(folder)
    argv = re.sub(r"(-o|editors) \S+", r"\1 -", command).split()
    done = adamslite(folder, argv)
    assert contents(folder) == before
    if argv[0] in ("solve", "cable"):
        assert done.returncode == 0 and len(done.stdout) > 500, done.stderr
    else:
        assert done.returncode == 2 and done.stdout == "" and "-" in done.stderr, done.stderr


@POSIX
@pytest.mark.parametrize("name", EACH)
def test_a_file_that_may_not_grow(name: str, folder: Path) -> None:
    """The system takes ten bytes of a file, of the cache too, and no more."""
    put_old(name, folder)
    before = contents(folder)
    done = adamslite(folder, WRITING[name].command.split(), LIMITED.format(most=10))
    assert done.returncode == IO_FAILED, done.stderr
    last = done.stderr.splitlines()[-1]
    assert any(last == f"adamslite: '{each}': File too large" for each in WRITING[name].files)
    assert contents(folder) == before


# ---- a disk that is full, and one that is read-only ------------------------------------------

#: A small disk of its own, seen by this process alone; it goes with the process.
MOUNTED = """\
import json, os, shutil, subprocess, sys
sys.path.insert(0, {tests!r})
from pathlib import Path
from test_failing_writes import put_old
from writing_commands import WRITING, adamslite, contents
name, made, here, state = sys.argv[1:]
here = Path(here)
mount = ["mount", "-t", "tmpfs", "-o", "size=4m", "none", here]
subprocess.run(mount, check=True)
shutil.copytree(made, here, dirs_exist_ok=True)
put_old(name, here)
before = contents(here)
if state == "read-only":
    subprocess.run(["mount", "-o", "remount,ro", here], check=True)
else:
    with open(here / "filler", "wb", buffering=0) as filler:
        try:
            while filler.write(bytes(4096)):
                pass
        except OSError:
            filler.truncate(filler.tell() - 4096 * int(state))
done = adamslite(here, WRITING[name].command.split())
after = contents(here)
after.pop("filler", None)
changed = {{
    each: after.get(each, b"").hex()
    for each in before | after if after.get(each) != before.get(each)
}}
print(json.dumps([done.returncode, done.stderr, changed]))
"""
SPACE = ["unshare", "--user", "--map-root-user", "--mount"]


def can_mount() -> bool:
    if not (sys.platform == "linux" and shutil.which("unshare")):
        return False
    return not subprocess.run(
        [*SPACE, "mount", "-t", "tmpfs", "none", "/mnt"], capture_output=True
    ).returncode


MOUNT = pytest.mark.skipif(not can_mount(), reason="the system mounts no disk for this user")


def on_a_disk(
    name: str, made: Path, here: Path, state: str
) -> tuple[int, str, Mapping[str, bytes]]:
    """Exit code, messages and the files that have changed or gone (empty), of a command on a disk
    with so many pages free, or read-only.
    """
    program = MOUNTED.format(tests=str(Path(__file__).parent))
    here.mkdir()
    words = [sys.executable, "-c", program, name, str(made), str(here), state]
    done = subprocess.run([*SPACE, *words], capture_output=True, text=True, env=environment())
    assert done.returncode == 0, done.stderr
    code, said, changed = json.loads(done.stdout)
    return code, said, {each: bytes.fromhex(text) for each, text in changed.items()}


@MOUNT
@pytest.mark.parametrize("name", EACH)
def test_a_full_disk(name: str, made: Path, tmp_path: Path) -> None:
    code, said, changed = on_a_disk(name, made, tmp_path / "disk", "0")
    last = said.splitlines()[-1]
    assert code == IO_FAILED and last.endswith("': No space left on device"), said
    assert changed == {}


@MOUNT
@pytest.mark.slow
def test_a_disk_that_fills_between_files(made: Path, tmp_path: Path) -> None:
    """Some files are written before there is no room for one: each is the old one or whole."""
    name = "files of SAVE and LINEAR"
    whole = Path(shutil.copytree(made, tmp_path / "whole"))
    adamslite(whole, WRITING[name].command.split())
    code, said, changed = on_a_disk(name, made, tmp_path / "disk", "1")
    assert code == IO_FAILED and said.endswith("'out.csv': No space left on device\n"), said
    assert {*changed} == {"halfway"} and changed["halfway"] == (whole / "halfway").read_bytes()


@MOUNT
@pytest.mark.parametrize("name", EACH)
def test_a_disk_that_is_read_only(name: str, made: Path, tmp_path: Path) -> None:
    code, said, changed = on_a_disk(name, made, tmp_path / "disk", "read-only")
    last = said.splitlines()[-1]
    assert code == IO_FAILED, said
    assert last.endswith(("cannot be written there: no permission", "Read-only file system")), said
    assert changed == {}


@pytest.mark.skipif(not CAREFUL, reason="the user may write anywhere")
@pytest.mark.parametrize("name", EACH)
def test_a_folder_that_is_read_only(name: str, folder: Path) -> None:
    put_old(name, folder)
    before = contents(folder)
    closed = [folder, *(each for each in folder.rglob("*") if each.is_dir())]
    for each in closed:
        each.chmod(0o500)
    try:
        done = adamslite(folder, WRITING[name].command.split(), prefix=CAREFUL)
    finally:
        for each in closed:
            each.chmod(0o700)
    assert done.returncode == IO_FAILED, done.stderr
    assert contents(folder) == before


# ---- streams ----------------------------------------------------------------------------------

PRINTS = (
    "solve swing.adm -o - --quiet", "help PART", "--help", "names swing.adm", "check swing.adm",
    "diff swing.csv swing.csv", "linear swing.adm", "cable hoist.toml --no-trial",
)  # fmt: skip


def in_a_shell(folder: Path, text: str) -> tuple[int, str]:
    """Exit code of a command with its streams, and what it wrote to standard error."""
    program = f'"{sys.executable}" -m adamslite {text}'
    done = subprocess.run(
        ["bash", "-c", program], cwd=folder, env=environment(), capture_output=True, text=True
    )
    return done.returncode, done.stderr


@POSIX
@pytest.mark.parametrize("command", PRINTS)
@pytest.mark.parametrize(
    ("stream", "said"), [(">/dev/full", "No space left on device"), (">&-", "Bad file descriptor")]
)
def test_a_standard_output_that_takes_nothing(
    command: str, stream: str, said: str, folder: Path
) -> None:
    if not Path("/dev/full").exists():
        pytest.skip("no /dev/full")
    code, told = in_a_shell(folder, f"{command} {stream}")
    assert code == IO_FAILED and told.endswith(f"adamslite: standard output: {said}\n"), told


@POSIX
@pytest.mark.parametrize("command", PRINTS)
def test_a_reader_that_has_gone_is_no_fault(command: str, folder: Path) -> None:
    code, told = in_a_shell(folder, f"{command} | true; exit ${{PIPESTATUS[0]}}")
    assert code == IO_FAILED and told == ""


@POSIX
@pytest.mark.parametrize("streams", ["2>/dev/full", "2>&-", ">&-", "<&- >&- 2>&-", "2> >(true)"])
def test_a_run_without_someone_who_listens(streams: str, folder: Path) -> None:
    """Its results are those of every run: none of its messages is in their file."""
    code, _ = in_a_shell(folder, f"solve swing.adm -o out.csv {streams}")
    assert code == 0
    assert (folder / "out.csv").read_bytes() == (folder / "swing.csv").read_bytes()


# ---- one name for two -------------------------------------------------------------------------


def test_runs_that_write_one_file_at_once(folder: Path) -> None:
    """The file is that of one of them, whole."""
    other = (folder / "swing.adm").read_text().replace("K=150", "K=50")
    (folder / "other.adm").write_text(other)
    words = [sys.executable, "-m", "adamslite", "solve", "--quiet", "-o"]
    whole = set()
    for name in ("swing", "other"):
        adamslite(folder, ["solve", f"{name}.adm", "--quiet"])
        whole.add((folder / f"{name}.csv").read_bytes())
    before = contents(folder)
    runs = [
        subprocess.Popen([*words, "out.csv", f"{name}.adm"], cwd=folder, env=environment())
        for name in ("swing", "other") * 2
    ]
    assert [run.wait() for run in runs] == [0] * 4
    assert len(whole) == 2 and (folder / "out.csv").read_bytes() in whole
    assert {*contents(folder)} == {*before, "out.csv"}


def test_threads_that_write_one_file_at_once(tmp_path: Path) -> None:
    """Of every draft that gets the name, all was written by one thread."""
    path, faults = tmp_path / "out", []

    def write(letter: str) -> None:
        try:
            for _ in range(20):
                with whole_file(path) as stream:
                    for _ in range(50):
                        stream.write(letter * 1000)
                assert {*path.read_text()} <= {*"abcdefgh"} and len({*path.read_text()}) == 1
        except Exception as fault:
            faults.append(fault)

    threads = [threading.Thread(target=write, args=(letter,)) for letter in "abcdefgh"]
    for each in threads:
        each.start()
    for each in threads:
        each.join()
    assert faults == [] and os.listdir(tmp_path) == ["out"]
    assert path.stat().st_size == 50_000


def test_a_disk_that_is_full_only_when_it_must_be_written(tmp_path: Path, monkeypatch) -> None:
    """Some systems take all bytes, and report at the end that there was no room for them."""

    def full(number: int) -> None:
        raise OSError(28, "No space left on device")

    path = tmp_path / "out.nc"
    path.write_bytes(OLD)
    monkeypatch.setattr(os, "fsync", full)
    with pytest.raises(OSError) as told:
        fall(3).save(path)
    assert told.value.filename == str(path)
    assert contents(tmp_path) == {"out.nc": OLD}
