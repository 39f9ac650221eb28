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
from adamslite.plots.selection import clipped, listed
from adamslite.plots.style import framed
from adamslite.plots.sweep_axes import WIDTH
from adamslite.plots.sweep_histories import histories_figure
from adamslite.plots.sweep_measures import measures_figure
from adamslite.plots.sweep_selection import Runs, Wanted, chosen
from adamslite.sweeps.record import Sweep

if TYPE_CHECKING:
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
