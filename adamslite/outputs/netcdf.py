"""NetCDF-3 (64-bit offsets): arrays with units and titles, which xarray opens.

Dimensions are ``time``, ``body`` and ``axis`` (or ``angle``)::

    position, velocity, angular_velocity, acceleration,
    angular_acceleration      (time, body, axis)    of the centre of mass, in ground axes
    orientation               (time, body, angle)   3-1-3 angles psi, theta, phi [rad]
    SFORCE_5_f, REQUEST_1_F2, ...  (time)           one of each other column

``body`` holds the statements (``PART/2``). A variable has ``units`` and ``long_name``, that of a
single column also ``channel``, its name in the deck, ``quantity`` and ``title``. What a body does
not have (a POINT_MASS has no angles) is not a number. The attribute ``channels`` lists all columns
in their order (JSON); the others are the texts of the run, see above. The times are records, one
behind the other, so that a file of more than 262 144 numbers is written while its run lasts; it has
an attribute ``reserved`` of blanks, which leaves room for what the run has found.
"""

from __future__ import annotations

import json
import re
import struct
from collections.abc import Iterator
from functools import partial
from io import BytesIO
from math import prod
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from adamslite.errors import FormatError, UsageError
from adamslite.language.text import contents
from adamslite.outputs import row_by_row
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
#: Rows that the format can count.
MOST_ROWS = 2**31 - 1
TOO_LONG = "NetCDF-3 holds {most} rows, and there are {rows}: fewer STEPS, or -o FILE.csv"
#: Attributes that are known when the run has ended, for which a long file has room, and the one
#: that takes what is left of it.
LATE, ROOM_BYTES, ROOM = ("outcome", "message", "summary", "comments", "linear"), 2**14, "reserved"
HDF5 = b"\x89HDF"
TEXT = "utf-8"


class _Records:
    """What SciPy takes for the values of a variable along the time, and leaves to others: rows are
    written behind what it writes.
    """

    itemsize, dtype = 8, np.dtype(">f8")

    def __init__(self, count: int, shape: tuple[int, ...]) -> None:
        self.count, self.shape, self.size = count, (count, *shape), prod(shape)

    def __len__(self) -> int:
        return self.count

    def __getitem__(self, row: int) -> _Records:
        return self

    def __iter__(self) -> Iterator[np.ndarray]:
        return iter(())


def write(results: Results, path: str | Path) -> None:
    """Write `results` to the file `path`, whole or not at all."""
    need_rows(results)
    row_by_row.write(LAYOUT, results, path)


def content(results: Results) -> bytes:
    """What a file of `results` holds, however long."""
    need_rows(results)
    return b"".join(row_by_row.pieces(LAYOUT, results, long=False))


def _head(results: Results, long: bool) -> bytes:
    """All but the rows; in a long file there is room for whatever the run comes to."""
    need_room(*results.shape)
    texts = {name: text.encode(TEXT) for name, text in attributes(results).items()}
    if long:
        taken = sum(map(_taken, LATE, (texts.get(name, b"") for name in LATE)))
        texts[ROOM] = b" " * (ROOM_BYTES - taken)
    return _with_attributes(results, texts)


def need_room(rows: int, columns: int) -> None:
    """Raise UsageError for more rows than the format can count."""
    if rows > MOST_ROWS:
        raise UsageError(TOO_LONG.format(rows=rows, most=MOST_ROWS))


def _taken(name: str, text: bytes) -> int:
    """Bytes that an attribute takes, none without a text."""
    return 12 + sum(size + -size % 4 for size in (len(name), len(text))) if text else 0


def _with_attributes(results: Results, texts: dict[str, bytes]) -> bytes:
    from scipy.io import netcdf_file

    memory = BytesIO()
    file = netcdf_file(memory, "w", version=VERSION)
    for name, text in texts.items():
        setattr(file, name, text)
    file.channels = json.dumps(results.names).encode(TEXT)
    file.createDimension("time", None)
    variable = _variable(file, "time", ("time",), results.count)
    variable.long_name, variable.units = b"time", results.channel("time").unit.encode(TEXT)
    bodies, single = _of_bodies(results)
    _write_bodies(file, results, bodies)
    _write_single(file, results, single)
    file.flush()
    return memory.getvalue()


def _rows(results: Results) -> row_by_row.Writer:
    """What rows hold: the time, what moves, single columns."""
    bodies, single = _of_bodies(results)
    groups = [where.ravel() for where in bodies.where.values()]
    columns = np.concatenate([*groups, np.array(single, dtype=int)])
    there = np.flatnonzero(columns >= 0)

    def written(time: np.ndarray, values: np.ndarray, before: row_by_row.Before) -> Iterator[bytes]:
        rows = np.full((len(time), 1 + len(columns)), np.nan, dtype=">f8")
        rows[:, 0] = time
        rows[:, 1 + there] = values[:, columns[there]]
        yield rows.tobytes()

    return written


def _tail(results: Results, long: bool) -> bytes:
    return b""


LAYOUT = row_by_row.Layout(_head, _rows, _tail)


def _variable(file: Any, name: str, dimensions: tuple[str, ...], count: int) -> Any:
    """A variable along the time, of rows that are written elsewhere."""
    variable = file.createVariable(name, "d", dimensions)
    shape = tuple(file.dimensions[each] for each in dimensions[1:])
    variable.__dict__["data"] = _Records(count, shape)
    return variable


class _Bodies(NamedTuple):
    """What moves: labels of the statements, and by group the columns (nb, 3), -1 for none."""

    labels: list[str]
    where: dict[str, np.ndarray]


def _split(name: str) -> tuple[str, str]:
    """Body and component of a column; empty where it is none of a body."""
    body, _, part = name.rpartition(".")
    return (body, part) if part in PLACES and body.startswith(BODIES) else ("", "")


def _of_bodies(results: Results) -> tuple[_Bodies, list[int]]:
    """What moves, and the columns that are left."""
    found = [_split(name) for name in results.names]
    bodies = {body: n for n, body in enumerate(dict.fromkeys(body for body, _ in found if body))}
    columns = {group: np.full((len(bodies), 3), -1) for group in GROUPS}
    for column, (body, part) in enumerate(found):
        if body:
            group, axis = PLACES[part]
            columns[group][bodies[body], axis] = column
    where = {group: each for group, each in columns.items() if (each >= 0).any()}
    single = [column for column, (body, _) in enumerate(found) if not body]
    return _Bodies(list(bodies), where), single


def _write_bodies(file: Any, results: Results, bodies: _Bodies) -> None:
    if bodies.labels:
        _label(file, "body", [label.encode(TEXT) for label in bodies.labels])
        _label(file, "axis", [word.encode() for word in AXIS])
        if "orientation" in bodies.where:
            _label(file, "angle", [word.encode() for word in ANGLE])
    for group, where in bodies.where.items():
        last = "angle" if group == "orientation" else "axis"
        variable = _variable(file, group, ("time", "body", last), results.count)
        channel = results.channel(results.names[int(where[where >= 0][0])])
        variable.long_name = f"{channel.quantity}, ground axes".encode()
        variable.units = channel.unit.encode(TEXT)


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
        variable = _variable(file, named, ("time",), results.count)
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
    growing=partial(row_by_row.GrowingFile, LAYOUT),
    need_room=need_room,
)
