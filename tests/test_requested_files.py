"""Files that a deck requests with OUTPUT and RESULTS: which, where, and under what names."""

from __future__ import annotations

from pathlib import Path

import pytest
from adams_decks import MACHINE

from adamslite.cli.main import main

ASKING = MACHINE.replace("SIMULATE", "OUTPUT/REQSAVE, GRSAVE\nRESULTS/FORMATTED, XRF\nSIMULATE")


@pytest.fixture
def asking(tmp_path: Path, monkeypatch) -> Path:
    monkeypatch.chdir(tmp_path)
    Path("a.adm").write_text(ASKING)
    return tmp_path


def files(folder: Path) -> list[str]:
    return sorted(each.name for each in folder.iterdir() if each.suffix not in (".adm", ".acf"))


def test_output_and_results_of_a_deck_write_their_files(asking: Path, capsys) -> None:
    assert main(["solve", "a.adm"]) == 0
    assert files(asking) == ["a.csv", "a.req", "a.res"]
    said = capsys.readouterr().err
    assert "req of ADAMS         a.req" in said and "res of ADAMS         a.res" in said
    assert "passed over, as it does not change the motion: OUTPUT GRSAVE" in said
    assert main(["diff", "a.csv", "a.res"]) == 0


def test_they_have_the_name_of_the_results(asking: Path) -> None:
    Path("a.acf").write_text("a\nrun7\nSIMULATE/DYNAMIC, END=0.1, STEPS=1\nSTOP\n")
    assert main(["solve", "a.adm", "--quiet"]) == 0
    assert files(asking) == ["run7.csv", "run7.req", "run7.res"]
    assert main(["solve", "a.adm", "--quiet", "-o", "x.nc"]) == 0
    assert main(["solve", "a.adm", "--quiet", "-o", "y.res"]) == 0
    assert {"x.nc", "x.req", "x.res", "y.req", "y.res"} <= set(files(asking))


def test_limited_columns_leave_a_file_out_with_a_word(asking: Path, capsys) -> None:
    assert main(["solve", "a.adm", "--quiet", "--outputs", "PART/2.x"]) == 0
    assert files(asking) == ["a.csv", "a.req"]
    assert "a.res would be empty" in capsys.readouterr().err


def test_commands_request_them_too(tmp_path: Path, monkeypatch) -> None:
    monkeypatch.chdir(tmp_path)
    Path("a.adm").write_text(MACHINE)
    Path("a.acf").write_text("a\n\nOUTPUT/REQSAVE\nSIMULATE/DYNAMIC, END=0.1, STEPS=1\nSTOP\n")
    assert main(["solve", "a.adm", "--quiet"]) == 0
    assert files(tmp_path) == ["a.csv", "a.req"]


def test_nothing_is_written_beside_standard_output(asking: Path, capsys) -> None:
    assert main(["solve", "a.adm", "--quiet", "-o", "-"]) == 0
    assert files(asking) == [] and capsys.readouterr().out.startswith("# adamslite")


def test_a_file_of_that_name_is_checked_before_the_run(asking: Path, capsys) -> None:
    Path("a.res").mkdir()
    assert main(["solve", "a.adm"]) == 5
    assert "a.res" in capsys.readouterr().err and files(asking) == ["a.res"]


def test_a_file_that_a_command_names_is_not_theirs(asking: Path, capsys) -> None:
    Path("a.acf").write_text(
        "a\n\nSIMULATE/DYNAMIC, END=0.1, STEPS=1\nLINEAR/STATEMAT, FILE=a.res\nSTOP\n"
    )
    assert main(["solve", "a.adm"]) == 3
    assert "a.res" in capsys.readouterr().err and files(asking) == []
