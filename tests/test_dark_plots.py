"""Figures on a dark ground: everything stands out there as it does on white."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from figure_checks import boxes
from sweep_tables import design, made, measures

import adamslite as al
from adamslite.cli.main import main

Text = pytest.importorskip("matplotlib.text").Text

GRID = design("grid", "K=80:140:4", "M=1,2")
TIME = np.linspace(0, 1, 11)


def luminance(colour: Any) -> float:
    from matplotlib.colors import to_rgb

    linear = [c / 12.92 if c <= 0.04045 else ((c + 0.055) / 1.055) ** 2.4 for c in to_rgb(colour)]
    return float(np.dot([0.2126, 0.7152, 0.0722], linear))


def contrast(colour: Any, ground: Any) -> float:
    """As WCAG 2 defines it, from 1 to 21."""
    bright, dim = sorted((luminance(colour), luminance(ground)), reverse=True)
    return (bright + 0.05) / (dim + 0.05)


@pytest.mark.parametrize(
    "wish", [{}, {"band": (0, 100)}, {"pairs": True}, {"indices": True}, {"x": "K", "by": "M"}]
)
def test_everything_stands_out_on_white_and_on_a_dark_ground(wish: dict[str, Any]) -> None:
    kind = "grid" if "band" in wish else "saltelli:16"
    values = GRID if kind == "grid" else design(kind, "K=80:140", "M=1:2")
    failed = {} if "indices" in wish else {3: "INVALID"}
    sweep = made(kind, measures(values), values, failed=failed)
    for dark in (False, True):
        figure = sweep.plot(**wish, dark=dark)
        boxes(figure)  # numbers beside axes are made when a figure is drawn
        ground = figure.get_facecolor()
        assert (luminance(ground) < 0.02) is dark
        shown = [text for text in figure.findobj(Text) if text.get_text() and text.get_visible()]
        assert min(contrast(text.get_color(), ground) for text in shown) > 4
        for axes in figure.axes:
            assert axes.get_facecolor() == ground
            marks = [line.get_color() for line in axes.get_lines()]
            marks += [face for each in axes.collections if each.get_alpha() is None
                      for face in each.get_facecolor()]  # fmt: skip
            # The brightest value of a scale of colours is yellow, which white is near to.
            assert min([contrast(colour, ground) for colour in marks], default=2) > 1.25


def test_a_result_is_drawn_on_a_dark_ground_too(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    result = al.Results(time=TIME, names=("x", "y"), values=np.column_stack([TIME, TIME**2]))
    figure = result.plot("x", "y", dark=True)
    ground = figure.get_facecolor()
    assert luminance(ground) < 0.02
    lines = [line for axes in figure.axes for line in axes.get_lines()]
    assert len(lines) == 2
    assert all(contrast(line.get_color(), ground) > 4.5 for line in lines)
    result.save("run.csv")
    assert main(["plot", "run.csv", "x", "--dark", "-o", "a.svg"]) == 0
    assert "#12161c" in Path("a.svg").read_text()
    light = [axes.get_lines()[0].get_color() for axes in result.plot("x", "y").axes]
    assert light == ["#0072B2", "#D55E00"]
