"""Measures of a sweep: curves and bands over a number, scatter, each over each other."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING

import numpy as np

from adamslite.errors import UsageError
from adamslite.plots import style
from adamslite.plots.selection import clipped, listed
from adamslite.plots.style import framed
from adamslite.plots.sweep_axes import (
    MANY_POINTS,
    MARKED,
    MOST_LINES,
    USUAL,
    WIDTH,
    Scale,
    height_of,
    mark_failed,
    number_axis,
    thinned,
)
from adamslite.plots.sweep_selection import Column, Runs, Wanted

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

#: Points of a line up to which each is marked.
MARKED_POINTS = 40
#: Points up to which they are large.
FEW = 100
#: Most columns of a matrix of scatter, and the side of one of its axes [in].
MOST_COLUMNS, SIDE = 7, 1.75
#: Letters along such a side.
SMALL = 7.0


def measures_figure(runs: Runs, names: Sequence[str], wanted: Wanted) -> Figure:
    """Curves over a number of a grid; scatter of a sample, or over a measure."""
    columns = [runs.column(name) for name in names]
    if wanted.pairs:
        return pairs(runs, columns)
    if wanted.x is None and not runs.is_grid and not wanted.band:
        by = runs.number(wanted.by, "--by") if wanted.by else None
        return scatter_by_number(runs, columns, by)
    x = _across(runs, wanted)
    others = [each for each in columns if each.name != x.name] or columns
    if wanted.band:
        return bands(runs, others, x, wanted.band)
    is_number = x.name in runs.sweep.names
    by = _coloured_by(runs, x, wanted)
    if is_number and runs.is_grid:
        groups = _groups(runs, x)
        if len(groups) > MOST_LINES and not wanted.by:
            return bands(runs, others, x, USUAL)
        return curves(runs, others, x, by, groups)
    return scatter(runs, others, x, by)


def _across(runs: Runs, wanted: Wanted) -> Column:
    """What is asked for, else the number with most values."""
    if wanted.x:
        return runs.column(wanted.x)
    free = [each for each in runs.varied if each.name.casefold() != (wanted.by or "").casefold()]
    return max(free or runs.varied, key=lambda each: len(each.levels))


def _coloured_by(runs: Runs, x: Column, wanted: Wanted) -> Column | None:
    if wanted.by:
        return runs.number(wanted.by, "--by")
    others = [each for each in runs.varied if each.name != x.name and len(each.levels) > 1]
    return others[0] if others and runs.is_grid else None


def curves(
    runs: Runs, columns: Sequence[Column], x: Column, by: Column | None, groups: list[np.ndarray]
) -> Figure:
    """A line for each group of runs, coloured by a number."""
    scale = Scale(by)
    notes = list(_failure_notes(runs))
    if len(groups) > MOST_LINES:
        notes.insert(0, f"{MOST_LINES} of {len(groups)} lines are drawn.")
    rest = [each.name for each in runs.varied if each.name not in (x.name, by.name if by else "")]
    if rest:
        notes.append(f"Lines of one colour differ in {listed(rest)}.")
    figure, axes = _stacked(runs, columns, x, notes, f"{_names(columns)} over {clipped(x.name)}")
    for axis, column in zip(axes, columns, strict=True):
        for group in thinned(groups):
            order = group[np.argsort(x.values[group], kind="stable")]
            colour = scale.colours(by.values[order[:1]])[0] if by else style.BLUE
            marker = "o" if len(order) <= MARKED_POINTS else ""
            axis.plot(x.values[order], column.values[order], color=colour, marker=marker,
                      markersize=3.5, linewidth=1.5)  # fmt: skip
        mark_failed(axis, x.values[runs.failed])
    scale.explain(figure, axes)
    return figure


def _groups(runs: Runs, x: Column) -> list[np.ndarray]:
    """The runs that have all numbers but one in common."""
    others = [k for k, name in enumerate(runs.sweep.names) if name != x.name]
    every = np.arange(len(runs.sweep))
    if not others:
        return [every]
    _, group = np.unique(runs.sweep.values[:, others], axis=0, return_inverse=True)
    group = group.reshape(-1)
    order = np.argsort(group, kind="stable")
    return np.split(every[order], np.flatnonzero(np.diff(group[order])) + 1)


def bands(
    runs: Runs, columns: Sequence[Column], x: Column, percentiles: tuple[float, float]
) -> Figure:
    """The median of all runs with the same value of a number, and a band of percentiles."""
    if x.name not in runs.sweep.names or not runs.is_grid:
        raise UsageError(
            f"a band over {x.name} needs a grid: in a sample no two runs have the same value"
        )
    notes = [f"Line: median of the runs with the same {clipped(x.name)}; {band_words(percentiles)}"]
    title = f"{_names(columns)} over {clipped(x.name)}"
    figure, axes = _stacked(runs, columns, x, [*notes, *_failure_notes(runs)], title)
    for axis, column in zip(axes, columns, strict=True):
        values = [column.values[x.values == level] for level in x.levels]
        draw_band(axis, x.levels, percentiles_of(values, percentiles))
        mark_failed(axis, x.values[runs.failed])
    return figure


def percentiles_of(values: Sequence[np.ndarray], percentiles: tuple[float, float]) -> np.ndarray:
    """Low, median and high of each of several sets (3, n); no numbers of an empty set."""
    low, high = percentiles
    sets = [each[np.isfinite(each)] for each in values]
    rows = [
        np.percentile(each, [low, 50.0, high]) if len(each) else np.full(3, np.nan) for each in sets
    ]
    return np.array(rows).T


def draw_band(axis: Axes, x: np.ndarray, ends: np.ndarray) -> None:
    """A median and its band (3, n)."""
    axis.fill_between(x, ends[0], ends[2], color=style.SKY, alpha=0.35, linewidth=0, zorder=2)
    axis.plot(x, ends[1], color=style.BLUE, linewidth=1.8, zorder=3,
              marker="o" if len(x) <= MARKED_POINTS else "", markersize=3.5)  # fmt: skip


def band_words(percentiles: tuple[float, float]) -> str:
    """What a band is, for small print."""
    low, high = percentiles
    if (low, high) == (0.0, 100.0):
        return "band: from the least to the largest."
    return f"band: from {low:g} to {high:g} % of the runs."


def scatter(runs: Runs, columns: Sequence[Column], x: Column, by: Column | None) -> Figure:
    """A point for each run, over a number or a measure."""
    scale = Scale(by)
    is_number = x.name in runs.sweep.names
    notes = list(_failure_notes(runs, marked=is_number))
    figure, axes = _stacked(runs, columns, x, notes, f"{_names(columns)} over {clipped(x.name)}")
    for axis, column in zip(axes, columns, strict=True):
        _points(axis, x, column, scale)
        if is_number:
            mark_failed(axis, x.values[runs.failed])
    scale.explain(figure, axes, "o")
    return figure


def scatter_by_number(runs: Runs, columns: Sequence[Column], by: Column | None) -> Figure:
    """A row for each measure, an axis in it for each number that varies."""
    numbers = runs.varied[:MOST_COLUMNS]
    notes = list(_failure_notes(runs))
    if len(runs.varied) > len(numbers):
        notes.append(f"{len(numbers)} of {len(runs.varied)} numbers; --x draws another one.")
    scale = Scale(by)
    figure = framed(
        _capital(f"{_names(columns)} over each number"), runs.subtitle, notes,
        max(WIDTH, 2.2 * len(numbers)), height_of(len(columns)) * len(columns) + 0.4,
    )  # fmt: skip
    axes = figure.subplots(len(columns), len(numbers), sharex="col", sharey="row", squeeze=False)
    for row, column in zip(axes, columns, strict=True):
        row[0].set_title(column.label)
        style.plain_ticks(row[0].yaxis)
        for axis, number in zip(row, numbers, strict=True):
            _points(axis, number, column, scale)
            mark_failed(axis, number.values[runs.failed])
    for axis, number in zip(axes[-1], numbers, strict=True):
        number_axis(axis.xaxis, _short(number))
    _few_ticks(axes[-1])
    scale.explain(figure, [*axes[:, -1]], "o")
    return figure


def pairs(runs: Runs, columns: Sequence[Column]) -> Figure:
    """Numbers that vary and measures, each over each other; counts of values on the diagonal."""
    every = {each.name: each for each in [*runs.varied, *columns]}
    shown = list(every.values())
    if not 2 <= len(shown) <= MOST_COLUMNS:
        raise UsageError(
            f"--pairs draws 2 to {MOST_COLUMNS} quantities over each other, and these are "
            f"{len(shown)}: name fewer measures, or vary fewer numbers"
        )
    side = SIDE * len(shown) + 0.8
    title = f"{_names(columns)} and the numbers, over each other"
    notes = list(_failure_notes(runs, marked=False))
    figure = framed(_capital(title), runs.subtitle, notes, max(side, 6.0), side)
    axes = figure.subplots(len(shown), len(shown), sharex="col", squeeze=False)
    for n, row in enumerate(axes):
        for m, axis in enumerate(row):
            if m == n:
                values = shown[n].values[runs.good]
                axis.hist(values[np.isfinite(values)], bins=20, color=style.SKY)
                axis.set_yticks([])
            else:
                if m:
                    axis.sharey(row[0] if n else row[1])
                _points(axis, shown[m], shown[n], Scale(None), size=7.0, good=runs.good)
            axis.tick_params(labelleft=m == (0 if n else 1) and m != n, labelsize=7)
    for n, each in enumerate(shown):
        number_axis(axes[-1, n].xaxis, _short(each))
        axes[n, 0].set_ylabel(_short(each).label, fontsize=SMALL)
        axes[-1, n].xaxis.label.set_size(SMALL)
        style.plain_ticks(axes[n, 1 if n == 0 else 0].yaxis)
    _few_ticks(axes[-1])
    return figure


def _points(
    axis: Axes, x: Column, y: Column, scale: Scale, size: float | None = None,
    good: np.ndarray | None = None,
) -> None:  # fmt: skip
    """A point for each run that has both values."""
    kept = np.isfinite(x.values + y.values) & (True if good is None else good)
    colours = scale.colours(scale.column.values[kept]) if scale.column else style.BLUE
    axis.scatter(
        x.values[kept], y.values[kept], s=size or (14.0 if len(x.values) > FEW else 28.0),
        c=colours, alpha=0.75, linewidths=0.0, rasterized=len(x.values) > MANY_POINTS,
    )  # fmt: skip


def _stacked(
    runs: Runs, columns: Sequence[Column], x: Column, notes: Sequence[str], title: str
) -> tuple[Figure, list[Axes]]:
    """A figure with an axis for each column above a common one."""
    heights = height_of(len(columns)) * len(columns) + 0.5
    figure = framed(_capital(title), runs.subtitle, notes, WIDTH, heights)
    axes = [*figure.subplots(len(columns), 1, sharex=True, squeeze=False)[:, 0]]
    for axis, column in zip(axes, columns, strict=True):
        axis.set_title(column.label)
        style.plain_ticks(axis.yaxis)
    number_axis(axes[-1].xaxis, x)
    return figure, axes


def _failure_notes(runs: Runs, marked: bool = True) -> Iterator[str]:
    yield from runs.notes()
    if len(runs.failed):
        yield MARKED if marked else "They have no value, and are not drawn."


def _names(columns: Sequence[Column]) -> str:
    return listed([each.name for each in columns])


def _capital(text: str) -> str:
    return text[:1].upper() + text[1:]


def _short(column: Column) -> Column:
    """With a name that an axis has room for."""
    return Column(clipped(column.name, 24), column.unit, column.values)


def _few_ticks(axes: Sequence[Axes]) -> None:
    """As many numbers as narrow axes have room for."""
    from matplotlib.ticker import MaxNLocator

    for axis in axes:
        axis.xaxis.set_major_locator(MaxNLocator(3, steps=[1, 2, 2.5, 5, 10]))
