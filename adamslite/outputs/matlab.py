"""MATLAB files (version 5): ``time``, ``values``, ``names``, ``units`` and a struct ``run``.

In MATLAB or Octave::

    load pendulum.mat
    plot(time, values(:, strcmp(names, 'PART/2.x')))
    run.deck                       % the text of the deck

The fields of ``run`` are the texts of the run, see above.
"""

from __future__ import annotations

import struct
import zlib
from io import BytesIO
from pathlib import Path
from typing import IO, Any

import numpy as np

from adamslite.errors import FormatError, UsageError
from adamslite.language.text import contents
from adamslite.outputs.mat_file import Matrix, variables
from adamslite.outputs.whole_files import whole_file
from adamslite.results.channels import with_units
from adamslite.results.formats import register_format
from adamslite.results.results import Results
from adamslite.results.run_texts import attributes, need_rows, restored
from adamslite.results.untrusted import need_plausible

#: How the file begins: a text of 116 bytes; two words follow.
HEAD = b"MATLAB 5.0 MAT-file, by adamslite".ljust(116)
NEEDED = ("time", "values", "names")
NEW = b"MATLAB 7.3 MAT-file"
#: Bytes of a variable that MATLAB takes.
LARGEST = 2**31 - 8
TOO_LARGE = (
    "The values take {size:.3g} GB, and a MATLAB file (version 5) holds {most:.3g} GB of a "
    "variable: --outputs with fewer columns, fewer STEPS, or -o FILE.csv"
)
FAULTS = (ValueError, LookupError, OverflowError, struct.error, zlib.error, MemoryError)


class _Later(np.ndarray):
    """Numbers that SciPy leaves room for: they are written block by block."""

    @staticmethod
    def of(shape: tuple[int, int]) -> np.ndarray:
        """Numbers of that shape, which are in no memory."""
        found = np.broadcast_to(np.zeros(()), shape)
        return found.view(_Later) if found.size else found

    def tobytes(self, order: Any = None) -> Any:
        """What is written: itself, see :class:`_Room`."""
        return self


class _Room:
    """A stream that leaves room for numbers that are written later, and notes where."""

    def __init__(self, stream: IO[bytes]) -> None:
        self.stream, self.places = stream, list[int]()
        self.seek, self.tell = stream.seek, stream.tell

    def write(self, data: Any) -> None:
        """Bytes, or room for numbers."""
        if isinstance(data, _Later):
            self.places.append(self.tell())
            self.seek(data.nbytes, 1)
        else:
            self.stream.write(data)

    def fill(self, results: Results) -> None:
        """Write times and values, some rows of each column after the other."""
        first, count = 0, results.count
        for time, values in results.blocks() if self.places else ():
            starts = [self.places[1] + 8 * count * k for k in range(values.shape[1])]
            columns = np.ascontiguousarray(np.vstack([time, values.T]))
            for start, column in zip([self.places[0], *starts], columns, strict=True):
                self.seek(start + 8 * first)
                self.stream.write(column.data)
            first += len(time)


def need_room(rows: int, columns: int) -> None:
    """Raise UsageError where values have more bytes than MATLAB reads."""
    size = 8 * rows * columns
    if size > LARGEST:
        raise UsageError(TOO_LARGE.format(size=size / 1e9, most=LARGEST / 1e9))


def write(results: Results, path: str | Path) -> None:
    """Write `results` to the file `path`, whole or not at all.

    Raises
    ------
    UsageError
        When they are too many for the format.
    """
    from scipy.io import savemat

    need_rows(results)
    need_room(*results.shape)
    content = {
        "time": _Later.of((results.count, 1)),
        "values": _Later.of((results.count, len(results.names))),
        "names": _cells(list(results.names)),
        "units": _cells([results.channel(name).unit for name in results.names]),
        "run": {name: np.array(text, dtype=object) for name, text in attributes(results).items()},
    }
    with whole_file(path, binary=True) as stream:
        memory = None if stream.seekable() else BytesIO()
        room = _Room(memory or stream)
        savemat(room, content)
        room.seek(0)
        room.write(HEAD)  # in place of one with the time of day
        room.fill(results)
        if memory:
            stream.write(memory.getbuffer())


def _cells(texts: list[str]) -> np.ndarray:
    """A cell array (1, n) of texts."""
    cells = np.empty((1, len(texts)), dtype=object)
    cells[0, :] = texts
    return cells


def read(path: str | Path) -> Results:
    """Read what :func:`write` wrote, or any file with ``time``, ``values`` and ``names``.

    Raises
    ------
    FormatError
        When it is no such file, or is cut off.
    """
    data = contents(path)
    if data.startswith(NEW):
        raise FormatError(f"{path} is of MATLAB 7.3 (HDF5); write it in MATLAB with save -v7")
    try:
        found = variables(data)
        missing = [name for name in NEEDED if name not in found]
        if not missing:
            need_plausible(sum(found[name].size for name in NEEDED), len(data))
            return _results(found)
    except FormatError as fault:
        raise FormatError(f"{path}: {fault}") from None
    except FAULTS as fault:
        raise FormatError(f"{path} is no MATLAB file, or is damaged: {fault}") from None
    raise FormatError(f"{path}: there is no variable '{missing[0]}' in it")


def _results(found: dict[str, Matrix]) -> Results:
    names = tuple(found["names"].texts())
    time = found["time"].numbers()
    values = found["values"].numbers()
    values = np.ascontiguousarray(values.reshape(len(names), len(time)).T)  # column by column
    units = found["units"].texts() if "units" in found else []
    run = restored(_run(found))
    channels = {} if run["source"] else with_units(dict(zip(names, units, strict=False)))
    return Results(time=time, names=names, values=values, channels=channels, **run)


def _run(found: dict[str, Matrix]) -> dict[str, str]:
    """The struct ``run`` as texts by field."""
    fields = found["run"].fields() if "run" in found else {}
    return {name: each.text() for name, each in fields.items()}


register_format(
    ".mat",
    "MATLAB and Octave: time, values, names, units, and a struct run with the texts of the run",
    write,
    read,
    need_room=need_room,
)
