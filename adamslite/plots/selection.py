"""Which channels of results a plot shows, and on which of its axes."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from textwrap import shorten

import numpy as np

from adamslite.results.channels import Channel, statement_of
from adamslite.results.comparison import fits
from adamslite.results.results import Results

#: More axes than this are too many for channels whose quantity is not known to have their own.
MANY = 8
DEFINITION = 40


@dataclass(frozen=True, eq=False)
class Curve:
    """A channel, and its values (nt,) with not-a-number in place of infinity."""

    channel: Channel
    values: np.ndarray
    definition: str = ""

    @property
    def label(self) -> str:
        """For a legend: the column, with its name or definition in the deck below it."""
        words = self.definition or self.channel.title
        return f"{self.channel.name}\n{words}" if words else self.channel.name


@dataclass(frozen=True)
class Panel:
    """The curves of one axis, which share quantity and unit."""

    curves: tuple[Curve, ...]

    @property
    def title(self) -> str:
        """Quantity and unit, or the statement where no quantity is known."""
        first = self.curves[0].channel
        if first.quantity:
            return titled(first.quantity, first.unit)
        names = list(dict.fromkeys(curve.channel.statement for curve in self.curves))
        return titled(names[0] if len(names) == 1 else "values", first.unit)


def titled(words: str, unit: str) -> str:
    """A quantity with its unit in brackets."""
    return f"{words} [{pretty(unit)}]" if unit else words


def pretty(unit: str) -> str:
    """``m/s^2`` with a raised two."""
    return unit.replace("^2", "\N{SUPERSCRIPT TWO}")


def select(results: Results, patterns: Iterable[str]) -> list[str]:
    """The columns that names or patterns (``PART/2.*``) mean, each once, in the order of these.

    Raises
    ------
    UnknownChannel
        When one of them means no column; says which names are near.
    """
    found: dict[str, None] = {}
    for pattern in patterns:
        mine = [name for name in results.names if fits(pattern, name)]
        if not mine:
            mine = [results.channel(pattern).name]
        found |= dict.fromkeys(mine)
    return list(found)


def curve(results: Results, name: str) -> Curve:
    """The curve of a column, or of "time"."""
    values = np.array(results[name], dtype=float)
    values[~np.isfinite(values)] = np.nan
    channel = results.channel(name)
    return Curve(channel, values, definition(results, channel))


def definition(results: Results, channel: Channel) -> str:
    """The expression of a component of a REQUEST as the deck has it, if the deck is at hand."""
    request = statement_of(channel.statement, results.deck) if results.deck else None
    if request is None or request.keyword != "REQUEST":
        return ""
    _, _, text = request.spans.text(channel.component.lower()).partition("=")
    text = " ".join(text.split())
    return shorten(f"= {text}", DEFINITION, placeholder=" ...") if text else ""


def panels(curves: Sequence[Curve]) -> list[Panel]:
    """Curves by axis: those of one quantity share one, in the order of their first.

    Where no quantity is known a statement has an axis of its own, or, with many axes, all of them
    share one.
    """
    own = len({_axis(each.channel, True) for each in curves}) <= MANY
    found: dict[tuple[str, str, str], list[Curve]] = {}
    for each in curves:
        found.setdefault(_axis(each.channel, own), []).append(each)
    return [Panel(tuple(mine)) for mine in found.values()]


def _axis(channel: Channel, own: bool) -> tuple[str, str, str]:
    statement = channel.statement if own and not channel.quantity else ""
    return channel.quantity, channel.unit, statement


def summary(curves: Sequence[Curve]) -> str:
    """What curves show, in a few words: ``PART/2: position and velocity``."""
    channels = [each.channel for each in curves]
    if len(channels) == 1:
        return channels[0].long_name
    statements = list(dict.fromkeys(each.statement for each in channels))
    quantities = list(dict.fromkeys(each.quantity for each in channels if each.quantity))
    components = list(dict.fromkeys(each.component for each in channels if each.component))
    what = listed(quantities)
    if len(components) <= 3:
        what = f"{what} {listed(components)}".strip()
    return f"{listed(statements)}: {what}" if what else listed(statements)


def listed(words: Sequence[str]) -> str:
    """``a``, ``a and b``, ``a, b and c``, or of many the first and the last."""
    if len(words) > 4:
        return f"{words[0]} ... {words[-1]} ({len(words)})"
    head, last = words[:-1], words[-1:]
    return " and ".join(filter(None, (", ".join(head), *last)))
