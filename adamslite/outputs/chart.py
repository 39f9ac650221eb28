"""Charts of cost against accuracy, or against size, with labels at the ends of the lines.

matplotlib draws them; it is imported when the first chart is drawn and is an optional extra.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from io import BytesIO
from math import log10
from pathlib import Path
from typing import TYPE_CHECKING, Any

from adamslite.errors import UsageError
from adamslite.outputs.whole_files import whole_file

if TYPE_CHECKING:
    from matplotlib.axes import Axes as Plot
    from matplotlib.figure import Figure

ABSENT = "charts are drawn by matplotlib, which is not installed: python -m pip install matplotlib"

#: How each kind of line looks; they differ in lightness and dashes, so a grey print shows them.
STYLES: dict[str, dict[str, Any]] = {
    "ours": {"color": "#0b3c8c", "linewidth": 2.2, "markersize": 5.5, "zorder": 4},
    "implicit": {"color": "#8a8a8a", "linewidth": 1.0, "markersize": 4.0, "zorder": 2},
    "explicit": {"color": "#8a8a8a", "linewidth": 1.0, "markersize": 4.0, "zorder": 2,
                 "linestyle": (0, (4, 2))},
    "limit": {"color": "#c2410c", "linewidth": 1.3, "markersize": 4.0, "zorder": 3,
              "linestyle": (0, (1, 1.5))},
}  # fmt: skip
MARKERS = "osD^vP<X>*hpd8"
#: Height of a name, as a share of the height of the chart.
LINE_HEIGHT = 0.037
SIZE = (8.6, 5.4)


@dataclass(frozen=True)
class Line:
    """Points of one program, in the order they are joined; ``kind`` is a key of ``STYLES``."""

    name: str
    kind: str
    x: Sequence[float]
    y: Sequence[float]


@dataclass(frozen=True)
class Axes:
    """Titles of a chart; ``towards_less`` has x fall to the right, as errors do."""

    title: str
    x: str
    y: str
    towards_less: bool = False


def need_matplotlib() -> None:
    """Raise UsageError with one sentence when charts cannot be drawn."""
    from importlib.util import find_spec

    if find_spec("matplotlib") is None:
        raise UsageError(ABSENT)


def draw(lines: Sequence[Line], axes: Axes, paths: Sequence[Path]) -> None:
    """Draw lines on logarithmic axes into files; the suffix of each says which format.

    Raises
    ------
    UsageError
        Without matplotlib.
    """
    need_matplotlib()
    from matplotlib import rc_context
    from matplotlib.figure import Figure

    # Letters as letters keep the file small; without salt and date the same chart is the same file.
    with rc_context({"svg.fonttype": "none", "svg.hashsalt": "adamslite", "font.size": 9}):
        figure = Figure(figsize=SIZE)
        plot = figure.add_axes((0.1, 0.1, 0.62, 0.82))
        _frame(plot, axes)
        shown = [line for line in lines if len(line.x)]
        for k, line in enumerate(shown):
            marker = MARKERS[k % len(MARKERS)]
            plot.plot(line.x, line.y, marker=marker, markerfacecolor="white", **STYLES[line.kind])
        _names(plot, shown)
        for path in paths:
            _save(figure, path)


def _frame(plot: Plot, axes: Axes) -> None:
    from matplotlib.ticker import LogFormatter

    plot.set_xscale("log")
    plot.set_yscale("log")
    for which in (plot.yaxis.set_major_formatter, plot.yaxis.set_minor_formatter):
        which(LogFormatter(labelOnlyBase=False, minor_thresholds=(1.5, 0.6)))
    plot.set_title(axes.title, loc="left", fontsize=10)
    plot.set_xlabel(axes.x)
    plot.set_ylabel(axes.y)
    plot.grid(True, which="major", color="#dddddd", linewidth=0.6)
    plot.spines[["top", "right"]].set_visible(False)
    if axes.towards_less:
        plot.invert_xaxis()


def _names(plot: Plot, lines: Sequence[Line]) -> None:
    """Names in a column on the right, in the order of the ends of their lines."""
    low, high = (log10(y) for y in plot.get_ylim())
    heights = [(log10(line.y[-1]) - low) / (high - low) for line in lines]
    for line, at in zip(lines, spread(heights, LINE_HEIGHT), strict=True):
        style = STYLES[line.kind]
        plot.annotate(
            line.name, (line.x[-1], line.y[-1]), (1.03, at), "data", "axes fraction", va="center",
            color=style["color"], fontweight="bold" if line.kind == "ours" else "normal",
            fontsize=8, annotation_clip=False,
            arrowprops={"arrowstyle": "-", "color": "#bbbbbb", "linewidth": 0.5, "shrinkA": 0},
        )  # fmt: skip


def spread(heights: Sequence[float], least: float) -> list[float]:
    """Heights moved apart to ``least`` at least, in their order, about where they were.

    Neighbours that are too close form a block; a block sits at the mean of what its members want.
    """
    order = sorted(range(len(heights)), key=lambda k: heights[k])
    blocks: list[tuple[float, int]] = []  # (lowest place, members)
    for k in order:
        block = (heights[k], 1)
        while blocks and blocks[-1][0] + blocks[-1][1] * least > block[0]:
            start, count = blocks.pop()
            members = count + block[1]
            middle = _middle(start, count, least) * count + _middle(*block, least) * block[1]
            block = (middle / members - (members - 1) * least / 2.0, members)
        blocks.append(block)
    places = [start + j * least for start, count in blocks for j in range(count)]
    found = [0.0] * len(heights)
    for k, place in zip(order, places, strict=True):
        found[k] = place
    return found


def _middle(start: float, count: int, least: float) -> float:
    return start + (count - 1) * least / 2.0


def _save(figure: Figure, path: Path) -> None:
    kind = path.suffix.lstrip(".")
    content = BytesIO()
    figure.savefig(content, format=kind, dpi=130, metadata={"Date": None} if kind == "svg" else {})
    with whole_file(path, binary=True) as stream:
        stream.write(content.getvalue())
