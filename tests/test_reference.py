"""Reference files, and the verdict on decks that have one."""

from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from fakes import fall, stopped

from adamslite.errors import FormatError
from adamslite.resources import find
from adamslite.results.comparison import Mismatch, Tolerance
from adamslite.results.outcomes import Outcome
from adamslite.results.results import Results
from adamslite.verification.reference_file import Reference, read_reference
from adamslite.verification.verification import Case, Verdict, find_cases, verify

TABLE = "time,PART/2.x\n0,0\n0.5,0.125\n1,0.5\n"


def reference(tmp_path: Path, text: str) -> Reference:
    """Read `text` as a reference file."""
    path = tmp_path / "reference.csv"
    path.write_text(text)
    return read_reference(path)


def test_every_instruction_is_understood(tmp_path: Path) -> None:
    read = reference(
        tmp_path,
        "# Bessel solution: see README.md\n"
        "# tolerance: abs 1e-7\n"
        "# tolerance PART/*.vx: rel 1e-5 abs 1e-8\n"
        "# solve: --error 1e-8 --hmax 0.01 --integrator gstiff\n"
        "# expect: SINGULAR_ACCELERATION at 1.0 within 1e-3\n"
        "# interpolate: cubic\n"
        "# measure: mean PART/2.x from 0.5 to 1 = 0.3 tol rel 1e-3\n"
        "# units: integrator written by make_reference.py\n" + TABLE,
    )
    assert read.tolerance_of("PART/2.x") == Tolerance(abs=1e-7)
    assert read.tolerance_of("part/3.VX") == Tolerance(abs=1e-8, rel=1e-5)
    assert read.options == {"error": 1e-8, "hmax": 0.01, "integrator": "GSTIFF"}
    assert read.outcome is Outcome.SINGULAR_ACCELERATION and read.stop == (1.0, 1e-3)
    assert read.interpolate == "cubic"
    assert (read.measures[0].start, read.measures[0].end) == (0.5, 1.0)


@pytest.mark.parametrize(
    ("line", "message"),
    [
        ("tolerence: abs 1", "did you mean 'tolerance:'"),
        ("tolerance: 1e-6", "'1e-6' is not a tolerance"),
        ("tolerance: abs x", "'x' is not a number"),
        ("tolerance: rel 1e999", "'1e999' is no finite number"),
        ("tolerance: abs 1 foo 2", "is not a tolerance"),
        ("tolerance: digits 1.5", "how many significant digits"),
        ("tolerance: digits 0", "how many significant digits"),
        ("measures: mean x = 1 tol abs 1", "did you mean 'measure:'"),
        ("solve: --ned 1", "unrecognized arguments: --ned"),
        ("solve: --end -1", "must be a positive number"),
        ("expect: SINGULAR_ACELERATION", "did you mean SINGULAR_ACCELERATION?"),
        ("expect: DONE at 1", "write 'expect: OUTCOME'"),
        ("interpolate: quintic", "there are linear, cubic"),
        ("measure: mean x", "write 'measure: mean NAME"),
        ("measure: median x = 1 tol abs 1", "there are mean, max"),
        ("measure: value x = 1 tol abs 1", "takes one time"),
        ("measure: mean x at 1 = 1 tol abs 1", "takes one time"),
        ("measure: value x at 1 to 2 = 1 tol abs 1", "takes one time"),
        ("measure: arrival x = 1 tol abs 1", "takes a level"),
        ("measure: max x through 1 = 1 tol abs 1", "takes a level"),
        ("measure: max x smoothed by = 1 tol abs 1", "'by' is not a number"),
    ],
)
def test_a_wrong_instruction_is_explained(tmp_path: Path, line: str, message: str) -> None:
    with pytest.raises(FormatError) as fault:
        reference(tmp_path, f"# free text\n# {line}\n{TABLE}")
    assert "reference.csv:2: " in str(fault.value)
    assert message in str(fault.value)


@pytest.mark.parametrize(
    ("measure", "value"),
    [
        ("mean PART/2.vx", 0.5),
        ("mean PART/2.vx from 0.5 to 1", 0.75),
        ("mean PART/2.vx from 0.5 to 0.5", 0.5),
        ("max PART/2.vx to 0.3", 0.3),
        ("min PART/2.vx from 0.3", 0.3),
        ("range PART/2.vx from 0.2 to 0.7", 0.5),
        ("last PART/2.vx", 1.0),
        ("value PART/2.vx at 0.4", 0.4),
        ("arrival PART/2.vx through 0.55", 0.55),
        ("arrival PART/2.vx through 0.55 from 0.3 to 0.6", 0.55),
        ("max PART/2.vx smoothed 0.2 to 0.95", 0.9),
        ("value PART/2.vx smoothed 0.2 at 0.4", 0.4),
        # Of t^2/2 over a width w, joined by straight lines over h: t^2/2 + w^2/24 + h^2/12.
        ("value PART/2.x smoothed 0.2 at 0.4", 0.08 + 0.04 / 24 + 0.01 / 12),
        ("max PART/2.x smoothed 0.4 from 0.3 to 0.5", 0.125 + 0.16 / 24 + 0.01 / 12),
    ],
)
def test_measures(tmp_path: Path, measure: str, value: float) -> None:
    read = reference(tmp_path, f"# measure: {measure} = {value} tol abs 1e-12\n")
    assert read.judge(fall()).inside
    off = reference(tmp_path, f"# measure: {measure} = {value + 1e-3} tol abs 9e-4\n")
    assert not off.judge(fall()).inside


@pytest.mark.parametrize(
    ("measure", "message"),
    [
        ("mean PART/2.vx from 0.5 to 2", "is not covered by the results"),
        ("mean PART/3.vx", "no channel 'PART/3.vx'"),
        ("value PART/2.vx at 0.45", "is not an output time"),
        ("arrival PART/2.vx through 2", "never passes 2 from t = 0 to 1: it stays in 0 to 1"),
    ],
)
def test_measures_that_cannot_be_taken(tmp_path: Path, measure: str, message: str) -> None:
    read = reference(tmp_path, f"# measure: {measure} = 1 tol abs 1\n")
    with pytest.raises(Mismatch, match=message):
        read.judge(fall())


def folder(tmp_path: Path, **files: str) -> Path:
    """Make the folder `case` of the named files."""
    place = tmp_path / "case"
    place.mkdir()
    for name, text in files.items():
        (place / name.replace("__", "-").replace("_", ".")).write_text(text)
    return place


def judge(tmp_path: Path, text: str, results: Results) -> Verdict:
    """Return the verdict on `results` as the run of a deck with the reference `text`."""
    place = folder(tmp_path, case_adm="", reference_csv=text)
    (verdict,) = verify(find_cases([place]), lambda deck, options: results)
    return verdict


def test_a_folder_with_one_deck(tmp_path: Path) -> None:
    place = folder(tmp_path, case_adm="", reference_csv="", reference__tight_csv="", other_csv="")
    cases = find_cases([tmp_path])
    assert {case.name for case in cases} == {"case", "case (tight)"}
    assert {case.deck for case in cases} == {place / "case.adm"}
    assert find_cases([place / "case.adm"]) == cases


def test_a_folder_with_several_decks(tmp_path: Path) -> None:
    place = folder(tmp_path, a_adm="", b_adm="", a_reference_csv="", b_reference__x_csv="")
    cases = find_cases([place])
    assert [case.name for case in cases] == ["case/a", "case/b (x)"]
    assert [case.deck.name for case in cases] == ["a.adm", "b.adm"]
    assert [case.name for case in find_cases([place / "b.adm"])] == ["case/b (x)"]


def test_a_reference_that_belongs_to_no_deck_fails(tmp_path: Path) -> None:
    place = folder(tmp_path, a_adm="", b_adm="", reference_csv="# tolerance: abs 1\n" + TABLE)
    (verdict,) = verify(find_cases([place]), lambda deck, options: fall())
    assert not verdict.passed and "exactly one deck" in verdict.text


def test_the_worst_deviation_against_its_tolerance(tmp_path: Path) -> None:
    results = fall()
    results.values[5:, 0] += 1e-3
    verdict = judge(tmp_path, "# tolerance: abs 2e-3\n" + TABLE, results)
    assert verdict.passed
    assert verdict.text == "PART/2.x off by 1.00e-03 of 2.00e-03 allowed at t = 0.5"
    assert verdict.share == pytest.approx(0.5)
    tighter = "# tolerance: abs 1e-4\n" + TABLE
    (verdict,) = verify([_rewritten(verdict.case, tighter)], lambda deck, options: results)
    assert not verdict.passed and verdict.text.endswith("; outside from t = 0.5")


def _rewritten(case: Case, text: str) -> Case:
    case.reference.write_text(text)
    return case


def test_a_column_without_tolerance_is_an_error(tmp_path: Path) -> None:
    verdict = judge(tmp_path, "# tolerance PART/3.x: abs 1\n" + TABLE, fall())
    assert not verdict.passed and "fits the column 'PART/2.x'" in verdict.text


@pytest.mark.parametrize(
    ("expected", "results", "passed"),
    [
        ("", stopped(Outcome.NEWTON_FAILED, message="SFORCE/5:\nno"), False),
        ("# expect: SINGULAR_ACCELERATION\n", fall(), False),
        ("# expect: SINGULAR_ACCELERATION\n", stopped(Outcome.SINGULAR_ACCELERATION), True),
        (
            "# expect: SINGULAR_ACCELERATION at 1.0005 within 1e-3\n",
            stopped(Outcome.SINGULAR_ACCELERATION),
            True,
        ),
        (
            "# expect: SINGULAR_ACCELERATION at 1.002 within 1e-3\n",
            stopped(Outcome.SINGULAR_ACCELERATION),
            False,
        ),
    ],
)
def test_the_named_end(tmp_path: Path, expected: str, results: Results, passed: bool) -> None:
    verdict = judge(tmp_path, f"# tolerance: abs 1\n{expected}{TABLE}", results)
    assert verdict.passed is passed
    assert "\n" not in verdict.text


def test_the_time_of_the_end_uses_a_share(tmp_path: Path) -> None:
    text = f"# tolerance: abs 1\n# expect: SINGULAR_ACCELERATION at 1.0005 within 1e-3\n{TABLE}"
    verdict = judge(tmp_path, text, stopped(Outcome.SINGULAR_ACCELERATION))
    assert verdict.share == pytest.approx(0.5)


def test_a_run_is_not_repeated_for_a_second_reference_with_the_same_flags(tmp_path: Path) -> None:
    text = "# tolerance: abs 1\n" + TABLE
    folder(
        tmp_path,
        case_adm="",
        reference_csv=text,
        reference__b_csv=text,
        reference__c_csv="# solve: --steps 10\n" + text,
    )
    ran: list[Any] = []

    def run(deck: Path, options: Mapping[str, Any]) -> Results:
        ran.append(options)
        return fall()

    assert all(verdict.passed for verdict in verify(find_cases([tmp_path]), run))
    assert sorted(map(str, ran)) == ["{'steps': 10}", "{}"]


@pytest.mark.parametrize("case", find_cases([find("decks")]), ids=lambda case: case.name)
def test_references_that_come_with_the_program_are_complete(case: Case) -> None:
    read = read_reference(case.reference)
    assert case.deck is not None
    assert not read.without_tolerance()
    assert read.table.names or read.measures or read.stop
    assert np.isfinite(read.table.values).all()
