"""Attacks on the promises of docs/security.md: what a deck and a command file have written."""

from __future__ import annotations

import os
from pathlib import Path

import pytest
from scenes import SPRING

import adamslite as al
from adamslite.cli.main import main
from adamslite.language.file_name import is_file_name

ESCAPES = [
    "../a", "/tmp/a", "a/b", r"a\b", r"\\host\share\a", "//host/a", "C:a", r"C:\a", "a:stream",
    ".a", "..", ".", "", " a", "a ", "a.", "-a", "a*", "a?", "a|b", "a<b",
    'a"b', "a\x00b", "a\x1bb",
    "con", "NUL", "nul.csv", "Aux.a.b", "com1", "LPT9.txt", "COM¹", "conin$", "a\nb", "a\u202eb",
]  # fmt: skip


@pytest.mark.parametrize("name", ESCAPES)
def test_a_name_that_is_more_than_a_name_is_refused(name: str) -> None:
    assert not is_file_name(name)


@pytest.mark.parametrize("name", ["a", "a.b", "console.csv", "com10", "nulls", "crane-2 b_c", "ä"])
def test_a_plain_name_is_taken(name: str) -> None:
    assert is_file_name(name)


def scene(folder: Path, commands: str) -> list[str]:
    """A deck and its command file; the words that solve it there."""
    (folder / "deck.adm").write_text(SPRING)
    (folder / "deck.acf").write_text(commands)
    return ["solve", str(folder / "deck.adm"), "--quiet"]


WRITING = (
    "SAVE/SYSTEM, FILE={}", "LINEAR/STATEMAT, FILE={}", "LINEAR/MKB, FILE={}",
    "LINEAR/STATEMAT, FORMAT=MATLAB, FILE={}",
)  # fmt: skip


@pytest.mark.parametrize("command", WRITING)
@pytest.mark.parametrize("name", ["../out", "/out", "sub/out", "C:out", ".profile", "nul", "a:b"])
def test_no_command_writes_elsewhere(
    command: str, name: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    folder = tmp_path / "run"
    (folder / "sub").mkdir(parents=True)
    monkeypatch.chdir(folder)
    words = scene(folder, f"SIMULATE/STATIC\n{command.format(name)}\n")
    assert main(words) == 3
    assert sorted(each.name for each in tmp_path.rglob("*")) == [
        "deck.acf", "deck.adm", "run", "sub"
    ]  # fmt: skip


@pytest.mark.parametrize("name", ["../out", "/out", "C:out", ".profile", "nul", "con.1"])
@pytest.mark.parametrize("form", ["FILE/OUTPUT_PREFIX={}\n", "deck.adm\n{}\n"])
def test_no_prefix_leads_elsewhere(
    form: str, name: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    folder = tmp_path / "run"
    folder.mkdir()
    monkeypatch.chdir(folder)
    main(scene(folder, f"{form.format(name)}SIMULATE/STATIC\n"))
    written = {each.name for each in tmp_path.rglob("*")} - {"run", "deck.adm", "deck.acf"}
    assert written <= {"deck.csv"}


@pytest.mark.parametrize("command", WRITING[:3])
def test_no_command_replaces_a_file_of_the_user(
    command: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys
) -> None:
    """Its own files of an earlier run it does replace."""
    monkeypatch.chdir(tmp_path)
    words = scene(tmp_path, f"SIMULATE/STATIC\n{command.format('Makefile')}\n")
    (tmp_path / "Makefile").write_text("all: precious\n")
    assert main(words) == 2
    assert "is there and is no file of results" in capsys.readouterr().err
    assert (tmp_path / "Makefile").read_text() == "all: precious\n"
    assert not (tmp_path / "deck.csv").exists()
    (tmp_path / "Makefile").unlink()
    assert main(words) == main(words) == 0


def test_matrices_replace_no_table_of_the_user(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys
) -> None:
    """Both are numbers and nothing else."""
    monkeypatch.chdir(tmp_path)
    words = scene(tmp_path, f"SIMULATE/STATIC\n{WRITING[3].format('wind')}\n")
    for number in ("0.0 1.5\n", "17"):
        (tmp_path / "winda").write_text(number)
        assert main(words) == 2
        assert "is there and is no file of results" in capsys.readouterr().err
        assert (tmp_path / "winda").read_text() == number
    (tmp_path / "winda").unlink()
    assert main(words) == main(words) == 0


@pytest.mark.parametrize("suffix", ["csv", "req", "res"])
def test_results_that_nobody_named_replace_results_alone(
    suffix: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The first part of their names is what the command file says."""
    monkeypatch.chdir(tmp_path)
    words = scene(tmp_path, "FILE/OUTPUT_PREFIX=thesis\nSIMULATE/STATIC\n")
    asked = "OUTPUT/REQSAVE\nRESULTS/XRF\nREQUEST/1, F2=TIME\nEND\n"
    (tmp_path / "deck.adm").write_text(SPRING.replace("END\n", asked))
    (tmp_path / f"thesis.{suffix}").write_text("ten years of work\n")
    assert main(words) == 2
    assert (tmp_path / f"thesis.{suffix}").read_text() == "ten years of work\n"
    (tmp_path / f"thesis.{suffix}").unlink()
    assert main(words) == main(words) == 0
    (tmp_path / "thesis.csv").write_text("ten years of work\n")
    assert main([*words, "-o", "thesis.csv"]) == 0  # the user has named it


@pytest.mark.skipif(os.name == "nt", reason="links of Unix")
@pytest.mark.parametrize("name", ["deck.csv", "a.sav", "deck.modes.csv"])
def test_no_result_goes_through_a_link(
    name: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """It may have come with the deck."""
    folder, victim = tmp_path / "run", tmp_path / "victim"
    folder.mkdir()
    monkeypatch.chdir(folder)
    (folder / name).symlink_to(victim)
    words = scene(folder, "SIMULATE/STATIC\nLINEAR/EIGENSOL\nSAVE/SYSTEM, FILE=a.sav\n")
    assert main(words) == 2
    assert not victim.exists()


def test_a_deck_in_python_writes_nothing(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    deck = al.read(SPRING.replace("END\n", "OUTPUT/REQSAVE\nRESULTS/XRF\nEND\n"))
    al.simulate(deck, commands="SIMULATE/STATIC\nSAVE/SYSTEM, FILE=a.sav\nLINEAR/EIGENSOL\n")
    assert not [*tmp_path.iterdir()]
