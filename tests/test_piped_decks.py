"""Decks and descriptions from standard input: `-` where the name of a file is expected."""

from __future__ import annotations

import io
import sys
from pathlib import Path

import pytest
from scenes import SPRING

import adamslite as al
from adamslite.cli.main import main

RUN = ("--end", "0.5", "--steps", "5", "--quiet")


@pytest.fixture
def piped(tmp_path: Path, monkeypatch: pytest.MonkeyPatch):
    """What comes from standard input, in an empty current folder."""
    monkeypatch.chdir(tmp_path)

    def put(text: str | bytes) -> None:
        data = text if isinstance(text, bytes) else text.encode()
        monkeypatch.setattr(sys, "stdin", io.TextIOWrapper(io.BytesIO(data)))

    return put


@pytest.mark.parametrize("output", [(), ("-o", "mine.csv")])
def test_a_run_of_a_piped_deck_is_that_of_its_file(piped, tmp_path: Path, output) -> None:
    name = output[1] if output else "stdin.csv"
    piped(SPRING)
    assert main(["solve", "-", *RUN, *output]) == 0
    found = (tmp_path / name).read_bytes()
    assert [each.name for each in tmp_path.iterdir()] == [name]
    (tmp_path / "spring.adm").write_text(SPRING)
    assert main(["solve", "spring.adm", *RUN, "-o", name]) == 0
    assert (tmp_path / name).read_bytes() == found


def test_results_of_a_piped_deck_may_go_on_through_a_pipe(piped, tmp_path: Path, capsys) -> None:
    piped(SPRING)
    assert main(["solve", "-", *RUN, "-o", "-"]) == 0
    table = [line for line in capsys.readouterr().out.splitlines() if line[0] != "#"]
    assert len(table) == 7 and not list(tmp_path.iterdir())


@pytest.mark.parametrize("command", ["solve", "check", "linear"])
def test_messages_name_the_place_in_what_was_piped(piped, capsys, command: str) -> None:
    piped(SPRING.replace("SPRINGDAMPER/", "SPRINGDUMPER/"))
    assert main([command, "-"]) == 3
    told = "".join(capsys.readouterr())
    number = SPRING[: SPRING.index("SPRINGDAMPER/")].count("\n") + 1
    assert f"<stdin>:{number}:1: error: " in told


def test_a_piped_deck_is_checked(piped, capsys) -> None:
    piped(SPRING)
    assert main(["check", "-"]) == 0
    assert "\n<stdin>: 1 note" in capsys.readouterr().out


def test_a_piped_deck_reads_tables_from_the_current_folder(piped, tmp_path: Path, capsys) -> None:
    """As one with a file does from its own, and from nowhere else."""
    deck = "a spline\nPART/1, GROUND\nSPLINE/1, FILE={name}\nEND\n"
    table = "time,A\n0,1\n1,2\n2,4\n3,8\n"
    (tmp_path / "table.csv").write_text(table)
    piped(deck.format(name="table.csv"))
    assert main(["check", "-"]) == 0, capsys.readouterr().out
    piped(deck.format(name="../table.csv"))
    assert main(["check", "-"]) == 3


def test_a_piped_deck_is_laid_out(piped, tmp_path: Path, capsys) -> None:
    piped("title\r\npart/1,ground\r\nend\r\n")
    assert main(["fmt", "-"]) == 0
    assert capsys.readouterr().out == "title\nPART/1, GROUND\nEND\n"
    piped("title\npart/1,ground\nend\n")
    assert main(["fmt", "-", "--check"]) == 1
    assert capsys.readouterr().out == "<stdin>: not in the canonical layout\n"
    assert main(["fmt", "-", "other.adm"]) == 2 and not list(tmp_path.iterdir())


def test_a_piped_description_becomes_a_deck(piped, tmp_path: Path, capsys) -> None:
    description = (Path(__file__).parents[1] / "docs/tutorials/hoist.toml").read_text()
    (tmp_path / "hoist.toml").write_text(description)
    assert main(["cable", "hoist.toml", "--no-trial", "-o", "file.adm"]) == 0
    piped(description)
    assert main(["cable", "-", "--no-trial", "-o", "piped.adm"]) == 0
    assert Path("piped.adm").read_text() == Path("file.adm").read_text()
    piped("[cable\n")
    assert main(["cable", "-"]) == 3
    assert "<stdin>:1:1: error: " in capsys.readouterr().err


def test_a_run_of_a_piped_deck_is_not_resumed(piped, capsys) -> None:
    piped(SPRING)
    assert main(["solve", "-", "--resume", "x.csv.part"]) == 2
    assert "leave out '-', standard input" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("data", "code", "said"),
    [
        (b"", 3, "<stdin>:1:1: error: no part is the ground"),
        (b"\x00\xff\x00", 3, "<stdin>:1:1: error: "),
    ],
)
def test_what_is_no_deck_is_reported(piped, capsys, data: bytes, code: int, said: str) -> None:
    piped(data)
    assert main(["solve", "-"]) == code
    assert said in "".join(capsys.readouterr())


def test_more_than_a_file_may_hold_is_not_read(piped, capsys, monkeypatch) -> None:
    monkeypatch.setattr("adamslite.language.text.MOST", 1000)
    piped("!" * 1001)
    assert main(["solve", "-"]) == 5
    assert "'<stdin>': more than" in capsys.readouterr().err


def test_a_run_of_a_piped_deck_keeps_no_file(piped, monkeypatch) -> None:
    """Nothing could read the deck again."""

    def kept(*_: object) -> None:
        raise AssertionError

    monkeypatch.setattr("adamslite.analyses.dynamics.history.Journal", kept)
    piped(SPRING)
    assert main(["solve", "-", *RUN]) == 0


def test_sweeps_and_fits_of_a_piped_deck_are_those_of_its_file(piped, tmp_path: Path) -> None:
    """The file of a sweep has the name of the deck in it, the rest is the same."""
    (tmp_path / "spring.adm").write_text(SPRING)
    assert main(["solve", "spring.adm", *RUN]) == 0
    varied = ["POINT_MASS/2.MASS=1,2", "--measure", "max POINT_MASS/2.x", "--workers", "1", *RUN]
    fitted = ["spring.csv", "--by", "POINT_MASS/2.MASS", *RUN]
    for name in ("spring.adm", "-"):
        piped(SPRING)
        assert main(["sweep", name, *varied]) == 0
        piped(SPRING)
        assert main(["fit", name, *fitted]) == 0
    one, other = (al.load_sweep(f"{name}.sweep.nc") for name in ("spring", "stdin"))
    assert (one.measures == other.measures).all() and len(one) == 2
    one, other = (Path(f"{name}.fitted.adm").read_text() for name in ("spring", "stdin"))
    assert one == other
