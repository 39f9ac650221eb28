"""Statements that others bring with them, as many as a deck has room for.

The points of a CONTACT are those of every shape with every other one, the states of a GSE are a
number: without a bound a line of text could fill the memory.
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING, NamedTuple

if TYPE_CHECKING:
    from adamslite.language.interfaces import Lookup
    from adamslite.language.statement import Statement

MOST = 100_000
"""Statements that all others of a deck may bring."""

Group = tuple["Statement", tuple["Statement", ...]]


class Brought(NamedTuple):
    """Each statement with those it brings, and the statements that would bring too many: these
    bring none.
    """

    groups: list[Group]
    refused: list[Statement]


def brought_by(statements: Iterable[Statement], deck: Lookup) -> Brought:
    """What statements bring; ``bringing`` of a class tells how much that is before it is made."""
    found, left = Brought([], []), MOST
    for each in statements:
        count = getattr(each, "bringing", _nothing)(deck)
        if count > left:
            found.refused.append(each)
            found.groups.append((each, ()))
            continue
        left -= count
        found.groups.append((each, each.companions(deck)))
    return found


def _nothing(deck: Lookup) -> int:
    """Of most statements, which bring a few at most."""
    return 0
