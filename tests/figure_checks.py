"""What no figure may do: text outside of the canvas or over other text, axes without room."""

from __future__ import annotations

from itertools import combinations
from typing import Any

#: Pixels by which boxes of letters may reach over one another: they have room around them.
SLACK = 1.5


def boxes(figure: Any) -> list[tuple[str, Any]]:
    """Every visible text of a figure with its box, in pixels."""
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.text import Text

    from adamslite.plots.style import styled

    with styled():
        canvas = FigureCanvasAgg(figure)
        canvas.draw()
        renderer = canvas.get_renderer()
        idle = {label for axes in figure.axes for label in idle_labels(axes)}
        texts = [t for t in figure.findobj(Text) if t.get_visible() and t.get_text().strip()]
        return [(t.get_text(), t.get_window_extent(renderer)) for t in texts if t not in idle]


def idle_labels(axes: Any) -> set[Any]:
    """Labels of ticks that are kept for later, or lie beyond the limits of their axis."""
    found = set()
    for axis in (axes.xaxis, axes.yaxis):
        drawn = {id(tick) for tick in axis._update_ticks()}
        for tick in (*axis.majorTicks, *axis.minorTicks):
            if id(tick) not in drawn:
                found |= {tick.label1, tick.label2}
    return found


def outside(figure: Any, texts: list[tuple[str, Any]]) -> list[str]:
    """The texts that reach beyond the canvas."""
    canvas = figure.bbox
    return [
        text for text, box in texts
        if box.x0 < canvas.x0 - SLACK or box.x1 > canvas.x1 + SLACK
        or box.y0 < canvas.y0 - SLACK or box.y1 > canvas.y1 + SLACK
    ]  # fmt: skip


def overlapping(texts: list[tuple[str, Any]]) -> list[str]:
    """The pairs of texts that are drawn over one another."""
    return [
        f"{a} | {b}" for (a, p), (b, q) in combinations(texts, 2)
        if min(p.x1, q.x1) - max(p.x0, q.x0) > SLACK and min(p.y1, q.y1) - max(p.y0, q.y0) > SLACK
    ]  # fmt: skip


def cramped(figure: Any) -> list[str]:
    """Axes that what is around them has left less than 4.4 by 1.15 in."""
    width, height = figure.get_size_inches()
    found = [axes.get_position() for axes in figure.axes]
    return [
        f"axes of {width * box.width:.2f} by {height * box.height:.2f} in" for box in found
        if width * box.width < 4.4 or height * box.height < 1.15
    ]  # fmt: skip


def illegible(figure: Any) -> list[str]:
    """Texts that are clipped, pairs that overlap, and axes without room."""
    texts = boxes(figure)
    return [*outside(figure, texts), *overlapping(texts), *cramped(figure)]


def assert_legible(figure: Any) -> None:
    """Nothing is clipped, nothing overlaps, and there is room for the curves."""
    assert illegible(figure) == []
