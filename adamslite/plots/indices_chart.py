"""Sobol indices of a sweep: first and total with their intervals, for each measure."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from adamslite.plots import style
from adamslite.plots.frame import framed
from adamslite.plots.selection import clipped, listed
from adamslite.plots.sweep_axes import WIDTH
from adamslite.sweeps.record import Sweep

if TYPE_CHECKING:
    from matplotlib.figure import Figure

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
