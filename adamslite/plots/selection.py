"""Which channels of results a plot shows, and on which of its axes."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from textwrap import shorten

import numpy as np

from adamslite.results.channels import Channel, statement_of
from adamslite.results.results import Results, UnknownChannel
from adamslite.results.selection import means, near

#: More axes than this are too many for channels whose quantity is not known to have their own.
MANY = 8
#: Characters of a name or an expression in a legend.
LONGEST, DEFINITION = 32, 40


@dataclass(frozen=True, eq=False)
class Curve:
    """A channel, and its values (nt,) with not-a-number in place of infinity."""

    channel: Channel
    values: np.ndarray
    definition: str = ""

    @property
    def label(self) -> str:
        """For a legend: the column, below it its name and its definition in the deck."""
        lines = (clipped(self.channel.name), clipped(self.channel.title), self.definition)
        return "\n".join(filter(None, lines))


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
        return titled(clipped(names[0], 2 * LONGEST) if len(names) == 1 else "values", first.unit)


def titled(words: str, unit: str) -> str:
    """A quantity with its unit in brackets."""
    return f"{words} [{pretty(unit)}]" if unit else words


def pretty(unit: str) -> str:
    """``m/s^2`` with a raised two."""
    return unit.replace("^2", "\N{SUPERSCRIPT TWO}")


def clipped(text: str, longest: int = LONGEST) -> str:
    """A text whose middle is left out where it is too long."""
    half = (longest - 3) // 2
    return text if len(text) <= longest else f"{text[:half]}...{text[-half:]}"


def select(results: Results, patterns: Iterable[str]) -> list[str]:
    """The columns that names, patterns (``PART/2.v?``) or statements mean, once, in their order.

    Raises
    ------
    UnknownChannel
        When one of them means no column; says which names are near.
    """
    found: dict[str, None] = {}
    for pattern in patterns:
        mine = [name for name in results.names if means(pattern, name)]
        if not mine:
            raise UnknownChannel(f"no result is called '{pattern}'{near(pattern, results.names)}")
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
    """What curves show, in a few words: ``PART/2: position x and velocity vx``."""
    channels = [each.channel for each in curves]
    if len(channels) == 1:
        return clipped(channels[0].long_name, 3 * LONGEST)
    contents: dict[str, list[Channel]] = {}
    for each in channels:
        contents.setdefault(each.statement, []).append(each)
    texts = {label: _content(mine) for label, mine in contents.items()}
    if len(set(texts.values())) == 1:
        what = next(iter(texts.values()))
        return f"{listed(list(texts))}: {what}" if what else listed(list(texts))
    if len(texts) <= 2:
        named = {label: _with_title(label, contents[label]) for label in texts}
        return ", ".join(
            f"{named[label]}: {what}" if what else named[label] for label, what in texts.items()
        )
    quantities = list(dict.fromkeys(each.quantity for each in channels if each.quantity))
    what = listed(quantities) if len(quantities) <= 4 else f"{len(quantities)} quantities"
    return f"{listed(list(texts))}: {what}" if what else listed(list(texts))


def _with_title(label: str, channels: Sequence[Channel]) -> str:
    """A statement with the name that the deck gives to all of its channels."""
    titles = {each.title for each in channels}
    title = titles.pop() if len(titles) == 1 else ""
    return f"{label} ({clipped(title)})" if title else label


def _content(channels: Sequence[Channel]) -> str:
    """Quantities of one statement, each with its components unless these are all three."""
    found: dict[str, list[str]] = {}
    for each in channels:
        found.setdefault(each.quantity, []).append(each.component)
    texts = []
    for quantity, components in found.items():
        named = "" if quantity and len(components) == 3 else listed(list(filter(None, components)))
        texts.append(f"{quantity} {named}".strip())
    nested = any(" and " in text for text in texts)
    return ", ".join(filter(None, texts)) if nested else listed(list(filter(None, texts)))


def listed(words: Sequence[str]) -> str:
    """``a``, ``a and b``, ``a, b and c``, or of many the first and the last."""
    words = [clipped(word) for word in words]
    if len(words) > 4:
        return f"{words[0]} ... {words[-1]} ({len(words)})"
    head, last = words[:-1], words[-1:]
    return " and ".join(filter(None, (", ".join(head), *last)))


def without_numbers(curves: Sequence[Curve]) -> str:
    """A sentence about curves with gaps; empty when there are none."""
    gaps = [each for each in curves if np.isnan(each.values).any()]
    if not gaps:
        return ""
    first = gaps[0]
    missing, count = int(np.isnan(first.values).sum()), len(first.values)
    more = f", and {len(gaps) - 1} other channels have gaps" if len(gaps) > 1 else ""
    return f"{first.channel.name} is no number at {missing} of {count} output times{more}"
