"""The figure of a sweep: which one, by what is asked for and what the sweep has.

    figure = sweep_figure(runs, Wanted(names=["max REQUEST/1.F2"], by="PART/2.MASS"))

Of a grid measures are curves over the number with most values, coloured by another one; of a sample
points over each number; histories are lines over time.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from adamslite.errors import UsageError
from adamslite.plots import style
from adamslite.plots.dark import finished, themed
from adamslite.plots.indices_chart import indices_chart
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
