"""`.req` of ADAMS: written, read and compared."""

from __future__ import annotations

from pathlib import Path

import pytest
from adams_decks import MACHINE

import adamslite
from adamslite.cli.main import main
from adamslite.errors import FormatError
from adamslite.results.results import Results


def test_the_bytes_of_a_request_file(tmp_path: Path) -> None:
    deck = adamslite.read(
        "two requests\nUNITS/FORCE=NEWTON, MASS=KILOGRAM, LENGTH=MILLIMETER, TIME=SECOND\n"
        "PART/1, GROUND\nMARKER/1, PART=1\nPART/2, MASS=1, CM=2, IP=1,1,1, VX=5\nMARKER/2, PART=2\n"
        "REQUEST/7, DISPLACEMENT, I=2, J=1, RM=1\nREQUEST/8, F3=-TIME\n"
        "SIMULATE/DYNAMIC, END=0.5, STEPS=1\nEND\n"
    )
    adamslite.simulate(deck).save(tmp_path / "a.req")
    assert (tmp_path / "a.req").read_bytes().decode() == (
        " A.R3    2000-01-01 00:00:00               0         0  3D\n"
        f"{'two requests':80}\n"
        "    2     MMKGS_N_RACA 1.000000000000000E+03\n"
        "       7       1       2       1       1\n"
        "       8       5       0       0       0\n"
        "   0.00000E+00\n"
        "   0.00000E+00   0.00000E+00   0.00000E+00   0.00000E+00   0.00000E+00   0.00000E+00\n"
        "   0.00000E+00   0.00000E+00   0.00000E+00   0.00000E+00   0.00000E+00   0.00000E+00\n"
        "   5.00000E-01\n"
        "   2.50000E+00   0.00000E+00   0.00000E+00   0.00000E+00   0.00000E+00   0.00000E+00\n"
        "   0.00000E+00  -5.00000E-01   0.00000E+00   0.00000E+00   0.00000E+00   0.00000E+00\n"
    )


def test_a_request_file_of_adams_without_requests(tmp_path: Path) -> None:
    """As ADAMS 2017 writes it, with the first time twice."""
    (tmp_path / "a.req").write_text(
        " A.R3    2017-12-20 16:18:45               0         0  3D\ntitle\n"
        "    0     MMKGS_N_RACA 1.000000000000000E+03\n   0.00000E+00\n   0.00000E+00\n"
        "   5.00000E-03\n"
    )
    found = Results.load(tmp_path / "a.req")
    assert found.names == () and found.time.tolist() == [0.0, 0.005]


@pytest.mark.parametrize("named", [False, True])
def test_a_name_may_follow_the_entry_of_a_request(tmp_path: Path, named: bool) -> None:
    """RecurDyn writes an entry as one line, MotionSolve as two."""
    names = [" the tip  of it\n", " 5 wheels\n"] if named else ["", ""]
    (tmp_path / "a.req").write_text(
        " A.R3    2017-12-20\ntitle\n 2 MMKGS_N_RACA 1\n"
        f" 5 1 20 30 0\n{names[0]} 9 5 0 0 0\n{names[1]}"
        " 0.5\n 1 2 3 4 5 6\n 7 8 9 10 11 12\n"
    )
    found = Results.load(tmp_path / "a.req")
    assert found.time.tolist() == [0.5]
    assert found["REQUEST/5.F2"].tolist() == [1.0] and found["REQUEST/5.F8"].tolist() == [6.0]
    assert found["REQUEST/9.F6"].tolist() == [10.0]


def test_a_run_is_compared_with_a_request_file(tmp_path, monkeypatch, capsys) -> None:
    """Six digits of numbers and of times (thirds) are no difference; a seventh is not compared."""
    monkeypatch.chdir(tmp_path)
    Path("a.adm").write_text(MACHINE.replace("STEPS=4", "STEPS=3"))
    assert main(["solve", "a.adm", "--quiet", "-o", "a.req"]) == 0
    assert main(["solve", "a.adm", "--quiet", "-o", "a.nc"]) == 0
    assert main(["diff", "a.nc", "a.req", "--tol", "0", "--all"]) == 0
    said = capsys.readouterr()
    assert "REQUEST/1.F6" in said.out and "REQUEST/2.F4" in said.err
    text = Path("a.req").read_text()
    Path("b.req").write_text(text.replace("   8.00000E-01", "   8.00010E-01"))
    assert main(["diff", "a.nc", "b.req", "--tol", "0"]) == 1
    assert "REQUEST/2.F3" in capsys.readouterr().out


@pytest.mark.parametrize(
    ("text", "sentence"),
    [
        ("", "does not begin with A.R3"),
        ("x\ny\nz\n", "does not begin with A.R3"),
        (" A.R3\ntitle", "does not begin with A.R3"),
        (" A.R3\ntitle\n", "cut off"),
        (" A.R3\ntitle\n 1 M\n", "cut off"),
        (" A.R3\ntitle\n 1 M\n 5 1 2 3 0\n 0.0\n 1 2 3\n", "no multiple of the 7"),
        (" A.R3\ntitle\n 1 M\n 5 1 2 3 0\n 0.0\n 1 2 3 4 5 x\n", "cut off"),
        (" A.R3\ntitle\n 2 M\n 5 1 2 3 0\n 0.0\n 1 2 3 4 5 6\n", "is not that of a REQUEST"),
        (" A.R3\ntitle\n 2 M\n 5 1 2 3 0\n 5 1 2 3 0\n 0.0\n", "have one number"),
        ("\0\0 A.R3", "not a request file in text"),
    ],
)
def test_bad_request_files_are_named(text: str, sentence: str, tmp_path: Path, capsys) -> None:
    (tmp_path / "a.req").write_text(text)
    with pytest.raises(FormatError, match=sentence):
        Results.load(tmp_path / "a.req")
    assert main(["diff", str(tmp_path / "a.req"), str(tmp_path / "a.req")]) == 5
    assert capsys.readouterr().err.count("\n") == 1
