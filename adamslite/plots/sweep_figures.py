"""The figure of a sweep: which one, by what is asked for and what the sweep has.

    figure = sweep_figure(runs, Wanted(names=["max REQUEST/1.F2"], by="PART/2.MASS"))

Of a grid measures are curves over the number with most values, coloured by another one; of a sample
points over each number; histories are lines over time.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from adamslite.errors import UsageError
from adamslite.plots import style
from adamslite.plots.dark import finished, themed
from adamslite.plots.selection import clipped, listed, titled
from adamslite.plots.style import framed
from adamslite.plots.sweep_axes import MOST_LINES, USUAL, WIDTH, Scale, height_of, thinned
from adamslite.plots.sweep_measures import band_words, draw_band, measures_figure, percentiles_of
from adamslite.plots.sweep_selection import TIME, Runs, Wanted, chosen
from adamslite.sweeps.record import Sweep

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure


def sweep_figure(sweep: Sweep, wanted: Wanted, dark: bool = False) -> Figure:
    """Draw a sweep, on white or on a dark ground.

    Raises
    ------
    UsageError
        Without matplotlib, and when there is nothing of what is asked for.
    """
    style.need_matplotlib()
    with themed(dark):
        if wanted.indices:
            return finished(indices_chart(sweep, wanted.names), dark)
        return finished(_of_runs(sweep, wanted), dark)


def _of_runs(sweep: Sweep, wanted: Wanted) -> Figure:
    """Histories, or measures of the runs that reached their end."""
    runs = Runs(sweep)
    measures, histories = chosen(sweep, wanted.names)
    if histories:
        return histories_figure(runs, histories, wanted)
    if not runs.good.any():
        raise UsageError(f"none of the {len(sweep)} runs reached its end: nothing can be drawn")
    for name in measures:
        if np.isnan(runs.column(name).values).all():
            raise UsageError(f"{name} is not a number in any run")
    return measures_figure(runs, measures, wanted)


#: Height of a number [in].
ROW = 0.42
NOTES = (
    "First: the part of the variance that a number is behind by itself; total: with all others. "
    "Lines: intervals of 95 % from resampling the points."
)


def indices_chart(sweep: Sweep, names: Sequence[str]) -> Figure:
    """An axis for each measure, a line in it for each number."""
    found = sweep.indices(names)
    count = len(found.names)
    height = len(found.measures) * (ROW * count + 0.6) + 0.5
    notes = [NOTES, f"{found.points} points, {len(sweep)} runs."]
    title = f"Sobol indices of {listed(list(found.measures))}"
    figure = framed(title, sweep.meta.get("deck", ""), notes, WIDTH, height)
    axes = figure.subplots(len(found.measures), 1, sharex=True, squeeze=False)[:, 0]
    places = np.arange(count)
    for m, axis in enumerate(axes):
        axis.set_title(found.measures[m])
        for values, ends, up, colour, marker, label in (
            (found.first[m], found.first_interval[m], -0.13, style.BLUE, "o", "first"),
            (found.total[m], found.total_interval[m], 0.13, style.RED, "s", "total"),
        ):
            reach = np.abs(ends - values[:, None]).T
            axis.errorbar(values, places + up, xerr=reach, fmt=marker, color=colour,
                          markersize=5, linewidth=1.3, label=label)  # fmt: skip
        axis.set_yticks(places, [clipped(name) for name in found.names])
        axis.set_ylim(count - 0.5, -0.5)
        axis.axvline(0.0, color=style.MUTED, linewidth=0.8)
    axes[0].legend(loc="upper left", bbox_to_anchor=(1.01, 1.03), borderaxespad=0.0)
    axes[-1].set_xlabel("part of the variance")
    return figure


#: Histories with fewer output times have their points marked.
FEWEST = 3
DOTTED = (0, (1, 1.4))


def histories_figure(runs: Runs, names: Sequence[str], wanted: Wanted) -> Figure:
    """Lines, or a band when asked for and of very many runs."""
    if wanted.x and wanted.x.casefold() != TIME:
        raise UsageError(f"histories are drawn over time, not over {wanted.x}; measures are")
    if wanted.pairs:
        raise UsageError(f"--pairs draws measures, and {names[0]} is a history")
    if not any(len(time) for time, _ in runs.sweep.histories.values()):
        raise UsageError("no run has a history: there is nothing to draw")
    drawn = [k for k in runs.sweep.histories if len(runs.sweep.histories[k][0])]
    if wanted.band or (len(drawn) > MOST_LINES and not wanted.by):
        return bands(runs, names, wanted.band or USUAL)
    return lines(runs, names, drawn, wanted)


def lines(runs: Runs, names: Sequence[str], drawn: Sequence[int], wanted: Wanted) -> Figure:
    """A line for each run; that of one that failed is dotted and ends in a cross."""
    from matplotlib.collections import LineCollection

    by = runs.number(wanted.by, "--by") if wanted.by else runs.varied[0]
    scale, notes = Scale(by), list(runs.notes())
    if len(drawn) > MOST_LINES:
        notes.insert(0, f"{MOST_LINES} of {len(drawn)} runs are drawn.")
        drawn = thinned(drawn)
    failed = [k for k in drawn if not runs.good[k]]
    if failed:
        notes.append("Dotted: a run that failed, until it ended (x).")
    others = [each.name for each in runs.varied if each.name != by.name]
    if others:
        notes.append(f"Runs of one colour differ in {listed(others)}.")
    figure, axes = _stacked(runs, names, notes)
    for axis, name in zip(axes, names, strict=True):
        at = runs.sweep.channels.index(name)
        for kept, dashes in (([k for k in drawn if runs.good[k]], "-"), (failed, DOTTED)):
            table = [_line(runs, k, at) for k in kept]
            axis.add_collection(LineCollection(
                table, colors=scale.colours(by.values[kept]), linestyles=[dashes],
                linewidths=1.4 if len(drawn) <= 12 else 0.8,
            ))  # fmt: skip
        _few(axis, runs, [k for k in drawn if runs.good[k]], at, scale)
        _ends(axis, runs, failed, at, scale)
        axis.autoscale_view()
    scale.explain(figure, axes)
    return figure


def _line(runs: Runs, run: int, at: int) -> np.ndarray:
    """Times and values (nt, 2)."""
    time, values = runs.sweep.histories[run]
    own = np.where(np.isfinite(values[:, at]), values[:, at], np.nan)
    return np.column_stack([time, own])


def _few(axis: Axes, runs: Runs, drawn: Sequence[int], at: int, scale: Scale) -> None:
    """Points of histories that are hardly a line: those of an equilibrium have one."""
    short = [k for k in drawn if len(runs.sweep.histories[k][0]) < FEWEST]
    if short and scale.column:
        rows = [_line(runs, k, at) for k in short]
        values = np.repeat(scale.column.values[short], [len(row) for row in rows])
        time, points = np.concatenate(rows).T
        axis.scatter(time, points, s=16, c=scale.colours(values), zorder=4)


def _ends(axis: Axes, runs: Runs, failed: Sequence[int], at: int, scale: Scale) -> None:
    """Crosses where runs failed."""
    if not failed or scale.column is None:
        return
    ends = np.array([_line(runs, k, at)[-1] for k in failed])
    colours = scale.colours(scale.column.values[failed])
    axis.scatter(ends[:, 0], ends[:, 1], marker="x", s=34, c=colours, linewidths=1.4, zorder=6)


def bands(runs: Runs, names: Sequence[str], percentiles: tuple[float, float]) -> Figure:
    """Median and band of the runs that reached their end, as far as all of them go."""
    good = [k for k in runs.sweep.histories if runs.good[k] and len(runs.sweep.histories[k][0])]
    if not good:
        raise UsageError("no run reached its end: there is no band to draw")
    ends = [runs.sweep.histories[k][0][-1] for k in good]
    notes = [f"Line: median of {len(good)} runs; {band_words(percentiles)}"]
    if max(ends) > min(ends):
        notes.append(f"Drawn to {min(ends):.6g}, where the first run ends.")
    notes += runs.notes()
    figure, axes = _stacked(runs, names, notes)
    whole = max((runs.sweep.histories[k][0] for k in good), key=len)
    time = whole[whole <= min(ends)]
    for axis, name in zip(axes, names, strict=True):
        at = runs.sweep.channels.index(name)
        table = np.array([_at(runs, k, at, time) for k in good])
        draw_band(axis, time, percentiles_of([*table.T], percentiles))
    return figure


def _at(runs: Runs, run: int, at: int, time: np.ndarray) -> np.ndarray:
    """Values of a run at times: its own, or on straight lines between them."""
    own, values = runs.sweep.histories[run]
    if np.array_equal(own[: len(time)], time):
        return values[: len(time), at]
    return np.interp(time, own, values[:, at])


def _stacked(runs: Runs, names: Sequence[str], notes: Sequence[str]) -> tuple[Figure, list[Axes]]:
    """An axis for each history above a common time."""
    title = f"{listed(list(names))} over time"
    heights = height_of(len(names)) * len(names) + 0.5
    figure = framed(title[:1].upper() + title[1:], runs.subtitle, notes, WIDTH, heights)
    axes = [*figure.subplots(len(names), 1, sharex=True, squeeze=False)[:, 0]]
    for axis, name in zip(axes, names, strict=True):
        axis.set_title(titled(clipped(name, 44), runs.sweep.units.get(name, "")))
        style.plain_ticks(axis.yaxis)
    axes[-1].set_xlabel(titled(TIME, runs.sweep.units.get(TIME, "")))
    style.plain_ticks(axes[-1].xaxis)
    return figure, axes
