"""NetCDF-3 (64-bit offsets): arrays with units and titles, which xarray opens.

Dimensions are ``time``, ``body`` and ``axis`` (or ``angle``)::

    position, velocity, angular_velocity, acceleration,
    angular_acceleration      (time, body, axis)    of the centre of mass, in ground axes
    orientation               (time, body, angle)   3-1-3 angles psi, theta, phi [rad]
    SFORCE_5_f, REQUEST_1_F2, ...  (time)           one of each other column

``body`` holds the statements (``PART/2``). A variable has ``units`` and ``long_name``, that of a
single column also ``channel``, its name in the deck, ``quantity`` and ``title``. What a body does
not have (a POINT_MASS has no angles) is not a number. The attribute ``channels`` lists all columns
in their order (JSON); the others are the texts of the run, see above.
"""

from __future__ import annotations

import json
import re
import struct
from collections.abc import Iterator
from io import BytesIO
from pathlib import Path
from typing import IO, TYPE_CHECKING, Any

import numpy as np

from adamslite.errors import FormatError, UsageError
from adamslite.language.text import contents
from adamslite.outputs.whole_files import whole_file
from adamslite.results.channels import describe
from adamslite.results.formats import register_format
from adamslite.results.results import Results
from adamslite.results.run_texts import attributes, need_rows, restored
from adamslite.results.untrusted import from_json

if TYPE_CHECKING:
    from adamslite.results.channels import Channel

AXIS, ANGLE = ("x", "y", "z"), ("psi", "theta", "phi")
GROUPS = {
    "position": AXIS, "orientation": ANGLE,
    "velocity": ("vx", "vy", "vz"), "angular_velocity": ("wx", "wy", "wz"),
    "acceleration": ("ax", "ay", "az"), "angular_acceleration": ("alx", "aly", "alz"),
}  # fmt: skip
PLACES = {part: (group, n) for group, parts in GROUPS.items() for n, part in enumerate(parts)}
BODIES = ("PART/", "POINT_MASS/")
# 64-bit offsets: a file may be larger than 2 GB.
VERSION = 2
# Bytes of a variable, and those that the header takes for it.
LARGEST, LARGEST_TOLD = 2**32 - 4, 2**31 - 8
TOO_LARGE = (
    "'{name}' takes {size:.3g} GB, and NetCDF-3 holds {most:.3g} GB of each variable: --outputs "
    "with fewer columns, fewer STEPS, or -o FILE.csv"
)
HDF5 = b"\x89HDF"
TEXT = "utf-8"


class _Later:
    """The values of a variable, ``columns`` (nb, 3) or one of them (-1: the time), for which there
    is room: they are written block by block.  ``size`` is that of the header, which readers ignore.
    """

    itemsize = 8

    def __init__(self, count: int, columns: np.ndarray) -> None:
        self.columns, self.shape = columns, (count, *columns.shape)
        self.bytes = self.itemsize * count * columns.size
        self.size = min(self.bytes, LARGEST_TOLD) // self.itemsize

    def tobytes(self) -> _Later:
        """What is written: itself, see :class:`_Room`."""
        return self

    def of(self, time: np.ndarray, values: np.ndarray) -> bytes:
        """What belongs there of some rows: times (n,), values (n, nc)."""
        if self.columns.ndim == 0:
            return (time if self.columns < 0 else values[:, self.columns]).astype(">f8").tobytes()
        found = values[:, self.columns].astype(">f8")  # -1 takes the last column
        found[:, self.columns < 0] = np.nan
        return found.tobytes()


class _Room:
    """A stream that leaves room for values that are written later, and notes where."""

    def __init__(self, stream: IO[bytes]) -> None:
        self.stream, self.later = stream, dict[int, _Later]()
        self.seek, self.tell, self.closed = stream.seek, stream.tell, False

    def write(self, data: bytes | _Later) -> None:
        """Bytes, or room for values."""
        if isinstance(data, _Later):
            self.later[self.tell()] = data
            self.seek(data.bytes, 1)
        else:
            self.stream.write(data)

    def fill(self, results: Results) -> None:
        """Write the values."""
        first = 0
        for time, values in results.blocks():
            for at, each in self.later.items():
                self.seek(at + first * (each.bytes // max(1, results.count)))
                self.stream.write(each.of(time, values))
            first += len(values)

    def close(self) -> None:
        """The header is written; whose stream it is, closes that."""
        self.closed = True


def write(results: Results, path: str | Path) -> None:
    """Write `results` to the file `path`, whole or not at all."""
    need_rows(results)
    with whole_file(path, binary=True) as stream:
        write_to(results, stream)


def content(results: Results) -> bytes:
    """What a file of `results` holds."""
    memory = BytesIO()
    write_to(results, memory)
    return memory.getvalue()


def write_to(results: Results, stream: IO[bytes]) -> None:
    """Write `results` to an open stream, some rows at a time."""
    from scipy.io import netcdf_file

    room = _Room(stream)
    file = netcdf_file(room, "w", version=VERSION)
    for name, text in attributes(results).items():
        setattr(file, name, text.encode(TEXT))
    file.channels = json.dumps(results.names).encode(TEXT)
    # A dimension of length 0 means one that grows, which then has no records.
    file.createDimension("time", results.count or None)
    variable = _variable(file, "time", ("time",), results, np.array(-1))
    variable.long_name, variable.units = b"time", results.channel("time").unit.encode(TEXT)
    rest = _write_bodies(file, results)
    _write_single(file, results, rest)
    file.close()
    room.fill(results)


def _variable(
    file: Any, name: str, dimensions: tuple[str, ...], results: Results, columns: np.ndarray
) -> Any:
    """A variable whose values are these columns.

    Raises
    ------
    UsageError
        When it has no room in the format.
    """
    values = _Later(results.count, columns)
    if values.bytes > LARGEST:
        raise UsageError(TOO_LARGE.format(name=name, size=values.bytes / 1e9, most=LARGEST / 1e9))
    variable = file.createVariable(name, "d", dimensions)
    if results.count:
        variable.__dict__["data"] = values
    return variable


def _split(name: str) -> tuple[str, str]:
    """Body and component of a column; empty where it is none of a body."""
    body, _, part = name.rpartition(".")
    return (body, part) if part in PLACES and body.startswith(BODIES) else ("", "")


def _write_bodies(file: Any, results: Results) -> list[int]:
    """Write what moves; the columns that are left."""
    found = [_split(name) for name in results.names]
    bodies = {body: n for n, body in enumerate(dict.fromkeys(body for body, _ in found if body))}
    columns = {group: np.full((len(bodies), 3), -1) for group in GROUPS}
    for column, (body, part) in enumerate(found):
        if body:
            group, axis = PLACES[part]
            columns[group][bodies[body], axis] = column
    if bodies:
        _label(file, "body", [body.encode(TEXT) for body in bodies])
        _label(file, "axis", [word.encode() for word in AXIS])
        if (columns["orientation"] >= 0).any():
            _label(file, "angle", [word.encode() for word in ANGLE])
    for group, where in columns.items():
        if (where >= 0).any():
            last = "angle" if group == "orientation" else "axis"
            variable = _variable(file, group, ("time", "body", last), results, where)
            channel = results.channel(results.names[int(where[where >= 0][0])])
            variable.long_name = f"{channel.quantity}, ground axes".encode()
            variable.units = channel.unit.encode(TEXT)
    return [column for column, (body, _) in enumerate(found) if not body]


def _label(file: Any, name: str, labels: list[bytes]) -> None:
    """A dimension and the words along it."""
    width = max(map(len, labels))
    file.createDimension(name, len(labels))
    file.createDimension(f"{name}_letters", width)
    variable = file.createVariable(name, "c", (name, f"{name}_letters"))
    variable[:] = np.array(labels, dtype=f"S{width}").view("S1").reshape(len(labels), width)
    variable._Encoding = TEXT.encode()  # by which xarray makes texts of them


def _write_single(file: Any, results: Results, columns: list[int]) -> None:
    used = set(file.variables) | set(file.dimensions)
    for column in columns:
        name = results.names[column]
        named = identifier(name, used)
        variable = _variable(file, named, ("time",), results, np.array(column))
        channel = results.channel(name)
        variable.channel = name.encode(TEXT)
        variable.long_name = channel.long_name.encode(TEXT)
        variable.units = channel.unit.encode(TEXT)
        variable.quantity, variable.title = (
            channel.quantity.encode(TEXT),
            channel.title.encode(TEXT),
        )


def identifier(name: str, used: set[str]) -> str:
    """``REQUEST/1.F2`` as ``REQUEST_1_F2``, numbered where that is taken."""
    plain = re.sub(r"\W", "_", name, flags=re.ASCII)
    plain = plain if plain[:1].isalpha() else f"_{plain}"
    found, number = plain, 2
    while found in used:
        found, number = f"{plain}_{number}", number + 1
    used.add(found)
    return found


def read(path: str | Path) -> Results:
    """Read what :func:`write` wrote; of other files every variable along ``time``.

    Raises
    ------
    FormatError
        When it is no NetCDF-3 file, or is cut off.
    """
    from scipy.io import netcdf_file

    data = contents(path)
    if data.startswith(HDF5):
        raise FormatError(
            f"{path} is NetCDF-4 (HDF5), and NetCDF-3 is read: "
            f"`nccopy -k 64-bit-offset` converts it, or to_netcdf(format='NETCDF3_64BIT') of xarray"
        )
    if not data.startswith(b"CDF"):
        raise FormatError(f"{path} is no NetCDF file")
    try:
        with netcdf_file(BytesIO(data), "r", mmap=False) as file:
            return _results(file)
    except FormatError as fault:
        raise FormatError(f"{path}: {fault}") from None
    except (ValueError, TypeError, IndexError, KeyError, OverflowError, struct.error):
        raise FormatError(
            f"{path} is damaged or cut off: its {len(data)} bytes are not those of whole results"
        ) from None


def _results(file: Any) -> Results:
    found = {name: _text(value) for name, value in file._attributes.items()}
    if "sweep" in found:
        raise FormatError("it holds a sweep of runs, not one: adamslite.load_sweep reads it")
    if "time" not in file.variables:
        raise FormatError("there is no variable 'time' in it")
    time = np.array(file.variables["time"][:], dtype=float)
    columns = {name: values for name, values in _columns(file, len(time))}
    listed = from_json(found["channels"]) if "channels" in found else list(columns)
    missing = [name for name in listed if name not in columns]
    if missing:
        raise FormatError(f"its variables have no column {missing[0]}")
    values = np.empty((len(time), len(listed)))
    for n, name in enumerate(listed):
        values[:, n] = columns[name]
    channels = {each.name: each for each in _channels(file)}
    return Results(
        time=time, names=tuple(listed), values=values, channels=channels, **restored(found)
    )


def _columns(file: Any, nt: int) -> Iterator[tuple[str, np.ndarray]]:
    """Names and histories (nt,) of everything in the file."""
    labels = _labels(file)
    for name, variable in file.variables.items():
        if variable.dimensions[:1] != ("time",) or name == "time":
            continue
        values = np.array(variable[:], dtype=float)
        if values.shape[0] != nt:
            raise ValueError(f"'{name}' has {values.shape[0]} records, 'time' {nt}")
        if name in GROUPS and values.ndim == 3:
            for n, body in enumerate(labels):
                for axis, part in enumerate(GROUPS[name]):
                    yield f"{body}.{part}", values[:, n, axis]
        elif values.ndim == 1:
            yield _text(getattr(variable, "channel", name)), values


def _labels(file: Any) -> list[str]:
    """The bodies."""
    if "body" not in file.variables:
        return []
    letters = np.ascontiguousarray(file.variables["body"][:])
    return [_text(row.tobytes().rstrip(b"\0")) for row in letters]


def _channels(file: Any) -> Iterator[Channel]:
    """What the single columns are; those of bodies follow from their names."""
    for variable in file.variables.values():
        if hasattr(variable, "channel"):
            facts = (_text(getattr(variable, word, b"")) for word in ("quantity", "title", "units"))
            quantity, title, unit = facts
            plain = describe(_text(variable.channel), {})
            yield plain._replace(quantity=quantity, title=title, unit=unit)


def _text(value: Any) -> str:
    return value.decode(TEXT) if isinstance(value, bytes) else str(value)


register_format(
    ".nc",
    "NetCDF-3: arrays by time, body and axis with units, and the texts of deck and commands; "
    "opens in xarray",
    write,
    read,
)
