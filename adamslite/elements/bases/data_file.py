"""Tables in files: comma-separated numbers beside the deck.

    # comments
    time, SFORCE/1.f, road        names of the columns; the row may be missing
    0.0, 12.5, 0.01               x, then one channel for each further column
    0.1, 12.7, 0.02

Files that ``adamslite solve -o NAME.csv`` writes are such tables.
"""

from __future__ import annotations

import csv
from collections.abc import Iterable
from contextlib import suppress
from functools import lru_cache
from pathlib import Path

from adamslite.language.file_name import inside
from adamslite.language.text import contents, text_of

Column = tuple[float, ...]
SUFFIX = ".csv"
# How many column names a message lists.
LISTED = 6
#: Of every file, what it was when it was read last.
_seen: dict[Path, tuple[int, int]] = {}


class UnusableFile(Exception):
    """A file that gives no points; its text is the reason."""


def columns(folder: Path, name: str) -> tuple[Column, ...]:
    """All columns of the file ``name`` in ``folder`` or below."""
    return _read(located(folder, name))[1]


def points(
    folder: Path, name: str, channel: int | None, block: str | None
) -> tuple[Column, Column]:
    """x and one channel of the file ``name`` in ``folder`` or below.

    ``channel``: its number, from 1; ``block``: its name.  Without both it must be the only one.
    """
    names, columns = _read(located(folder, name))
    return columns[0], columns[_number(names, len(columns), channel, block)]


def located(folder: Path, name: str) -> Path:
    """The file, which is never outside of the folder, by links neither, unless the user has opened
    another one.

    Raises
    ------
    UnusableFile
    """
    try:
        path = inside(folder, name)
        there = path is not None and path.is_file()
    except (OSError, ValueError, RuntimeError):  # a link to itself
        raise UnusableFile("that is no name of a file") from None
    if path is None:
        raise UnusableFile(
            "it is not in the folder of the deck or below, nor in one that --allow-path opens"
        )
    if path.suffix.lower() != SUFFIX:
        raise UnusableFile(f"only tables {SUFFIX} can be read")
    if not there:
        raise UnusableFile("there is no such file")
    return path


def is_as_read(path: Path) -> bool:
    """Whether a file is still the one that this process has taken its numbers from, if it has."""
    try:
        return _seen.get(path) in (None, _facts(path))
    except OSError:
        return False


def tables(folder: Path, names: Iterable[str]) -> dict[str, Path]:
    """The files among some names that can be read."""
    found = {}
    for name in names:
        with suppress(UnusableFile):
            found[name] = located(folder, name)
    return found


def _read(path: Path) -> tuple[tuple[str, ...], tuple[Column, ...]]:
    """Names and columns of a file as it is now."""
    facts = _seen[path] = _facts(path)
    return _table(path, *facts)


def _facts(path: Path) -> tuple[int, int]:
    """What changes with the content of a file."""
    found = path.stat()
    return found.st_mtime_ns, found.st_size


@lru_cache(maxsize=4)
def _table(path: Path, time: int, size: int) -> tuple[tuple[str, ...], tuple[Column, ...]]:
    """Names and columns of a file; ``time`` and ``size`` tell that it has changed."""
    try:
        lines = text_of(contents(path).decode("utf-8-sig")).splitlines()
    except OSError as fault:
        raise UnusableFile(f"it cannot be read: {fault.strerror}") from None
    except UnicodeDecodeError as fault:
        raise UnusableFile(f"it cannot be read: {fault}") from None
    written = [(n, line) for n, line in enumerate(lines, 1) if line.strip() and line[0] != "#"]
    if not written:
        raise UnusableFile("it is empty")
    try:
        first = [cell.strip() for cell in next(csv.reader([written[0][1]]))]
    except csv.Error as fault:
        raise UnusableFile(f"it cannot be read: {fault}") from None
    names = () if _is_number(first[0]) else tuple(first)
    rows = [_row(line, number, len(first)) for number, line in written[bool(names) :]]
    return names, tuple(zip(*rows, strict=True)) or ((),) * len(first)


def _is_number(cell: str) -> bool:
    try:
        float(cell)
    except ValueError:
        return False
    return True


def _row(line: str, number: int, width: int) -> list[float]:
    cells = line.split(",")
    if len(cells) != width:
        raise UnusableFile(f"line {number} has {len(cells)} columns, those before it {width}")
    try:
        return [float(cell) for cell in cells]
    except ValueError:
        wrong = next(cell for cell in cells if not _is_number(cell))
        raise UnusableFile(f"line {number}: {wrong.strip()!r} is not a number") from None


def _number(names: tuple[str, ...], width: int, channel: int | None, block: str | None) -> int:
    """Which column is meant; 0 is x."""
    listed = ", ".join(names[1 : 1 + LISTED]) + (", ..." if width > 1 + LISTED else "")
    if block is not None:
        wanted = block.casefold()
        found = [n for n, name in enumerate(names) if n and name.casefold() == wanted]
        if not found:
            raise UnusableFile(f"it has no column {block}; its columns are {listed}")
        return found[0]
    if channel is None and width != 2:
        raise UnusableFile(f"name one of its columns by BLOCK or CHANNEL: {listed or width - 1}")
    if channel is not None and not 1 <= channel < width:
        raise UnusableFile(f"it has no channel {channel}, but 1 to {width - 1}")
    return channel or 1
