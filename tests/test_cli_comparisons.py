"""`adamslite diff` and `verify`: what they print, and with which exit code."""

from pathlib import Path

import numpy as np
from fakes import ERROR, fall

from adamslite.cli.main import main
from adamslite.results.results import Results


def test_diff_of_two_files(pipeline, capsys) -> None:
    results = fall()
    results.save("b.csv")
    results.values[3:, 0] += 1e-4
    results.save("a.csv")
    assert main(["diff", "a.csv", "a.csv"]) == 0
    assert "2 compared, all within their tolerances" in capsys.readouterr().out
    assert main(["diff", "a.csv", "b.csv"]) == 1
    table = capsys.readouterr().out.splitlines()
    assert table[1].split() == ["PART/2.x", "1.000e-04", "1.500e-06", "0.3", "0.3"]
    assert table[-1] == "2 compared, 1 outside its tolerance"
    assert main(["diff", "a.csv", "b.csv", "--tol", "1e-3"]) == 0
    assert main(["diff", "a.csv", "b.csv", "--tol", "abs 1e-3"]) == 0
    assert main(["diff", "a.csv", "b.csv", "--tol", "rel"]) == 2


def test_diff_uses_the_tolerances_of_the_reference(pipeline, capsys) -> None:
    fall().save("a.csv")
    Path("b.csv").write_text("# tolerance: abs 1e-3\ntime,PART/2.x\n0.5,0.1255\n")
    assert main(["diff", "a.csv", "b.csv"]) == 0
    Path("b.csv").write_text("time,PART/2.x\n0.55,0.15125\n")
    assert main(["diff", "a.csv", "b.csv"]) == 1
    assert "different: t = 0.55 is not an output time" in capsys.readouterr().out
    assert main(["diff", "a.csv", "b.csv", "--interpolate", "cubic"]) == 0


def test_verify_prints_one_line_each(pipeline, capsys) -> None:
    Path("reference.csv").write_text("# tolerance: abs 1e-3\ntime,PART/2.x\n1,0.5\n")
    Path("reference-bad.csv").write_text("# tolerance: abs 1e-3\ntime,PART/2.x\n1,0.6\n")
    assert main(["verify", "."]) == 1
    lines = capsys.readouterr().out.splitlines()
    assert lines[0].startswith("ok    0.00  ") and lines[1].startswith("FAIL 100.00  ")
    told = "1 of 2 references met; the largest share of a tolerance is 100.00, in "
    assert lines[2].startswith(told)
    Path("reference-bad.csv").unlink()
    assert main(["verify", "cable.adm"]) == 0
    Path("reference.csv").unlink()
    assert main(["verify", "cable.adm"]) == 2


def test_verify_shares_decks_among_processes(tmp_path: Path, capsys) -> None:
    """Two decks that hold still, each with a reference that is off by 0.5 mm of 2 mm."""
    reference = "# tolerance: abs 2e-3\n# measure: last POINT_MASS/2.x = 1.0005 tol abs 2e-3\n"
    for name in ("a", "b"):
        (tmp_path / f"{name}.adm").write_text(
            "Stays\nPART/1, GROUND\nPOINT_MASS/2, MASS=1, QG=1,0,0, CM=2\n"
            "MARKER/2, POINT_MASS=2\nSIMULATE/DYNAMICS, END=1, STEPS=1\nEND\n"
        )
        (tmp_path / f"{name}.reference.csv").write_text(reference)
    assert main(["verify", str(tmp_path), "-j", "2"]) == 0
    lines = capsys.readouterr().out.splitlines()
    assert [line[:12] for line in lines[:2]] == 2 * ["ok    0.25  "]
    assert main(["verify", str(tmp_path), "-j", "1", "--share", "0.3"]) == 0
    assert main(["verify", str(tmp_path), "-j", "1", "--share", "0.2"]) == 1
    assert capsys.readouterr().out.splitlines()[-1].startswith("0 of 2 references met")
    assert [line.split()[2].rpartition("/")[2] for line in lines[:2]] == ["a", "b"]
    assert lines[2].endswith(
        f"2 references met; the largest share of a tolerance is 0.25, in {tmp_path.name}/a"
    )


def test_verify_reports_a_broken_deck_and_goes_on(pipeline, capsys) -> None:
    pipeline.diagnostics = (ERROR,)
    Path("reference.csv").write_text("# tolerance: abs 1e-3\ntime,PART/2.x\n1,0.5\n")
    assert main(["verify", "."]) == 1
    out = capsys.readouterr().out
    assert "the deck has errors: cable.adm:2:4: there is no MARKER/7" in out


def saved(path: str, worse: tuple[int, ...] = (), columns: int = 30) -> None:
    """Histories t of VARIABLE/0, ...; some are off by their number at the end."""
    values = np.outer(np.linspace(0, 1, 5), np.ones(columns))
    values[-1, list(worse)] += worse
    names = tuple(f"VARIABLE/{n}" for n in range(columns))
    Results(time=np.linspace(0, 1, 5), names=names, values=values).save(path)


def test_diff_lists_what_is_outside_first_and_the_rest_with_all(pipeline, capsys) -> None:
    saved("a.csv", worse=(3, 12))
    saved("b.csv")
    assert main(["diff", "a.csv", "b.csv"]) == 1
    lines = capsys.readouterr().out.splitlines()
    assert [line.split()[0] for line in lines] == ["channel", "VARIABLE/12", "VARIABLE/3", "30"]
    assert lines[-1] == "30 compared, 2 outside their tolerances; --all lists the others"
    assert main(["diff", "a.csv", "b.csv", "--all"]) == 1
    lines = capsys.readouterr().out.splitlines()
    assert [line.split()[0] for line in lines[1:4]] == ["VARIABLE/12", "VARIABLE/3", "VARIABLE/0"]
    assert len(lines) == 32
    assert main(["diff", "b.csv", "b.csv"]) == 0
    assert capsys.readouterr().out == "30 compared, all within their tolerances; --all lists them\n"


def test_diff_shows_a_short_table_whole(pipeline, capsys) -> None:
    saved("a.csv", worse=(3,), columns=4)
    saved("b.csv", columns=4)
    assert main(["diff", "a.csv", "b.csv"]) == 1
    lines = capsys.readouterr().out.splitlines()
    assert [line.split()[0] for line in lines[1:5]] == [f"VARIABLE/{n}" for n in (3, 0, 1, 2)]


def test_diff_with_nothing_to_compare_is_no_agreement(pipeline, capsys) -> None:
    fall().save("a.csv")
    for text, what in (
        ("", "no channel"), ("time\n0\n", "no channel"), ("time,PART/2.x\n", "no output time"),
    ):  # fmt: skip
        Path("b.csv").write_text(text)
        assert main(["diff", "a.csv", "b.csv"]) == 1
        assert capsys.readouterr().out == f"different: the reference has {what} at all\n"


def test_diff_of_a_column_without_numbers_is_outside(pipeline, capsys) -> None:
    Path("a.csv").write_text("time,x\n0,nan\n1,nan\n")
    assert main(["diff", "a.csv", "a.csv"]) == 1
    assert "1 outside its tolerance" in capsys.readouterr().out


def test_diff_names_a_channel_that_may_be_meant(pipeline, capsys) -> None:
    fall().save("a.csv")
    Path("c.csv").write_text("time,PART/2.vy\n0,0\n")
    assert main(["diff", "a.csv", "c.csv"]) == 1
    assert "no channel 'PART/2.vy'; did you mean PART/2.vx?" in capsys.readouterr().out


def test_diff_of_two_decks_says_so(pipeline, capsys) -> None:
    fall(meta={"deck": "a boom", "deck hash": "1"}).save("a.csv")
    fall(meta={"deck": "a winch", "deck hash": "2"}).save("b.csv")
    assert main(["diff", "a.csv", "b.csv"]) == 0
    said = capsys.readouterr().err
    assert said == "adamslite: A and B are results of different decks, 'a boom' and 'a winch'\n"
    assert main(["diff", "a.csv", "a.csv"]) == 0
    assert capsys.readouterr().err == ""
    Path("c.csv").write_text("# deck: a winch\n# deck hash: 2\ntime,SFORCE/1.f\n0,0\n")
    assert main(["diff", "a.csv", "c.csv"]) == 1
    assert "different decks, 'a boom' and 'a winch'" in capsys.readouterr().out
