"""What the command line says of runs that did not end, and how it goes on with them."""

from __future__ import annotations

import os
import random
import shutil
import signal
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from unfinished_runs import OFTEN, command, left_behind, solved, until_there_is_a_state
from unfinished_scenes import cranked, lowered, pendulum, written

from adamslite.analyses.dynamics.checkpoint import begin
from adamslite.caching import secret
from adamslite.cli.main import main
from adamslite.outputs.part_file import PartFile
from adamslite.results.outcomes import Outcome
from adamslite.results.results import Results

#: It runs for some seconds.
LONG = pendulum(1200, 6000)
FLAGS = ("--integrator", "GSTIFF", "--error", "1e-6")


#: What a signal ends: its name, the deck, flags.
ENDED = [
    ("SIGTERM", LONG, *FLAGS),
    ("SIGHUP", LONG, *FLAGS),
    ("SIGINT", LONG, *FLAGS),
    ("SIGTERM", lowered(30000)),
    ("SIGINT", cranked(60, 3000)),
]


@pytest.mark.parametrize(
    "case",
    [each if each == 0 else pytest.param(each, marks=pytest.mark.slow) for each in range(5)],
    ids=["SIGTERM", "SIGHUP", "SIGINT", "equilibria", "postures"],
)
def test_a_signal_ends_a_run_which_can_go_on(tmp_path: Path, case: int) -> None:
    name, text, *flags = ENDED[case]
    deck, output = written(tmp_path, text), tmp_path / "x.csv"
    part = Path(f"{output}.part")
    caught = signal.signal(getattr(signal, name), signal.default_int_handler)  # nohup ignores it
    try:
        process = subprocess.Popen(
            command(str(deck), "-o", str(output), *flags), stderr=subprocess.PIPE, cwd=tmp_path
        )
    finally:
        signal.signal(getattr(signal, name), caught)
    until_there_is_a_state(process, part)
    process.send_signal(getattr(signal, name))
    error = process.communicate(timeout=120)[1].decode()
    assert process.returncode == 4
    assert f"adamslite solve --resume {part}" in error and "Traceback" not in error
    found = Results.load(output)
    assert found.outcome is Outcome.INTERRUPTED and found.count > 10
    whole = solved(deck, *flags)
    done = subprocess.run(command("--resume", str(part)), capture_output=True, cwd=tmp_path)
    assert done.returncode == 0 and output.read_bytes() == whole
    assert sorted(p.name for p in tmp_path.iterdir()) == ["deck.adm", "undisturbed.csv", "x.csv"]


@pytest.mark.slow
@pytest.mark.skipif(sys.platform == "win32", reason="files have no limit there")
def test_a_full_disk_ends_a_run_which_can_go_on(tmp_path: Path) -> None:
    """No file may be larger than 2 MB, then any."""
    text = pendulum(600, 40000)
    deck, part = written(tmp_path, text), tmp_path / "x.csv.part"
    full = "import resource\nresource.setrlimit(resource.RLIMIT_FSIZE, (2 << 20, 2 << 20))\n"
    words = ["solve", str(deck), "-o", "x.csv", "--quiet", *FLAGS]
    ended = subprocess.run(
        [sys.executable, "-c", full + OFTEN, *words], capture_output=True, text=True, cwd=tmp_path
    )
    assert ended.returncode == 5 and "Traceback" not in ended.stderr
    assert "x.csv.part': " in ended.stderr and "goes on with `adamslite" in ended.stderr
    assert part.exists() and not (tmp_path / "x.csv").exists()
    done = subprocess.run(command("--resume", str(part)), capture_output=True, cwd=tmp_path)
    assert done.returncode == 0 and not part.exists()
    assert (tmp_path / "x.csv").read_bytes() == solved(deck, *FLAGS)


def test_a_short_run_writes_no_file(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    deck = written(tmp_path, pendulum(1, 10))
    made: list[Path] = []
    create = PartFile.create
    monkeypatch.setattr(PartFile, "create", lambda path, _: made.append(path) or create(path, _))
    assert main(["solve", str(deck), "-o", str(tmp_path / "x.csv"), "--quiet"]) == 0
    assert not made and sorted(p.name for p in tmp_path.iterdir()) == ["deck.adm", "x.csv"]


class TestWhatWasLeftBehind:
    @pytest.fixture
    def deck(self, tmp_path: Path) -> Path:
        begin(tmp_path / "x.csv.part", {}, 7.0).close()
        return written(tmp_path, pendulum(1, 10))

    def test_it_is_reported_and_left_alone(self, deck: Path, capsys) -> None:
        part = deck.with_name("x.csv.part")
        before = part.read_bytes()
        assert main(["solve", str(deck), "-o", str(deck.with_name("x.csv")), "--quiet"]) == 0
        told = capsys.readouterr().err
        assert "a run that did not end (t = 0 of 7) has left" in told
        assert f"adamslite solve --resume {part}" in told
        assert part.read_bytes() == before

    def test_a_damaged_one_is_reported(self, deck: Path, capsys) -> None:
        deck.with_name("x.csv.part").write_text("no run")
        assert main(["solve", str(deck), "-o", str(deck.with_name("x.csv")), "--quiet"]) == 0
        assert "is damaged" in capsys.readouterr().err

    def test_one_of_a_stranger_is_reported(self, deck: Path, capsys, monkeypatch) -> None:
        monkeypatch.setattr(secret, "_secret", lambda: b"of another user")
        assert main(["solve", str(deck), "-o", str(deck.with_name("x.csv")), "--quiet"]) == 0
        assert "was not written with this cache" in capsys.readouterr().err

    def test_one_that_is_being_written_ends_the_second_run(self, deck: Path, capsys) -> None:
        part = PartFile.open(deck.with_name("x.csv.part"))
        assert main(["solve", str(deck), "-o", str(deck.with_name("x.csv")), "--quiet"]) == 2
        assert "another run is writing" in capsys.readouterr().err
        assert not deck.with_name("x.csv").exists()
        part.close()


@pytest.mark.skipif(sys.platform == "win32", reason="named pipes")
@pytest.mark.parametrize("kind", ["folder", "pipe"])
def test_a_name_that_is_taken_by_no_file_is_refused_before_the_run(
    tmp_path: Path, kind: str, capsys
) -> None:
    deck, part = written(tmp_path, pendulum(1, 10)), tmp_path / "x.csv.part"
    part.mkdir() if kind == "folder" else os.mkfifo(part)
    assert main(["solve", str(deck), "-o", str(tmp_path / "x.csv")]) == 2
    assert "is not a plain file, and the run would be kept there" in capsys.readouterr().err


#: A swing with a spring of Python's.
ROUTINE = pendulum(40, 4000).replace(
    "SIMULATE",
    "VFORCE/1, I=4, JFLOAT=9, RM=1, FUNCTION=USER(1)\nMARKER/9, PART=1, FLOATING\nSIMULATE",
)


@pytest.mark.parametrize(
    ("text", "words", "why"),
    [
        (pendulum(400, 20000), ["-o", "-"], "its results go to standard output"),
        (pendulum(400, 20000), ["-o", os.devnull], f"{os.devnull} is no plain file"),
        pytest.param(
            ROUTINE, ["-o", "x.csv", "--user", "VFOSUB=spring:force"],
            "its routines of Python may remember anything", marks=pytest.mark.slow,
        ),
    ],
)  # fmt: skip
def test_a_long_run_that_is_not_kept_says_so(
    tmp_path: Path, text: str, words: list[str], why: str
) -> None:
    """Its rows are in a file without a name; they are those of a run whose rows are in memory."""
    (tmp_path / "spring.py").write_text(
        "import adamslite\n"
        "@adamslite.reads('DX(4)', 'DY(4)')\n"
        "def force(parameters, time, x, y):\n"
        "    return -x, -y, 0.0\n"
    )
    deck = written(tmp_path, text)
    often = (
        OFTEN.replace("import sys", "import sys; sys.path.insert(0, '.')")
        .replace("history.SETTLED,", "history.MOST, history.SETTLED,")
        .replace("= 0.0, 0.02", "= 0, 0.0, 0.02")
    )
    flags = [*words, "--integrator", "RKF45"]
    done = subprocess.run(
        [sys.executable, "-c", often, "solve", deck.name, *flags],
        capture_output=True, text=True, cwd=tmp_path,
    )  # fmt: skip
    assert done.returncode == 0, done.stderr
    assert f"a run that is killed begins anew: it is not kept, because {why}" in done.stderr
    found = (tmp_path / "x.csv").read_text() if "x.csv" in words else done.stdout
    whole = subprocess.run(
        [sys.executable, "-m", "adamslite", "solve", deck.name, *flags, "--quiet"],
        capture_output=True, text=True, cwd=tmp_path,
    )  # fmt: skip
    assert whole.returncode == 0 and "begins anew" not in whole.stderr
    assert found == ((tmp_path / "x.csv").read_text() if "x.csv" in words else whole.stdout)
    assert not list(tmp_path.glob("*.part*"))


@pytest.fixture(scope="module")
def kept(tmp_path_factory: pytest.TempPathFactory) -> bytes:
    """What a run that was killed has left, in a folder that is there no more."""
    folder = tmp_path_factory.mktemp("killed")
    data = left_behind(folder, LONG, *FLAGS).read_bytes()
    shutil.rmtree(folder)
    return data


class TestGoingOn:
    @pytest.fixture
    def part(self, kept: bytes, tmp_path: Path) -> Path:
        """Its file, with rows before the last state, beside the deck."""
        part = written(tmp_path, LONG).with_name("x.csv.part")
        part.write_bytes(kept)
        return part

    def test_a_deck_that_has_changed_is_refused(self, part: Path, capsys) -> None:
        part.with_name("deck.adm").write_text(LONG.replace("MASS=1", "MASS=2"))
        assert main(["solve", "--resume", str(part)]) == 2
        assert "tables or what RELOAD reads have changed since" in capsys.readouterr().err
        assert part.exists()

    def test_a_folder_that_was_moved_has_its_deck_with_it(self, part: Path, tmp_path: Path) -> None:
        whole, moved = solved(part.with_name("deck.adm"), *FLAGS), tmp_path.parent / "moved"
        tmp_path.rename(moved)
        done = subprocess.run(command("--resume", "moved/x.csv.part"), cwd=moved.parent)
        assert done.returncode == 0 and (moved / "x.csv").read_bytes() == whole

    @pytest.mark.slow
    def test_a_page_is_written_where_the_run_would_have(self, tmp_path: Path) -> None:
        """Not in the folder that the run happens to be resumed in."""
        (tmp_path / "run").mkdir()
        part = left_behind(tmp_path / "run", LONG, *FLAGS, "--page", "shown.html")
        done = subprocess.run(command("--resume", "run/x.csv.part"), cwd=tmp_path)
        assert done.returncode == 0 and part.with_name("shown.html").exists()
        assert [each.name for each in tmp_path.iterdir()] == ["run"]

    def test_a_deck_that_has_gone_is_named(self, part: Path, capsys) -> None:
        part.with_name("deck.adm").unlink()
        assert main(["solve", "--resume", str(part)]) == 5
        assert "deck.adm" in capsys.readouterr().err and part.exists()

    @pytest.mark.slow
    def test_what_was_damaged_is_refused_or_does_no_harm(self, part: Path) -> None:
        """Cut, or with a byte changed, anywhere."""
        whole, chance = solved(part.with_name("deck.adm"), *FLAGS), random.Random(1)
        data, output = part.read_bytes(), part.with_name("x.csv")
        for k in range(16):
            at = chance.randrange(256 if k % 4 == 0 else len(data))
            changed = bytearray(data)
            changed[at] ^= 1 << chance.randrange(8)
            part.write_bytes(data[:at] if k % 4 == 1 else bytes(changed))
            code = main(["solve", "--resume", str(part), "--quiet"])
            refused = code in (2, 5)  # 2: as the run of another deck, program or processor
            assert refused or (code == 0 and output.read_bytes() == whole)
            assert output.exists() == (code == 0) and part.exists() == refused
            output.unlink(missing_ok=True)

    @pytest.mark.parametrize(
        ("fact", "said"), [("processor", "another kind of processor"), ("program", "version")]
    )
    def test_one_of_elsewhere_is_refused(self, part: Path, fact: str, said: str, capsys) -> None:
        changed = PartFile.open(part)
        facts = {**changed.state["facts"], fact: ""}
        changed.commit(changed.write_state({**changed.state, "facts": facts}, changed.arrays))
        changed.close()
        assert main(["solve", "--resume", str(part)]) == 2
        assert said in capsys.readouterr().err

    @pytest.mark.skipif(sys.platform == "win32", reason="anybody may open a file there")
    def test_two_at_once_are_refused(self, part: Path, capsys) -> None:
        held = PartFile.open(part)
        assert main(["solve", "--resume", str(part)]) == 2
        assert "another run is writing" in capsys.readouterr().err
        held.close()

    def test_a_function_that_the_file_names_is_not_loaded(self, part: Path) -> None:
        """A file of others may name any module; numbers alone are taken from it."""
        from adamslite.cli.commands.unfinished import _texts

        facts = {"outputs": [], "values": [], "page": None,
                 "user": ["VARSUB=this:function", "VARIABLE/1=0, 2.5"]}  # fmt: skip
        assert _texts(facts)["user"] == ["VARIABLE/1=0, 2.5"]

    def test_flags_of_the_run_are_not_taken_again(self, part: Path, capsys) -> None:
        more = ["--end", "3", "-o", "y.csv", "--set", "PART/2.MASS=3"]
        assert main(["solve", "--resume", str(part), *more]) == 2
        assert "leave out --end, --set, -o" in capsys.readouterr().err

    def test_one_of_another_version_is_refused(self, part: Path, capsys) -> None:
        changed = PartFile.open(part)
        facts = {**changed.state["facts"], "program": "another"}
        changed.commit(changed.write_state({**changed.state, "facts": facts}, changed.arrays))
        changed.close()
        assert main(["solve", "--resume", str(part)]) == 2
        assert "another version of adamslite" in capsys.readouterr().err

    def test_changed_rows_are_refused(self, part: Path, capsys) -> None:
        open_part = PartFile.open(part)
        at = open_part.state["stretches"][0][1]
        open_part.close()
        data = bytearray(part.read_bytes())
        data[at] ^= 1
        part.write_bytes(data)
        assert main(["solve", "--resume", str(part)]) == 5
        assert "its rows were changed" in capsys.readouterr().err

    def test_one_of_a_stranger_is_resumed_only_when_it_is_trusted(
        self, part: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys
    ) -> None:
        """Who has another secret can be a stranger, or the user on another machine."""
        before = part.read_bytes()
        with monkeypatch.context() as elsewhere:
            elsewhere.setattr(secret, "_secret", lambda: b"of another user")
            assert main(["solve", "--resume", str(part)]) == 2
            told = capsys.readouterr().err
            assert "was not written with this cache" in told and f"{part} --trust" in told
            assert part.read_bytes() == before
            trusted = PartFile.open(part, trusted=True)
            assert trusted.state["facts"]["outputs"] == []
            trusted.close()
        changed = PartFile.open(part)
        changed.commit((*changed._named[0][:3], bytes(16).hex()))
        changed.close()
        assert main(["solve", "--resume", str(part)]) == 2
        assert main(["solve", "--resume", str(part), "--trust", "--quiet"]) == 0
        assert (tmp_path / "x.csv").exists() and not part.exists()

    def test_a_state_of_other_arrays_is_refused(self, part: Path, capsys) -> None:
        """What native code writes to is only what it had room for."""
        changed = PartFile.open(part)
        arrays = {**changed.arrays, "q": np.zeros(99)}
        changed.commit(changed.write_state(changed.state, arrays))
        changed.close()
        assert main(["solve", "--resume", str(part)]) == 5
        assert "it is of another run" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("words", "sentence"),
    [
        (["solve"], "give the name of a deck, or --resume OUT.part"),
        (["solve", "--resume", "nothing.csv.part"], "No such file"),
        (["solve", "deck.adm", "--trust"], "--trust goes with --resume OUT.part"),
        (["solve", "--resume", "deck.adm"], "the file of a run that did not end is OUT.part"),
    ],
)
def test_what_cannot_go_on(
    words: list[str], sentence: str, tmp_path: Path, capsys, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    written(tmp_path, pendulum(1, 10))
    assert main(words) in (2, 5)
    assert sentence in capsys.readouterr().err


#: Its own peak; that of getrusage begins with the memory of the process that started it.
MANY = """\
import sys
from adamslite.cli.main import main
code = main()
peak = next(line for line in open("/proc/self/status") if line.startswith("VmHWM"))
print(int(peak.split()[1]) // 1024)
sys.exit(code)
"""


@pytest.mark.slow
@pytest.mark.skipif(sys.platform != "linux", reason="it reads /proc")
@pytest.mark.parametrize("suffix", ["csv", "nc"])
def test_memory_does_not_grow_with_outputs(tmp_path: Path, suffix: str) -> None:
    """1e7 outputs of 10 columns: 880 MB of numbers."""
    text = """\
a mass on a spring
PART/1, GROUND
MARKER/1, PART=1
POINT_MASS/2, MASS=1, QG=1,0,0, CM=2
MARKER/2, POINT_MASS=2
SPRINGDAMPER/1, TRANSLATION, I=2, J=1, K=1, LENGTH=0.5
END
"""
    deck = written(tmp_path, text)
    found = []
    for steps in (100, 10_000_000):
        words = [str(deck), "-o", f"x.{suffix}", "--end", "1e5", "--steps", str(steps), "--quiet"]
        run = subprocess.run(
            [sys.executable, "-c", MANY, "solve", *words, "--hmax", "100", "--integrator", "RKF45"],
            capture_output=True, text=True, cwd=tmp_path, check=True,
        )  # fmt: skip
        found.append(int(run.stdout))
    assert (tmp_path / f"x.{suffix}").stat().st_size > 8e8
    assert found[1] < 300
