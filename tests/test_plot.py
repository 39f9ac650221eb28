"""Plots of channels: what they show, for whom they are legible, and what they do not draw."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from figure_checks import assert_legible, illegible
from plot_tables import BODY, SPRING, TIME, UNITS, table
from tiers import every

from adamslite.errors import UsageError
from adamslite.plots import style
from adamslite.plots.selection import curve as curve_of
from adamslite.plots.selection import panels, select, summary
from adamslite.plots.style import balanced
from adamslite.plots.time_histories import plot
from adamslite.results.comparison import Tolerance
from adamslite.results.outcomes import Outcome
from adamslite.results.results import Results, UnknownChannel
from adamslite.results.source import RunSource
from adamslite.verification.reference_file import Reference

pytest.importorskip("matplotlib")

LONG = "VARIABLE/a_name_that_is_much_longer_than_what_has_room_beside_an_axis_of_a_figure"


def titles(figure: Any) -> list[str]:
    return [axis.get_title(loc="left") for axis in figure.axes]


def heading(figure: Any) -> str:
    return " ".join(text.get_text() for text in figure.texts)


@pytest.mark.slow
def test_each_quantity_has_an_axis_with_its_unit() -> None:
    figure = plot(BODY, ["PART/2.*", "JOINT/3.fx"])
    assert titles(figure) == ["position [mm]", "velocity [mm/s]", "angle [rad]", "force [N]"]
    assert figure.axes[-1].get_xlabel() == "time [s]"
    assert "PART/2 and JOINT/3" in heading(figure) or "PART/2: " in heading(figure)
    assert_legible(figure)


def test_curves_are_the_columns() -> None:
    (axis,) = plot(BODY, "PART/2.x").axes
    (line,) = axis.get_lines()
    np.testing.assert_array_equal(line.get_xdata(), TIME)
    np.testing.assert_array_equal(line.get_ydata(), BODY["PART/2.x"])


def test_curves_differ_in_more_than_their_colour() -> None:
    results = table(**{f"PART__{k}_x": k * TIME for k in range(2, 9)})
    (axis,) = plot(results, "*").axes
    looks = {(line.get_color(), str(line.get_linestyle())) for line in axis.get_lines()}
    assert len({color for color, _ in looks}) == len(looks) == 7


@pytest.mark.parametrize("count", every(3, [8, 1, 3, 9, 7, 14]))
def test_any_number_of_curves_is_legible(count: int) -> None:
    """As many forces as there are, each with its definition, on the third of three axes."""
    forces = "\\".join(f"F{k}=FX(2,1,1)" for k in range(2, 9))
    requests = f"REQUEST/1, {forces}\nREQUEST/2, {forces}"
    names = [f"REQUEST/{r}.F{k}" for r in (1, 2) for k in range(2, 9)][:count]
    columns = ("POINT_MASS/2.x", "POINT_MASS/2.vx", *names)
    results = Results(
        time=TIME, names=columns, values=np.outer(TIME, np.arange(len(columns))), meta=UNITS,
        source=RunSource(deck=SPRING.replace("REQUEST/1, F2=DM(2,1)\\F3=2*DM(2,1)", requests)),
    )  # fmt: skip
    figure = plot(results, "*", against=results)
    differences = figure.axes[3].get_lines()
    assert len({str(line.get_color()) for line in differences}) == len(differences) == count + 2
    assert figure.axes[2].get_title(loc="left") == "force [N]"
    curves = figure.axes[2].get_lines()[:count]
    assert len({str(line.get_color()) for line in curves}) == count
    assert "= FX(2,1,1)" in figure.axes[2].get_legend().get_texts()[0].get_text()
    assert_legible(figure)


def test_a_hundred_bodies_have_a_scale_of_colours_and_a_short_legend() -> None:
    results = table(**{f"PART__{k}_x": k * TIME for k in range(2, 102)})
    figure = plot(results, "PART/*.x")
    assert len(figure.axes[0].get_lines()) == 100
    assert len(figure.axes[0].get_legend().get_texts()) == 5
    assert heading(figure).startswith("PART/2 ... PART/101 (100): position x over time")
    assert_legible(figure)


def test_requests_are_named_by_their_expressions() -> None:
    """F2 = DM(2,1) is a length; 2*DM(2,1) may be anything."""
    results = table(REQUEST__1_F2=TIME, REQUEST__1_F3=TIME)
    results = Results(
        time=TIME, names=results.names, values=results.values, meta=UNITS,
        source=RunSource(deck=SPRING),
    )  # fmt: skip
    figure = plot(results, "REQUEST/1.*")
    assert titles(figure) == ["displacement [mm]", "REQUEST/1"]
    legend = figure.axes[0].get_legend().get_texts()
    assert [text.get_text() for text in legend] == ["REQUEST/1.F2\n= DM(2,1)"]


def test_many_columns_of_no_known_quantity_share_an_axis() -> None:
    results = table(**{f"VARIABLE__v{k}": k * TIME for k in range(30)})
    curves = [curve_of(results, name) for name in results.names]
    assert len(panels(curves)) == 1
    assert len(panels(curves[:3])) == 3


def test_patterns_mean_columns_once_in_their_order_in_any_case() -> None:
    assert select(BODY, ["part/2.V*", "PART/2.?x", "joint/3.FX"]) == ["PART/2.vx", "JOINT/3.fx"]
    with pytest.raises(UnknownChannel, match=r"did you mean PART/2\.vx"):
        select(BODY, ["PART/2.vxx"])
    with pytest.raises(UnknownChannel, match=r"no result is called 'PART/9\.\*'"):
        select(BODY, ["PART/9.*"])


@pytest.mark.parametrize(
    ("names", "words"),
    [
        (["PART/2.x"], "position x of PART/2"),
        (["PART/2.x", "PART/2.vx"], "PART/2: position x and velocity vx"),
        (["PART/2.x", "JOINT/3.fx"], "PART/2: position x, JOINT/3: force fx"),
        (["PART/2.x", "PART/2.y", "PART/2.vx"], "PART/2: position x and y, velocity vx"),
    ],
)
def test_the_title_says_what_is_seen(names: list[str], words: str) -> None:
    assert summary([curve_of(BODY, name) for name in names]) == words


def banded(off: float) -> Any:
    """x is ``off`` beside its reference sin(t), of which 0.1 is allowed."""
    wanted = table(PART__2_x=np.sin(TIME))
    reference = Reference(
        path=Path("reference.csv"), table=wanted, tolerances=[("*", Tolerance(abs=0.1))]
    )
    return plot(table(PART__2_x=np.sin(TIME) + off), "PART/2.x", against=reference)


def test_the_band_of_the_reference_is_drawn() -> None:
    figure = banded(0.05)
    (band,) = figure.axes[0].collections
    y = band.get_paths()[0].vertices[:, 1]
    assert (y.min(), y.max()) == pytest.approx((-0.1, np.sin(TIME).max() + 0.1))
    assert "within 50 % of the tolerance of reference.csv" in heading(figure)
    assert figure.axes[1].get_lines()[0].get_ydata() == pytest.approx(np.full(41, 0.5))
    assert_legible(figure)


def test_what_leaves_the_band_is_in_the_title() -> None:
    figure = banded(0.2)
    assert "outside the tolerance of reference.csv: PART/2.x from t = 0" in heading(figure)


def test_times_between_output_times_are_interpolated_and_that_is_said() -> None:
    between = np.array([0.01, 0.52, 7.0])
    wanted = Results(time=between, names=("PART/2.psi",), values=between[:, None])
    figure = plot(BODY, "PART/2.psi", against=wanted)
    assert "interpolated linearly" in heading(figure)
    assert "within 0.1 % of the tolerance" in heading(figure)  # 7 s is beyond the results


def test_a_reference_of_another_deck_is_named() -> None:
    wanted = table(PART__2_x=np.sin(TIME))
    other = Results(time=TIME, names=wanted.names, values=wanted.values, meta={"deck hash": "1"})
    mine = Results(time=TIME, names=BODY.names, values=BODY.values, meta={"deck hash": "2"})
    assert "is of another deck" in heading(plot(mine, "PART/2.x", against=other))


@pytest.mark.parametrize(
    ("wanted", "why"),
    [
        (table(PART__9_x=0.0), "has none of these channels; it has PART/9.x"),
        (
            Results(time=np.array([9.0]), names=("PART/2.x",), values=np.zeros((1, 1))),
            "no time in common",
        ),
        (
            Results(time=np.empty(0), names=("PART/2.x",), values=np.empty((0, 1))),
            "no time in common",
        ),
    ],
)
def test_a_reference_that_does_not_fit_is_rejected(wanted: Results, why: str) -> None:
    with pytest.raises(UsageError, match=why):
        plot(BODY, "PART/2.x", against=wanted)


def test_events_are_marked_and_explained() -> None:
    """Two sensors close to each other share a mark; the run stopped at 2 s."""
    meta = {**UNITS, "sensor passed": "SENSOR/1 at t = 0.5; SENSOR/2 at t = 0.51"}
    results = Results(
        time=TIME, names=BODY.names, values=BODY.values, meta=meta, outcome=Outcome.NEWTON_FAILED,
        message="stuck",
    )  # fmt: skip
    figure = plot(results, ["PART/2.x", "PART/2.vx"])
    assert [text.get_text() for text in figure.axes[0].texts] == ["(1, 2)", "(3)"]
    assert "(3) stopped early at t = 2: NEWTON_FAILED" in heading(figure)
    marks = [line.get_xdata()[0] for line in figure.axes[1].get_lines()[1:]]
    assert marks == [0.5, 0.51, 2.0]
    assert_legible(figure)


def test_one_channel_over_another_is_a_path_with_a_begin_and_an_end() -> None:
    results = table(PART__2_x=np.cos(TIME), PART__2_y=np.sin(TIME))
    figure = plot(results, "PART/2.y", x="PART/2.x")
    (axis,) = figure.axes
    assert axis.get_xlabel() == "PART/2.x: position [mm]"
    assert axis.get_aspect() == 1.0
    first, last = axis.get_lines()[1:]
    assert (first.get_xdata()[0], last.get_ydata()[0]) == (1.0, np.sin(2.0))
    assert_legible(figure)


@pytest.mark.slow
def test_the_reference_of_a_path_is_a_path() -> None:
    results = table(PART__2_x=np.cos(TIME), PART__2_y=np.sin(TIME))
    figure = plot(results, "PART/2.y", x="PART/2.x", against=results)
    (axis,) = figure.axes
    dashed = axis.get_lines()[-1]
    np.testing.assert_array_equal(dashed.get_xdata(), np.cos(TIME))
    np.testing.assert_array_equal(dashed.get_ydata(), np.sin(TIME))
    without = plot(results, "PART/2.y", x="PART/2.x", against=table(PART__2_y=0.0))
    assert len(without.axes[0].get_lines()) == 3 and not without.axes[0].collections
    assert "outside the tolerance" in heading(without)


def test_a_pattern_does_not_mean_the_channel_of_the_horizontal_axis() -> None:
    results = table(PART__2_x=np.cos(TIME), PART__2_y=np.sin(TIME))
    figure = plot(results, "PART/2.?", x="PART/2.x")
    assert heading(figure).startswith("Position y of PART/2 over position x of PART/2")


def test_gaps_are_left_open_and_said() -> None:
    values = np.where(TIME > 1.0, np.inf, TIME)
    figure = plot(table(PART__2_x=values), "PART/2.x")
    assert np.isnan(figure.axes[0].get_lines()[0].get_ydata()[-1])
    assert "PART/2.x is no number at 20 of 41 output times" in heading(figure)


@pytest.mark.slow
def test_units_that_the_deck_does_not_name_are_not_made_up() -> None:
    results = Results(time=TIME, names=BODY.names, values=BODY.values, meta={})
    figure = plot(results, "PART/2.x")
    assert titles(figure) == ["position"]
    assert "names no units" in heading(figure)


def test_one_output_time_is_a_point() -> None:
    results = Results(time=TIME[:1], names=BODY.names, values=BODY.values[:1], meta=UNITS)
    figure = plot(results, "*")
    assert figure.axes[0].get_lines()[0].get_marker() == "o"
    assert_legible(figure)


@pytest.mark.parametrize("size", every(4, [1e-300, 1e-9, 1e-3, 1.0, 1e6, 1e12, 1e300]))
def test_numbers_beside_an_axis_are_legible_at_any_size(size: float) -> None:
    figure = plot(table(PART__2_x=size * np.sin(TIME), PART__2_vx=1e5 + 1e-3 * TIME), "*")
    assert_legible(figure)


@pytest.mark.parametrize(
    "name",
    every(4, [LONG, "VARIABLE/крюк", "VARIABLE/$x_1$", "VARIABLE/100%_{a", "VARIABLE/\u7ef3"]),
)
def test_odd_names_are_drawn_as_they_are(name: str, tmp_path: Path) -> None:
    results = Results(time=TIME, names=(name,), values=TIME[:, None], meta={"deck": f"{name} " * 9})
    figure = plot(results, "*")
    assert_legible(figure)
    for suffix in style.SUFFIXES:
        style.save(figure, tmp_path / f"figure{suffix}")


@pytest.mark.parametrize(
    ("value", "places", "text"),
    [
        (0.5, [0.0, 0.25, 0.5], "0.50"),
        (1.0, [0.0, 1.0, 2.0], "1"),
        (-2.5, [-2.5, 0.0, 2.5], "-2.5"),
        (2e-7, [0.0, 1e-7, 2e-7], "2e-7"),
        (3e9, [0.0, 1e9, 3e9], "3e9"),
        (0.0, [0.0], "0"),
        (1e-17, [0.0, 0.1], "0.0"),
    ],
)
def test_numbers_beside_an_axis(value: float, places: list[float], text: str) -> None:
    assert style.tick_text(value, places) == text


def test_a_title_of_two_lines_has_no_single_word_in_the_second() -> None:
    text = "the best other program takes thirteen times that"
    assert balanced(text, 44) == ["the best other program", "takes thirteen times that"]
    assert balanced(text, 90) == [text]
    assert balanced("", 10) == []
    assert balanced("x" * 30, 10) == ["x" * 10] * 3


def test_the_check_finds_text_that_is_cut_off_and_text_over_text() -> None:
    figure = plot(BODY, "PART/2.x")
    figure.text(0.98, 0.5, "beyond the edge")
    figure.text(0.3, 0.5, "one")
    figure.text(0.3, 0.5, "other")
    assert illegible(figure) == ["beyond the edge", "one | other"]


@pytest.mark.slow
def test_the_same_figure_is_the_same_file(tmp_path: Path) -> None:
    for name in ("a.svg", "b.svg"):
        style.save(plot(BODY, "PART/2.*"), tmp_path / name)
    assert (tmp_path / "a.svg").read_bytes() == (tmp_path / "b.svg").read_bytes()


@pytest.mark.slow
def test_settings_of_the_user_do_not_change_a_figure(tmp_path: Path) -> None:
    import matplotlib

    style.save(plot(BODY, "PART/2.*"), tmp_path / "a.svg")
    with matplotlib.rc_context({"lines.linewidth": 9, "axes.facecolor": "black", "font.size": 30}):
        style.save(plot(BODY, "PART/2.*"), tmp_path / "b.svg")
        assert matplotlib.rcParams["font.size"] == 30
    assert (tmp_path / "a.svg").read_bytes() == (tmp_path / "b.svg").read_bytes()
