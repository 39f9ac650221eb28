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

import numpy as np

from adamslite.errors import FormatError
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
FAULTS = (ValueError, LookupError, OverflowError, struct.error, zlib.error, MemoryError)


def write(results: Results, path: str | Path) -> None:
    """Write `results` to the file `path`, whole or not at all."""
    from scipy.io import savemat

    need_rows(results)
    content = {
        "time": results.time.reshape(-1, 1),
        "values": results.values,
        "names": _cells(list(results.names)),
        "units": _cells([results.channel(name).unit for name in results.names]),
        "run": {name: np.array(text, dtype=object) for name, text in attributes(results).items()},
    }
    with whole_file(path, binary=True) as stream:
        memory = None if stream.seekable() else BytesIO()
        draft = memory or stream
        savemat(draft, content)
        draft.seek(0)
        draft.write(HEAD)  # in place of one with the time of day
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
)
