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
from math import prod
from pathlib import Path
from typing import Any

import numpy as np

from adamslite.errors import FormatError
from adamslite.language.text import contents
from adamslite.outputs.whole_files import whole_file
from adamslite.results.channels import with_units
from adamslite.results.formats import register_format
from adamslite.results.results import Results
from adamslite.results.run_texts import attributes, need_rows, restored
from adamslite.results.untrusted import need_plausible

NEEDED = ("time", "values", "names")
NEW = b"MATLAB 7.3 MAT-file"
FAULTS = (ValueError, TypeError, IndexError, KeyError, OSError, OverflowError, struct.error,
          zlib.error, NotImplementedError, MemoryError)  # fmt: skip


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
    memory = BytesIO()
    savemat(memory, content)
    with whole_file(path, binary=True) as stream:
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
    from scipy.io import loadmat, whosmat
    from scipy.io.matlab import MatReadError

    data = contents(path)
    if data.startswith(NEW):
        raise FormatError(f"{path} is of MATLAB 7.3 (HDF5); write it in MATLAB with save -v7")
    try:
        shapes = [shape for _, shape, _ in whosmat(BytesIO(data))]
        need_plausible(sum(map(prod, shapes)), len(data))
        found = loadmat(BytesIO(data), squeeze_me=False)
        missing = [name for name in NEEDED if name not in found]
        if not missing:
            return _results(found)
    except FormatError as fault:
        raise FormatError(f"{path}: {fault}") from None
    except (*FAULTS, MatReadError) as fault:
        raise FormatError(f"{path} is no MATLAB file, or is damaged: {fault}") from None
    raise FormatError(f"{path}: there is no variable '{missing[0]}' in it")


def _results(found: dict[str, Any]) -> Results:
    names = tuple(_text(cell) for cell in found["names"].ravel())
    time = np.array(found["time"], dtype=float).ravel()
    values = np.array(found["values"], dtype=float, order="C").reshape(len(time), len(names))
    units = [_text(cell) for cell in found["units"].ravel()] if "units" in found else []
    run = restored(_run(found))
    channels = {} if run["source"] else with_units(dict(zip(names, units, strict=False)))
    return Results(time=time, names=names, values=values, channels=channels, **run)


def _run(found: dict[str, Any]) -> dict[str, str]:
    """The struct ``run`` as texts by field."""
    run = found.get("run")
    fields = (run.dtype.names if run is not None and run.size else None) or ()
    return {name: _text(run[0, 0][name]) for name in fields}  # type: ignore[index]


def _text(cell: Any) -> str:
    """A text, which loadmat gives as arrays of texts in arrays; an empty one has no elements."""
    while isinstance(cell, np.ndarray):
        if cell.size == 0:
            return ""
        cell = cell.ravel()[0]
    return str(cell)


register_format(
    ".mat",
    "MATLAB and Octave: time, values, names, units, and a struct run with the texts of the run",
    write,
    read,
)
