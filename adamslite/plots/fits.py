"""A fit: of each channel what was measured and what was fitted, and below that their difference."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from adamslite.plots import style
from adamslite.plots.selection import clipped, titled
from adamslite.plots.style import framed

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from adamslite.fitting.record import Fit

WIDTH = 9.0
#: Heights [in] of the axis of a channel, and of that of its residuals.
CURVES, RESIDUALS = 2.2, 1.1
#: Channels that are drawn; more have no room.
MOST = 6


def drawn(fit: Fit) -> Figure:
    """The figure of a fit.

    Raises
    ------
    UsageError
        Without matplotlib.
    """
    style.need_matplotlib()
    channels = fit.measured.channels[:MOST]
    heights = [CURVES, RESIDUALS] * len(channels)
    with style.styled():
        title = f"Fitted to {fit.measured.name}: {', '.join(map(clipped, channels))}"
        figure = framed(title, fit.deck.title, _notes(fit), WIDTH, sum(heights) + 0.5)
        found = figure.subplots(len(heights), 1, sharex=True, squeeze=False, height_ratios=heights)
        axes: list[Axes] = [*found[:, 0]]
        for k in range(len(channels)):
            _channel(fit, k, axes[2 * k])
            _residuals(fit, k, axes[2 * k + 1])
        axes[-1].set_xlabel(titled("time", fit.results.channel("time").unit))
        for axis in axes:
            style.plain_ticks(axis.yaxis)
        style.plain_ticks(axes[-1].xaxis)
    return figure


def _notes(fit: Fit) -> list[str]:
    """Small print: the numbers, and channels without room."""
    found = [f"Fitted, with standard errors: {'; '.join(fit.phrases)}."]
    found += [str(each) for each in fit.certainty.unidentifiable]
    if more := len(fit.measured.channels) - MOST:
        found += [f"{more} more channels are not drawn."] if more > 0 else []
    return found


def _channel(fit: Fit, k: int, axis: Axes) -> None:
    """Measured values as points, the fitted curve and that of the start as lines."""
    name, known = fit.measured.channels[k], fit.measured.known[:, k]
    channel = fit.results.channel(name)
    axis.set_title(titled(f"{channel.quantity} {clipped(name)}".strip(), channel.unit))
    axis.plot(
        fit.measured.time[known], fit.measured.values[known, k], ".", color=style.MUTED,
        markersize=3.0, label="measured", zorder=1,
    )  # fmt: skip
    axis.plot(
        fit.before.time, fit.before[name], color=style.ORANGE, linewidth=1.0,
        linestyle=(0, (4, 3)), label="before", zorder=2,
    )  # fmt: skip
    axis.plot(fit.results.time, fit.results[name], color=style.BLUE, linewidth=1.5,
              label="fitted", zorder=3)  # fmt: skip
    axis.legend(loc="upper left", bbox_to_anchor=(1.01, 1.03), borderaxespad=0.0)


def _residuals(fit: Fit, k: int, axis: Axes) -> None:
    """Fitted less measured, and the band or the noise that it is divided by."""
    known, time = fit.measured.known[:, k], fit.measured.time
    has_band = bool(fit.measured.bands[known, k].all())
    axis.set_title("fitted less measured")
    axis.fill_between(
        time[known], -fit.sigmas[known, k], fit.sigmas[known, k], color=style.BAND, linewidth=0,
        label="band" if has_band else "noise found", zorder=0,
    )  # fmt: skip
    apart = np.where(known, fit.apart[:, k], np.nan)
    axis.plot(time, apart, ".", color=style.DARK, markersize=2.5, zorder=2)
    axis.legend(loc="upper left", bbox_to_anchor=(1.01, 1.03), borderaxespad=0.0)
