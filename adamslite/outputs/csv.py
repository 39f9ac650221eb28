"""Comma-separated values: comment lines, one header row of result names, one row per output time.

    # adamslite 0.1.0
    # deck: cable.adm
    # units: meter kilogram newton second
    time,PART/2.x,PART/2.vx
    0.0,0.01,0.0

Numbers are written with the fewest digits (17 at most) that read back to the same bits,
so the same run gives the same bytes and nothing is lost. A table of more than 262 144 numbers is
written while its run lasts: comments that say what the run has found, and how it ended, then stand
behind the last row. The header of a table from elsewhere may name units behind names,
``time [ms],REQUEST/1.F2 [kN]``. With orjson (extra ``fast``) a long table is written about twice
as fast, in the same bytes.
"""

import csv
import io
import re
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import IO, Any

import numpy as np

import adamslite
from adamslite.errors import FormatError
from adamslite.language.text import contents, text_of
from adamslite.outputs import row_by_row
from adamslite.outputs.number_text import lines
from adamslite.results.formats import register_format
from adamslite.results.outcomes import Outcome
from adamslite.results.results import Results

SEPARATED = "; commas separate columns, and decimals have points"
#: Comments that are known before the first row.
EARLY = ("deck", "deck hash", "units", "integrator", "integrator chosen", "user")
#: A name with its unit behind it.
UNIT = re.compile(r"(.*\S)\s+\[([^\[\]]*)\]")


@dataclass(frozen=True)
class Table:
    """A file as read: its results, and its comment lines as (line number, text) pairs."""

    results: Results
    comments: tuple[tuple[int, str], ...]


def write(results: Results, path: str | Path) -> None:
    """Write `results` to the file `path`, whole or not at all."""
    row_by_row.write(LAYOUT, results, path)


def write_to(results: Results, stream: IO[str]) -> None:
    """Write `results` to an open text stream."""
    long = row_by_row.is_long(results)
    stream.writelines(piece.decode() for piece in row_by_row.pieces(LAYOUT, results, long))


def _head(results: Results, long: bool) -> bytes:
    """The comments that stand before the rows, and the names of the columns."""
    stream = io.StringIO()
    stream.write(f"# adamslite {adamslite.__version__}\n{_comments(results, long, True)}")
    header = csv.writer(stream, lineterminator="\n")
    header.writerow(["time", *results.names])
    return stream.getvalue().encode()


def _tail(results: Results, long: bool) -> bytes:
    return _comments(results, long, False).encode()


def _comments(results: Results, long: bool, early: bool) -> str:
    """Those before the rows or those behind them, which are what the run of a long table found."""
    found = {key: _one_line(value) for key, value in results.meta.items()}
    if results.outcome is not Outcome.DONE:
        found["outcome"] = f"{results.outcome.name} {_one_line(results.message)}"
    here = (key for key in found if (key in EARLY or not long) == early)
    return "".join(f"# {key}: {found[key]}\n" for key in here)


def _rows(results: Results) -> row_by_row.Writer:
    return lambda time, values, before: (each.encode() for each in lines(time[:, None], values))


LAYOUT = row_by_row.Layout(_head, _rows, _tail)


def read(path: str | Path) -> Results:
    """Read a result file; errors as for :func:`read_table`."""
    return read_table(path).results


def read_table(path: str | Path) -> Table:
    """Read a result file with its comment lines.

    Raises
    ------
    FormatError
        When a row has the wrong number of values or something that is not a number.
    """
    try:
        lines = text_of(contents(path).decode("utf-8-sig")).splitlines()
    except UnicodeDecodeError as fault:
        raise FormatError(f"{path} is not a table in UTF-8: {fault.reason}") from None
    comments, start = _leading_comments(lines)
    comments += _comments_behind(lines, start)
    meta = dict(_key_and_value(text) for _, text in comments if ": " in text)
    outcome, message = _ending(meta)
    run: dict[str, Any] = {"meta": meta, "outcome": outcome, "message": message}
    if start == len(lines):
        empty = Results(time=np.empty(0), names=(), values=np.empty((0, 0)), **run)
        return Table(empty, comments)
    names, units = _header(lines[start], f"{path}:{start + 1}")
    if units:
        run["channels"] = _described(units)
    numbers = _numbers(lines, start + 1, len(names), path)
    results = Results(time=numbers[:, 0], names=names[1:], values=numbers[:, 1:], **run)
    return Table(results, comments)


def _described(units: dict[str, str]) -> dict[str, Any]:
    """Columns of which the header names the unit."""
    from adamslite.results.channels import Channel, with_units

    time = Channel("time", "", "", "", "time", units.pop("time", ""))
    return {**with_units(units), **({"time": time} if time.unit else {})}


def _ending(meta: dict[str, str]) -> tuple[Outcome, str]:
    """How the run ended, which a comment of an early end says; taken out of the comments."""
    name, _, message = meta.get("outcome", "").partition(" ")
    if name not in Outcome.__members__:
        return Outcome.DONE, ""
    del meta["outcome"]
    return Outcome[name], message


def _one_line(text: str) -> str:
    return " ".join(str(text).split())


def _leading_comments(lines: list[str]) -> tuple[tuple[tuple[int, str], ...], int]:
    comments = []
    for index, line in enumerate(lines):
        if line.startswith("#"):
            comments.append((index + 1, line[1:].strip()))
        elif line.strip():
            return tuple(comments), index
    return tuple(comments), len(lines)


def _comments_behind(lines: list[str], start: int) -> tuple[tuple[int, str], ...]:
    """Comments behind the last row, which are taken out of the lines."""
    end = len(lines)
    while end > start and (not lines[end - 1].strip() or lines[end - 1].startswith("#")):
        end -= 1
    comments, _ = _leading_comments(lines[end:])
    del lines[end:]
    return tuple((end + number, text) for number, text in comments)


def _key_and_value(text: str) -> tuple[str, str]:
    key, _, value = text.partition(": ")
    return key, value.strip()


def _header(line: str, place: str) -> tuple[tuple[str, ...], dict[str, str]]:
    """Names of columns, and the units of those that have one in brackets."""
    try:
        words = [name.strip() for name in next(csv.reader(io.StringIO(line)))]
    except csv.Error as fault:
        raise FormatError(f"{place}: {fault}") from None
    found = [UNIT.fullmatch(word) for word in words]
    pairs = [(m[1], m[2].strip()) if m else (w, "") for w, m in zip(words, found, strict=True)]
    names = tuple(name for name, _ in pairs)
    if names[0].casefold() != "time":
        apart = SEPARATED if len(names) == 1 and any(mark in line for mark in ";\t") else ""
        raise FormatError(
            f"{place}: the header row must start with 'time', not '{names[0]}'{apart}"
        )
    seen = set()
    for name in map(str.casefold, names):
        if name in seen:
            raise FormatError(f"{place}: the column '{name}' is there twice")
        seen.add(name)
    return names, {("time" if n == 0 else name): u for n, (name, u) in enumerate(pairs) if u}


def _numbers(lines: list[str], start: int, width: int, path: str | Path) -> np.ndarray:
    rows = [line for line in lines[start:] if line.strip()]
    if not rows:
        return np.empty((0, width))
    try:
        numbers = np.loadtxt(rows, delimiter=",", ndmin=2, comments=None)
        if numbers.shape[1] == width:
            return numbers
    except ValueError:
        pass  # the search below says which line is wrong, and why
    raise FormatError(_first_fault(lines, start, width, path))


def _first_fault(lines: list[str], start: int, width: int, path: str | Path) -> str:
    for index in range(start, len(lines)):
        cells = lines[index].split(",")
        place = f"{path}:{index + 1}"
        if lines[index].strip() and len(cells) != width:
            return f"{place}: {len(cells)} values where the header has {width} columns"
        if not lines[index].strip():
            continue
        for cell in cells:
            if not cell.strip():
                return f"{place}: a cell is empty; write nan where there is no number"
            try:
                float(cell)
            except ValueError:
                return f"{place}: '{cell.strip()}' is not a number"
    return f"{path}: the table cannot be read"


register_format(
    ".csv",
    "a table: comment lines, a row of names, then a row of numbers with all digits per time",
    write,
    read,
    growing=partial(row_by_row.GrowingFile, LAYOUT),
)
