"""`.res` of ADAMS as it is read: XML, the older text, and damaged files."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from adams_decks import stone_res, text_form

from adamslite.cli.main import main
from adamslite.errors import FormatError
from adamslite.results.results import Results


@pytest.fixture
def folder(tmp_path: Path, monkeypatch) -> Path:
    monkeypatch.chdir(tmp_path)
    stone_res(tmp_path)
    return tmp_path


def test_a_file_of_adams_is_read(folder: Path) -> None:
    """Ids that skip and are in no order in the map, degrees, the raw input and the first of two
    initial steps left aside.
    """
    found = Results.load("adams.res")
    assert found.time.tolist() == [0.0, 0.25, 0.5]
    assert found.names[0] == "VARIABLE/7" and found.names[1:7] == tuple(
        f"PART/2.bcs_{name}" for name in ("x", "y", "z", "psi", "theta", "phi")
    )
    assert found["PART/2.bcs_psi"][0] == pytest.approx(np.pi / 2)
    assert found["PART/2.wz"] == pytest.approx([2.0] * 3)
    assert found["VARIABLE/7"].tolist() == [0.0, 0.5, 1.0]
    assert found["POUTPUT/1.out1"].tolist() == [1.0] * 3
    assert found.channel("PART/2.bcs_vx").unit == "mm/s"
    assert found.channel("PART/2.wz").unit == "rad/s"
    assert found.meta == {
        "deck": "a falling part", "written by": "Adams 2017 Adams Solver (C++)",
    }  # fmt: skip


def test_steps_of_another_kind_are_left_aside(folder: Path) -> None:
    """Eigenvalues have a map of their own; a step of the motion has to have what the map names."""
    text = Path("adams.res").read_text()
    eigen = '<Data name="eigen_001"><Step type="eigen">1 2 3</Step></Data><TerminationStatus'
    Path("adams.res").write_text(text.replace("<TerminationStatus", eigen))
    assert Results.load("adams.res").time.tolist() == [0.0, 0.25, 0.5]


BAD = {
    "binary": (b"\x00\x01ADAMS" + bytes(100), "binary form .* RESULTS/FORMATTED, XRF"),
    "a text": (b"time,x\n0,1\n", "no results file of ADAMS"),
    "nothing": (b"", "no results file of ADAMS"),
    "other XML": (b"<html><body/></html>", "names no TIME"),
    "no namespace": (b"<Results><Analysis/></Results>", "not in the namespace"),
    "a bomb": (b"<!DOCTYPE a [<!ENTITY b 'c'>]><a>&b;</a>", "declares a document type"),
}


@pytest.mark.parametrize("content", BAD)
def test_what_is_no_results_file_is_one_sentence(content: str, tmp_path: Path, capsys) -> None:
    data, sentence = BAD[content]
    path = tmp_path / "a.res"
    path.write_bytes(data)
    with pytest.raises(FormatError, match=sentence):
        Results.load(path)
    assert main(["diff", str(path), str(path)]) == 5
    assert capsys.readouterr().err.count("\n") == 1


@pytest.mark.parametrize("share", [0.05, 0.3, 0.6, 0.9, 0.98])
def test_xml_that_is_cut_off_is_named(folder: Path, share: float) -> None:
    data = Path("adams.res").read_bytes()
    Path("adams.res").write_bytes(data[: int(share * len(data))])
    with pytest.raises(FormatError, match="adams.res is damaged or cut off"):
        Results.load("adams.res")


@pytest.mark.parametrize(
    ("old", "new", "sentence"),
    [
        ("7 7 7 7 7 7\n7", "7 7 7 7 7\n7", "a step of it has 14 numbers where 15 are named"),
        ("7 7 7 7 7 7\n7", "7 7 x 7 7 7\n7", "damaged"),
        ('id="56"', 'id="-"', "a component of 'LOAD' has no number"),
        ('objectId="7"', 'objectId="7" x', "damaged or cut off"),
        ('name="VY"', 'name="VX"', "'PART/2.bcs_vx' is there twice"),
    ],
)
def test_damage_is_named(folder: Path, old: str, new: str, sentence: str) -> None:
    text = Path("adams.res").read_text()
    Path("adams.res").write_text(text.replace(old, new, 1))
    with pytest.raises(FormatError, match=sentence):
        Results.load("adams.res")


def test_the_older_text_form_is_read(tmp_path: Path) -> None:
    (tmp_path / "a.res").write_text(text_form([0.0, 0.5]))
    found = Results.load(tmp_path / "a.res")
    assert found.time.tolist() == [0.0, 0.5] and found.meta["deck"] == "a sledge"
    assert found["PART/5.bcs_x"].tolist() == [0.0, 0.5]
    assert found["PART/5.bcs_z"].tolist() == [-1.0, -1.0]
    assert found["PART/5.bcs_psi"] == pytest.approx([np.pi / 3] * 2, abs=1e-5)
    assert found["PART/5.wz"].tolist() == [-2.0, -2.0] and found.printed.digits == 6


@pytest.mark.parametrize("cut", [30, 100, 200, 420])
def test_a_text_form_that_is_cut_off_is_named(tmp_path: Path, cut: int) -> None:
    (tmp_path / "a.res").write_text(text_form([0.0, 0.5])[:-cut])
    with pytest.raises(FormatError, match="damaged or cut off"):
        Results.load(tmp_path / "a.res")
