"""Results of ADAMS beside runs of a deck: compared, plotted, on a page, from Python."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from adams_decks import FREE, MACHINE, STONE, stone_res

import adamslite
from adamslite.cli.main import main
from adamslite.outputs.xrf import rounded
from adamslite.results.common_terms import in_common_terms
from adamslite.results.comparison import Tolerance, compare
from adamslite.results.printed import Printed
from adamslite.results.results import Results
from adamslite.results.unit_factors import unit_ratio


@pytest.fixture
def folder(tmp_path: Path, monkeypatch) -> Path:
    monkeypatch.chdir(tmp_path)
    Path("stone.adm").write_text(STONE)
    stone_res(tmp_path)
    return tmp_path


@pytest.mark.parametrize("suffix", [".nc", ".res", ".mat"])
def test_a_run_is_compared_with_what_adams_wrote(folder: Path, suffix: str, capsys) -> None:
    """Origin and centre of mass, degrees and radians, millimetres and metres: to 1e-6."""
    assert main(["solve", "stone.adm", "--quiet", "-o", f"a{suffix}"]) == 0
    assert main(["diff", f"a{suffix}", "adams.res", "--all"]) == 0
    said = capsys.readouterr()
    compared = [line.split()[0] for line in said.out.splitlines()[1:-1]]
    assert {"PART/2.x", "PART/2.psi", "PART/2.vy", "PART/2.wz", "VARIABLE/7"} <= set(compared)
    assert "POUTPUT/1.out1: in the reference alone, not compared" in said.err
    assert "converted to the units of the deck: mm to m, mm/s to m/s" in said.err


@pytest.mark.parametrize("name", ["stone", ".hill.stone"])
def test_parts_without_ids_are_found_by_their_names(folder: Path, name: str, capsys) -> None:
    text = Path("adams.res").read_text()
    text = text.replace(' entType="Part" objectId="2"', ' entType="Part"')
    Path("adams.res").write_text(text.replace('entity="stone"', f'entity="{name}"'))
    deck = STONE.replace("PART/2, MASS", "! adams_view_name='stone'\nPART/2, MASS")
    Path("stone.adm").write_text(deck)
    assert main(["solve", "stone.adm", "--quiet", "-o", "a.nc"]) == 0
    assert main(["diff", "a.nc", "adams.res", "--all"]) == 0
    assert "PART/2.x" in capsys.readouterr().out


def test_a_wrong_run_differs_from_what_adams_wrote(folder: Path, capsys) -> None:
    """A centre of mass that is a millimetre elsewhere."""
    Path("stone.adm").write_text(STONE.replace("QP=0.3", "QP=0.301"))
    assert main(["solve", "stone.adm", "--quiet", "-o", "a.nc"]) == 0
    assert main(["diff", "a.nc", "adams.res"]) == 1
    assert "PART/2.vx" in capsys.readouterr().out


def test_the_deck_of_a_table_is_named(folder: Path, capsys) -> None:
    """A .csv does not hold its deck: parts are left out with a word, unless --deck names it."""
    assert main(["solve", "stone.adm", "--quiet"]) == 0
    assert main(["diff", "stone.csv", "adams.res"]) == 0
    said = capsys.readouterr()
    assert "PART/2.bcs_x, PART/2.bcs_y" in said.err and "give the deck by --deck" in said.err
    assert "PART/2.x" not in said.out and "PART/2.wz" in said.out
    assert main(["diff", "stone.csv", "adams.res", "--deck", "stone.adm"]) == 0
    said = capsys.readouterr()
    assert "PART/2.x" in said.out and "bcs" not in said.err
    assert main(["diff", "adams.res", "stone.csv", "--deck", "stone.adm"]) == 0


def test_another_deck_than_that_of_the_file_is_named(folder: Path, capsys) -> None:
    Path("other.adm").write_text(MACHINE.replace("PART/2", "PART/22").replace("PART=2", "PART=22"))
    assert main(["solve", "stone.adm", "--quiet"]) == 0
    assert main(["diff", "stone.csv", "adams.res", "--deck", "other.adm"]) == 0
    said = capsys.readouterr()
    assert "the deck has no such part" in said.err and "PART/2.x" not in said.out


def test_two_files_of_adams_are_compared_as_they_are(folder: Path, capsys) -> None:
    assert main(["diff", "adams.res", "adams.res", "--deck", "stone.adm"]) == 0
    assert "compared, all within" in capsys.readouterr().out


def test_nothing_in_common_is_no_agreement(folder: Path, capsys) -> None:
    Path("b.csv").write_text("time,REQUEST/5.F2\n0,1\n0.25,1\n0.5,1\n")
    assert main(["diff", "b.csv", "adams.res"]) == 1
    assert "no channel in common" in capsys.readouterr().out


def test_rounded_digits_are_no_difference() -> None:
    """A file with four decimals is met by everything that rounds to it, and by nothing else."""
    exact = np.array([[1.23456], [2.0e-6]])
    names, time = ("VARIABLE/1",), np.array([0.0, 1.0])
    run = Results(time=time, names=names, values=exact)
    printed = Printed(decimals=4)
    written = Results(time=time, names=names, values=rounded(exact, 4), printed=printed)
    assert compare(run, written, Tolerance()).inside
    off = Results(time=time, names=names, values=exact + [[1e-4], [0]])
    assert not compare(off, written, Tolerance()).inside
    small = Results(time=time, names=names, values=exact + [[0], [1e-9]])
    assert not compare(small, written, Tolerance()).inside


def test_whole_turns_and_the_split_of_aligned_angles_are_no_difference() -> None:
    """theta = 0: ADAMS may split a turn of 0.3 as 0.1 + 0.2, or as 0.3 + 2 pi."""
    names = ("PART/2.psi", "PART/2.theta", "PART/2.phi")
    ours = Results(time=np.zeros(1), names=names, values=np.array([[0.3, 0.0, 0.0]]))
    for values in ([0.1, 0.0, 0.2], [0.3 + 2 * np.pi, 1e-9, 0.0], [-0.7, 0.0, 1.0]):
        meta = {"written by": "ADAMS"}
        theirs = Results(time=np.zeros(1), names=names, values=np.array([values]), meta=meta)
        common = in_common_terms(ours, theirs)
        assert compare(common.results, common.reference, Tolerance(abs=1e-8)).inside, values


def test_units_are_converted_between_any_two_results(tmp_path, monkeypatch, capsys) -> None:
    """The same pendulum in metres and in millimetres; a number of unknown unit is named."""
    monkeypatch.chdir(tmp_path)
    mks = FREE.replace("INTEGRATOR", "VARIABLE/5, FUNCTION=2*TIME\nINTEGRATOR")
    mm = mks.replace("SYSTEM=MKS", "FORCE=NEWTON, MASS=KILOGRAM, LENGTH=MILLIMETER, TIME=SECOND")
    mm = mm.replace("QG=1,2,3", "QG=1000,2000,3000").replace("VX=3", "VX=3000")
    mm = mm.replace("QP=0.5,-0.2,0.1", "QP=500,-200,100").replace("IP=1,1,1", "IP=1E6,1E6,1E6")
    Path("a.adm").write_text(mks)
    Path("b.adm").write_text(mm)
    for name in "ab":
        assert main(["solve", f"{name}.adm", "--quiet"]) == 0
    assert main(["diff", "a.csv", "b.csv"]) == 0
    said = capsys.readouterr()
    assert "all within" in said.out and "m to mm" in said.err
    assert "VARIABLE/5: of unknown unit, compared as they are" in said.err


TENSION = """a rope that is pulled
UNITS/SYSTEM=MKS
PART/1, GROUND
VARIABLE/pull, FUNCTION=4000+500*SIN(5*TIME)
REQUEST/1, F2=VARVAL(pull)\\ F3=TIME\\, CUNITS="","N"
SIMULATE/TRANSIENT, END=1, STEPS=20
END
"""


@pytest.mark.parametrize("suffix", [".csv", ".nc"])
@pytest.mark.parametrize("head", ["[kN]", ""])
@pytest.mark.parametrize("deck", [[], ["--deck", "pull.adm"]])
def test_what_is_known_of_the_unit_of_a_table_is_said(
    suffix: str, head: str, deck: list[str], tmp_path: Path, monkeypatch, capsys
) -> None:
    """A table in kN, in its heading or without a word, beside results in N."""
    monkeypatch.chdir(tmp_path)
    Path("pull.adm").write_text(TENSION)
    run = adamslite.simulate("pull.adm")
    run.save(f"a{suffix}")
    noise = np.random.default_rng(1).normal(size=len(run.time))
    rows = zip(run.time, 1e-3 * run["REQUEST/1.F2"] + 0.02 * noise, strict=True)
    lines = [f"time [s],REQUEST/1.F2 {head}", *(f"{t},{f}" for t, f in rows)]
    Path("kN.csv").write_text("\n".join(lines) + "\n")
    known = bool(head) and (bool(deck) or suffix == ".nc")
    assert main(["diff", f"a{suffix}", "kN.csv", "--tol", "0.1", *deck]) == (0 if known else 1)
    said = capsys.readouterr().err
    assert ("converted to the units of the reference: N to kN" in said) == known
    assert ("REQUEST/1.F2: 1000 times the reference throughout" in said) != known
    named = bool(head) and not known
    assert ("one file alone names kN; compared as they are, unless --deck" in said) == named


@pytest.mark.filterwarnings("error")
@pytest.mark.parametrize(
    ("values", "ratio"),
    [
        ([5.0, -1.0, 2.0], 1000.0),
        ([5.02, -1.1, 1.91], 1000.0),
        ([6.0, -1.0, 2.0], None),
        ([0.0, 0.0, 0.0], None),
        ([np.nan, 1.0, 2.0], None),
        ([np.inf, 1.0, 2.0], None),
    ],
)
def test_a_ratio_of_two_units_is_found_under_noise_and_no_other(
    values: list[float], ratio: float | None
) -> None:
    others, found = np.array([5.0, -1.0, 2.0]), np.array(values)
    for times in (1e3, 7.0, 1.05):  # 7: of no two units
        expected = ratio if times == 1e3 else None
        assert unit_ratio(times * found, others) == pytest.approx(expected)
        assert unit_ratio(found, times * others) == pytest.approx(expected and 1.0 / expected)


def test_python_compares_like_the_command(folder: Path) -> None:
    """Units that are converted and channels that cannot be compared are warnings."""
    run = adamslite.simulate("stone.adm")
    with pytest.warns(adamslite.DeckWarning) as said:
        assert adamslite.compare(run, "adams.res").inside
    assert any("mm to m" in str(each.message) for each in said)
    run.save("a.csv")
    with pytest.warns(adamslite.DeckWarning):
        found = adamslite.compare("a.csv", "adams.res", deck="stone.adm")
    assert found.inside and "PART/2.x" in {each.name for each in found}
    with pytest.warns(adamslite.DeckWarning, match="give the deck"):
        found = adamslite.compare("a.csv", "adams.res")
    assert "PART/2.x" not in {each.name for each in found}


def test_what_adams_wrote_is_plotted(folder: Path, capsys) -> None:
    """In the terms of the deck that is named: the centre of mass, in metres."""
    assert main(["plot", "adams.res", "PART/2.y", "--deck", "stone.adm", "-o", "a.svg"]) == 0
    assert "mm to m" in capsys.readouterr().err and Path("a.svg").stat().st_size > 1000
    assert main(["plot", "stone.adm", "PART/2.y", "--against", "adams.res", "-o", "b.svg"]) == 0


def test_a_page_of_what_adams_wrote(folder: Path, capsys) -> None:
    assert main(["view", "adams.res", "--deck", "stone.adm", "-o", "a.html", "--no-open"]) == 0
    page = Path("a.html").read_text(encoding="utf-8")
    assert "PART/2" in page
