"""The size of a run before it begins: rows, columns, memory and disk.

With n rows, c columns and w numbers in a record (workspace and outputs), a run takes at its height

    8 n (w + m + 5)     byte: the record, what is made of it; times

m is 2 c: columns, and what is found of them, or all in one table; those of several analyses that
are kept, where these are some of all, besides.  Of columns that are a part of the record, those of
point masses alone, m is c for several analyses and none for one, and those that are kept.  Sensors
end one of k analyses early, with another record: (w + c) / k more.  Where rows are kept in a file
none of them is in memory but times, unless a page is drawn or the run is confirmed.
A file takes 8 n (c + 1) byte at least, and as much again while rows are kept in a file.
Numbers that use all their digits take 19 as text, those that are zero 4.
"""

from __future__ import annotations

from pathlib import Path
from typing import NamedTuple

from adamslite.errors import NoRoom
from adamslite.machine import free_disk, free_memory
from adamslite.results.formats import format_of

NUMBER, OF_TIME = 8, 5
GIGA = 1e9
TOO_LARGE = (
    "The results would have {rows} rows of {columns} columns, which take {need:.3g} GB of {what}, "
    "and {free:.3g} GB are free{where}: {remedy}."
)
FEWER = "fewer STEPS, a longer DTOUT"
IN_FILES = f"{FEWER}, or without --page and --confirm, which need all rows in memory"
ELSEWHERE = "fewer columns (--outputs), or another disk"


class Rows(NamedTuple):
    """The rows of a run: how many; their columns, the numbers of a record, and how many are made of
    these; whether they are kept in a file while the run lasts, and how often they are all in memory
    when it has ended; how many files have them.
    """

    number: int
    columns: int
    record: int
    made: int
    filed: bool
    tables: int = 0
    files: int = 1


def require_room(rows: Rows, kept: int, file: Path | None) -> None:
    """Reject a run whose results there is no room for.

    Parameters
    ----------
    rows : Rows
    kept : int
        Of the columns, those that are written.
    file : Path or None
        Where the results will be written.

    Raises
    ------
    NoRoom
        With what would be needed, what there is, and what to do.
    UsageError
        When the format does not hold so many.
    """
    if file is not None and (fits := format_of(file).need_room):
        fits(rows.number, kept)
    own = 0 if rows.filed else rows.record + rows.made
    memory = NUMBER * rows.number * (own + rows.tables * rows.columns + OF_TIME)
    remedy = IN_FILES if rows.tables else FEWER
    _need("memory", memory, free_memory(), rows, rows.columns, "", remedy)
    if file is not None:
        disk = NUMBER * rows.number * (rows.files * (kept + 1) + rows.filed * (rows.columns + 1))
        folder = file.resolve().parent
        where = f" in {folder}"
        _need("disk", disk, free_disk(folder), rows, kept, where, f"{FEWER}, {ELSEWHERE}")


def _need(
    what: str, need: int, free: int | None, rows: Rows, columns: int, where: str, remedy: str
) -> None:
    if free is None or need <= free:
        return
    raise NoRoom(
        TOO_LARGE.format(
            rows=rows.number, columns=columns, need=need / GIGA, what=what, free=free / GIGA,
            where=where, remedy=remedy,
        )
    )  # fmt: skip
