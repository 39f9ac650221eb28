"""Histories of channels over time, or over another channel: one axis for each quantity.

    figure = plot(results, ["PART/2.x", "JOINT/*.f?"], against="reference.csv")

A reference is drawn as a dashed line in the band of its tolerance. Where such a band is too thin to
be seen the last axis shows it: the difference from the reference as a part of the tolerance.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from textwrap import shorten
from typing import TYPE_CHECKING, Any, TypeAlias

import numpy as np

from adamslite.errors import UsageError
from adamslite.plots import style
from adamslite.plots.dark import finished, themed
from adamslite.plots.references import Beside, beside, reference_of
from adamslite.plots.selection import (
    Curve,
    Panel,
    clipped,
    curve,
    panels,
    select,
    summary,
    titled,
    without_numbers,
)
from adamslite.plots.style import framed
from adamslite.results.events import Event, events_of
from adamslite.results.results import Results
from adamslite.verification.reference_file import Reference

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

#: Colour and dashes.
Look: TypeAlias = tuple[Any, Any]
WIDTH = 9.0
#: Heights [in]: of an axis by the number of axes, of a line of a legend.
HEIGHTS, LOWEST, ENTRY = {1: 3.6, 2: 2.5, 3: 2.1}, 1.8, 0.16
#: Characters of an event in the small print.
NOTE = 220
#: More curves than this in an axis are told apart by a scale of colours only.
TELLABLE = len(style.CURVES)
SHOWN_OF_MANY = 5
#: So many events are marked and explained.
MARKED = 6
#: Marks that are closer than this part of the axis are one.
CLOSE = 0.06


@dataclass(frozen=True, eq=False)
class Drawn:
    """What a figure shows."""

    results: Results
    x: Curve
    panels: tuple[Panel, ...]
    beside: Beside | None
    events: tuple[Event, ...]

    @property
    def over_time(self) -> bool:
        """Whether time is the common axis."""
        return self.x.channel.name == "time"

    @property
    def curves(self) -> list[Curve]:
        """Those of all axes."""
        return [each for panel in self.panels for each in panel.curves]

    @cached_property
    def looks(self) -> Mapping[str, Look]:
        """Colour and dashes of every channel, different in all axes if there are few."""
        names = [[each.channel.name for each in panel.curves] for panel in self.panels]
        groups = [sum(names, [])] if len(self.curves) <= TELLABLE else names
        pairs = (zip(group, _looks(len(group)), strict=True) for group in groups)
        return {name: look for group in pairs for name, look in group}


def plot(
    results: Results,
    channels: str | Sequence[str],
    against: Reference | Results | str | Path | None = None,
    x: str = "time",
    dark: bool = False,
) -> Figure:
    """Draw channels of results.

    Parameters
    ----------
    results : Results
    channels : str or sequence of str
        Names or patterns: ``PART/2.x``, ``PART/*.v?``.
    against : Reference, Results, str or Path, optional
        A reference, or a file with one.
    x : str
        The channel of the horizontal axis.
    dark : bool
        Whether the ground is dark.

    Raises
    ------
    UnknownChannel
        When there is no such channel.
    UsageError
        Without matplotlib, and when there is nothing to draw.
    """
    style.need_matplotlib()
    drawn = _chosen(results, [channels] if isinstance(channels, str) else channels, against, x)
    with themed(dark):
        return finished(_figure(drawn), dark)


def _chosen(
    results: Results,
    channels: Sequence[str],
    against: Reference | Results | str | Path | None,
    x: str,
) -> Drawn:
    if not len(results.time):
        raise UsageError("the results hold no output time: there is nothing to draw")
    results = results.by_row() if against is None else results
    if not channels:
        near = ", ".join(results.names[:3])
        raise UsageError(f"no channel is named; there are {near}, ...")
    across, names = curve(results, x), select(results, channels)
    others = [name for name in names if name != across.channel.name]  # it over itself is a line
    curves = [curve(results, name) for name in others or names]
    if all(np.isnan(each.values + across.values).all() for each in curves):
        empty = across if np.isnan(across.values).all() else curves[0]
        raise UsageError(f"{empty.channel.name} is not a number at any output time")
    found = None
    if against is not None:
        found = beside(results, curves, reference_of(against), across.channel.name)
    return Drawn(results, across, tuple(panels(curves)), found, tuple(events_of(results)))


def _figure(drawn: Drawn) -> Figure:
    heights = list(_heights(drawn))
    subtitle = drawn.results.meta.get("deck", "")
    figure = framed(_title(drawn), subtitle, list(_notes(drawn)), WIDTH, sum(heights) + 0.5)
    axes: list[Axes] = [
        *figure.subplots(len(heights), 1, sharex=True, squeeze=False, height_ratios=heights)[:, 0]
    ]
    for panel, axis in zip(drawn.panels, axes, strict=False):
        _panel(axis, panel, drawn)
    if _has_difference(drawn):
        _difference(axes[-1], drawn)
    _across(axes, drawn)
    return figure


def _heights(drawn: Drawn) -> Iterator[float]:
    """Of every axis [in]: enough for its legend, too."""
    count = len(drawn.panels) + _has_difference(drawn)
    usual = HEIGHTS.get(count, LOWEST)
    for panel in drawn.panels:
        labels = [each.label for each in panel.curves]
        shown = labels if len(labels) <= TELLABLE else labels[:SHOWN_OF_MANY]
        entries = sum(1 + label.count("\n") for label in shown) + (2 if drawn.beside else 0)
        yield max(usual, ENTRY * (entries + 2))
    if _has_difference(drawn):
        yield max(usual, ENTRY * (min(len(drawn.curves), TELLABLE) + 2))


def _has_difference(drawn: Drawn) -> bool:
    return drawn.beside is not None and drawn.over_time


def _title(drawn: Drawn) -> str:
    over = drawn.x.channel.quantity if drawn.over_time else drawn.x.channel.long_name
    text = f"{summary(drawn.curves)} over {over}"
    if drawn.beside:
        text += f": {drawn.beside.verdict}"
    return text[:1].upper() + text[1:]


def _notes(drawn: Drawn) -> Iterator[str]:
    """The lines of small print: events by their numbers, and what else has to be said."""
    if drawn.over_time:
        for number, event in enumerate(drawn.events[:MARKED], 1):
            yield shorten(f"({number}) {event.text}", NOTE, placeholder=" ...")
        if len(drawn.events) > MARKED:
            yield f"and {len(drawn.events) - MARKED} more events"
    else:
        yield "Open circle: begin; filled circle: end."
    if drawn.beside:
        yield from drawn.beside.notes
    if gaps := without_numbers(drawn.curves):
        yield gaps
    named = any(each.channel.quantity for each in drawn.curves)
    if named and not drawn.results.unit_symbols:
        yield "The deck names no units: lengths, forces and times are in its own."


def _panel(axis: Axes, panel: Panel, drawn: Drawn) -> None:
    """One axis with its curves, the reference and the marks of events."""
    axis.set_title(panel.title)
    marker = "o" if len(drawn.results.time) < 3 or drawn.x.channel.quantity == "row" else ""
    many = len(panel.curves) > TELLABLE
    handles: list[Any] = []
    for each in panel.curves:
        color, dashes = drawn.looks[each.channel.name]
        dashes = dashes if len(panel.curves) > 1 else "-"
        (line,) = axis.plot(
            drawn.x.values, each.values, color=color, linestyle=dashes, marker=marker,
            linewidth=0.9 if many else 1.7, label=each.label,
        )  # fmt: skip
        handles.append(line)
        if not drawn.over_time:
            _ends(axis, drawn.x.values, each.values, color)
    _legend(axis, handles, _reference(axis, panel, drawn))
    style.plain_ticks(axis.yaxis)


def _legend(axis: Axes, handles: Sequence[Any], others: Sequence[Any] = ()) -> None:
    """The legend beside an axis; of many curves it has a few, from the first to the last."""
    title, count = None, len(handles)
    if count > TELLABLE:
        picked = np.unique(np.linspace(0, count - 1, SHOWN_OF_MANY).round().astype(int))
        handles, title = [handles[k] for k in picked], f"{count} channels, from"
    axis.legend(handles=[*handles, *others], loc="upper left", bbox_to_anchor=(1.01, 1.03),
                borderaxespad=0.0, title=title, alignment="left", title_fontsize=8)  # fmt: skip


def _looks(count: int) -> Sequence[Look]:
    """Colour and dashes of so many curves: many are drawn in a scale of colours."""
    if count <= TELLABLE:
        return style.CURVES[:count]
    from matplotlib import colormaps

    scale = colormaps["cividis"]
    return [(scale(k / (count - 1) * 0.95), "-") for k in range(count)]


def _ends(axis: Axes, x: np.ndarray, y: np.ndarray, color: Any) -> None:
    """Where a path begins (open) and ends (filled)."""
    known = np.flatnonzero(~np.isnan(x + y))
    for at, face in ((known[:1], "white"), (known[-1:], color)):
        axis.plot(x[at], y[at], "o", markersize=5, markerfacecolor=face, markeredgecolor=color)


def _reference(axis: Axes, panel: Panel, drawn: Drawn) -> list[Any]:
    """The reference of the curves of an axis, and over time its band; these for the legend."""
    if drawn.beside is None:
        return []
    handles: dict[str, Any] = {}
    for each in panel.curves:
        c = drawn.beside.compared.get(each.channel.name)
        if c is None or c.across is None:
            continue
        (handles["line"],) = axis.plot(
            c.across, c.values, color=style.BLACK, linewidth=0.9, linestyle=(0, (4, 3)),
            label=drawn.beside.name, zorder=3, marker="o" if c.time.size < 3 else "", markersize=3,
        )  # fmt: skip
        if drawn.over_time:
            handles["band"] = axis.fill_between(
                c.time, c.values - c.allowed, c.values + c.allowed, color=style.BAND, linewidth=0,
                label="its tolerance", zorder=1,
            )  # fmt: skip
    return list(handles.values())


def _difference(axis: Axes, drawn: Drawn) -> None:
    """Difference from the reference as a part of the tolerance, of all curves that have one."""
    assert drawn.beside is not None
    compared = drawn.beside.compared
    axis.set_title(f"difference from {drawn.beside.name}, as a part of the tolerance")
    axis.axhspan(-1.0, 1.0, color=style.BAND, linewidth=0, zorder=0)
    names = [each.channel.name for each in drawn.curves if each.channel.name in compared]
    few = len(drawn.curves) <= TELLABLE
    looks = [drawn.looks[name] for name in names] if few else _looks(len(names))
    largest, handles = 1.0, list[Any]()
    for name, (color, dashes) in zip(names, looks, strict=True):
        c = compared[name]
        share = np.where(np.isfinite(c.share), c.share, np.nan)
        handles += axis.plot(
            c.time, share, color=color, linestyle=dashes, linewidth=1.2,
            marker="o" if c.time.size < 3 else "", label=clipped(name),
        )  # fmt: skip
        largest = max(largest, float(np.nanmax(np.abs(share), initial=0.0)))
    if largest > 10.0:
        axis.set_yscale("symlog", linthresh=1.0)
    else:
        style.plain_ticks(axis.yaxis)
    axis.set_ylim(-1.15 * largest, 1.15 * largest)
    _legend(axis, handles)


def _across(axes: Sequence[Axes], drawn: Drawn) -> None:
    """The common horizontal axis, and the marks of events on it."""
    last = axes[-1]
    if drawn.over_time:
        last.set_xlabel(titled(drawn.x.channel.quantity, drawn.x.channel.unit))
    else:
        channel = drawn.x.channel
        last.set_xlabel(
            f"{clipped(channel.name)}: {titled(channel.quantity or 'value', channel.unit)}"
        )
        if len(axes) == 1 and _is_path(drawn):
            last.set_aspect("equal", adjustable="datalim")
    style.plain_ticks(last.xaxis)
    if not drawn.over_time:
        return
    for axis in axes:
        for event in drawn.events:
            axis.axvline(event.time, color=style.MUTED, linewidth=0.8, linestyle=(0, (2, 2)))
    if drawn.events:
        axes[0].set_title(axes[0].get_title(loc="left"), pad=18)
    for time, numbers in _numbered(drawn.events[:MARKED], last.get_xlim()):
        axes[0].annotate(
            f"({numbers})", (time, 1.0), (0, 2), xycoords=("data", "axes fraction"),
            textcoords="offset points", ha="center", va="bottom", fontsize=8, color=style.DARK,
        )  # fmt: skip


def _numbered(events: Sequence[Event], limits: tuple[float, float]) -> Iterator[tuple[float, str]]:
    """Times and numbers of events; those that are close to one another share a mark."""
    close = CLOSE * (limits[1] - limits[0])
    groups: list[list[int]] = []
    for k, event in enumerate(events):
        if groups and event.time - events[groups[-1][-1]].time < close:
            groups[-1].append(k)
        else:
            groups.append([k])
    for group in groups:
        middle = sum(events[k].time for k in group) / len(group)
        yield middle, ", ".join(str(k + 1) for k in group)


def _is_path(drawn: Drawn) -> bool:
    """Whether both axes are lengths of the same kind."""
    first = drawn.curves[0].channel
    across = drawn.x.channel
    return (first.quantity, first.unit) == (across.quantity, across.unit) != ("", "")
