"""The scenes of the benchmarks: their decks are decks, and their arrays what the decks say."""

import csv
import runpy
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from figure_checks import illegible
from tiers import every

import adamslite as al
from adamslite import read
from adamslite.verification.variants import Variant, variants
from benchmarks import (
    charts,
    conclusions,
    counts,
    figures,
    hard_cases,
    matrix,
    points,
    report,
    tables,
)
from benchmarks.decks import deck
from benchmarks.figures import Figure
from benchmarks.growth import worth_measuring
from benchmarks.measure import TIME_UP, Effort, point, steps_needed
from benchmarks.mechanisms import PLANAR, SPATIAL, WATCHED, mechanism, truth, watched
from benchmarks.peers import PROGRAMS, numba_chain
from benchmarks.peers.ours import FIXED_STEPS
from benchmarks.peers.program import Program
from benchmarks.planar import Equations, planar
from benchmarks.points import Row
from benchmarks.reference import reference
from benchmarks.scenes import (
    CHAINS,
    FALL,
    FALLING,
    SCALING,
    STARTING,
    acceleration,
    chain,
    parameters,
    sizes,
)
from benchmarks.structures import NET, REVOLUTES, structure
from benchmarks.torture import CASES
from benchmarks.worker import answer, error_of


@pytest.mark.parametrize("scene", list(parameters()))
def test_the_deck_of_a_scene_has_no_mistakes(scene: str) -> None:
    assert read(deck(scene, min(sizes(scene)))).of("SIMULATE")


@pytest.mark.parametrize("scene", CHAINS)
def test_the_deck_of_a_chain_has_its_masses_in_their_places(scene: str) -> None:
    n = min(sizes(scene))
    c = chain(scene, n)
    masses = read(deck(scene, n)).of("POINT_MASS")
    assert [m.id for m in masses] == list(range(2, n + 2))
    np.testing.assert_array_equal([m.mass for m in masses], c.mass)
    np.testing.assert_array_equal([m.qg for m in masses], c.position)
    np.testing.assert_array_equal([(m.vx, m.vy, m.vz) for m in masses], c.velocity)


def test_springs_act_and_react() -> None:
    c = chain("S2", 100)
    inside = slice(20, 80)  # moves only these, so the ends pull as before
    x, rule = c.position.copy(), acceleration(c)
    before = c.mass @ rule(0.0, x, 0.0 * x)
    x[inside] += 0.1 * np.random.default_rng(1).standard_normal((60, 3))
    np.testing.assert_allclose(c.mass @ rule(0.0, x, 0.0 * x), before, atol=1e-6)


@pytest.mark.parametrize("scene", CHAINS)
def test_a_reference_is_at_hand(scene: str) -> None:
    known = reference(scene, min(sizes(scene)))
    assert known is not None and np.isfinite(known).all()


@pytest.mark.parametrize("scene", [*PLANAR, *SPATIAL])
def test_what_is_watched_of_a_mechanism_is_known(scene: str) -> None:
    assert np.isfinite(truth(scene, min(sizes(scene)))).all()


@pytest.mark.parametrize("scene", PLANAR)
def test_planar_equations_start_like_the_mechanism_in_space(scene: str) -> None:
    """Pins are closed, their rates vanish, and the accelerations meet the constraints."""
    n = min(sizes(scene))
    m = planar(scene, n)
    equations = Equations(m)
    gradient, gamma = equations.constraints(m.place, m.speed)
    a, _ = equations.accelerations(m.place, m.speed)
    size = np.abs(m.speed).max() + 1.0
    np.testing.assert_allclose(gradient @ m.speed.ravel(), 0.0, atol=1e-7 * size)
    np.testing.assert_allclose(gradient @ a.ravel(), gamma, atol=1e-8 * size**2)
    for i, p, j, q in m.pins:
        apart = _point(m.place, i, p) - _point(m.place, j, q)
        np.testing.assert_allclose(apart, 0.0, atol=1e-8)


def _point(place: np.ndarray, body: int, p: np.ndarray) -> np.ndarray:
    if body < 0:
        return p
    c, s = np.cos(place[body, 2]), np.sin(place[body, 2])
    return place[body, :2] + np.array([[c, -s], [s, c]]) @ p


def test_the_pendulum_of_the_peers_swings_as_the_law_says() -> None:
    """A uniform rod of 1.5 m from the horizontal: phi" = (3 g/2 l) cos(phi) = 9.81 cos(phi)."""
    m = planar("A01", 1)
    a, _ = Equations(m).accelerations(m.place, m.speed)
    assert abs(a[0, 2]) == pytest.approx(9.81, rel=1e-9)


def test_energy_and_angle_are_watched_at_the_start_of_the_four_bars() -> None:
    m, n = mechanism("S4", 4), 4
    p = planar("S4", n)
    angle, energy = watched("S4", n, p.place, p.speed)
    assert angle == pytest.approx(np.pi / 2)
    assert energy == pytest.approx(truth("S4", n)[1], rel=1e-12)
    assert m.n == 2 * n + 1


def test_programs_climb_from_loose_to_tight() -> None:
    for program in PROGRAMS.values():
        for scene in program.scenes:
            rungs = program.ladder(scene, min(sizes(scene)))
            steps = [rung.get("steps", 0) for rung in rungs]
            allowed = [rung.get("rtol", rung.get("error", 1.0)) for rung in rungs]
            assert steps == sorted(steps) and allowed == sorted(allowed, reverse=True)


def test_every_integrator_takes_part() -> None:
    names = {name for name, program in PROGRAMS.items() if program.kind == "ours"}
    assert {f"adamslite {variant.label}" for variant in variants()} <= names


def test_ours_answers_with_the_error_of_a_scene() -> None:
    name = next(name for name in PROGRAMS if "SI2" in name)
    for scene, bound in (("S1", 1e-4), ("A01", 1e-2)):
        question = {"scene": scene, "n": min(sizes(scene)), "settings": {"error": 1e-6}}
        told = answer(name, question)
        assert told["ok"] and told["error"] < bound and told["steps"] > 10


def test_what_cannot_be_done_is_told() -> None:
    told = answer("adamslite VERLET", {"scene": "A01", "n": 1, "settings": {"error": 1e-3}})
    assert not told["ok"] and told["refused"] and "JOINT/1" in told["reason"]


def test_a_method_of_order_two_needs_ten_times_the_steps_for_a_hundredth_of_the_error() -> None:
    program = Program("", "implicit", (), lambda s, n: [], answer, bool, order=2)
    made = point("Exudyn", "S1", 10, {"steps": 100})
    made.error = 1e-3
    assert steps_needed(program, made, 1e-5) == pytest.approx(900.0)


def test_nothing_is_begun_when_the_time_is_up() -> None:
    assert not Effort((1e-3,), 1.0, 3).over and Effort((1e-3,), 1.0, 3, deadline=0.0).over


def test_a_matrix_that_is_kept_does_not_spoil_the_answer() -> None:
    """S1 with 200 masses in 100 equal steps of HHT: full Newton iterations leave 6 mm of 10 m.

    Matrices kept without a look at how iterations contract have left 0.45 m, and no word of it.
    """
    solved = FIXED_STEPS.solve("S1", 200, {"steps": 100})
    assert solved.ok
    assert error_of("S1", 200, solved.values)["error"] < 0.01


def test_the_start_of_the_cable_lasts_as_many_segments_at_every_size() -> None:
    ends = [chain(STARTING, n).end * n for n in (10, 200)]
    assert ends[0] == pytest.approx(ends[1])
    assert "END" in deck(STARTING, 10)
    assert chain(FALLING, 10).end == chain(FALLING, 200).end == FALL


@pytest.mark.parametrize(("steps", "scene"), [(21, FALLING), (600, STARTING)])
def test_the_cost_of_a_step_is_not_that_of_first_steps(steps: int, scene: str) -> None:
    """Growth is measured over a longer time for a program that has hardly started otherwise."""

    class Finished:
        def ask(self, point: object, patience: float | None = None) -> dict[str, object]:
            return {"ok": True, "steps": steps}

    name = "adamslite GSTIFF SI2"
    assert worth_measuring(name, {"error": 1e-4}, {name: Finished()}, 200) == scene


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


def test_every_watched_deck_has_its_channels_in_the_reference() -> None:
    for scene, told in WATCHED.items():
        assert len(truth(scene, 1)) == len(told.channels)


def test_counts_that_changed_are_named_with_their_bands() -> None:
    """Counts of a run have a band, a share of the count or of the steps; code has none."""
    kept = {"steps": 200, "rejected": 3, "newton": 500, "entries": 90, "instructions": 1000}
    rows = [("S1 10 HHT", kept, 0.01), ("gone", kept, 0.0)]
    found = {
        "S1 10 HHT": {**kept, "steps": 202, "rejected": 6, "newton": 480, "instructions": 1001},
        "new": kept,
    }
    assert counts.differences(rows, found) == [
        "S1 10 HHT: rejected 3 -> 6 (+100.0 %, 2 allowed)",
        "S1 10 HHT: newton 500 -> 480 (-4.0 %, 5 allowed)",
        "S1 10 HHT: instructions 1000 -> 1001 (+0.1 %)",
        "gone: is kept, but no longer counted",
        "new: is counted, but not kept",
    ]


def test_a_band_is_twice_what_processors_differ_by() -> None:
    one = {"steps": 100, "rejected": 2, "newton": 200}
    other = {"steps": 103, "rejected": 6, "newton": 202}
    assert counts.band(one, []) == counts.band(one, [one]) == 0.0
    assert counts.band(one, [one, other]) == pytest.approx(0.08)


def test_counts_are_kept_for_every_scene_that_is_counted() -> None:
    """Matrix and code of a small scene are those of the file, whatever the processor."""
    rows = {name: kept for name, kept, _ in counts.kept()}
    names = {counts.name_of(s, n, m) for s, n, methods, _ in counts.SCENES for m in methods}
    assert names <= set(rows)
    kernels, *_ = counts.prepared("S1", 10)
    assert counts.factor_entries(kernels) == rows["S1 10 HHT"]["entries"]
    assert counts.instructions(kernels) == rows["S1 10 HHT"]["instructions"]
    assert counts.lines_of("define void @f() {\nentry:\n  %a = add i64 1, 2\n  ret void\n}") == 2


@pytest.mark.parametrize(("kind", "size"), [(NET, 4), (REVOLUTES, 4)])
def test_structures_are_decks(kind: str, size: int) -> None:
    """A net of n x n knots with its first row held; a chain with one freedom for each rod."""
    model = al.assemble(al.read(structure(kind, size)))
    bodies = {NET: size * (size - 1), REVOLUTES: size}[kind]
    assert sum(s.keyword in ("PART", "POINT_MASS") for s in model.deck.statements) == bodies + 1
    springs = {NET: 2 * size * (size - 1) - (size - 1), REVOLUTES: 0}[kind]
    assert sum(s.keyword == "SPRINGDAMPER" for s in model.deck.statements) == springs


@pytest.mark.parametrize("scene", CHAINS)
def test_the_compiled_right_hand_side_is_that_of_numpy(scene: str) -> None:
    """Every state of a chain in some motion; sums in another order."""
    pytest.importorskip("numba")
    c = chain(scene, 10)
    generator = np.random.default_rng(2)
    x, v = c.position + 1e-3 * generator.random((10, 3)), generator.random((10, 3))
    right = np.zeros(3) if c.right is None else c.right
    out = np.zeros(60)
    numba_chain.compiled()(
        0.3, np.hstack((x, v)).ravel(), out, np.concatenate((c.left, right)), c.mass,
        np.array([c.k, c.d, c.l0, c.gravity, c.rate, float(c.right is not None)]),
    )  # fmt: skip
    found, expected = out.reshape(10, 6), acceleration(c)(0.3, x, v)
    np.testing.assert_array_equal(found[:, :3], v)
    np.testing.assert_allclose(found[:, 3:], expected, rtol=1e-9, atol=1e-9 * abs(expected).max())
