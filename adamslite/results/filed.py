"""Results whose rows are in a file, because there may be more of them than memory has room for."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any, Protocol

import numpy as np

from adamslite.results.results import Results


class Rows(Protocol):
    """A table that is read some rows at a time."""

    @property
    def names(self) -> tuple[str, ...]:
        """Names of the columns."""

    @property
    def count(self) -> int:
        """How many rows there are."""

    def parts(self, size: int, first: int = 0) -> Iterator[tuple[np.ndarray, np.ndarray]]:
        """Times and values of so many rows after the other, from one of them on."""


class FiledResults(Results):
    """Results of rows in a file, and of some ``columns`` of them where these are given.

    ``time`` and ``values`` are read when they are first asked for, and stay in memory.
    """

    def __new__(cls, rows: Rows | None = None, *_: Any, **facts: Any) -> Any:
        """Plain results where no rows are given: a changed copy of these."""
        return Results(**facts) if rows is None else super().__new__(cls)

    def __init__(self, rows: Rows, columns: Sequence[int] | None = None, **facts: Any) -> None:
        own = rows.names
        chosen = range(len(own)) if columns is None else columns
        names = tuple(own[k] for k in chosen)
        super().__init__(time=np.zeros(0), names=names, values=np.zeros((0, len(names))), **facts)
        hidden = self.__dict__
        hidden.update(_rows=rows, _columns=None if columns is None else list(columns), _facts=facts)
        del hidden["time"], hidden["values"]

    def __getattr__(self, name: str) -> Any:
        if name not in ("time", "values"):
            raise AttributeError(name)
        found = list(self.parts(max(1, self.count)))
        time, values = found[0] if found else (np.zeros(0), np.zeros((0, len(self.names))))
        self.__dict__.update(time=time, values=values)
        return self.__dict__[name]

    def __reduce__(self) -> tuple[Any, ...]:
        facts = {name: getattr(self, name) for name in ("time", "names", "values")}
        return _plain, ({**facts, **self._facts},)

    @property
    def count(self) -> int:
        """How many output times there are."""
        return int(self._rows.count)

    @property
    def shape(self) -> tuple[int, ...]:
        """Rows and columns of the values."""
        return self.count, len(self.names)

    def parts(self, size: int, first: int = 0) -> Iterator[tuple[np.ndarray, np.ndarray]]:
        """Times and values of so many rows after the other, from one of them on."""
        for time, values in self._rows.parts(size, first):
            yield time, values if self._columns is None else values[:, self._columns]

    def limited(self, columns: list[int]) -> Results:
        """The results with some of the columns alone, which stay in the file."""
        own = columns if self._columns is None else [self._columns[k] for k in columns]
        return FiledResults(self._rows, own, **self._facts)


def _plain(facts: dict[str, Any]) -> Results:
    return Results(**facts)
