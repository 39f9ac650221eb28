"""`adamslite plot`: what it reads and writes, and mistakes in one sentence each."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from plot_tables import BODY, SPRING, TIME, table

from adamslite.cli.main import main
from adamslite.results.results import Results

pytest.importorskip("matplotlib")


@pytest.fixture
def spring(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    Path("spring.adm").write_text(SPRING)
    return tmp_path


def saved(folder: Path, results: Results, name: str = "run.csv") -> str:
    results.save(folder / name)
    return name


def test_a_deck_is_solved_and_plotted(spring: Path, capsys: pytest.CaptureFixture) -> None:
    assert main(["plot", "spring.adm", "POINT_MASS/2.x", "--steps", "10"]) == 0
    assert Path("spring-plot.png").read_bytes().startswith(b"\x89PNG")
    assert "spring-plot.png: 1 of 12 channels" in capsys.readouterr().err


def test_what_a_run_knows_of_its_accuracy_is_said(
    spring: Path, capsys: pytest.CaptureFixture
) -> None:
    words = ["plot", "spring.adm", "POINT_MASS/2.x", "--audit", "--confirm", "--error", "1e-7"]
    assert main(words) == 0
    told = capsys.readouterr().err
    assert "\nenergy: " in f"\n{told}" and "confirmed" in told


def test_results_find_their_deck_beside_them(spring: Path, capsys: pytest.CaptureFixture) -> None:
    assert main(["solve", "spring.adm", "-o", "run.csv", "--quiet"]) == 0
    assert main(["plot", "run.csv", "REQUEST/1.F2", "-o", "a.svg"]) == 0
    assert "= DM(2,1)" in Path("a.svg").read_text()
    Path("spring.adm").write_text(SPRING.replace("A mass", "Another mass"))
    assert main(["plot", "run.csv", "REQUEST/1.F2", "-o", "b.svg"]) == 0
    assert "= DM(2,1)" not in Path("b.svg").read_text()
    capsys.readouterr()
    assert main(["plot", "run.csv", "REQUEST/1.F2", "-o", "c.svg", "--deck", "spring.adm"]) == 0
    assert "the deck is not the one of these results" in capsys.readouterr().err
    assert "= DM(2,1)" in Path("c.svg").read_text()


def test_the_reference_of_a_file_is_drawn(spring: Path) -> None:
    saved(spring, BODY)
    Path("reference.csv").write_text("# tolerance: abs 1\ntime,PART/2.psi\n0,0\n2,2.5\n")
    words = ["plot", "run.csv", "PART/2.psi", "--against", "reference.csv", "-o", "f.svg"]
    assert main(words) == 0
    assert "within 50 % of the tolerance of reference.csv" in Path("f.svg").read_text()


EMPTY = Results(time=np.empty(0), names=("PART/2.x",), values=np.empty((0, 1)))


@pytest.mark.parametrize(
    ("words", "code", "why"),
    [
        (["run.csv", "PART/2.y"], 2, "did you mean"),
        (["run.csv", "PART/2.x", "--x", "PART/2.q"], 2, "did you mean"),
        (["run.csv"], 2, "no channel is named; there are PART/2.x"),
        (["run.csv", "JOINT/3.fx"], 2, "JOINT/3.fx is not a number at any output time"),
        (["run.csv", "PART/2.x", "--x", "JOINT/3.fx"], 2, "JOINT/3.fx is not a number at any"),
        (["run.csv", "PART/2.x", "-o", "fig.jpg"], 2, "none of .png, .svg, .pdf"),
        (["run.csv", "PART/2.x", "-o", "fig"], 2, "none of .png, .svg, .pdf"),
        (["run.csv", "PART/2.x", "--end", "2"], 2, "there is nothing to solve"),
        (["spring.adm", "PART/2.x", "--deck", "spring.adm"], 2, "is a deck itself"),
        (["empty.csv", "PART/2.x"], 5, "empty.csv holds no output time"),
        (["nothing.csv", "PART/2.x"], 5, "'nothing.csv': No such file"),
        (["fig.png", "PART/2.x"], 5, "results cannot be read from fig.png"),
        (["words.csv", "PART/2.x"], 5, "words.csv:1: the header row must start with 'time'"),
        (["run.csv", "PART/2.x", "--against", "words.csv"], 5, "words.csv:1"),
        (["run.csv", "PART/2.x", "-o", "nowhere/fig.png"], 5, "no such folder"),
    ],
)
def test_what_cannot_be_drawn_is_one_sentence(
    spring: Path, capsys: pytest.CaptureFixture, words: list[str], code: int, why: str
) -> None:
    holes = table(PART__2_x=TIME, PART__2_vx=TIME, JOINT__3_fx=np.nan)
    saved(spring, holes)
    saved(spring, EMPTY, "empty.csv")
    Path("words.csv").write_text("these are words\n")
    Path("fig.png").write_bytes(b"\x89PNG")
    assert main(["plot", *words]) == code
    told = capsys.readouterr().err
    assert why in told and told.count("\n") == 1
    assert not list(Path().glob("*-plot.*"))


def test_no_file_that_is_read_is_written_over(spring: Path, capsys: pytest.CaptureFixture) -> None:
    saved(spring, BODY)
    Path("run.csv").rename("run.svg.csv")
    Path("fig.svg").symlink_to("run.svg.csv")
    assert main(["plot", "run.svg.csv", "PART/2.x", "-o", "fig.svg"]) == 2
    assert "is read, and would be written over" in capsys.readouterr().err


def test_without_matplotlib_there_is_one_sentence(
    spring: Path, capsys: pytest.CaptureFixture, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("importlib.util.find_spec", lambda name: None)
    assert main(["plot", saved(spring, BODY), "PART/2.x"]) == 2
    told = capsys.readouterr().err
    assert "python -m pip install matplotlib" in told and told.count("\n") == 1


def test_a_run_that_stops_early_is_plotted_up_to_there(
    spring: Path, capsys: pytest.CaptureFixture
) -> None:
    """A force 1/(0.5 - t)^3 is infinite at 0.5 s."""
    pole = SPRING.replace("END\n", "VFORCE/1, I=2, J_PART=1, FX=1/(0.5-TIME)**3\nEND\n")
    Path("pole.adm").write_text(pole)
    assert main(["plot", "pole.adm", "POINT_MASS/2.x", "-o", "pole.svg"]) == 4
    assert "stopped early at t = 0." in Path("pole.svg").read_text()


def test_a_reference_beside_results_that_went_back_is_one_sentence(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    Path("back.csv").write_text("time,x\n0,1\n1,2\n2,3\n1,7\n2,8\n")
    Path("once.csv").write_text("time,x\n0,1\n1,2\n2,3\n")
    assert main(["plot", "back.csv", "x", "--against", "once.csv", "-o", "f.svg"]) == 2
    assert "once.csv cannot be drawn beside the results: the results go back" in (
        capsys.readouterr().err
    )
