"""Files that are written row by row, and so can be written while their run lasts.

A :class:`Layout` says what stands before the rows, what they are, and what stands behind them.
Where a table is long, what stands before the rows is as long whatever the run comes to, so that it
is written anew in its place when the run has ended: then nothing is left to do but some rows, and
a run that is interrupted is over at once, however many rows it has.  A file is the same to the byte
whether it has grown or was written at the end.
"""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator, Sequence
from contextlib import ExitStack, suppress
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple, TypeAlias

import numpy as np

from adamslite.errors import UsageError
from adamslite.outputs.whole_files import whole_file

if TYPE_CHECKING:
    from adamslite.results.filed import Rows
    from adamslite.results.results import Results

#: A file of more numbers is a long one.
LONG = 2**18
#: Numbers that are written at once while a run lasts, and read at once for it.
SLICE, BLOCK = 2**16, 2**20
#: Bytes that the disk is asked to take while the run goes on, so that none wait for its end.
SENT = 2**23


#: Of the rows before: the time of the first, and whether any has another one; None without any.
Before: TypeAlias = tuple[float, bool] | None
#: Writes times (n,) and values (n, nc).
Writer: TypeAlias = Callable[[np.ndarray, np.ndarray, Before], Iterator[bytes]]


class Layout(NamedTuple):
    """A format as functions.

    ``head(results, long)`` is what stands before the rows, ``tail(results, long)`` what stands
    behind them; ``rows(results)`` writes them.
    """

    head: Callable[[Results, bool], bytes]
    rows: Callable[[Results], Writer]
    tail: Callable[[Results, bool], bytes]


def is_long(results: Results) -> bool:
    """Whether a file of these results is a long one."""
    return results.count * (len(results.names) + 1) > LONG


def pieces(layout: Layout, results: Results, long: bool) -> Iterator[bytes]:
    """All that a file of results holds, in its order."""
    yield layout.head(results, long)
    yield from _rows(layout.rows(results), results.blocks(), None)
    yield layout.tail(results, long)


def _rows(
    write: Writer, blocks: Iterator[tuple[np.ndarray, np.ndarray]], before: Before
) -> Iterator[bytes]:
    for time, values in blocks:
        yield from write(time, values, before)
        before = _behind(time, before)


def _behind(time: np.ndarray, before: Before) -> Before:
    """What is before the next row."""
    start, moved = before or (float(time[0]), False)
    return start, moved or bool((time != start).any())


def write(layout: Layout, results: Results, path: str | Path) -> None:
    """Write results to the file `path`, whole or not at all."""
    found = pieces(layout, results, is_long(results))
    head = next(found)  # what it takes is loaded before there is a draft
    with whole_file(path, binary=True) as stream:
        stream.write(head)
        stream.writelines(found)


class _Written(NamedTuple):
    """Rows that are written, the bytes to their end, and what is before the next row."""

    rows: int
    end: int
    before: Before


class _GivenUp(Exception):
    """A file that is not wanted any more."""


class Growing:
    """A file of results that is written while their run lasts.

    Parameters
    ----------
    path : Path
        It changes when the file is finished.
    patterns : sequence of str
        Of the columns that are written; all are without.
    """

    _names: tuple[str, ...] | None
    _chosen: list[int] | None
    _sent: int

    def __init__(self, path: Path, patterns: Sequence[str] = ()) -> None:
        self.path, self.patterns = path, patterns
        #: What is known of the results before the first row, by the names of their columns.
        self.begun: Callable[[tuple[str, ...]], Results] | None = None
        self._draft: ExitStack | None = None
        self._forget()

    @property
    def count(self) -> int:
        """How many rows are written."""
        raise NotImplementedError

    def follow(self, rows: Rows) -> None:
        """Write further rows, where they are many enough."""
        if self.begun is None:
            return
        count, names = rows.count, rows.names
        if names != self._names:
            self._forget()
            self._chosen = self._columns(names)
            self._names = names
        width = 1 + len(names if self._chosen is None else self._chosen)
        if count * width <= LONG or (count - self.count) * width < SLICE:
            return
        try:
            self._follow(rows)
        except (OSError, MemoryError, UsageError):  # all will be written, or reported, at the end
            self.close()

    def back_to(self, count: int) -> None:
        """Rows from this one on have been taken back."""
        raise NotImplementedError

    def finish(self, results: Results) -> bool:
        """Write the rest; False when the file has to be written as a whole, as it has not grown, or
        the results are not as they were begun.
        """
        raise NotImplementedError

    def close(self) -> None:
        """Give up what there is of it."""
        self.begun = None
        self._drop()

    def _forget(self) -> None:
        """Rows have other columns."""
        self._names, self._chosen, self._sent = None, None, 0

    def _follow(self, rows: Rows) -> None:
        raise NotImplementedError

    def _drop(self) -> None:
        draft, self._draft = self._draft, None
        if draft:
            with suppress(OSError, _GivenUp), draft:
                raise _GivenUp

    def _open(self) -> None:
        """A draft, which takes the place of the file when it is finished."""
        draft, self._sent = ExitStack(), 0
        self._stream = draft.enter_context(whole_file(self.path, binary=True))
        self._draft = draft

    def _columns(self, names: tuple[str, ...]) -> list[int] | None:
        """The columns that are written; None for all."""
        if not self.patterns:
            return None
        from adamslite.results.selection import meant

        return meant(names, self.patterns)

    def _own_names(self) -> tuple[str, ...]:
        names = self._names or ()
        return names if self._chosen is None else tuple(names[k] for k in self._chosen)

    def _own(self, values: np.ndarray) -> np.ndarray:
        return values if self._chosen is None else values[:, self._chosen]

    def _send(self, end: int) -> None:
        """Have the disk take what is written up to there, without waiting for it."""
        if end - self._sent >= SENT and hasattr(os, "posix_fadvise"):
            self._stream.flush()
            with suppress(OSError):  # it is no more than a wish
                os.posix_fadvise(self._stream.fileno(), self._sent, 0, os.POSIX_FADV_DONTNEED)
            self._sent = end


class GrowingFile(Growing):
    """One that is written row by row, as a layout has it."""

    def __init__(self, layout: Layout, path: Path, patterns: Sequence[str] = ()) -> None:
        super().__init__(path, patterns)
        self.layout = layout

    def _forget(self) -> None:
        super()._forget()
        self._written = [_Written(0, 0, None)]
        self._writer: Writer | None = None

    @property
    def count(self) -> int:
        return self._written[-1].rows

    def back_to(self, count: int) -> None:
        while self.count > count:
            self._written.pop()

    def finish(self, results: Results) -> bool:
        head = self.layout.head(results, True) if self._draft and is_long(results) else b""
        own, last = (self._own_names(), self._written[0].end), self._written[-1]
        as_begun = (results.names, len(head)) == own and results.count >= last.rows
        if not self._draft or not head or not as_begun:
            self.close()
            return False
        draft, self._draft = self._draft, None
        stream, rest = self._stream, results.blocks(last.rows)
        with draft:
            stream.seek(last.end)
            stream.writelines(_rows(self.layout.rows(results), rest, last.before))
            stream.write(self.layout.tail(results, True))
            stream.truncate()
            stream.seek(0)
            stream.write(head)
        return True

    def _follow(self, rows: Rows) -> None:
        head = self._begin() if not self.count else b""
        if self._draft is None:
            self._open()
        if head:
            self._stream.seek(0)
            self._stream.write(head)
            self._written = [_Written(0, len(head), None)]
        self._stream.seek(self._written[-1].end)
        write = self._writer
        assert write is not None
        for time, values in rows.parts(max(1, BLOCK // max(1, len(rows.names))), self.count):
            before, count = self._written[-1].before, self.count + len(time)
            self._stream.writelines(write(time, self._own(values), before))
            end, before = self._stream.tell(), _behind(time, before)
            self._written.append(_Written(count, end, before))
            self._send(end)

    def _begin(self) -> bytes:
        """What stands before the rows, by what is known now; who writes these is kept, as it may
        take a while to be made.
        """
        assert self.begun is not None
        results = self.begun(self._own_names())
        head, self._writer = self.layout.head(results, True), self.layout.rows(results)
        return head
