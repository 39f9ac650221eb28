"""`adamslite diff` and `verify`: what they print, and with which exit code."""

from pathlib import Path

from fakes import ERROR, fall

from adamslite.cli.main import main


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
