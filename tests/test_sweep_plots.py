"""Figures of sweeps: what is drawn are the numbers of the runs, and failed runs are none.

The measures of a made sweep are min y = -M/K and max F = M + K.
"""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from figure_checks import boxes, outside, overlapping
from sweep_tables import design, made, measures

import adamslite as al
from adamslite.cli.main import main
from adamslite.errors import UsageError
from adamslite.sweeps.record import Sweep

pytest.importorskip("matplotlib")

K, M = [80.0, 100.0, 120.0, 140.0], [1.0, 2.0]
GRID = design("grid", "K=80:140:4", "M=1,2")
SAMPLE = design("lhs:64", "K=80:140", "M=1:2", "C=0:1")
TIME = np.linspace(0, 1, 11)


def grid(**given: Any) -> Sweep:
    return made("grid", measures(GRID), GRID, **given)


def sample(**given: Any) -> Sweep:
    return made("lhs:64 seed 0", measures(SAMPLE), SAMPLE, **given)


def histories(values: np.ndarray) -> dict[int, tuple[np.ndarray, np.ndarray]]:
    """y = K t of each run."""
    return {k: (TIME, row[0] * TIME) for k, row in enumerate(values)}


def notes(figure: Any) -> str:
    return " ".join(text.get_text() for text in figure.texts)


def crosses(axis: Any) -> list[list[float]]:
    """Places of the marks of failed runs, on the horizontal axis or where a history ends."""
    found = [c for c in axis.collections if len(c.get_offsets()) and len(c.get_linewidths())]
    marks = [
        c for c in found if c.get_linewidths()[0] == 1.4 and c.get_paths()[0].vertices.shape[0] == 4
    ]
    return [offset for each in marks for offset in np.asarray(each.get_offsets()).tolist()]


def dots(axis: Any) -> np.ndarray:
    """Points of scatter (n, 2)."""
    return np.asarray(axis.collections[0].get_offsets())


def assert_legible(figure: Any) -> None:
    texts = boxes(figure)
    assert outside(figure, texts) == [] and overlapping(texts) == []


# ---- measures of a grid ----------------------------------------------------------------------


def test_one_number_of_a_grid_is_a_curve() -> None:
    values = design("grid", "K=80:140:4")
    figure = made("grid", {"max F": 2 * values[:, 0]}, values).plot()
    (axis,) = figure.axes
    (line,) = axis.get_lines()
    assert line.get_xdata().tolist() == K and line.get_ydata().tolist() == [160, 200, 240, 280]
    assert (axis.get_xlabel(), axis.get_title(loc="left")) == ("K [N/m]", "max F [N]")
    assert_legible(figure)


def test_two_numbers_of_a_grid_are_curves_over_the_one_with_more_values() -> None:
    figure = grid().plot()
    first, second = figure.axes
    assert [line.get_xdata().tolist() for line in first.get_lines()] == [K, K]
    for line, mass in zip(first.get_lines(), M, strict=True):
        assert line.get_ydata() == pytest.approx(-mass / np.array(K), rel=1e-15)
    for line, mass in zip(second.get_lines(), M, strict=True):
        assert line.get_ydata() == pytest.approx(mass + np.array(K), rel=1e-15)
    entries = [text.get_text() for text in first.get_legend().get_texts()]
    assert entries == ["1 kg", "2 kg"] and first.get_legend().get_title().get_text() == "M"
    colours = [line.get_color() for line in first.get_lines()]
    assert not np.allclose(colours[0], colours[1])
    assert_legible(figure)


def test_the_other_number_is_across_when_it_is_asked_for() -> None:
    figure = grid().plot("max F", x="m")
    (axis,) = figure.axes
    assert [line.get_xdata().tolist() for line in axis.get_lines()] == [M] * 4
    assert axis.get_xlabel() == "M [kg]"
    by = grid().plot("max F", by="K").axes[0]
    assert [line.get_xdata().tolist() for line in by.get_lines()] == [M] * 4


def test_a_third_number_gives_lines_of_one_colour_and_many_values_a_scale_of_colours() -> None:
    values = design("grid", "K=80:140:4", "M=1,2", "C=0,1,2")
    figure = made("grid", measures(values), values).plot("max F")
    assert len(figure.axes[0].get_lines()) == 6
    assert "Lines of one colour differ in C." in notes(figure)
    values = design("grid", "K=80:140:20", "M=1:2:12")
    figure = made("grid", measures(values), values).plot("max F")
    assert len(figure.axes) == 2 and figure.axes[1].get_ylabel() == "M [kg]"
    assert_legible(figure)


def test_failed_runs_are_marked_and_never_drawn_as_numbers() -> None:
    """Runs 2 (K = 100, M = 1) and 7 (K = 140, M = 2) failed, with measures of what they had."""
    sweep = grid(failed={2: "NEWTON_FAILED", 7: "INVALID"})
    assert np.isfinite(sweep.measures).all()
    figure = sweep.plot("max F")
    (axis,) = figure.axes
    drawn = [line.get_ydata() for line in axis.get_lines()]
    assert np.isnan(drawn[0]).tolist() == [False, True, False, False]
    assert np.isnan(drawn[1]).tolist() == [False, False, False, True]
    assert crosses(axis) == [[100, 0], [140, 0]]
    assert "2 of 8 runs failed: 1 NEWTON_FAILED, 1 INVALID." in notes(figure)
    assert_legible(figure)
    low, high = sweep.plot("max F", x="M", by="K").axes[0].get_xlim()
    assert low < 1 and high > 2


def test_a_failed_run_alone_at_its_place_is_inside_of_the_axis() -> None:
    values = design("grid", "K=-100,80,90")
    sweep = made("grid", {"max F": values[:, 0]}, values, failed={0: "INVALID"})
    assert sweep.plot().axes[0].get_xlim()[0] < -100


def test_a_band_of_a_grid_is_median_and_percentiles_of_the_runs_at_a_value() -> None:
    values = design("grid", "K=80:140:4", "M=1:5:5")
    sweep = made("grid", measures(values), values, failed={4: "INVALID"})  # K = 80, M = 5
    figure = sweep.plot("max F", x="K", band=(0, 100))
    (axis,) = figure.axes
    assert axis.get_lines()[0].get_ydata() == pytest.approx([82.5, 103, 123, 143])
    corners = axis.collections[0].get_paths()[0].vertices
    at = {x: np.unique(corners[corners[:, 0] == x, 1]) for x in K}
    assert at[80.0].tolist() == [81, 84] and at[100.0].tolist() == [101, 105]
    assert "band: from the least to the largest." in notes(figure)
    narrow = sweep.plot("max F", x="K", band=(25, 75)).axes[0].collections[0]
    assert set(narrow.get_paths()[0].vertices[:, 1]) >= {102.0, 104.0}


def test_very_many_curves_are_a_band_unless_a_number_is_asked_for() -> None:
    values = design("grid", "K=80:140:4", "M=1:5:400")
    sweep = made("grid", measures(values), values)
    figure = sweep.plot("max F", x="K")
    assert "from 5 to 95 % of the runs" in notes(figure)
    assert figure.axes[0].get_lines()[0].get_ydata() == pytest.approx([83, 103, 123, 143])
    figure = sweep.plot("max F", x="K", by="M")
    assert len(figure.axes[0].get_lines()) == 300
    assert "300 of 400 lines are drawn" in notes(figure)


def test_a_measure_over_a_measure() -> None:
    figure = grid(failed={0: "INVALID"}).plot("max F", x="min y")
    axis = figure.axes[0]
    assert dots(axis).tolist() == [[-m / k, k + m] for k in K for m in M][1:]
    assert axis.get_xlabel() == "min y [m]" and not crosses(axis)
    assert "not drawn" in notes(figure)
    assert_legible(figure)


# ---- samples ---------------------------------------------------------------------------------


def test_a_sample_is_drawn_over_each_number() -> None:
    figure = sample(failed={5: "INVALID"}).plot()
    axes = np.reshape(figure.axes, (2, 3))
    good = np.arange(64) != 5
    for m, column in enumerate(measures(SAMPLE).values()):
        for n in range(3):
            assert np.array_equal(dots(axes[m, n]), np.c_[SAMPLE[:, n], column][good])
            assert crosses(axes[m, n]) == [[SAMPLE[5, n], 0]]
    assert [axis.get_xlabel() for axis in axes[1]] == ["K [N/m]", "M [kg]", "C"]
    assert_legible(figure)


def test_a_sample_over_one_number_is_coloured_by_another() -> None:
    figure = sample().plot("max F", x="K", by="M")
    axis, bar = figure.axes
    assert np.array_equal(dots(axis)[:, 0], SAMPLE[:, 0])
    assert bar.get_ylabel() == "M [kg]"
    colours = axis.collections[0].get_facecolors()
    assert len(np.unique(colours, axis=0)) > 30
    assert_legible(figure)


def test_pairs_are_drawn_over_each_other_without_failed_runs() -> None:
    figure = sample(failed={5: "INVALID"}).plot("max F", pairs=True)
    axes = np.reshape(figure.axes, (4, 4))
    assert len(dots(axes[0, 1])) == 63
    assert sum(patch.get_height() for patch in axes[3, 3].patches) == 63
    assert [axis.get_xlabel() for axis in axes[3]] == ["K [N/m]", "M [kg]", "C", "max F [N]"]
    assert outside(figure, boxes(figure)) == []


# ---- histories -------------------------------------------------------------------------------


def test_histories_are_lines_coloured_by_a_number() -> None:
    sweep = grid(histories=histories(GRID))
    figure = sweep.plot("y", by="M")
    (axis,) = figure.axes
    good = axis.collections[0]
    assert [line[-1].tolist() for line in good.get_segments()] == [[1, k] for k in GRID[:, 0]]
    assert len(np.unique(good.get_colors(), axis=0)) == 2
    assert (axis.get_xlabel(), axis.get_title(loc="left")) == ("time [s]", "y [m]")
    assert_legible(figure)
    assert len(np.unique(sweep.plot("y").axes[0].collections[0].get_colors(), axis=0)) == 4


def test_a_history_that_ended_early_is_dotted_ends_in_a_cross_and_is_in_no_band() -> None:
    found = histories(GRID)
    found[7] = TIME[:6], 1e6 * TIME[:6]
    sweep = grid(histories=found, failed={7: "NEWTON_FAILED"})
    figure = sweep.plot("y")
    (axis,) = figure.axes
    assert len(axis.collections[0].get_segments()) == 7
    assert crosses(axis) == [[0.5, 5e5]]
    assert "Dotted: a run that failed" in notes(figure)
    band = sweep.plot("y", band=(0, 100)).axes[0]
    assert band.get_lines()[0].get_ydata()[-1] == pytest.approx(100.0)
    assert band.collections[0].get_paths()[0].vertices[:, 1].max() == 140


def test_a_band_of_histories_goes_as_far_as_all_of_them_at_common_times() -> None:
    """y = K t is a straight line: between output times it is exact."""
    found = histories(GRID)
    fine = np.linspace(0, 0.8, 33)
    found[0] = fine, GRID[0, 0] * fine
    figure = grid(histories=found).plot("y", band=(25, 75))
    (axis,) = figure.axes
    time, median = axis.get_lines()[0].get_data()
    assert np.array_equal(time, fine)
    assert median == pytest.approx(110 * fine)
    assert "Drawn to 0.8" in notes(figure)


def test_very_many_histories_are_a_band_unless_a_number_is_asked_for() -> None:
    values = design("lhs:400", "K=80:140", "M=1:2")
    sweep = made("lhs:400 seed 0", {}, values, histories=histories(values))
    figure = sweep.plot()
    assert "from 5 to 95 % of the runs" in notes(figure)
    figure = sweep.plot("y", by="K")
    assert len(figure.axes[0].collections[0].get_segments()) == 300
    assert "300 of 400 runs are drawn" in notes(figure)


def test_histories_of_an_equilibrium_are_points() -> None:
    found = {k: (np.zeros(1), np.array([row[0]])) for k, row in enumerate(GRID)}
    (axis,) = grid(histories=found).plot("y").axes
    points = axis.collections[-1].get_offsets()
    assert np.asarray(points).tolist() == [[0, k] for k in GRID[:, 0]]


# ---- indices, and the command ----------------------------------------------------------------


def test_indices_are_drawn_with_their_intervals() -> None:
    values = design("saltelli:64", "K=80:140", "M=1:2")
    sweep = made("saltelli:64 seed 0", measures(values), values)
    figure = sweep.plot("max F", indices=True)
    (axis,) = figure.axes
    found = sweep.indices("max F")
    first, total = axis.containers
    assert first.lines[0].get_xdata() == pytest.approx(found.first[0])
    assert total.lines[0].get_xdata() == pytest.approx(found.total[0])
    reach = first.lines[2][0].get_segments()[0][:, 0]
    assert reach == pytest.approx(found.first_interval[0, 0])
    assert [text.get_text() for text in axis.get_yticklabels()] == ["K", "M"]
    assert_legible(figure)


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    return tmp_path


def test_the_command_draws_a_file(folder: Path, capsys: pytest.CaptureFixture) -> None:
    grid(histories=histories(GRID)).save("runs.nc")
    assert main(["plot", "runs.nc"]) == 0
    assert Path("runs-plot.png").read_bytes().startswith(b"\x89PNG")
    assert "runs-plot.png: 8 of 8 runs" in capsys.readouterr().err
    assert main(["plot", "runs.nc", "max*", "--x", "M", "-o", "a.svg"]) == 0
    assert "max F [N]" in Path("a.svg").read_text() and "min y" not in Path("a.svg").read_text()
    assert main(["plot", "runs.nc", "y", "--band", "5:95", "-o", "b.pdf"]) == 0
    first = Path("a.svg").read_bytes()
    assert main(["plot", "runs.nc", "max*", "--x", "M", "-o", "a.svg"]) == 0
    assert Path("a.svg").read_bytes() == first
    grid(failed={1: "INVALID"}).save("failed.nc")
    assert main(["plot", "failed.nc"]) == 4
    assert Path("failed-plot.png").is_file()


@pytest.mark.parametrize(
    ("words", "told"),
    [
        (["runs.nc", "max G"], "the sweep has no 'max G'; did you mean"),
        (["runs.nc", "--x", "L"], "the sweep has no number or measure 'L'"),
        (["runs.nc", "--by", "max F"], "--by max F: it is none of the numbers that vary, K, M"),
        (["runs.nc", "y", "max F"], "max F is a measure and y a history"),
        (["runs.nc", "y", "--x", "K"], "histories are drawn over time, not over K"),
        (["runs.nc", "y", "--pairs"], "--pairs draws measures"),
        (["runs.nc", "--indices"], "these runs (grid) have no Sobol indices"),
        (["runs.nc", "--band", "95:5"], "percentiles go up"),
        (["runs.nc", "--band", "0:100", "--x", "max F"], "a band over max F needs a grid"),
        (["runs.nc", "--band", "0:100", "--by", "M"], "--by does not belong to --band"),
        (["runs.nc", "--pairs", "--x", "M"], "--x does not belong to --pairs"),
        (["runs.nc", "--pairs", "--indices"], "--pairs and --indices are different figures"),
        (["runs.nc", "--x", "M", "--by", "m"], "--x and --by are both M"),
        (["runs.nc", "--end", "2"], "holds a sweep: there is nothing to solve"),
        (["runs.nc", "--against", "runs.nc"], "--against belongs to results"),
        (["runs.nc", "-o", "a.jpg"], "none of .png, .svg, .pdf"),
        (["none.nc"], "none of the 8 runs reached its end"),
        (["result.csv", "x", "--pairs"], "belong to the file of a sweep"),
    ],
)
def test_mistakes_are_told_in_a_sentence(
    folder: Path, capsys: pytest.CaptureFixture, words: list[str], told: str
) -> None:
    grid(histories=histories(GRID)).save("runs.nc")
    grid(failed=dict.fromkeys(range(8), "INVALID")).save("none.nc")
    Path("result.csv").write_text("time,x\n0,0\n1,1\n")
    assert main(["plot", *words]) == 2
    said = capsys.readouterr().err
    assert told in said and len(said.splitlines()) == 1
    assert not list(folder.glob("*.png"))


def test_python_takes_a_sweep_or_its_file(folder: Path) -> None:
    grid().save("runs.nc")
    for given in ("runs.nc", Path("runs.nc"), grid()):
        figure = al.plot(given, "max F", output="a.png")
        assert len(figure.axes[0].get_lines()) == 2
    with pytest.raises(UsageError, match="against= and deck= belong to results"):
        al.plot(grid(), against="x.csv")
    with pytest.raises(UsageError, match="belong to a sweep"):
        al.plot(al.Results(time=TIME, names=("x",), values=TIME[:, None]), "x", by="K")


@pytest.mark.parametrize("name", ["a" * 200, "$x_1$ <b>&", "\u7ef3\n$$\\frac{", "%s{0}"])
def test_odd_names_and_sizes_are_drawn_as_they_are(name: str) -> None:
    values = design("grid", "K=1e-30:1e30:4", "M=-5e-9,1e12")
    found = {f"max {name}": values[:, 0] * 1e20}
    figure = made("grid", found, values, names=(name, "M")).plot()
    assert outside(figure, [each for each in boxes(figure) if "\u7ef3" not in each[0]]) == []
