"""All runs of a sweep in one file: NetCDF-3 (64-bit offsets), which xarray opens.

Dimensions are ``run`` and, where histories are kept, ``time``::

    SPRINGDAMPER_1_K, ...      (run)         the numbers that vary
    max_REQUEST_1_F2, ...      (run)         measures
    steps, t_end, ...          (run)         counters
    outcome, message           (run)         how a run ended, and why early; empty while it is ahead
    REQUEST_1_F2, ...          (run, time)   histories; not a number behind the end of a run

The attribute ``name`` of a variable is its name in the deck, ``role`` what it is. Where runs have
other output times, ``output_time`` (run, sample) has them. Attributes of the file say deck, sample
and ``sweep``, which identifies deck, numbers and what is kept; ``source`` and ``options`` (JSON)
are what the runs were made from (:mod:`adamslite.sweeps.origin`).
"""

from __future__ import annotations

import json
from collections.abc import Iterable
from io import BytesIO
from pathlib import Path
from typing import Any

import numpy as np

from adamslite.errors import FormatError, UsageError
from adamslite.language.text import contents
from adamslite.outputs.netcdf import TEXT, VERSION, identifier
from adamslite.outputs.whole_files import whole_file
from adamslite.results.untrusted import from_json
from adamslite.sweeps.job import SUMMARY
from adamslite.sweeps.recognition import DAMAGED
from adamslite.sweeps.record import Sweep

#: A variable of the format has less than 4 GB.
LARGEST = 2**32 - 4
NUMBER, MEASURE, COUNTER, HISTORY = "number", "measure", "counter", "history"


def need_room(runs: int, samples: int) -> None:
    """Reject histories that the format cannot hold.

    Raises
    ------
    UsageError
    """
    if 8 * runs * samples > LARGEST:
        raise UsageError(
            f"{runs} runs with {samples} output times are more than a NetCDF file holds for one "
            f"channel (4 GB); take fewer --steps, or --measure in place of --outputs"
        )


def write(sweep: Sweep, path: str | Path) -> None:
    """Write `sweep` to the file `path`, whole or not at all."""
    need_room(len(sweep), len(sweep.common_time))
    data = content(sweep)
    with whole_file(path, binary=True) as stream:
        stream.write(data)


def content(sweep: Sweep) -> bytes:
    """What a file of `sweep` holds."""
    from scipy.io import netcdf_file

    memory = BytesIO()
    file = netcdf_file(memory, "w", version=VERSION)
    for name, text in {**sweep.meta, "sweep": sweep.key}.items():
        setattr(file, name.replace(" ", "_"), text.encode(TEXT))
    file.written_by = json.dumps(list(sweep.meta)).encode(TEXT)
    file.createDimension("run", len(sweep))
    used = {"run", "time", "sample", "output_time", "outcome", "message", "samples"}
    _add(file, sweep, used, NUMBER, sweep.names, sweep.values.T)
    _add(file, sweep, used, MEASURE, sweep.measured, sweep.measures.T)
    _add(file, sweep, used, COUNTER, SUMMARY, sweep.summaries.T)
    _words(file, "outcome", sweep.outcomes)
    _words(file, "message", sweep.messages)
    if sweep.channels:
        _histories(file, sweep, used)
    file.flush()
    data = memory.getvalue()
    file.close()
    return data


def _histories(file: Any, sweep: Sweep, used: set[str]) -> None:
    """The histories, with the times that they have."""
    along = "time" if sweep.has_common_time else "sample"
    file.createDimension(along, _wide(sweep.common_time).shape[-1])
    variable = file.createVariable("samples", "i", ("run",))
    variable[:] = sweep.samples
    variable.long_name = b"output times of the run"
    if along == "time":
        variable = file.createVariable("time", "d", ("time",))
        variable[:] = _wide(sweep.common_time)
    else:
        variable = file.createVariable("output_time", "d", ("run", along))
        variable[:] = _wide(sweep.times())
    variable.units = sweep.units.get("time", "").encode(TEXT)
    tables = (_wide(sweep.history(k)) for k in range(len(sweep.channels)))
    _add(file, sweep, used, HISTORY, sweep.channels, tables, ("run", along))


def _wide(table: np.ndarray) -> np.ndarray:
    """The table with a column that is not a number where no run has an output time: a dimension of
    the format is not empty.
    """
    return table if table.shape[-1] else np.full((*table.shape[:-1], 1), np.nan)


def _add(
    file: Any, sweep: Sweep, used: set[str], role: str, names: Iterable[str],
    tables: Iterable[np.ndarray], dimensions: tuple[str, ...] = ("run",),
) -> None:  # fmt: skip
    for name, table in zip(names, tables, strict=True):
        variable = file.createVariable(identifier(name, used), "d", dimensions)
        variable[:] = table
        variable.role, variable.name = role.encode(TEXT), name.encode(TEXT)
        variable.long_name = name.encode(TEXT)
        variable.units = sweep.units.get(name, "").encode(TEXT)


def _words(file: Any, name: str, words: list[str]) -> None:
    """A text for each run."""
    letters = [word.encode(TEXT) for word in words]
    width = max([1, *map(len, letters)])
    file.createDimension(f"{name}_letters", width)
    variable = file.createVariable(name, "c", ("run", f"{name}_letters"))
    variable[:] = np.array(letters, dtype=f"S{width}").view("S1").reshape(len(words), width)
    variable._Encoding = TEXT.encode()


def read(path: str | Path) -> Sweep:
    """Read what :func:`write` wrote.

    Raises
    ------
    FormatError
        When it is no such file, or is cut off.
    """
    from scipy.io import netcdf_file

    data = contents(path)
    if not data.startswith(b"CDF"):
        raise FormatError(f"{path} holds no sweep")
    try:
        with netcdf_file(BytesIO(data), "r", mmap=False) as file:
            if "sweep" not in file._attributes:
                raise FormatError(f"{path} holds no sweep")
            return _sweep(file)
    except FormatError:
        raise
    except DAMAGED:  # in the words of whatever noticed it
        raise FormatError(
            f"{path} is damaged or cut off: its {len(data)} bytes are not those of a whole sweep"
        ) from None


def _sweep(file: Any) -> Sweep:
    roles = (NUMBER, MEASURE, COUNTER, HISTORY)
    found: dict[str, dict[str, np.ndarray]] = {role: {} for role in roles}
    units = {}
    for variable in file.variables.values():
        if hasattr(variable, "role"):
            name = _text(variable.name)
            found[_text(variable.role)][name] = np.array(variable[:], dtype=float)
            units[name] = _text(variable.units)
    facts = from_json(_text(file.written_by))
    sweep = Sweep(
        names=tuple(found[NUMBER]), values=np.column_stack(list(found[NUMBER].values())),
        measured=tuple(found[MEASURE]), channels=tuple(found[HISTORY]), key=_text(file.sweep),
        meta={name: _text(getattr(file, name.replace(" ", "_"))) for name in facts}, units=units,
    )  # fmt: skip
    sweep.outcomes, sweep.messages = (_read_words(file, name) for name in ("outcome", "message"))
    if {len(sweep.outcomes), len(sweep.messages)} != {len(sweep)}:
        raise ValueError(f"{len(sweep)} runs have {len(sweep.outcomes)} outcomes")
    sweep.summaries[:] = np.column_stack([found[COUNTER][name] for name in SUMMARY])
    if sweep.measured:
        sweep.measures[:] = np.column_stack(list(found[MEASURE].values()))
    if sweep.channels:
        _read_histories(file, sweep, list(found[HISTORY].values()))
    return sweep


def _read_histories(file: Any, sweep: Sweep, tables: list[np.ndarray]) -> None:
    common = "time" in file.variables
    times = np.array(file.variables["time" if common else "output_time"][:], dtype=float)
    sweep.units = {**sweep.units, "time": _text(file.variables[
        "time" if common else "output_time"].units)}  # fmt: skip
    for run, count in enumerate(np.array(file.variables["samples"][:])):
        if sweep.outcomes[run]:
            time = times[:count] if common else times[run, :count]
            values = np.column_stack([table[run, :count] for table in tables])
            sweep.histories[run] = time.copy(), values


def _read_words(file: Any, name: str) -> list[str]:
    letters = np.ascontiguousarray(file.variables[name][:])
    return [_text(row.tobytes().rstrip(b"\0")) for row in letters]


def _text(value: Any) -> str:
    return value.decode(TEXT) if isinstance(value, bytes) else str(value)
