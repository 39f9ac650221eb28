"""Where a run writes: beside its results, and never over what was read."""

from __future__ import annotations

import json
import os
from pathlib import Path

import pytest

from adamslite.cli.main import main

DECK = """\
a mass between a spring and a force from outside
PART/1, GROUND
MARKER/1, PART=1
POINT_MASS/2, MASS=1, CM=2, QG=1,0,0
MARKER/2, POINT_MASS=2
SFORCE/1, TRANSLATION, I=2, J=1, FUNCTION=-4*(DM(2,1)-1)
REQUEST/1, DISPLACEMENT, I=2
END
"""
RUN = "SIMULATE/DYNAMICS, END=0.01, STEPS=1"
DECK_ERRORS, USAGE, IO_FAILED = 3, 2, 5


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """The current folder, with a deck, its commands beside it, and a precious file above."""
    here = tmp_path / "here"
    here.mkdir()
    (tmp_path / "precious").write_text("precious\n")
    (here / "o.adm").write_text(DECK)
    monkeypatch.chdir(here)
    return here


def commands(*lines: str) -> None:
    Path("o.acf").write_text("".join(f"{line}\n" for line in (*lines, "STOP")))


def contents() -> dict[str, bytes]:
    """Every file of the current folder and of that above."""
    return {str(p): p.read_bytes() for p in Path("..").rglob("*") if p.is_file()}


def refused(capsys: pytest.CaptureFixture, argv: list[str], code: int) -> str:
    """What is said of a command that ends with ``code``, writes nothing and solves nothing."""
    before = contents()
    assert main(argv) == code
    assert contents() == before
    return capsys.readouterr().err


@pytest.mark.parametrize(
    "name",
    [
        "../precious", "../../x", "..", ".", "sub/x", "/tmp/x", "\\\\host\\x", "..\\x", "C:x",
        "C:\\x", ".profile", ".", "a\tb", "",
    ],
)  # fmt: skip
def test_a_name_in_a_command_file_is_a_bare_file_name(folder, capsys, name: str) -> None:
    commands(RUN, f'LINEAR/STATEMAT, FILE="{name}"')
    said = refused(capsys, ["solve", "o.adm"], DECK_ERRORS)
    assert "o.acf:2:18: error: " in said and "[not-a-file-name]" in said


def test_eigenvalues_have_no_file_to_name(folder, capsys) -> None:
    commands(RUN, "LINEAR/EIGENSOL, FILE=../precious")
    assert main(["solve", "o.adm"]) == 0
    assert (folder.parent / "precious").read_text() == "precious\n"
    assert "[no-effect]" in capsys.readouterr().err and Path("o.modes.csv").exists()


@pytest.mark.parametrize("name", ("o.adm", "o.acf", "o.csv", "link", "hard"))
def test_a_file_of_the_run_is_not_a_name_to_write_to(folder, capsys, name: str) -> None:
    """The deck, its commands, the results; also by another name of theirs."""
    Path("link").symlink_to("o.adm")
    commands(RUN, f"LINEAR/STATEMAT, FILE={name}")
    os.link("o.acf", "hard")
    said = refused(capsys, ["solve", "o.adm"], DECK_ERRORS)
    assert "o.acf:2:18: error: the file" in said and "[file-taken]" in said


def test_two_commands_with_one_file_are_told(folder, capsys) -> None:
    commands(RUN, "LINEAR/STATEMAT, FILE=a.json", "LINEAR/STATEMAT, FILE=a.json")
    assert "[file-taken]" in refused(capsys, ["solve", "o.adm"], DECK_ERRORS)


def test_a_file_without_a_name_of_its_own_keeps_off_those_named(folder) -> None:
    commands(RUN, "LINEAR/STATEMAT", "LINEAR/STATEMAT, FILE=o.states.json")
    assert main(["solve", "o.adm"]) == 0
    assert sorted(os.listdir()) == ["o.2.states.json", "o.acf", "o.adm", "o.csv", "o.states.json"]


@pytest.mark.parametrize("name", ("o.csv", "o.states.json", "o.modes.csv", "m.json"))
def test_a_link_out_of_the_folder_is_not_followed(folder, capsys, name: str) -> None:
    """Such as may come with a deck; -o NAME follows a link, because the user gave that name."""
    commands(RUN, "LINEAR/EIGENSOL", "LINEAR/STATEMAT", "LINEAR/STATEMAT, FILE=m.json")
    Path(name).symlink_to("../precious")
    assert "leads out of its folder" in refused(capsys, ["solve", "o.adm"], USAGE)
    Path(name).unlink()
    Path(name).symlink_to("../new")
    assert "leads out of its folder" in refused(capsys, ["solve", "o.adm"], USAGE)


def test_a_name_that_the_user_gives_may_be_a_link(folder) -> None:
    commands(RUN)
    Path("out.csv").symlink_to("../new.csv")
    assert main(["solve", "o.adm", "-o", "out.csv", "--quiet"]) == 0
    assert (folder.parent / "new.csv").read_text().startswith("# adamslite")


def test_a_trap_for_the_draft_is_not_stepped_into(folder, capsys, monkeypatch) -> None:
    """Content is written to a draft first; a link in its place, whose name cannot be known
    before, is not followed.
    """
    commands(RUN)
    monkeypatch.setattr(os, "urandom", bytes)
    Path(".o.csv.00000000.part").symlink_to("../precious")
    assert main(["solve", "o.adm", "--quiet"]) == 5
    assert "'o.csv': File exists" in capsys.readouterr().err
    assert (folder.parent / "precious").read_text() == "precious\n"


@pytest.mark.parametrize("kind", ("same", "symbolic", "hard"))
@pytest.mark.parametrize("read", ("o.adm", "o.acf"))
@pytest.mark.parametrize(
    ("command", "suffix"),
    [("solve", ""), ("linear", ".json"), ("chart", ".csv"), ("chart", ".png"), ("chart", ".svg")],
)
def test_what_is_read_is_never_written(folder, capsys, command, suffix, read, kind) -> None:
    commands(RUN)
    name = read
    if suffix or kind != "same":
        name = f"other{suffix}"
        os.link(read, name) if kind == "hard" else Path(name).symlink_to(read)
    output = "other" if command == "chart" else name
    said = refused(capsys, [command, "o.adm", "-o", output], USAGE)
    assert f"'{name}' is read, and would be written over" in said


@pytest.mark.parametrize("hard", (False, True))
def test_a_description_is_not_written_over(folder, capsys, hard: bool) -> None:
    Path("scene.toml").write_text("nothing\n")
    os.link("scene.toml", "a.adm") if hard else Path("a.adm").symlink_to("scene.toml")
    assert "would be written over" in refused(capsys, ["cable", "scene.toml", "-o", "a.adm"], USAGE)


@pytest.mark.parametrize(
    ("file", "said"), [("m.json", "folder"), ("o.modes.csv", "folder"), ("x" * 250, "too long")]
)
def test_all_outputs_are_looked_at_before_the_run(folder, capsys, monkeypatch, file, said) -> None:
    """A folder in the place of a file, a name too long for the system."""
    monkeypatch.setattr("adamslite.cli.commands.solve._write", pytest.fail)
    commands(RUN, "LINEAR/EIGENSOL", f"LINEAR/STATEMAT, FILE={'m.json' if '.' in file else file}")
    if said == "folder":
        Path(file).mkdir()
    assert said in refused(capsys, ["solve", "o.adm"], IO_FAILED)


def test_modes_without_a_file_to_lie_beside_are_told_of(folder, capsys) -> None:
    commands(RUN, "LINEAR/EIGENSOL")
    assert main(["solve", "o.adm", "-o", "-"]) == 0
    assert "linearised model     not written" in capsys.readouterr().err
    assert sorted(os.listdir()) == ["o.acf", "o.adm"]


def test_the_first_line_of_the_summary_names_commands_nobody_asked_for(folder, capsys) -> None:
    commands(RUN)
    for argv, first in (
        (["o.adm"], "o.adm with o.acf beside it: "),
        (["o.adm", "o.acf"], "o.adm: "),
    ):
        assert main(["solve", *argv]) == 0
        assert capsys.readouterr().err.startswith(first)
        assert main(["solve", *argv, "--summary", "json"]) == 0
        facts = json.loads(capsys.readouterr().out)
        assert (facts["deck"], facts["commands"], facts["output"]) == ("o.adm", "o.acf", "o.csv")
    assert main(["check", "o.adm"]) == 0
    assert capsys.readouterr().out.startswith("o.adm with o.acf beside it: ")
    assert main(["linear", "o.adm"]) == 0
    assert capsys.readouterr().err == "o.adm with o.acf beside it\n"


# ---- tables that are read, and the output prefix ------------------------------------------------

TABLE = "x,y\n0,0\n1,1\n2,4\n3,9\n"


@pytest.mark.parametrize(
    ("statement", "change"),
    [
        ("SPLINE/1, FILE=o.csv", ""),
        ("SPLINE/1, FILE=./o.csv", ""),
        ("SPLINE/1, FILE=other.csv", "SPLINE/1, FILE=o.csv"),
        ("MATRIX/1, FILE=o.csv", ""),
    ],
)
def test_a_table_that_the_deck_reads_is_not_written_over(
    folder: Path, capsys: pytest.CaptureFixture, statement: str, change: str
) -> None:
    """The results of o.adm would go to o.csv."""
    for name in ("o.csv", "other.csv"):
        Path(name).write_text(TABLE)
    Path("o.adm").write_text(DECK.replace("END\n", f"{statement}\nEND\n"))
    commands(*filter(None, (change, RUN)))
    said = refused(capsys, ["solve", "o.adm"], USAGE)
    assert "o.csv' is read, and would be written over" in said
    assert main(["solve", "o.adm", "-o", "r.csv"]) == 0


@pytest.mark.parametrize("prefix", ["o\nrun 1", "file/model=o, output_prefix=run 1"])
def test_the_output_prefix_names_the_results(
    folder: Path, capsys: pytest.CaptureFixture, prefix: str
) -> None:
    commands(prefix, RUN, "LINEAR/EIGENSOL")
    assert main(["solve", "o.adm"]) == 0
    assert sorted(os.listdir()) == ["o.acf", "o.adm", "run 1.csv", "run 1.modes.csv"]
    assert main(["solve", "o.adm", "-o", "r.csv"]) == 0
    assert Path("r.csv").exists() and Path("r.modes.csv").exists()
    assert "note" not in capsys.readouterr().err


@pytest.mark.parametrize("prefix", ["../precious", "C:\\run", ".run", "/tmp/run"])
def test_a_prefix_elsewhere_is_not_followed(
    folder: Path, capsys: pytest.CaptureFixture, prefix: str
) -> None:
    commands(f'file/model=o, output_prefix="{prefix}"', RUN)
    assert main(["solve", "o.adm"]) == 0
    assert Path("o.csv").exists() and "[prefix-unused]" in capsys.readouterr().err
    assert (folder.parent / "precious").read_text() == "precious\n"


def test_a_prefix_does_not_write_over_what_is_read(
    folder: Path, capsys: pytest.CaptureFixture
) -> None:
    Path("road.csv").write_text(TABLE)
    Path("o.adm").write_text(DECK.replace("END\n", "SPLINE/1, FILE=road.csv\nEND\n"))
    commands("o", "road", RUN)
    assert "road.csv' is read" in refused(capsys, ["solve", "o.adm"], USAGE)
