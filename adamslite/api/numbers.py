"""The numbers of a deck by name: a table of them, and the deck or kernels with others."""

from __future__ import annotations

import os
from collections.abc import Iterable
from fnmatch import fnmatchcase
from pathlib import Path
from typing import TYPE_CHECKING, overload

from adamslite.api.inputs import User
from adamslite.deck.deck import Deck
from adamslite.errors import UsageError
from adamslite.reading.numbers import Given, Named, numbers_of
from adamslite.reading.read import read
from adamslite.variation import decks

if TYPE_CHECKING:  # numpy is not needed to list names
    from adamslite.kernels.groups import Kernels

HEAD = ("name", "value", "unit", "place")


class NumberTable(list[Named]):
    """Numbers of a deck in its order; as text what `adamslite names` prints."""

    def __init__(self, numbers: Iterable[Named], short: dict[str, str]) -> None:
        super().__init__(numbers)
        self.short = short
        """Names of VARIABLEs that are one number, by the full name."""

    def __str__(self) -> str:
        rows = [HEAD, *map(self._row, self)]
        widths = [max(map(len, column)) for column in zip(*rows, strict=True)]
        lines = ("  ".join(map(str.ljust, row, widths)).rstrip() for row in rows)
        return "".join(f"{line}\n" for line in lines)

    def __repr__(self) -> str:
        return str(self).rstrip()

    def _row(self, number: Named) -> tuple[str, ...]:
        source = number.statement.spans.source
        written = source.text[number.start : number.end] if source else f"{number.value:.17g}"
        where = str(source.span(number.start, number.end)) if source else ""
        name = self.short.get(number.name, number.name)
        unit = "degrees" if number.unit else number.argument.unit
        return name, written.removesuffix(number.unit), unit, where


@overload
def with_values(subject: Deck, values: Given) -> Deck: ...
@overload
def with_values(subject: Kernels, values: Given) -> Kernels: ...
def with_values(subject: Deck | Kernels, values: Given) -> Deck | Kernels:
    """A deck or kernels with other numbers: what ``subject.with_values(values)`` is.

    Parameters
    ----------
    subject : Deck or Kernels
    values : mapping or iterable of str
        ``{"SPRINGDAMPER/1.K": 90}``, or ``"SPRINGDAMPER/1.K=90"``; :func:`adamslite.names` lists
        the names.

    Raises
    ------
    DeckError
        With the mistakes that the deck then has.
    UsageError
        When there is no number of a name, or a value is no finite number.
    """
    if isinstance(subject, Deck):
        return decks.with_values(subject, values)
    from adamslite.variation import kernels

    return kernels.with_values(subject, values)


def names(
    deck: Deck | str | os.PathLike[str], patterns: Iterable[str] = (), user: User = None
) -> NumberTable:
    """The numbers of a deck, by the names that ``values`` of :func:`adamslite.read` takes.

    Parameters
    ----------
    deck : str, Path or Deck
        A file, a text of more than one line, or a deck that has been read.
    patterns : iterable of str
        Only names that fit one, as ``PART/2.*``; ``L_0`` is that of a VARIABLE.
    user
        As for :func:`adamslite.read`.

    Raises
    ------
    DeckError
        When the deck has mistakes.
    UsageError
        When no name fits a pattern.
    """
    if not isinstance(deck, Deck):
        # Not by the reading that notes places: of a deck with mistakes nothing is listed.
        deck = read(deck if isinstance(deck, str) else Path(deck), user)
    found = numbers_of(deck.source, deck.path, deck.user)
    short = {each.name: str(each.statement.id) for each in found.parameters.values()}
    table = NumberTable(found.named.values(), {k: v for k, v in short.items() if not v.isdigit()})
    wanted = [patterns] if isinstance(patterns, str) else [*patterns]
    for pattern in wanted:
        if not any(_fits(each, table, [pattern]) for each in table):
            raise UsageError(f"no number has a name like {pattern}")
    return NumberTable((e for e in table if not wanted or _fits(e, table, wanted)), table.short)


def _fits(number: Named, table: NumberTable, patterns: Iterable[str]) -> bool:
    own = {number.name, number.name.rpartition(".")[2].partition("[")[0]}
    own |= {number.name.rpartition(".")[0], table.short.get(number.name, "")}
    return any(fnmatchcase(name.upper(), each.upper()) for name in own for each in patterns)
