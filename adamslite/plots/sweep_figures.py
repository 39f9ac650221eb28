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
from adamslite.plots.sweep_histories import histories_figure
from adamslite.plots.sweep_measures import measures_figure
from adamslite.plots.sweep_selection import Runs, Wanted, chosen
from adamslite.sweeps.record import Sweep

if TYPE_CHECKING:
    from matplotlib.figure import Figure


def sweep_figure(sweep: Sweep, wanted: Wanted) -> Figure:
    """Draw a sweep.

    Raises
    ------
    UsageError
        Without matplotlib, and when there is nothing of what is asked for.
    """
    style.need_matplotlib()
    if wanted.indices:
        from adamslite.plots.indices_chart import indices_chart

        return indices_chart(sweep, wanted.names)
    runs = Runs(sweep)
    measures, histories = chosen(sweep, wanted.names)
    with style.styled():
        if histories:
            return histories_figure(runs, histories, wanted)
        if not runs.good.any():
            raise UsageError(f"none of the {len(sweep)} runs reached its end: nothing can be drawn")
        for name in measures:
            if np.isnan(runs.column(name).values).all():
                raise UsageError(f"{name} is not a number in any run")
        return measures_figure(runs, measures, wanted)
