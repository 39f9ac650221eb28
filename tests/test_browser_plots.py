"""Plots of a page in a browser: channels, cursor and time, zoom, files, and a second result."""

from __future__ import annotations

import csv
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from sample_page import END, FRAMES, crank, sample

pytestmark = [pytest.mark.browser, pytest.mark.slow]

STEP = END / (FRAMES - 1)
CURSOR = 0.01  # time of a pixel of a plot, which is 290 wide


def test_the_time_slider_moves_the_cursor_of_the_plots(show: Any) -> None:
    with show(sample()) as tab:
        box = tab.page.locator("input.time").bounding_box()
        tab.page.mouse.click(box["x"] + 0.75 * box["width"], box["y"] + box["height"] / 2)
        assert tab.do("it.time") == pytest.approx(1.5, abs=0.05)
        assert tab.do("it.plotCursor") == pytest.approx(tab.do("it.time"), abs=CURSOR)


def test_dragging_over_a_plot_moves_the_time_and_the_slider(show: Any) -> None:
    with show(sample()) as tab:
        box = tab.page.locator(".u-over").first.bounding_box()
        middle = box["y"] + box["height"] / 2
        tab.page.mouse.move(box["x"] + 0.2 * box["width"], middle)
        tab.page.mouse.down()
        tab.page.mouse.move(box["x"] + 0.5 * box["width"], middle, steps=3)
        tab.page.mouse.up()
        assert tab.do("it.time") == pytest.approx(1.0, abs=CURSOR)
        assert float(tab.page.locator("input.time").input_value()) == pytest.approx(5000, abs=50)
        assert "1.0" in tab.seen(".readout")


def test_keys_play_step_and_switch(show: Any) -> None:
    with show(sample(), address="t=0&theme=light") as tab:
        press = tab.page.keyboard.press
        press("ArrowRight")
        assert tab.do("it.time") == pytest.approx(STEP, abs=1e-6)
        press("ArrowLeft")
        assert tab.do("it.time") == 0
        press("End")
        assert tab.do("it.time") == END
        press("Home")
        press(" ")
        tab.wait("it.playing && it.time > 0")
        press("t")
        assert tab.do("it.theme") == "dark"
        press("?")
        assert "frame the whole motion" in tab.seen(".help")


def test_channels_are_found_by_words_and_plotted_with_units(show: Any) -> None:
    with show(sample()) as tab:
        field = tab.page.get_by_label("search channels")
        field.fill("crank y")
        tab.page.locator(".channel").click()
        assert tab.do("it.plotted") == ["REQUEST/1.F2", "REQUEST/2.F2", "PART/2.y"]
        labels = tab.do("it.app.plots.plots.map(p => p.chart.axes.map(a => a.label))")
        assert ["time (s)", "PART/2.y (m)"] in labels
        assert all(time == "time (s)" for time, _ in labels)
        field.fill("no such channel")
        assert tab.seen(".channels") == "no channel has these words"


def test_the_wheel_zooms_all_plots_and_a_double_click_shows_all(show: Any) -> None:
    with show(sample()) as tab:
        plot = tab.page.locator(".u-over").first
        plot.hover()
        tab.page.mouse.wheel(0, -200)
        windows = "it.app.plots.plots.map(p => [p.chart.scales.x.min, p.chart.scales.x.max])"
        tab.wait(f"{windows}[0][0] > 0")
        found = tab.do(windows)
        assert all(window == found[0] for window in found)
        assert found[0][1] - found[0][0] == pytest.approx(0.85 * END, rel=0.01)
        plot.dblclick()
        tab.wait(f"{windows}[0][0] === 0 && {windows}[0][1] === {END}")


def test_curves_are_saved_as_csv_with_their_units_and_the_second_result(show: Any) -> None:
    with show(sample()) as tab:
        tab.do("it.plot(['PART/2.x', 'REQUEST/2.F2'])")
        with tab.page.expect_download() as saved:
            tab.page.get_by_label("Save the curves shown as CSV").first.click()
        assert saved.value.suggested_filename == "sample-curves.csv"
        head, *rows = csv.reader(Path(saved.value.path()).read_text().splitlines())
        other = ["other.csv: PART/2.x [m]", "other.csv: REQUEST/2.F2"]
        assert head == ["time [s]", "PART/2.x [m]", "REQUEST/2.F2", *other]
        assert len(rows) == FRAMES
        time, x, empty, late, _ = rows[150]
        assert float(time) == pytest.approx(1.5)
        assert float(x) == pytest.approx(crank(1.5)[0], abs=1e-6)
        assert float(late) == pytest.approx(crank(1.4)[0], abs=1e-6)
        assert empty == ""  # no number from t = 1 on


@pytest.mark.parametrize("button", ["Save the picture as PNG", "Save this plot as PNG"])
def test_pictures_are_saved_as_png(show: Any, button: str) -> None:
    with show(sample()) as tab:
        with tab.page.expect_download() as saved:
            tab.page.get_by_label(button).first.click()
        assert Path(saved.value.path()).read_bytes().startswith(b"\x89PNG")


def test_a_second_result_is_a_ghost_and_its_difference_is_plotted(show: Any) -> None:
    with show(sample(), address="t=0.5") as tab:
        tab.do("(it.plot(['PART/2.x']), it.select('PART/2'))")
        difference = tab.do("it.app.plots.plots[1].chart.data[1][50]")
        assert difference == pytest.approx(crank(0.5)[0] - crank(0.4)[0], abs=1e-6)
        assert "Dashed: other.csv." in tab.seen(".plots > .hint")
        apart = np.linalg.norm(crank(0.5) - crank(0.4))
        assert f"{apart:.3g} m from other.csv" in tab.seen(".selection")


def test_results_of_unlike_times_differ_where_both_have_one(show: Any) -> None:
    """A line between output times 0.2 apart would be wrong by 0.02."""
    with show(sample(every=20)) as tab:
        tab.do("it.plot(['PART/2.x'])")
        times, values = np.array(tab.do("it.app.plots.plots[1].chart.data.map(d => Array.from(d))"))
        assert times == pytest.approx(np.linspace(0, END, 11), abs=1e-6)
        assert values == pytest.approx((crank(times) - crank(times - 0.1))[:, 0], abs=1e-6)
