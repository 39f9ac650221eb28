"""Files of ADAMS that OUTPUT/REQSAVE and RESULTS/XRF request, in a deck or as commands."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from typing import TYPE_CHECKING

from adamslite.language.statement import Statement

if TYPE_CHECKING:
    from adamslite.deck.deck import Deck
    from adamslite.deck.redefinition import Command
    from adamslite.elements.passed_over import InertStatement

ALL_DECIMALS = 17


@dataclass(frozen=True)
class AdamsOptions:
    """What is written, and how.

    ``requests``, ``results``: whether the files .req and .res are; ``decimals``: digits after the
    point in the latter; ``without``: words like ``NOVELOCITIES``; ``comment``: a remark.
    """

    requests: bool = False
    results: bool = False
    decimals: int = ALL_DECIMALS
    without: frozenset[str] = frozenset()
    comment: str = ""


def adams_options(deck: Deck, commands: Iterable[Command] = ()) -> AdamsOptions:
    """What OUTPUT and RESULTS say; a later value wins over an earlier one."""
    found: dict[str, dict[str, str]] = {"OUTPUT": {}, "RESULTS": {}}
    for each in (*deck.statements, *commands):
        if each.keyword in found and isinstance(each, Statement):
            written: InertStatement = each  # type: ignore[assignment]
            found[each.keyword] |= written.words
    words = found["RESULTS"]
    places = words.get("DECIMALPLACES", "")
    return AdamsOptions(
        requests="REQSAVE" in found["OUTPUT"],
        results="XRF" in words,
        decimals=int(places) if places.isdecimal() else ALL_DECIMALS,
        without=frozenset(word for word in words if word.startswith("NO")),
        comment=words.get("COMMENT", ""),
    )
