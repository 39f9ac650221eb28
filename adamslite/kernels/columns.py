"""Columns: what many statements of one class have at the same place."""

from __future__ import annotations

from collections.abc import Hashable, Sequence
from operator import eq, itemgetter
from typing import Any


class Split(Exception):
    """Statements that are not of one shape; ``labels`` are equal for those that may be."""

    def __init__(self, labels: Sequence[Hashable]) -> None:
        super().__init__(labels)
        self.labels = labels


LARGEST = 20_000
"""Operations of one statement with all that is written out in it; compiling more than that takes
half a minute and gigabytes.
"""
MOST_IN_ALL = 1_000_000
"""Operations of all shapes of a deck."""


class TooLarge(Exception):
    """Expressions of more than ``most`` operations; ``variables``: ids of VARIABLEs that are
    written out in the first of them; ``number``: of the statement in a bundle.
    """

    number = 0

    def __init__(self, most: int, variables: Sequence[int | str]) -> None:
        super().__init__(most)
        self.most, self.variables = most, variables


def same(values: Sequence[Any]) -> Any:
    """The value that all have in common; raises :class:`Split`."""
    first = values[0]
    if len(values) > 1 and values.count(first) < len(values):
        raise Split(values)
    return first


def transposed(rows: Sequence[Sequence[Any]]) -> list[list[Any]]:
    """Columns of rows of equal length."""
    width = same([*map(len, rows)])
    return [[*map(itemgetter(number), rows)] for number in range(width)]


def slot(columns: list[Any], values: Sequence[Any]) -> int:
    """The column with these values; a new one where there is none."""
    values = [*values]
    if values in columns:
        return columns.index(values)
    for column in columns if len(values) > 1 else ():
        same([*map(eq, column, values)])  # equal here and there: not of one shape
    columns.append(values)
    return len(columns) - 1
