"""The report of the benchmarks: its tables, charts and conclusions are what was measured."""

import csv
import runpy
from dataclasses import replace
from pathlib import Path

import pytest
from figure_checks import illegible
from tiers import every

from adamslite.verification.variants import Variant
from benchmarks import charts, conclusions, figures, hard_cases, matrix, points, report, tables
from benchmarks.figures import Figure
from benchmarks.measure import TIME_UP
from benchmarks.points import Row
from benchmarks.scenes import SCALING
from benchmarks.torture import CASES


def row(program: str, kind: str, error: float | None, cpu: float, **facts: object) -> Row:
    told = {"scene": "S1", "n": 10, "setting": "x", "drift": None, "runs": 3, "setup": 0.001,
            "steps": 10, "peak": 50.0, "reason": ""}  # fmt: skip
    return Row(
        program=program, kind=kind, error=error, cpu_median=cpu, cpu_least=cpu, **{**told, **facts}
    )


ROWS = [
    row("adamslite HHT", "ours", 1e-4, 0.002),
    row("Other", "implicit", 5e-4, 0.02),
    row("Swift", "explicit", 5e-4, 0.01),
    row("C", "limit", 1e-9, 1e-5),
]


def test_ratios_are_those_of_the_cheapest_that_meet_the_target() -> None:
    line = tables.summary(ROWS, [1e-3]).splitlines()[2]
    assert "HHT x | 2 |" in line and "Other 20 ms | 10 |" in line and "Swift 10 ms | 5 |" in line
    assert "C " not in line  # a limit is no peer


def test_the_conclusions_follow_from_the_rows() -> None:
    shown = conclusions.conclusions(ROWS, [Figure("a", "b", 2.0, "s", 1.0)], CELLS)
    assert "The best other implicit program takes 10 to 10 times" in shown
    assert "The best other program of any kind takes 5 to 5 times" in shown
    assert "0 of 1 figures are within their bounds; beyond them: b (2 s, bound 1)" in shown
    assert "| S1 N=10 | HHT | 2 | Swift | 10 | 5 |" in conclusions.scenes(ROWS, 1e-3)
    counted = conclusions.cases(CELLS)
    assert "| HHT | 0 | 1 |" in counted and "| VERLET | 0 | 0 | 1 | 0 |" in counted


def test_a_program_without_a_turn_has_not_failed() -> None:
    late = [ROWS[0], row("Other", "implicit", None, 0.0, reason=TIME_UP)]
    shown = tables.summary(late, [1e-3])
    assert "S1 N=10*" in shown and "not measured" in shown and "time was up" in shown
    failed = [ROWS[0], row("Other", "implicit", None, 0.0, reason="it crashed")]
    assert "none got there" in tables.summary(failed, [1e-3])


def test_of_ours_alone_no_other_program_is_said_to_have_failed() -> None:
    assert "no other program" not in conclusions.conclusions(ROWS[:1], [], [])
    assert "| S1 N=10 | HHT | 2 | not measured | - | - |" in conclusions.scenes(ROWS[:1], 1e-3)
    assert "| S1 N=10 | HHT | 2 | none | - | - |" in conclusions.scenes(ROWS, 1.5e-4)


def test_tables_come_back_as_they_were_written(tmp_path: Path) -> None:
    points.write(ROWS, tmp_path)
    assert points.read(tmp_path) == ROWS
    given = [Figure("a", "b, c", 1.5, "s", 2.0), Figure("a", "d", 1.0, "MB")]
    figures.write(given, tmp_path)
    assert figures.read(tmp_path) == given


def test_a_scene_measured_again_loses_its_old_lines() -> None:
    other = row("Other", "implicit", 1e-4, 1.0, n=50)
    assert points.merged([*ROWS, other], [ROWS[0]]) == [other, ROWS[0]]


CELLS = [
    hard_cases.Cell("pulse", "HHT", hard_cases.PASSED, "1e-08", 0.5, 12.0, 100, 0.01, "DONE"),
    hard_cases.Cell("pulse", "RADAU", hard_cases.PASSED, "1e-06", 0.01, 0.01, 100, 0.01, "DONE"),
    hard_cases.Cell("pulse", "VERLET", hard_cases.STOPPED, outcome="UsageError", report="use ABAM"),
    hard_cases.Cell("pulse", "NEWMARK", hard_cases.SILENT, "1e-12", 2.0, 3.0, 100, 0.01, "DONE"),
]


def test_the_report_has_what_every_command_measured(tmp_path: Path) -> None:
    page = tmp_path / "page.md"
    hard_cases.write(CELLS, tmp_path)
    report.write(tmp_path, page, [".svg"])
    behind = tmp_path / "page-tables.md"
    line = next(line for line in behind.read_text().splitlines() if line.startswith("| pulse"))
    cells = [cell.strip() for cell in line.split("|")]
    assert {"0.5 at 1e-08", "0.01", "rejected", "**silent**, 2 at 1e-12"} <= set(cells)
    points.write(ROWS, tmp_path)
    report.write(tmp_path, page, [".svg"])
    assert "times ours" in behind.read_text() and line in behind.read_text()
    assert "Of 4 runs of hard cases 2 ended inside the band" in page.read_text()
    assert hard_cases.read(tmp_path) == sorted(CELLS, key=in_order)


def in_order(cell: hard_cases.Cell) -> int:
    return [variant.label for variant in hard_cases.columns()].index(cell.integrator)


@pytest.fixture(scope="module")
def square_wave() -> matrix.Scene:
    return matrix.Scene(next(c for c in CASES if "square-wave" in c.reference))


@pytest.mark.parametrize(
    ("label", "smaller"), [("GSTIFF SI2", False), ("HHT", True), ("CONSTANT_BDF", True)]
)
def test_an_integrator_climbs_into_the_band(
    square_wave: matrix.Scene, label: str, smaller: bool
) -> None:
    """At the ERROR of the deck, or at a smaller one: then the first was outside."""
    cell = matrix.attempt(square_wave, column(label), 20.0)
    assert cell.verdict == hard_cases.PASSED and cell.share <= 1.0
    assert (cell.first > 1.0) == smaller


def column(label: str) -> Variant:
    return next(variant for variant in hard_cases.columns() if variant.label == label)


def test_a_rejection_is_no_wrong_answer() -> None:
    pendulum = matrix.Scene(next(c for c in CASES if c.reference == "pendulum-gcon/reference.csv"))
    cell = matrix.attempt(pendulum, column("VERLET"), 20.0)
    assert cell.rejected_before and "GCON/1" in cell.report


def test_no_time_is_no_pass(square_wave: matrix.Scene) -> None:
    cell = matrix.attempt(square_wave, column("HHT"), 0.0)
    assert cell.share > 1.0 and cell.verdict in (hard_cases.SLOW, hard_cases.REPORTED)


def test_an_answer_outside_of_the_band_is_not_passed(square_wave: matrix.Scene) -> None:
    results = square_wave.run(error=1e-2)
    share, verdict = matrix.judged(square_wave.reference, results)
    assert share > 1.0 and verdict == hard_cases.SILENT


def test_the_matrix_on_the_page_has_no_silent_wrong_answer() -> None:
    """Every hard case by every integrator was measured, and each outside of its band says so."""
    cells = hard_cases.read(report.FOLDER)
    assert {cell.case for cell in cells} == {case.name for case in CASES}
    assert len(cells) == len(CASES) * len(hard_cases.columns())
    assert not [cell for cell in cells if cell.verdict == hard_cases.SILENT]


@pytest.mark.slow
def test_charts_are_the_same_file_for_the_same_points(tmp_path: Path) -> None:
    pytest.importorskip("matplotlib")
    made = []
    for name in ("a", "b"):
        folder = tmp_path / name
        folder.mkdir()
        points.write(ROWS, folder)
        report.write(folder, folder / "page.md", [".svg"])
        made.append((folder / "s1-10.svg").read_bytes())
    assert made[0] == made[1] and b"Swift" in made[0]


CHARTED = sorted(path.stem for path in report.FOLDER.glob("*.svg"))


@pytest.mark.parametrize("name", every(4, CHARTED))
def test_no_text_of_a_chart_in_docs_is_clipped_or_overlaps(
    name: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The charts of the rows in docs, as they are drawn for the page."""
    pytest.importorskip("matplotlib")
    drawn = []
    monkeypatch.setattr(charts, "save", lambda figure, path: drawn.append(figure))
    rows = points.read(report.FOLDER)
    mine = [r for r in rows if r.scene in SCALING] if name == charts.GROWTH else [
        r for r in rows if charts.file_name(r.scene, r.n) == name
    ]  # fmt: skip
    assert charts.draw_all(mine, Path(), [".svg"], few=True) == [name]
    (figure,) = drawn
    assert illegible(figure) == []


def test_the_figure_of_the_kink_is_legible_and_that_of_its_table() -> None:
    pytest.importorskip("matplotlib")
    script = report.PAGE.with_name("kink_load.py")
    program = runpy.run_path(str(script), run_name="kink_load")
    with script.with_name("kink-load.csv").open(encoding="utf-8") as stream:
        rows = list(csv.DictReader(stream))
    figure = program["draw"](rows)
    assert illegible(figure) == []
    mean = next(line for line in figure.axes[0].get_lines() if line.get_label() == "ale: mean load")
    assert mean.get_ydata() == pytest.approx([1.0 + float(row["ale T2"]) for row in rows])
    page = script.with_name("cables.md").read_text(encoding="utf-8")
    for row in rows:
        cells = (f"{100 * float(text):+.3g} %" for name, text in row.items() if name != "N")
        assert f"| {row['N']} | {' | '.join(cells)} |" in page


def test_the_page_has_a_chart_of_every_scene() -> None:
    shown = {
        charts.file_name(scene, n) for scene, n, _ in tables.by_scene(points.read(report.FOLDER))
        if n in charts.SIZES_IN_DOCS.get(scene, (n,))
    }  # fmt: skip
    assert set(CHARTED) == shown | {charts.GROWTH}


def test_a_chart_says_who_was_tried() -> None:
    slow = replace(ROWS[0], program="Exudyn X", kind="implicit", error=1.0)
    own = replace(ROWS[0], kind="ours", error=1e-6)
    assert "Exudyn, the only other program that was tried" in charts.result("S1", [own, slow])
    other = replace(slow, program="scipy X")
    assert "no other program gets there" in charts.result("S1", [own, slow, other])
    best = replace(other, error=1e-6, cpu_median=own.cpu_median * 4)
    assert "scipy X, takes 4 times that" in charts.result("S1", [own, slow, best])
    assert charts.result("S1", [slow]) == "No program reaches 0.001 m"
