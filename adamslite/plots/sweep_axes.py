"""What figures of sweeps have in common: colours by a number, legends, marks of failed runs."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from adamslite.plots import style
from adamslite.plots.dark import GROUND
from adamslite.plots.selection import clipped, pretty
from adamslite.plots.sweep_selection import Column

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

#: Width of a figure, height of its axes by their number [in].
WIDTH, HEIGHTS, LOWEST = 9.0, {1: 3.8, 2: 2.6, 3: 2.2}, 1.9
#: So many values of a number have an entry in a legend; more have a scale of colours.
TELLABLE = 8
#: Markers of so many points are pixels in a drawing of lines: it would be large, and slow to show.
MANY_POINTS = 3000
#: More lines than this are a surface: they are drawn as a band, of these percentiles.
MOST_LINES, USUAL = 300, (5.0, 95.0)
MARKED = "x: a run that failed, where its number stands; it has no value."


def height_of(count: int) -> float:
    """Of an axis among so many [in]."""
    return HEIGHTS.get(count, LOWEST)


class Scale:
    """Colours by the values of a number: pale ones do not vanish on white."""

    def __init__(self, column: Column | None) -> None:
        self.column = column
        self.levels = column.levels if column else np.empty(0)

    @property
    def is_listed(self) -> bool:
        """Whether each value has an entry in a legend."""
        return 0 < len(self.levels) <= TELLABLE

    def colours(self, values: np.ndarray) -> Any:
        """Colours (n, 4) of values of the number (n,)."""
        return _map()(self._norm()(values)) if len(self.levels) else style.BLUE

    def _norm(self) -> Any:
        from matplotlib.colors import Normalize

        low, high = float(self.levels[0]), float(self.levels[-1])
        return Normalize(low, high if high > low else low + 1.0)

    def explain(self, figure: Figure, axes: Sequence[Axes], marker: str = "") -> None:
        """A legend beside the first axis, or a scale of colours beside all."""
        if self.column is None or not len(self.levels):
            return
        if self.is_listed:
            self._legend(axes[0], marker)
            return
        from matplotlib.cm import ScalarMappable

        shown = ScalarMappable(self._norm(), _map())
        bar = figure.colorbar(shown, ax=list(axes), aspect=30, pad=0.02)
        bar.set_label(self.column.label)
        bar.outline.set_visible(False)  # type: ignore[operator]
        style.plain_ticks(bar.ax.yaxis)

    def _legend(self, axis: Axes, marker: str) -> None:
        from matplotlib.lines import Line2D

        assert self.column is not None
        unit = pretty(self.column.unit)
        handles = [
            Line2D([], [], color=colour, marker=marker, linestyle="" if marker else "-",
                   label=f"{value:.6g} {unit}".rstrip())
            for value, colour in zip(self.levels, self.colours(self.levels), strict=True)
        ]  # fmt: skip
        axis.legend(
            handles=handles, loc="upper left", bbox_to_anchor=(1.01, 1.03), borderaxespad=0.0,
            title=clipped(self.column.name), alignment="left", title_fontsize=8,
        )  # fmt: skip


def _map() -> Any:
    """The part of a scale of colours that is seen on the ground of the figure that is made."""
    from matplotlib import colormaps, rcParams
    from matplotlib.colors import ListedColormap

    seen = (0.35, 1.0) if rcParams["axes.facecolor"] == GROUND else (0.0, 0.93)
    return ListedColormap(colormaps["cividis"](np.linspace(*seen, 256)))


def mark_failed(axis: Axes, places: np.ndarray) -> None:
    """Crosses on the horizontal axis: runs that failed, at places of it."""
    if len(places):
        axis.scatter(
            places, np.zeros(len(places)), marker="x", s=34, c=style.RED, linewidths=1.4,
            transform=axis.get_xaxis_transform(), zorder=6, clip_on=False,
        )  # fmt: skip
        axis.update_datalim(np.column_stack([places, places]), updatey=False)
        axis.autoscale_view()


def thinned(items: Sequence[Any]) -> Sequence[Any]:
    """As many as can be drawn as lines, evenly from the first to the last."""
    if len(items) <= MOST_LINES:
        return items
    picked = np.linspace(0, len(items) - 1, MOST_LINES).round().astype(int)
    return [items[k] for k in picked]


def number_axis(axis: Any, column: Column) -> None:
    """Label and ticks of an axis; a few values of a number are the ticks."""
    axis.set_label_text(column.label)
    style.plain_ticks(axis)
