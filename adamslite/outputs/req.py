"""Request files of ADAMS (`.req`), as OUTPUT/REQSAVE asks for: REQUESTs with six digits.

    line 1      the form A.R3 and a date, which is the same in all files of this program
    line 2      title of the deck, 80 places
    line 3      number of REQUESTs, units (length, mass, time, force), UCF
    then        a line for each REQUEST: id, kind, I, J, RM
    each time   a line with the time, then one for each REQUEST with F2 F3 F4 F6 F7 F8

Kinds are 1 DISPLACEMENT, 2 VELOCITY, 3 ACCELERATION, 4 FORCE and 5 expressions. F1 and F5, the
magnitudes, are not in such a file, and what a REQUEST does not have is 0. REQUESTs that have a name
instead of an id get the numbers after the largest one.

Lines 1 to 3 and the time are as in files of ADAMS, which were at hand only without any REQUEST. The
lines of REQUESTs follow what RecurDyn and MotionSolve publish of files in this form;
widths are chosen (8 places an integer, 14 a number). Reading goes by blanks, not by places.
"""

from __future__ import annotations

from collections.abc import Iterator
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np

from adamslite.errors import FormatError
from adamslite.outputs import row_by_row
from adamslite.outputs.xrf import source_of
from adamslite.results.formats import register_format
from adamslite.results.printed import Printed
from adamslite.results.results import Results
from adamslite.results.run_texts import need_rows, printable

FORM = "A.R3"
# A date of its own would make two runs of one deck differ.
DATE = "2000-01-01 00:00:00"
KINDS = {"DISPLACEMENT": 1, "VELOCITY": 2, "ACCELERATION": 3, "FORCE": 4}
EXPRESSIONS = 5
WRITTEN = ("F2", "F3", "F4", "F6", "F7", "F8")
DIGITS = 6
#: Numbers in the line of a REQUEST, and how many have to be there.
ENTRY, LEAST = 5, 4


def write(results: Results, path: str | Path) -> None:
    """Write the REQUESTs of `results` to the file `path`, whole or not at all.

    Raises
    ------
    UsageError
        When the deck of the results is not known.
    """
    need_rows(results)
    row_by_row.write(LAYOUT, results, path)


def _requests(results: Results) -> list[Any]:
    """Those of the deck that the results have all of."""
    deck, _ = source_of(results)
    return [each for each in deck.of("REQUEST") if _is_whole(each, results)]


def _is_whole(request: Any, results: Results) -> bool:
    """Whether the results have all of it."""
    return all(f"{request.label}.{name}" in results for name in request.result_names)


def _head(results: Results, long: bool) -> bytes:
    deck, _ = source_of(results)
    requests, symbols = _requests(results), results.unit_symbols
    kinds = ("length", "mass", "time", "force")
    code = "".join(f"{symbols.get(kind, '').upper():_<2.2}" for kind in kinds)
    head = (
        f" {FORM}    {DATE}               0         0  3D\n"
        f"{printable(deck.title):80.80}\n"
        f"{len(requests):5d}     {code}RACA {deck.ucf:.15E}\n"
    )
    return "".join([head, *_entries(requests)]).encode()


def _entries(requests: list[Any]) -> Iterator[str]:
    last = max((each.id for each in requests if isinstance(each.id, int)), default=0)
    for each in requests:
        number = each.id
        if not isinstance(number, int):
            last, number = last + 1, last + 1
        kind = KINDS.get(each.kind, EXPRESSIONS)
        markers = (each.i, each.j, each.rm) if each.kind else (0, 0, 0)
        numbers = (number, kind, *(m if isinstance(m, int) else 0 for m in markers))
        yield "".join(f"{each:8d}" for each in numbers) + "\n"


def _rows(results: Results) -> row_by_row.Writer:
    column = {name.casefold(): k for k, name in enumerate(results.names)}
    names = [f"{each.label}.{name}".casefold() for each in _requests(results) for name in WRITTEN]
    there = [k for k, name in enumerate(names) if name in column]
    taken = [column[names[k]] for k in there]
    line = "{:14.5E}" * len(WRITTEN) + "\n"
    form = "{:14.5E}\n" + line * (len(names) // len(WRITTEN))

    def written(time: np.ndarray, values: np.ndarray, before: row_by_row.Before) -> Iterator[bytes]:
        table = np.zeros((len(time), 1 + len(names)))
        table[:, 0] = time
        table[:, [1 + k for k in there]] = values[:, taken]
        return (form.format(*row).encode() for row in table.tolist())

    return written


def _tail(results: Results, long: bool) -> bytes:
    return b""


LAYOUT = row_by_row.Layout(_head, _rows, _tail)


def read(path: str | Path) -> Results:
    """Read a request file; the REQUESTs have the numbers that it gives them.

    Raises
    ------
    FormatError
        When it is damaged, cut off or no such file.
    """
    from adamslite.language.text import contents, decoded

    data = contents(path)
    if b"\0" in data[:4096]:
        raise FormatError(f"{path} is not a request file in text")
    lines = decoded(data).replace("\r\n", "\n").split("\n")
    if len(lines) < 3 or not lines[0].split()[:1] == [FORM]:
        raise FormatError(f"{path} is no request file of ADAMS: it does not begin with {FORM}")
    try:
        return _results(lines)
    except (ValueError, IndexError) as fault:
        raise FormatError(f"{path} is damaged or cut off: {fault}") from None


def _results(lines: list[str]) -> Results:
    count = int(lines[2].split()[0])
    ids, start = _directory(lines, count)
    numbers = np.array(" ".join(lines[start:]).split(), dtype=float)
    size = 1 + count * len(WRITTEN)
    if numbers.size % size:
        raise ValueError(f"{numbers.size} numbers are no multiple of the {size} of an output time")
    table = numbers.reshape(-1, size)
    if DATE not in lines[0]:  # ADAMS writes the first state twice
        table = table[np.append((table[1:] != table[:-1]).any(axis=1), True)[: len(table)]]
    names = tuple(f"REQUEST/{id}.{name}" for id in ids for name in WRITTEN)
    return Results(
        time=table[:, 0], names=names, values=table[:, 1:],
        meta={"deck": lines[1].strip(), "written by": "ADAMS, request file"},
        printed=Printed(digits=DIGITS),
    )  # fmt: skip


def _directory(lines: list[str], count: int) -> tuple[list[int], int]:
    """The ids of the REQUESTs and the line of the first time; a name may follow an entry."""
    ids, at = [], 3
    for number in range(count):
        if not _is_entry(lines[at]):
            raise ValueError(f"line {at + 1} is not that of a REQUEST")
        ids.append(int(lines[at].split()[0]))
        at += 1
        last = number == count - 1
        if at < len(lines) and not _is_entry(lines[at]) and not (last and _is_time(lines[at])):
            at += 1
    if len(set(ids)) < count:
        raise ValueError("two REQUESTs have one number")
    return ids, at


def _is_entry(line: str) -> bool:
    words = line.split()
    plain = all(word.removeprefix("-").isdigit() for word in words)
    return LEAST <= len(words) <= ENTRY and plain


def _is_time(line: str) -> bool:
    try:
        return len(line.split()) == 1 and float(line) is not None
    except ValueError:
        return False


register_format(
    ".req",
    "request file of ADAMS: REQUESTs without their magnitudes, with six digits",
    write,
    read,
    exact=False,
    growing=partial(row_by_row.GrowingFile, LAYOUT),
)
